//! What a bed of grains is made of, and how its grains are moved: the same structs in the case, the problem and the engine.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::grains::{Grain, Point};
use crate::closures::contact::LinearSpring;

/// A bed of spheres. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainBed {
    /// diameter \[m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// mobile grains
    pub mobile: usize,
    /// what the bed rests on
    pub bottom: Bottom,
    /// period along x, and period or distance of walls along y \[m]
    pub size: [f64; 2],
    /// whether walls bound y
    pub side_walls: bool,
    /// whether those are without friction
    pub smooth_walls: bool,
    /// slope angle \[rad]
    pub beta: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// contact of the grains
    pub contact: LinearSpring,
    /// how they are moved and averaged
    pub discrete: Discrete,
}

impl GrainBed {
    /// Mass of a grain \[kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        Grain::at_rest([0.0; 3], 0.5 * self.d, self.rho_p).mass()
    }

    /// Gravity along the flow, across it and normal to the bed [m/s2].
    #[must_use]
    pub fn gravity(&self) -> Point {
        [self.g * self.beta.sin(), 0.0, -self.g * self.beta.cos()]
    }
}

/// What a bed rests on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Bottom {
    /// Fixed grains side by side, their elevations at random in three steps of a third of the diameter.
    #[default]
    Steps,
    /// A slice of grains of a bed deposited before on a plane, fixed where they lie.
    Slice,
    /// A plane with the friction of the grains.
    Plane,
}

/// How grains are moved and averaged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Discrete {
    /// Simulated time after the bed has come to rest.
    #[serde(default = "duration")]
    #[schemars(extend("x-unit" = "s", "minimum" = 0.0, "maximum" = 1e5))]
    pub duration: f64,
    /// Share of that time, at its end, over which profiles are averaged.
    #[serde(default = "half")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub averaged: f64,
    /// Longest time that the grains are given to fall and come to rest.
    #[serde(default = "settle")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub settle: f64,
    /// Time step; derived from the stability limit where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub time_step: Option<f64>,
    /// Derived time step over the stability limit of a grain in a packing.
    #[serde(default = "safety")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub safety: f64,
    /// Whether a time step beyond the stability limit is taken nevertheless.
    #[serde(default)]
    pub force_time_step: bool,
    /// Listed neighbours are nearer than a diameter and this share of it.
    #[serde(default = "skin")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.01, "maximum" = 1.0))]
    pub skin: f64,
    /// Thickness of the slices of the profile over the diameter.
    #[serde(default = "slice")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.005, "maximum" = 2.0))]
    pub slice: f64,
    /// Number from which the positions of the cloud are drawn.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1_000_000))]
    pub seed: u32,
    /// Frames of the grains for ParaView, evenly spaced over the duration.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10_000))]
    pub frames: u32,
}

impl Default for Discrete {
    fn default() -> Self {
        Self {
            duration: duration(),
            averaged: half(),
            settle: settle(),
            time_step: None,
            safety: safety(),
            force_time_step: false,
            skin: skin(),
            slice: slice(),
            seed: 0,
            frames: 0,
        }
    }
}

fn duration() -> f64 {
    5.0
}
fn half() -> f64 {
    0.5
}
fn settle() -> f64 {
    1.0
}
fn safety() -> f64 {
    0.7
}
fn skin() -> f64 {
    0.15
}
fn slice() -> f64 {
    1.0 / 30.0
}
