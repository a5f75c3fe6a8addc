//! Shear stress on the top of the flow: a free surface or the lid of a duct.
//!
//! The stress `tau_top` is that which the lid takes from the fluid, positive where it slows the flow.

pub mod colebrook_white;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Info, Standing};
pub use colebrook_white::ColebrookWhite;

/// Catalogue entry.
pub static FREE_SURFACE: Info = Info {
    family: "lid",
    law: "free-surface",
    equation: "τ_top = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// Catalogue entry.
pub static STRESS: Info = Info {
    family: "lid",
    law: "stress",
    equation: "τ_top given",
    source: "measured, or from another model",
    ranges: &[],
    standing: Standing::Validated,
};

/// Catalogue entry.
pub static SOLVED: Info = Info {
    family: "lid",
    law: "solved",
    equation: "τ_top such that the slope gives the wanted stress at the bed",
    source: "momentum of the whole layer above the bed",
    ranges: &[],
    standing: Standing::Validated,
};

/// What is on top of the flow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Lid {
    /// A free surface.
    #[default]
    FreeSurface,
    /// A lid whose stress is known.
    Stress(LidStress),
    /// A lid whose stress follows from the slope and the wanted Shields number or friction velocity.
    Solved,
    /// A lid with the friction law of Colebrook and White.
    ColebrookWhite(ColebrookWhite),
}

/// A lid whose stress is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LidStress {
    /// Shear stress that the lid takes from the fluid.
    #[schemars(extend("x-unit" = "Pa", "minimum" = 0.0, "maximum" = 1e6))]
    pub stress: f64,
}

impl Lid {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::FreeSurface => &FREE_SURFACE,
            Self::Stress(_) => &STRESS,
            Self::Solved => &SOLVED,
            Self::ColebrookWhite(_) => &colebrook_white::INFO,
        }
    }
}
