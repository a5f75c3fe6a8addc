//! Velocity of the eddies that a grain meets, which the mean flow does not know.

use super::role::role;

role! {
    /// Law of the fluctuations.
    #[derive(Default)]
    pub enum Fluctuation {
        #[default]
        none::None,
        random_walk::RandomWalk(..),
    }
}
