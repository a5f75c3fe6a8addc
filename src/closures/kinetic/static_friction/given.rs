//! A stress ratio that is known: Coulomb (1773).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Threshold;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "static_friction",
    law: "given",
    equation: "τ_el = μ_s p_el",
    source: "Coulomb (1773); Chassagne et al. (2023), eq. (2.15)",
    ranges: &[],
    standing: Standing::Validated,
};

/// A given number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Given {
    /// Stress ratio below which grains do not move.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
}

impl Threshold for Given {
    fn mu_s(&self, _: f64) -> f64 {
        self.mu_s
    }
}
