//! Turbulence by a mixing length: `R_xz = rho_f l_m^2 |du/dz| du/dz`.

pub mod prandtl;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use prandtl::Prandtl;

/// Law of the mixing length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MixingLength {
    /// Proportional to the distance from the wall.
    Prandtl(Prandtl),
}
