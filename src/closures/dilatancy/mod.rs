//! How grains spread where they shear.

pub mod none;
pub mod phi_i;
pub mod phi_iv;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use phi_i::PhiI;
pub use phi_iv::PhiIv;

/// Law of the solid fraction of sheared grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Dilatancy {
    /// The solid fraction of the bed, sheared or not.
    #[default]
    None,
    /// The solid fraction falls with the root of the inertial number.
    PhiI(PhiI),
    /// The solid fraction falls with the viscous number.
    PhiIv(PhiIv),
}

impl Dilatancy {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &none::INFO,
            Self::PhiI(_) => &phi_i::INFO,
            Self::PhiIv(_) => &phi_iv::INFO,
        }
    }
}
