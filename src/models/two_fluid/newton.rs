//! Newton's method on the column at one time.

use super::face::Mobilised;
use super::state::{Cell, HEAT, LENGTH, LOGIT, SIZE, Unknowns, VOLUME, solid};
use super::system::{Column, Linear, Memory};
use crate::closures::kinetic::Moving;

/// A step changes the logit of the solid fraction and the logarithm of the temperature by this much at most.
const LONGEST: f64 = 2.0;

/// Round-off of a balance of momentum, relative to its terms.
const ROUND_OFF: f64 = 1e-13;

/// A Newton iteration that has not converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// smallest residual
    pub residual: f64,
    /// iterations made
    pub iterations: usize,
    /// what was left to do at the end
    pub left: Left,
}

/// What a method that has not converged was left with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Left {
    /// the residual of Newton's method
    Residual,
    /// no residual, but forces that do not balance: the largest one of a cell, in units of the weight of a layer of grains
    Force(f64),
    /// a march in pseudo-time that did not slow down: the step that it ended with, in units of the time in which grains fall
    March(f64),
}

impl NotConverged {
    /// The one of two failures that came closer to a solution: an end of Newton's method before that of a march, then the smaller
    /// residual.
    #[must_use]
    pub fn closer(best: Option<Self>, failed: Self) -> Self {
        let rank = |x: &Self| (matches!(x.left, Left::March(_)), x.residual);
        best.filter(|best| rank(best) <= rank(&failed)).unwrap_or(failed)
    }
}

/// When the iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// largest change of a scaled unknown after which no step follows
    pub tolerance: f64,
    /// largest force that a cell may miss then, in units of the weight of a layer of grains: the velocities of a bed at rest are
    /// too small to say whether its stresses balance
    pub force: f64,
    /// most iterations
    pub max_iterations: usize,
}

impl Column {
    /// Solid volume of `state`.
    #[must_use]
    pub fn solid_volume(&self, state: &[Unknowns]) -> f64 {
        state.iter().zip(&self.widths).map(|(x, dz)| solid(&self.laws, x) * dz).sum()
    }

    /// Sets what follows from the other unknowns: volumes and mixing lengths from the solid fractions, and the granular
    /// temperature from the shear rates where that is what it stands for.
    pub fn accumulate(&self, state: &mut [Unknowns]) {
        let mut length = 0.0;
        for (x, dz) in state.iter_mut().zip(&self.widths) {
            length += Cell::new(&self.laws, x).clearance * dz;
            x[LENGTH] = length;
        }
        // The inertial rheology has the square of the shear rate for a temperature.
        if let Moving::Inertial(_) = self.laws.moving {
            let shear: Vec<f64> = self.shear(state).chain([0.0]).collect();
            for (x, shear) in state.iter_mut().zip(shear.windows(2)) {
                let square = 0.5 * (shear[0] * shear[0] + shear[1] * shear[1]);
                x[HEAT] = (self.laws.floors.temperature + square).ln();
            }
        }
        let mut volume = 0.0;
        for (x, dz) in state.iter_mut().zip(&self.widths).rev() {
            x[VOLUME] = volume;
            volume += solid(&self.laws, x) * dz;
        }
    }

    /// Solves for the end of a step, from `state`; the number of iterations and the last residual.
    ///
    /// # Errors
    /// [`NotConverged`] if the residual does not fall to `control.tolerance`.
    pub fn newton(
        &self,
        state: &mut [Unknowns],
        memory: &Memory,
        linear: &mut Linear,
        control: StepControl,
    ) -> Result<(usize, f64), NotConverged> {
        let mut best = f64::INFINITY;
        let (rate, velocity) = (self.laws.floors.rate, self.laws.fall().recip());
        let mut shear: Vec<f64> = self.shear(state).collect();
        let mut mobilised: Vec<Mobilised> = shear.iter().map(|shear| Mobilised(shear / shear.hypot(rate))).collect();
        // Inertia over a short time leaves a round-off of its own.
        let highest = self.widths.iter().copied().fold(0.0, f64::max);
        let allowed = control.force.max(ROUND_OFF * memory.rate * self.laws.ratio * velocity * highest);
        let mut left = Left::Residual;
        for iteration in 0..control.max_iterations {
            self.linearise(state, memory, &mobilised, linear);
            let norm = linear.norm(state);
            if !norm.is_finite() {
                return Err(NotConverged { residual: best, iterations: iteration, left: Left::Residual });
            }
            best = best.min(norm);
            let Ok(step) = linear.step(state) else {
                return Err(NotConverged { residual: best, iterations: iteration, left: Left::Residual });
            };
            let mut largest: f64 = 0.0;
            for (x, step) in state.iter_mut().zip(step.as_chunks::<SIZE>().0) {
                for (k, (value, step)) in x.iter_mut().zip(step).enumerate() {
                    match k {
                        VOLUME | LENGTH => {}
                        LOGIT | HEAT => {
                            largest = largest.max(step.abs());
                            *value += step.clamp(-LONGEST, LONGEST);
                        }
                        _ => {
                            largest = largest.max(step.abs());
                            *value += step * velocity;
                        }
                    }
                }
            }
            self.accumulate(state);
            for ((r, from), to) in mobilised.iter_mut().zip(&mut shear).zip(self.shear(state)) {
                *r = r.after(*from, to - *from, rate);
                *from = to;
            }
            left = Left::Residual;
            if largest <= control.tolerance && !control.force.is_infinite() {
                let missed = self.missed(state, memory, &mobilised);
                let force = missed.iter().flatten().fold(0.0, |most: f64, force| most.max(force.abs()));
                // A force that is no number does not balance either.
                if !(force <= allowed && missed.iter().flatten().all(|force| force.is_finite())) {
                    left = Left::Force(force);
                }
            }
            if largest <= control.tolerance && left == Left::Residual {
                // What a steady flow reports is the residual that it ends with.
                let last = if memory.rate > 0.0 {
                    norm
                } else {
                    self.linearise(state, memory, &mobilised, linear);
                    linear.norm(state)
                };
                linear.mobilised = mobilised;
                return Ok((iteration + 1, last));
            }
        }
        Err(NotConverged { residual: best, iterations: control.max_iterations, left })
    }
}
