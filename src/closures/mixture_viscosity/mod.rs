//! Effective viscosity of a fluid with grains, relative to the clear fluid.

pub mod boyer;
pub mod clear;
pub mod einstein;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use boyer::Boyer;

/// Law of the effective viscosity eta_e of the mixture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MixtureViscosity {
    /// The grains do not change the viscosity.
    Clear,
    /// Einstein's dilute viscosity, which the papers use in dense beds too.
    Einstein,
    /// Viscosity of a dense suspension, diverging at phi_max.
    Boyer(Boyer),
}

impl MixtureViscosity {
    /// `eta_e/eta` at the solid fraction `phi`.
    #[must_use]
    pub fn relative(&self, phi: f64) -> f64 {
        match self {
            Self::Clear => clear::relative(phi),
            Self::Einstein => einstein::relative(phi),
            Self::Boyer(law) => law.relative(phi),
        }
    }

    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::Clear => &clear::INFO,
            Self::Einstein => &einstein::INFO,
            Self::Boyer(_) => &boyer::INFO,
        }
    }
}
