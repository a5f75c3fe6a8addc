//! The dilatancy law phi(I): `phi = phi_max/(1 + b sqrt(I))`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `phi`, `phi_max` | solid fraction, and that of the bed at rest | 1 |
//! | `I` | inertial number, by the largest rearrangement time | 1 |
//! | `b` | constant of order 1; Boyer et al. have 1 | 1 |
//!
//! Measured for 0.4 <= phi <= 0.585; against other data down to 0.3.
//! Source: Boyer, Guazzelli & Pouliquen (2011), Phys. Rev. Lett. 107, 188301; Revil-Baudard & Chauchat (2013), eq. (24).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Where it was measured.
pub const RANGE: Range = Range { variable: "phi", min: 0.3, max: 0.62 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "dilatancy",
    law: "phi-i",
    equation: "φ = φ_max/(1 + b I^½)",
    source: "Boyer, Guazzelli & Pouliquen (2011); Revil-Baudard & Chauchat (2013), eq. (24)",
    ranges: &[RANGE],
    standing: Standing::Validated,
};

/// The solid fraction falls with the root of the inertial number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PhiI {
    /// Solid fraction of the bed at rest.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_max: f64,
    /// Constant b of order 1.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub b: f64,
}

/// Of spheres: Maurin et al. (2016), J. Fluid Mech. 804, 490-512.
impl Default for PhiI {
    fn default() -> Self {
        Self { phi_max: 0.61, b: 0.31 }
    }
}

impl PhiI {
    /// Solid fraction at the inertial number `i`.
    #[must_use]
    pub fn solid_fraction<T: Real>(&self, i: T) -> T {
        T::constant(self.phi_max) / (i.sqrt() * self.b + 1.0)
    }

    /// Inertial number at the solid fraction `phi` up to phi_max.
    #[must_use]
    pub fn inertial_number(&self, phi: f64) -> f64 {
        ((self.phi_max / phi - 1.0) / self.b).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAW: PhiI = PhiI { phi_max: 0.6, b: 0.75 };

    #[test]
    fn limits_and_a_value_by_hand() {
        assert_eq!(LAW.solid_fraction(0.0), 0.6);
        assert_relative_eq!(LAW.solid_fraction(16.0), 0.15, max_relative = 1e-15);
        assert!(LAW.solid_fraction(1e12) > 0.0);
    }

    #[test]
    fn inverse() {
        for i in [1e-8, 1e-3, 1.0, 30.0] {
            assert_relative_eq!(LAW.inertial_number(LAW.solid_fraction(i)), i, max_relative = 1e-6);
        }
    }
}
