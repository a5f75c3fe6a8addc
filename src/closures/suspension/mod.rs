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
}
