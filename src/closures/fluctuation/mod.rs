//! Velocity of the eddies that a grain meets, which the mean flow does not know.

pub mod none;
pub mod random_walk;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use random_walk::RandomWalk;

/// Law of the fluctuations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Fluctuation {
    /// Grains meet the mean flow.
    #[default]
    None,
    /// A random velocity for each grain, drawn anew at every turn of the largest eddies.
    RandomWalk(RandomWalk),
}

impl Fluctuation {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &none::INFO,
            Self::RandomWalk(_) => &random_walk::INFO,
        }
    }
}
