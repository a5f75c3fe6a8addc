//! Pressure of enduring contacts, after Johnson and Jackson: `p_el = P_0 (phi - phi_rlp)^3/(phi_max - phi)^5` above phi_rlp, 0 below.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `P_0` | elastic modulus of the packing | Pa |
//! | `phi_rlp` | random loose packing | 1 |
//! | `phi_max` | solid fraction at which the pressure diverges | 1 |
//!
//! Source: Johnson & Jackson (1987), J. Fluid Mech. 176, 67; Chassagne et al. (2023), eq. (2.14).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Enduring;
use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "elastic",
    law: "johnson-jackson",
    equation: "p_el = P₀ (φ - φ_rlp)³/(φ_max - φ)⁵ above φ_rlp",
    source: "Johnson & Jackson (1987); Chassagne et al. (2023), eq. (2.14)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.635 }],
    standing: Standing::Validated,
};

/// A packing that resists from random loose packing on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JohnsonJackson {
    /// Elastic modulus of the packing.
    #[serde(default = "p_0")]
    #[schemars(extend("x-unit" = "Pa", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub p_0: f64,
    /// Random loose packing, below phi_max of the bed.
    #[serde(default = "phi_rlp")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_rlp: f64,
}

fn p_0() -> f64 {
    0.05
}

fn phi_rlp() -> f64 {
    0.57
}

impl Default for JohnsonJackson {
    /// As published.
    fn default() -> Self {
        Self { p_0: p_0(), phi_rlp: phi_rlp() }
    }
}

impl Enduring for JohnsonJackson {
    fn constants(&self) -> Vec<Constant> {
        vec![("P₀", self.p_0, "Pa"), ("φ_rlp", self.phi_rlp, "")]
    }
}

impl JohnsonJackson {
    /// Elastic pressure in the unit of `p_0`, at the solid fraction `phi`, whose distance to phi_max is `gap` > 0.
    #[must_use]
    pub fn pressure<T: Real>(&self, phi: T, gap: T) -> T {
        let above = phi - self.phi_rlp;
        if above.value() <= 0.0 {
            return T::constant(0.0);
        }
        let square = gap * gap;
        above * above * above * self.p_0 / (square * square * gap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn from_loose_packing_to_divergence() {
        let law = JohnsonJackson { p_0: 0.05, phi_rlp: 0.57 };
        assert_eq!(law.pressure(0.57, 0.065), 0.0);
        assert_eq!(law.pressure(0.3, 0.335), 0.0);
        // 0.05 0.04^3/0.025^5 = 327.68.
        assert_relative_eq!(law.pressure(0.61, 0.025), 327.68, max_relative = 1e-10);
        assert!(law.pressure(0.635 - 1e-6, 1e-6) > 1e24);
        // It starts without a kink, like a cube.
        assert_relative_eq!(law.pressure(0.5702, 0.0648) / law.pressure(0.5701, 0.0649), 8.0, max_relative = 1e-2);
    }
}
