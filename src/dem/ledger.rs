//! Balances of energy and momentum, step by step.

use super::grains::Point;
use super::tile::Moved;
use crate::numerics::sum::Sum;

/// What was given to the mobile grains since the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// kinetic energy at the beginning \[J]
    pub initial_kinetic: f64,
    /// work of contacts among grains and with walls \[J]
    pub contacts: Sum,
    /// work of gravity \[J]
    pub gravity: Sum,
    /// work of the body force \[J]
    pub body: Sum,
    /// momentum at the beginning [kg m/s]
    pub initial_momentum: Point,
    /// impulse of gravity and body force [N s]
    pub impulse: [Sum; 3],
    /// impulse of fixed grains and walls, from what acts on the former and by the latter [N s]
    pub bounds: [Sum; 3],
}

impl Ledger {
    pub(super) fn begin(&mut self, kinetic: f64, momentum: Point) {
        *self = Self { initial_kinetic: kinetic, initial_momentum: momentum, ..Self::default() };
    }

    pub(super) fn add(&mut self, moved: &Moved) {
        self.contacts.add(moved.contact_work);
        self.gravity.add(moved.gravity_work);
        self.body.add(moved.body_work);
        for k in 0..3 {
            self.impulse[k].add(moved.impulse[k]);
            self.bounds[k].add(-moved.on_fixed[k]);
        }
    }

    pub(super) fn add_walls(&mut self, force: Point, kick: f64) {
        for (sum, force) in self.bounds.iter_mut().zip(force) {
            sum.add(kick * force);
        }
    }

    /// Momentum of the mobile grains [kg m/s] minus what it was minus all impulses from outside, relative to the largest of
    /// them: round-off, if what grains do to each other cancels.
    #[must_use]
    pub fn momentum_defect(&self, momentum: Point) -> f64 {
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        let given = self.impulse.iter().zip(&self.bounds).map(|(a, b)| [a.total(), b.total()]);
        for ((now, before), [given, bounds]) in momentum.into_iter().zip(self.initial_momentum).zip(given) {
            let parts = [now, -before, -given, -bounds];
            let mut sum = Sum::default();
            for part in parts {
                sum.add(part);
                scale = scale.max(part.abs());
            }
            worst = worst.max(sum.total().abs());
        }
        if scale > 0.0 { worst / scale } else { 0.0 }
    }

    /// Kinetic energy \[J] minus what it was minus all work: round-off.
    #[must_use]
    pub fn defect(&self, kinetic: f64) -> f64 {
        let mut sum = Sum::default();
        for part in [kinetic, -self.initial_kinetic, -self.contacts.total(), -self.gravity.total(), -self.body.total()]
        {
            sum.add(part);
        }
        sum.total()
    }

    /// Largest of the energies in the balance \[J].
    #[must_use]
    pub fn scale(&self, kinetic: f64) -> f64 {
        [kinetic, self.initial_kinetic, self.contacts.total(), self.gravity.total(), self.body.total()]
            .into_iter()
            .fold(0.0, |scale, energy| scale.max(energy.abs()))
    }

    /// Impulse of gravity and body force [N s].
    #[must_use]
    pub fn given(&self) -> Point {
        self.impulse.map(|sum| sum.total())
    }
}
