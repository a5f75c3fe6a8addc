//! What two grains that touch do to each other.

pub mod linear_spring;
pub mod restitution;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use linear_spring::LinearSpring;

/// Law of contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Contact {
    /// Linear springs and a dashpot, Coulomb slider.
    LinearSpring(LinearSpring),
}

/// What the dashpot may do while grains part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Tension {
    /// The normal force never pulls.
    #[default]
    Cut,
    /// It may pull: the solution of the linear equation up to zero overlap.
    Kept,
}
