//! The fully rough wall: the velocity vanishes at `z_0 = k_s/30`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `k_s` | Nikuradse's equivalent sand roughness | m |
//! | `z_0` | roughness length | m |
//!
//! Source: Nikuradse (1933); fully rough where u_* k_s/nu is above about 70.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};

/// Where the viscosity does not matter.
pub const ROUGH_RANGE: Range = Range { variable: "roughness_reynolds", min: 70.0, max: f64::INFINITY };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "wall",
    law: "rough",
    equation: "u(z_0) = 0,  z_0 = k_s/30",
    source: "Nikuradse (1933)",
    ranges: &[ROUGH_RANGE],
    standing: Standing::Validated,
};

/// Fully rough: the viscosity does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rough {
    /// Equivalent sand roughness k_s.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub k_s: f64,
}

impl Rough {
    /// Elevation z_0 \[m] at which the logarithmic profile vanishes.
    #[must_use]
    pub fn roughness_length(&self) -> f64 {
        self.k_s / 30.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thirtieth() {
        assert_eq!(Rough { k_s: 0.03 }.roughness_length(), 0.001);
    }
}
