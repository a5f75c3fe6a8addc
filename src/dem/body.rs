//! What acts on each grain by itself, besides its weight: the seam to the fluid.

use super::grains::Point;

/// One grain as a body force takes it.
#[derive(Clone, Copy, Debug)]
pub struct GrainState {
    /// its name: place in the order of the scene
    pub id: u32,
    /// centre \[m]
    pub position: Point,
    /// velocity half a step before [m/s]
    pub velocity: Point,
    /// radius \[m]
    pub radius: f64,
}

/// A force on each grain, as a function of its own state.
pub trait Body: Sync {
    /// Force on a mobile grain \[N].
    fn force(&self, grain: &GrainState) -> Point;
}

/// No force.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nothing;

impl Body for Nothing {
    #[inline(always)]
    fn force(&self, _: &GrainState) -> Point {
        [0.0; 3]
    }
}

/// A layer that is pushed along the flow, in a fluid at rest that slows everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pushed {
    /// force along x on grains above the level \[N]
    pub force: f64,
    /// the level \[m]
    pub above: f64,
    /// drag coefficient: force over minus velocity [kg/s]
    pub drag: f64,
}

impl Body for Pushed {
    #[inline(always)]
    fn force(&self, grain: &GrainState) -> Point {
        let push = if grain.position[2] > self.above { self.force } else { 0.0 };
        let [u, v, w] = grain.velocity;
        [push - self.drag * u, -self.drag * v, -self.drag * w]
    }
}
