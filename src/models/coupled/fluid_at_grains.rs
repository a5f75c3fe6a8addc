//! Fluid velocity at the grains between two solutions of the fluid: mean and hindrance by cells, eddies by grains.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use crate::closures::drag::DallavalleGrain;
use crate::dem::body::{Body, GrainState};
use crate::dem::grains::Point;

/// Cells of equal height from z = 0 to the free surface, and what each grain carries with it.
#[derive(Debug)]
pub struct FluidAtGrains {
    law: DallavalleGrain,
    /// of [`DallavalleGrain::viscous`] [m/s]
    viscous: f64,
    per_height: f64,
    /// velocity of the fluid [m/s]; one more entry, for what is above the surface
    pub(super) velocity: Vec<f64>,
    /// of [`DallavalleGrain::size`] [kg/m], 0 above the surface
    pub(super) size: Vec<f64>,
    /// of each grain by name: fluctuation of the fluid [m/s], and the sum of its drag along x over the steps \[N]
    memory: Vec<[AtomicU64; 4]>,
}

/// Drag on a grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dragged {
    /// force \[N]
    pub force: Point,
    /// change of the force along x with the velocity of the fluid [kg/s]
    pub slope: f64,
}

impl FluidAtGrains {
    /// Clear fluid at rest in `cells` cells of height `height` \[m], for `grains` grains.
    #[must_use]
    pub fn new(law: DallavalleGrain, viscous: f64, cells: usize, height: f64, grains: usize) -> Self {
        let memory = (0..grains).map(|_| Default::default()).collect();
        Self {
            law,
            viscous,
            per_height: 1.0 / height,
            velocity: vec![0.0; cells + 1],
            size: vec![0.0; cells + 1],
            memory,
        }
    }

    /// Cell of the elevation `z` \[m]; below the bottom the lowest, above the surface one more than there are.
    #[inline(always)]
    #[must_use]
    pub fn cell(&self, z: f64) -> usize {
        // Negative and not a number become 0.
        ((z * self.per_height) as usize).min(self.velocity.len() - 1)
    }

    /// What the fluid does to a grain, and how that changes with its velocity.
    #[must_use]
    pub fn drag(&self, id: u32, z: f64, velocity: Point) -> Dragged {
        let (w, size) = self.slip(id, z, velocity);
        let speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let rate = self.law.rate(speed, self.viscous);
        let steeper = if speed > 0.0 { self.law.constant * w[0] * w[0] / speed } else { 0.0 };
        Dragged { force: w.map(|w| size * rate * w), slope: size * (rate + steeper) }
    }

    #[inline(always)]
    fn slip(&self, id: u32, z: f64, velocity: Point) -> (Point, f64) {
        let cell = self.cell(z);
        let [x, y, z, _] = self.memory[id as usize].each_ref().map(|word| f64::from_bits(word.load(Relaxed)));
        ([self.velocity[cell] + x - velocity[0], y - velocity[1], z - velocity[2]], self.size[cell])
    }

    /// Sets the fluctuation that grain `id` meets [m/s].
    pub fn set_fluctuation(&mut self, id: u32, fluctuation: Point) {
        for (word, x) in self.memory[id as usize].iter_mut().zip(fluctuation) {
            *word.get_mut() = x.to_bits();
        }
    }

    /// Takes the sum of the drag along x on grain `id` over the steps since it was last taken \[N].
    pub fn take(&mut self, id: u32) -> f64 {
        f64::from_bits(std::mem::take(self.memory[id as usize][3].get_mut()))
    }

    /// Counts the drag since it was last taken `times` times.
    #[cfg(test)]
    pub(super) fn repeat(&mut self, times: f64) {
        for memory in &mut self.memory {
            let sum = memory[3].get_mut();
            *sum = (times * f64::from_bits(*sum)).to_bits();
        }
    }

    /// All that the grains carry, in the order of their names.
    pub(super) fn carried(&self) -> impl Iterator<Item = f64> + '_ {
        self.memory.iter().flatten().map(|word| f64::from_bits(word.load(Relaxed)))
    }

    /// Number of the values of [`Self::carried`], and the place of each.
    pub(super) fn carried_mut(&mut self) -> impl Iterator<Item = &mut u64> + '_ {
        self.memory.iter_mut().flatten().map(AtomicU64::get_mut)
    }
}

impl Body for FluidAtGrains {
    // Each grain is one thread's: relaxed words are plain loads and stores.
    #[inline(always)]
    fn force(&self, grain: &GrainState) -> Point {
        let (w, size) = self.slip(grain.id, grain.position[2], grain.velocity);
        let speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let strength = size * self.law.rate(speed, self.viscous);
        let force = w.map(|w| strength * w);
        let sum = &self.memory[grain.id as usize][3];
        sum.store((f64::from_bits(sum.load(Relaxed)) + force[0]).to_bits(), Relaxed);
        force
    }
}
