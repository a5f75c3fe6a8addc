//! The phi(I_v) rheology of dense suspensions: sheared grains make room for each other.
//!
//! `phi(I_v) = phi_m / (1 + a I_v^(1/2))`, with `I_v = eta |du_p/dz| / P_p`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `phi` | solid fraction | 1 |
//! | `phi_m` | solid fraction at rest: that of the bed | 1 |
//! | `I_v` | viscous number | 1 |
//! | `a` | 1 in the source | 1 |
//!
//! Source: Boyer, Guazzelli & Pouliquen (2011), Phys. Rev. Lett. 107, 188301, with phi_m = 0.585.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::friction::mu_iv::VISCOUS_RANGE;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "dilatancy",
    law: "phi-iv",
    equation: "φ(I_v) = φ_bed/(1 + a I_v^(1/2)),  I_v = η |du_p/dz|/P_p",
    source: "Boyer, Guazzelli & Pouliquen (2011)",
    ranges: &[VISCOUS_RANGE],
    standing: Standing::Validated,
};

/// The solid fraction falls with the viscous number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PhiIv {
    /// Factor of the root of the viscous number.
    #[serde(default = "one")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub a: f64,
}

fn one() -> f64 {
    1.0
}

impl PhiIv {
    /// Solid fraction and particle pressure in the middle of a layer of grains, whose own weight adds to the pressure `p_p` on
    /// its top: for the strain rate times viscosity `s`, the thickness `h` in units in which the weight is phi h, and the
    /// solid fraction `phi_m` at rest. `s`, `p_p` and `h` in one unit of stress.
    ///
    /// With `q = P_p^(1/2)` the weight `P_p' = -phi` reads `q' = -phi_m/(2 (q + a s^(1/2)))`, regular where the pressure vanishes;
    /// its midpoint rule is a quadratic equation, exact for constant s, and the pressure grows by just phi h over the layer.
    #[must_use]
    pub fn under(&self, phi_m: f64, s: f64, p_p: f64, h: f64) -> (f64, f64) {
        let (top, shear) = (p_p.sqrt(), self.a * s.abs().sqrt());
        let (b, c) = (shear - top, top * shear + 0.25 * h * phi_m);
        let root = (b * b + 4.0 * c).sqrt();
        let q = if b > 0.0 { 2.0 * c / (b + root) } else { 0.5 * (root - b) };
        (phi_m * q / (q + shear), q * q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAW: PhiIv = PhiIv { a: 1.0 };

    #[test]
    fn the_law_holds_in_the_middle() {
        for a in [0.5, 1.0, 2.0] {
            for s in [0.0, 1e-14, 1e-6, 1e-2, 1e6] {
                for p in [0.0, 1e-9, 1.0] {
                    let (phi, middle) = PhiIv { a }.under(0.6, s, p, 0.01);
                    assert_relative_eq!(phi, 0.6 / (1.0 + a * (s / middle).sqrt()), max_relative = 1e-14);
                    assert!(p <= middle && middle <= p + 0.006);
                }
            }
        }
        // Under a weight beside which its own is nothing, I_v = 1/4.
        assert_relative_eq!(LAW.under(0.6, 0.25, 1.0, 1e-18).0, 0.4, max_relative = 1e-15);
    }

    #[test]
    fn what_is_left_out_is_as_published() {
        assert_eq!(toml::from_str::<PhiIv>("").unwrap(), LAW);
    }

    #[test]
    fn exact_under_a_constant_shear_rate() {
        // (q + shear)^2 = shear^2 + phi_m z below a free top.
        let (s, depth): (f64, f64) = (0.04, 0.5);
        let exact = ((s + 0.6 * depth).sqrt() - s.sqrt()).powi(2);
        for n in [1, 7, 40] {
            let h = depth / f64::from(n);
            let bottom = (0..n).fold(0.0, |p, _| p + h * LAW.under(0.6, s, p, h).0);
            assert_relative_eq!(bottom, exact, max_relative = 1e-13);
        }
    }
}
