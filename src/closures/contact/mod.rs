//! What two grains that touch do to each other.

pub mod restitution;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::role::laws;

laws! {{
    linear_spring::LinearSpring(..),
}}

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
