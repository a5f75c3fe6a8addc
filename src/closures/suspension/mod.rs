//! Grains in suspension above the bed.

use super::role::role;

role! {
    /// Law of the suspension.
    #[derive(Default)]
    pub enum Suspension {
        #[default]
        none::None,
        rouse::Rouse(..),
    }

    /// What the laws of the suspension answer.
    pub trait Settling {
        /// Velocity at which the grains settle [m/s]; `None` where none are in suspension, and where it is not given.
        #[must_use]
        fn settling_velocity(&self) -> Option<f64>;
    }
}

impl Suspension {
    /// The same law without a settling velocity of its own: it is that of the grains.
    #[must_use]
    pub fn of_grains(self) -> Self {
        match self {
            Self::Rouse(_) => Self::Rouse(Rouse { settling_velocity: None }),
            Self::None => self,
        }
    }

    /// The same law for grains that settle at `w_s` [m/s].
    #[must_use]
    pub fn settling_at(self, w_s: f64) -> Self {
        match self {
            Self::Rouse(_) => Self::Rouse(Rouse { settling_velocity: Some(w_s) }),
            Self::None => self,
        }
    }
}
