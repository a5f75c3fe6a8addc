//! Drag of Dallavalle with the hindrance of Richardson and Zaki.
//!
//! `n f = C_D (U - u_p)`, `C_D = rho_f phi/(d (1 - phi)^n) (0.3 |U - u_p| + 18.3 eta/(rho_f d))`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `n f` | drag on the grains per volume | N/m3 |
//! | `U`, `u_p` | mixture velocity (1 - phi) u_f + phi u_p, and that of the grains | m/s |
//! | `C_D` | drag coefficient | kg/(m3 s) |
//! | `d`, `phi` | grain diameter, solid fraction | m, 1 |
//! | `n` | exponent of the hindrance, 3.1 in the source | 1 |
//!
//! The slip is that of the mixture, as the source writes it. As a pure number, for the rearrangement time in a turbulent
//! fluid, the coefficient is `(4/3)(0.3 + 18.3/Re)`, `Re = rho_f |U - u_p| d/eta`.
//! Source: Revil-Baudard & Chauchat (2013), eq. (11), after Jenkins & Hanes (1998), Hsu et al. (2004).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// The quadratic part, and the one that is linear in the velocity.
const PARTS: (f64, f64) = (0.3, 18.3);

/// Richardson and Zaki measured up to a loose bed.
pub const RANGE: Range = Range { variable: "phi", min: 0.0, max: 0.62 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "drag",
    law: "dallavalle",
    equation: "n f = C_D (U - u_p),  C_D = ρ_f φ/(d (1 - φ)^n) (0.3 |U - u_p| + 18.3 η/(ρ_f d))",
    source: "Revil-Baudard & Chauchat (2013), eq. (11); Dallavalle (1948); Richardson & Zaki (1954)",
    ranges: &[RANGE],
    standing: Standing::Validated,
};

/// Drag of single grains, hindered by their neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Dallavalle {
    /// Exponent of the hindrance.
    #[serde(default = "exponent")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 10.0))]
    pub exponent: f64,
}

fn exponent() -> f64 {
    3.1
}

/// As published.
impl Default for Dallavalle {
    fn default() -> Self {
        Self { exponent: exponent() }
    }
}

impl Dallavalle {
    /// Constants of the law.
    #[must_use]
    pub fn constants(&self) -> Vec<Constant> {
        vec![("exponent n", self.exponent, "")]
    }

    /// `C_D` [kg/(m3 s)] for the solid fraction `phi`, the slip `w` [m/s], and of the fluid the density `rho_f` [kg/m3] and
    /// viscosity `eta` [Pa s]; grains of diameter `d` \[m].
    #[must_use]
    pub fn coefficient<T: Real>(&self, phi: T, w: T, (rho_f, eta): (f64, f64), d: f64) -> T {
        let speed = w.abs() * PARTS.0 + PARTS.1 * eta / (rho_f * d);
        phi * speed * (rho_f / d) / (-phi + 1.0).powf(self.exponent)
    }
}

/// `1/C` of the pure number `C = (4/3)(0.3 + 18.3/Re)`; 0 at rest.
#[must_use]
pub fn inverse_number<T: Real>(w: T, (rho_f, eta): (f64, f64), d: f64) -> T {
    let speed = w.abs();
    speed * 0.75 / (speed * PARTS.0 + PARTS.1 * eta / (rho_f * d))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const WATER: (f64, f64) = (1000.0, 1e-3);

    #[test]
    fn a_value_by_hand_and_the_creeping_limit() {
        let law = Dallavalle { exponent: 3.1 };
        // 1000*0.5/(1e-3 * 0.5^3.1) (0.3*0.1 + 18.3*1e-6/1e-3) = 5e5*8.574188*0.0483
        assert_relative_eq!(law.coefficient(0.5, 0.1, WATER, 1e-3), 207_066.64, max_relative = 1e-6);
        assert_relative_eq!(law.coefficient(0.5, -0.1, WATER, 1e-3), law.coefficient(0.5, 0.1, WATER, 1e-3));
        let creeping = Dallavalle { exponent: 0.0 }.coefficient(0.5, 0.0, WATER, 1e-3);
        assert_relative_eq!(creeping, 18.3 * 0.5 * 1e-3 / 1e-6, max_relative = 1e-14);
    }

    #[test]
    fn the_pure_number() {
        // Re = 100
        assert_relative_eq!(inverse_number(0.1, WATER, 1e-3), 1.0 / (4.0 / 3.0 * (0.3 + 0.183)), max_relative = 1e-14);
        assert_eq!(inverse_number(0.0, WATER, 1e-3), 0.0);
    }
}
