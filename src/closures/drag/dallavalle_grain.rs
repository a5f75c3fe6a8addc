//! Drag of Dallavalle on one grain, with the hindrance of Richardson and Zaki.
//!
//! `f = (pi d^2/8) rho_f C_D |w| w`, `C_D = (C_inf + 24.4/Re) (1 - phi)^(-n)`, `Re = |w| d/nu`, w = u_f - v the slip.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `f` | drag on the grain | N |
//! | `w` | velocity of the fluid at the centre of the grain, fluctuation included, minus that of the grain | m/s |
//! | `C_inf` | drag coefficient of a fast grain: 0.4 in the source, 0.44 in the published code | 1 |
//! | `n` | exponent of the hindrance, 3.1 in the source | 1 |
//!
//! Source: Maurin et al. (2015), eq. (11)-(12), after Dallavalle (1948), Richardson & Zaki (1954), Jenkins & Hanes (1998).

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// The part of `C_D` that is inverse to the Reynolds number.
const VISCOUS: f64 = 24.4;

/// Richardson and Zaki measured up to a loose bed.
pub const RANGE: Range = Range { variable: "phi", min: 0.0, max: 0.62 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "drag",
    law: "dallavalle-grain",
    equation: "f = (π d²/8) ρ_f C_D |w| w,  C_D = (C_∞ + 24.4 ν/(|w| d)) (1 - φ)^(-n)",
    source: "Maurin et al. (2015), eq. (11)-(12); Dallavalle (1948); Richardson & Zaki (1954)",
    ranges: &[RANGE],
    standing: Standing::Validated,
};

/// Drag of Dallavalle, hindered by the other grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DallavalleGrain {
    /// Drag coefficient of a grain that is fast.
    #[serde(default = "constant")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 2.0))]
    pub constant: f64,
    /// Exponent of the hindrance.
    #[serde(default = "exponent")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 10.0))]
    pub exponent: f64,
}

fn constant() -> f64 {
    0.4
}

fn exponent() -> f64 {
    3.1
}

/// As published.
impl Default for DallavalleGrain {
    fn default() -> Self {
        Self { constant: constant(), exponent: exponent() }
    }
}

impl DallavalleGrain {
    /// Constants of the law.
    #[must_use]
    pub fn constants(&self) -> Vec<Constant> {
        vec![("C_∞", self.constant, ""), ("n", self.exponent, "")]
    }

    /// `(pi d^2/8) rho_f (1 - phi)^(-n)` [kg/m]: the drag over `C_D |w| w` without hindrance.
    #[must_use]
    pub fn size(&self, phi: f64, rho_f: f64, d: f64) -> f64 {
        PI * d * d / 8.0 * rho_f * libm::pow(1.0 - phi, -self.exponent)
    }

    /// `24.4 nu/d` [m/s]: the speed at which the viscous part is 1.
    #[must_use]
    pub fn viscous(&self, nu: f64, d: f64) -> f64 {
        VISCOUS * nu / d
    }

    /// `C_D |w|` without hindrance [m/s], for the speed `|w|` and [`Self::viscous`] [m/s].
    #[inline(always)]
    #[must_use]
    pub fn rate(&self, speed: f64, viscous: f64) -> f64 {
        self.constant * speed + viscous
    }

    /// `K d/rho_f` [m/s] and `C_inf/C_D` of the drag per volume `n f = phi (1 - phi) K w`, with
    /// `K = (3/4)(rho_f/d) C_D |w| (1 - phi)^(-n - 1)`: eq. (2.9)-(2.11) of Chassagne et al. (2023).
    #[must_use]
    pub fn per_volume<T: Real>(&self, phi: T, speed: T, viscous: f64) -> (T, T) {
        let fast = speed * self.constant;
        let whole = fast + viscous;
        ((-phi + 1.0).powf(-self.exponent - 1.0) * whole * 0.75, fast / whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAW: DallavalleGrain = DallavalleGrain { constant: 0.4, exponent: 3.1 };

    fn drag(w: f64, phi: f64, d: f64) -> f64 {
        LAW.size(phi, 1000.0, d) * LAW.rate(w.abs(), LAW.viscous(1e-6, d)) * w
    }

    #[test]
    fn a_bead_settles_as_fast_as_the_paper_says() {
        // w_s = 0.54 m/s for 6 mm of glass in water.
        let (d, weight) = (6e-3, PI / 6.0 * 6e-3_f64.powi(3) * 1500.0 * 9.81);
        let (mut low, mut high) = (0.0, 2.0);
        for _ in 0..60 {
            let w = 0.5 * (low + high);
            if drag(w, 0.0, d) < weight { low = w } else { high = w }
        }
        assert!((low - 0.54).abs() < 5e-3, "{low}");
    }

    #[test]
    fn by_hand() {
        // Re = 600: C_D = 0.4 + 24.4/600 = 0.4406667; 0.5 1000 (pi/4) 36e-6 0.4406667 0.01
        assert_relative_eq!(drag(0.1, 0.0, 6e-3), 6.229_779e-5, max_relative = 1e-6);
        assert_relative_eq!(drag(-0.1, 0.0, 6e-3), -drag(0.1, 0.0, 6e-3));
        // Hindrance: 0.5^-3.1 = 8.574188.
        assert_relative_eq!(drag(0.1, 0.5, 6e-3) / drag(0.1, 0.0, 6e-3), 8.574_187_7, max_relative = 1e-8);
    }
    #[test]
    fn drag_per_volume_is_that_of_the_grains_in_it() {
        let (phi, w, d): (f64, f64, f64) = (0.3, 0.2, 6e-3);
        let (k, share) = LAW.per_volume(phi, w, LAW.viscous(1e-6, d));
        let grains = phi / (PI / 6.0 * d.powi(3));
        assert_relative_eq!(phi * (1.0 - phi) * k * 1000.0 / d * w, grains * drag(w, phi, d), max_relative = 1e-13);
        // Re = 1200: 0.4/(0.4 + 24.4/1200).
        assert_relative_eq!(share, 0.951_625_7, max_relative = 1e-6);
    }
}
