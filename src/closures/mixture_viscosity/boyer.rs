//! Hydrodynamic viscosity of a dense suspension: `eta_e = eta (1 + 5/2 phi (1 - phi/phi_max)^-1)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `eta`, `eta_e` | viscosity of the fluid and of the mixture | Pa s |
//! | `phi`, `phi_max` | solid fraction, and the one at which the grains jam | 1 |
//!
//! The contact part of the measured viscosity is left out: in two-phase models the grains carry it themselves.
//! Source: Boyer, Guazzelli & Pouliquen (2011), Phys. Rev. Lett. 107, 188301; Revil-Baudard & Chauchat (2013), eq. (16).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RelativeViscosity;
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixture_viscosity",
    law: "boyer",
    equation: "η_e = η (1 + 5/2 φ (1 - φ/φ_max)⁻¹)",
    source: "Boyer, Guazzelli & Pouliquen (2011); Revil-Baudard & Chauchat (2013), eq. (16)",
    ranges: &[Range { variable: "phi", min: 0.3, max: 0.585 }],
    standing: Standing::Experimental,
};

/// Viscosity of a dense suspension, diverging at phi_max.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Boyer {
    /// Solid fraction at which the grains jam; more than the solid fraction of the bed.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_max: f64,
}

impl RelativeViscosity for Boyer {
    fn relative(&self, phi: f64) -> f64 {
        1.0 + 2.5 * phi / (1.0 - phi / self.phi_max)
    }

    fn fluidity<T: Real>(&self, phi: T) -> T {
        let gap = -phi / self.phi_max + 1.0;
        gap / (gap + phi * 2.5)
    }

    fn phi_max(&self) -> f64 {
        self.phi_max
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::mixture_viscosity::einstein::Einstein;
    use approx::assert_relative_eq;

    #[test]
    fn dilute_limit_is_einstein_and_jamming_diverges() {
        let law = Boyer { phi_max: 0.585 };
        assert_relative_eq!(law.relative(1e-8), Einstein.relative(1e-8), max_relative = 1e-14);
        assert_relative_eq!(law.relative(0.585 / 2.0), 1.0 + 2.5 * 0.585, max_relative = 1e-14);
        assert!(law.relative(0.585 * (1.0 - 1e-9)) > 1e9);
    }
}
