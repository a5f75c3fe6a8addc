//! Friction of enduring contacts: `tau_el = mu_s p_el`.
//!
//! `mu_s = 0.146 + 0.228 tanh(mu_p/0.232)` from the friction mu_p between two grains, or a given number.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `mu_s` | stress ratio below which grains do not move | 1 |
//! | `mu_p` | friction coefficient between two grains | 1 |
//!
//! Limits: 0.146 for frictionless grains, whose shape alone holds them, and 0.374 for rough ones.
//! Source: fit of Chassagne et al. (2023), eq. (2.15) and (B1), to data collected by Dai, Yang & Zhou (2016).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};

const SHAPE: f64 = 0.146;
const ROUGH: f64 = 0.228;
const SATURATION: f64 = 0.232;

/// Catalogue entries.
pub static FIT: Info = Info {
    family: "static_friction",
    law: "dai",
    equation: "τ_el = μ_s p_el,  μ_s = 0.146 + 0.228 tanh(μ_p/0.232)",
    source: "Chassagne et al. (2023), eq. (B1), to data of Dai, Yang & Zhou (2016)",
    ranges: &[Range { variable: "friction", min: 0.0, max: 1.5 }],
    standing: Standing::Validated,
};
/// See [`FIT`].
pub static GIVEN: Info = Info {
    family: "static_friction",
    law: "given",
    equation: "τ_el = μ_s p_el",
    source: "Coulomb (1773); Chassagne et al. (2023), eq. (2.15)",
    ranges: &[],
    standing: Standing::Validated,
};

/// Friction of enduring contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum StaticFriction {
    /// By the friction between two grains.
    #[default]
    Dai,
    /// A given number.
    Given(Given),
}

/// A given stress ratio.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Given {
    /// Stress ratio below which grains do not move.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
}

impl StaticFriction {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::Dai => &FIT,
            Self::Given(_) => &GIVEN,
        }
    }

    /// `mu_s` for the friction `mu_p` between two grains.
    #[must_use]
    pub fn mu_s(&self, mu_p: f64) -> f64 {
        match self {
            Self::Dai => SHAPE + ROUGH * (mu_p / SATURATION).tanh(),
            Self::Given(law) => law.mu_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_source_says() {
        let law = StaticFriction::Dai;
        assert_eq!(law.mu_s(0.0), 0.146);
        assert!((law.mu_s(0.4) - 0.36).abs() < 0.002, "{}", law.mu_s(0.4));
        assert!((law.mu_s(50.0) - 0.374).abs() < 1e-12);
        assert_eq!(StaticFriction::Given(Given { mu_s: 0.3 }).mu_s(0.4), 0.3);
    }
}
