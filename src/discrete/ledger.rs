//! Energy and momentum, accounted for step by step.

use super::grains::Point;
use super::tile::Moved;
use crate::numerics::sum::Sum;

/// What was given to the mobile grains since the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// kinetic energy at the beginning [J]
    pub initial_kinetic: f64,
    /// work of contacts among grains and with walls [J]
    pub contacts: Sum,
    /// work of gravity [J]
    pub gravity: Sum,
    /// work of the body force [J]
    pub body: Sum,
    /// impulse of gravity and body force [N s]
    pub impulse: [Sum; 3],
}

impl Ledger {
    pub(super) fn begin(&mut self, kinetic: f64) {
        *self = Self { initial_kinetic: kinetic, ..Self::default() };
    }

    pub(super) fn add(&mut self, moved: &Moved) {
        self.contacts.add(moved.contact_work);
        self.gravity.add(moved.gravity_work);
        self.body.add(moved.body_work);
        for (sum, part) in self.impulse.iter_mut().zip(moved.impulse) {
            sum.add(part);
        }
    }

    /// Kinetic energy [J] minus what it was minus all work: round-off.
    #[must_use]
    pub fn defect(&self, kinetic: f64) -> f64 {
        let mut sum = Sum::default();
        for part in [kinetic, -self.initial_kinetic, -self.contacts.total(), -self.gravity.total(), -self.body.total()]
        {
            sum.add(part);
        }
        sum.total()
    }

    /// Largest of the energies in the balance [J].
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
