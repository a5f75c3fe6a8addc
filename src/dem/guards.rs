//! When the grains cannot go on: who, where and when.

use super::engine::Engine;
use super::error::{GrainError, Place};
use super::law::ContactLaw;
use super::stability;

impl<C: ContactLaw> Engine<C> {
    /// The first grain whose state is no number, or that has left.
    pub(super) fn look_for_madness(&self, and_lost: bool) -> Result<(), GrainError> {
        for i in 0..self.grains.len() {
            let rows = [self.grains.positions[i], self.grains.velocities[i], self.grains.spins[i]];
            if rows.iter().any(|row| row.0.iter().any(|x| !x.is_finite())) {
                return Err(GrainError::NotFinite { place: self.place(i) });
            }
            if and_lost && self.grains.position(i)[2] < self.settings.lowest {
                return Err(GrainError::Lost { place: self.place(i), lowest: self.settings.lowest });
            }
        }
        Ok(())
    }

    pub(super) fn overlap_error(&self) -> GrainError {
        let limit = self.settings.largest_overlap;
        if let Err(error) = self.look_for_madness(false) {
            return error;
        }
        let deepest = self.contacts().max_by(|a, b| a.ratio.total_cmp(&b.ratio));
        match deepest {
            Some(contact) => GrainError::Overlap {
                place: self.place(contact.first),
                other: contact.second.map(|j| self.grains.ids[j]),
                ratio: contact.ratio,
                limit,
            },
            None => GrainError::NotFinite { place: self.place(0) },
        }
    }

    /// Refuses a time step beyond what the present contacts bear.
    ///
    /// # Errors
    /// [`GrainError::StepTooLong`] with the grain that sets the limit.
    pub fn check_step(&self) -> Result<(), GrainError> {
        let limit = stability::limit(self);
        if self.settings.dt <= limit.step {
            return Ok(());
        }
        Err(GrainError::StepTooLong {
            place: self.place(limit.grain),
            step_s: self.settings.dt,
            limit_s: limit.step,
            contacts: limit.contacts,
        })
    }

    pub(super) fn place(&self, i: usize) -> Place {
        Place { grain: self.grains.ids[i], step: self.step, position: self.grains.position(i) }
    }
}
