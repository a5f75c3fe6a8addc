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
        /// Velocity at which the grains settle [m/s]; `None` where none are in suspension.
        #[must_use]
        fn settling_velocity(&self) -> Option<f64>;
    }
}
