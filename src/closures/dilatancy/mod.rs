//! Dilatancy of the grains: the solid fraction at which they shear.

pub mod phi_i;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use phi_i::PhiI;

/// Dilatancy law of the granular phase.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Dilatancy {
    /// Solid fraction that falls with the root of the inertial number.
    PhiI(PhiI),
}

impl Dilatancy {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::PhiI(_) => &phi_i::INFO,
        }
    }
}
