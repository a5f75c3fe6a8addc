//! What a wall does to a turbulent flow.

pub mod rough;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use rough::Rough;

/// Law of the wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Wall {
    /// Fully rough: the viscosity does not matter.
    Rough(Rough),
}
