//! Velocity of the eddies that a grain meets, which the mean flow does not know.

use super::role::role;
use crate::runtime::rng::Stream;

role! {
    /// Law of the fluctuations.
    #[derive(Default)]
    pub enum Fluctuation {
        #[default]
        none::None,
        random_walk::RandomWalk(..),
    }

    /// What the laws of the fluctuations answer.
    pub trait Eddies {
        /// Whether grains meet eddies at all, which are drawn anew at every turn of the largest.
        #[must_use]
        fn are_drawn(&self) -> bool;
        /// Standard deviation [m/s] for the Reynolds stress \[Pa] at porosity `eps` in a fluid of density `rho_f` [kg/m3].
        #[must_use]
        fn deviation(&self, reynolds: f64, eps: f64, rho_f: f64) -> f64;
        /// Fluctuation along x, y and z [m/s] of standard deviation `sigma` [m/s].
        #[must_use]
        fn draw(&self, stream: &mut Stream, sigma: f64) -> [f64; 3];
    }
}
