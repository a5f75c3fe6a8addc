//! Friction of the grains: the ratio mu = tau_p / P_p at which they shear.

pub mod coulomb;
pub mod mu_i;
pub mod mu_iv;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use coulomb::Coulomb;
pub use mu_i::MuI;
pub use mu_iv::MuIv;

/// Friction law of the granular phase.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Friction {
    /// One friction coefficient at any shear rate.
    Coulomb(Coulomb),
    /// Friction that grows with the inertial number.
    MuI(MuI),
    /// Friction that grows with the viscous number.
    MuIv(MuIv),
}

impl Friction {
    /// Value of `law`.
    #[must_use]
    pub fn law(&self) -> &'static str {
        match self {
            Self::Coulomb(_) => coulomb::INFO.law,
            Self::MuI(_) => mu_i::INFO.law,
            Self::MuIv(_) => mu_iv::INFO.law,
        }
    }
}
