//! Grains in suspension above the bed.

pub mod rouse;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Info, Standing};
pub use rouse::Rouse;

/// Catalogue entry of the neutral law.
pub static NONE: Info = Info {
    family: "suspension",
    law: "none",
    equation: "φ = 0 above the bed",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// Law of the suspension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Suspension {
    /// Clear fluid above the bed.
    #[default]
    None,
    /// Settling against turbulent diffusion.
    Rouse(Rouse),
}

impl Suspension {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &NONE,
            Self::Rouse(_) => &rouse::INFO,
        }
    }
}
