//! Grains that the turbulence carries from where they are many to where they are few: a drift velocity in the drag.
//!
//! `n f = phi (1 - phi) K (u_f - u_p + u_d)`, `u_d = -(nu_t/S_c) grad(phi)/phi`
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `u_d` | drift velocity | m/s |
//! | `nu_t` | eddy viscosity | m2/s |
//! | `S_c` | Schmidt number: 1/3 in the source | 1 |
//!
//! The source prints eq. (4.4) without the minus sign, which would pile the grains up: a drift towards fewer grains is meant.
//! Source: Chassagne et al. (2023), eq. (4.3)-(4.4), after Rouse (1937) and Chauchat (2018).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Info, Standing};

/// Catalogue entries.
pub static NONE: Info = Info {
    family: "dispersion",
    law: "none",
    equation: "u_d = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};
/// See [`NONE`].
pub static GRADIENT: Info = Info {
    family: "dispersion",
    law: "gradient",
    equation: "u_d = -(ν_t/S_c) ∇φ/φ",
    source: "Chassagne et al. (2023), eq. (4.3)-(4.4); Chauchat (2018)",
    ranges: &[],
    standing: Standing::Experimental,
};

/// Dispersion of the grains by turbulence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Dispersion {
    /// The turbulence does not carry grains.
    #[default]
    None,
    /// A drift towards fewer grains.
    Gradient(Gradient),
}

/// A drift towards fewer grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Gradient {
    /// Schmidt number S_c: eddy viscosity over the diffusivity of the grains.
    #[serde(default = "schmidt")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub schmidt: f64,
}

fn schmidt() -> f64 {
    1.0 / 3.0
}

impl Dispersion {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &NONE,
            Self::Gradient(_) => &GRADIENT,
        }
    }

    /// Diffusivity of the grains over the eddy viscosity.
    #[must_use]
    pub fn strength(&self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Gradient(law) => 1.0 / law.schmidt,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_published() {
        let law: Dispersion = toml::from_str("law = \"gradient\"").unwrap();
        assert!((law.strength() - 3.0).abs() < 1e-15);
        assert_eq!(Dispersion::None.strength(), 0.0);
    }
}
