//! Transport coefficients of inelastic hard spheres, after Garzo and Dufty: the classical kinetic theory.
//!
//! ```text
//! p = rho_p F1 T,  eta = rho_p d F2 T^(1/2),  kappa = rho_p d F3 T^(1/2),  Gamma = -(rho_p/d) F4 T^(3/2)
//! F1 = phi [1 + 2 (1 + e) phi g0]
//! F2 = eta_k + eta_c + eta_b        eta_k = (5 sqrt(pi)/96) [1 - (2/5)(1 + e)(1 - 3e) phi g0] / {g0 [1 - (1-e)^2/4 - (5/24)(1-e^2)]}
//!                                   eta_c = (4/5)(1 + e) phi g0 eta_k      eta_b = (4/(5 sqrt(pi))) (1 + e) phi^2 g0
//! F3 = kap_k + kap_c + kap_b        kap_k = (25 sqrt(pi)/64) [1 + (3/5)(1 + e)^2 (2e - 1) phi g0] / {(1 + e) g0 [1 - (7/16)(1 - e)]}
//!                                   kap_c = (6/5)(1 + e) phi g0 kap_k      kap_b = (2/sqrt(pi)) (1 + e) phi^2 g0
//! F4 = (12/sqrt(pi)) (1 - e^2) phi^2 g0
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `T` | granular temperature, a third of the mean square of the velocity fluctuations | m2/s2 |
//! | `e`, `d` | restitution coefficient, grain diameter | 1, m |
//! | `k`, `c`, `b` | kinetic, collisional and bulk part | |
//!
//! Source: Garzo & Dufty (1999), Phys. Rev. E 59, 5895, to first order in the gradients and without the a2 (Sonine)
//! correction, as two-fluid codes use it; Chassagne et al. (2023), Table 1, left column. Below e = 1/2 kap_k is negative in
//! dense flow, and below 1/3 eta_k too.

use std::f64::consts::{FRAC_2_SQRT_PI, PI};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{DragWork, Kinetic, Moving, Radial, Stresses};
use crate::closures::kinetic::radial::AtContact;
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Where the theory keeps positive coefficients at every solid fraction.
pub const RESTITUTION_RANGE: Range = Range { variable: "restitution", min: 0.5, max: 1.0 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular",
    law: "garzo-dufty",
    equation: "p_kin = ρ_p F₁ T,  η = ρ_p d F₂ T^½,  κ = ρ_p d F₃ T^½,  Γ = -(ρ_p/d) F₄ T^(3/2)",
    source: "Garzo & Dufty (1999); Chassagne et al. (2023), Table 1, left column",
    ranges: &[RESTITUTION_RANGE],
    standing: Standing::Validated,
};

/// The classical kinetic theory of frictionless grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GarzoDufty {
    /// Radial distribution function.
    #[serde(default = "smooth")]
    pub radial: Radial,
}

fn smooth() -> Radial {
    Radial::ChialvoSundaresan
}

impl Default for GarzoDufty {
    /// As published.
    fn default() -> Self {
        Self { radial: smooth() }
    }
}

impl GarzoDufty {
    /// The theory of grains with the restitution `e`; the friction `mu_p` counts in the frictional `g_0` alone.
    #[must_use]
    pub fn kinetic(&self, e: f64, mu_p: f64) -> Kinetic {
        Kinetic {
            e,
            e_eff: e,
            radial: self.radial,
            a: self.radial.coefficient(mu_p),
            saltation: None,
            drag_work: DragWork::Linear,
        }
    }
}

impl Stresses for GarzoDufty {
    fn moving(&self, e: f64, mu_p: f64) -> Moving {
        Moving::Kinetic(self.kinetic(e, mu_p))
    }

    fn parts(&self) -> Vec<&'static Info> {
        vec![self.radial.info()]
    }
}

/// `F1` at the solid fraction `phi`, for `g0` and the restitution `e`.
#[must_use]
pub fn pressure<T: Real>(phi: T, g0: T, e: f64) -> T {
    phi * pressure_per_grain(phi, g0, e)
}

/// `F1/phi`, finite in the dilute limit.
#[must_use]
pub fn pressure_per_grain<T: Real>(phi: T, g0: T, e: f64) -> T {
    phi * g0 * (2.0 * (1.0 + e)) + 1.0
}

/// The parts (kinetic, collisional + bulk) of a coefficient; the collisional part goes with the kinetic one of the theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts<T> {
    /// `eta_k` or `kap_k`
    pub kinetic: T,
    /// the rest
    pub contact: T,
}

/// The parts of `F2`.
#[must_use]
#[inline]
pub fn viscosity<T: Real>(phi: T, g0: T, e: f64) -> Parts<T> {
    let x = phi * g0;
    let below = 1.0 - 0.25 * (1.0 - e) * (1.0 - e) - 5.0 / 24.0 * (1.0 - e * e);
    let kinetic = (x * (-0.4 * (1.0 + e) * (1.0 - 3.0 * e)) + 1.0) * (5.0 * PI.sqrt() / 96.0) / (g0 * below);
    let bulk = phi * x * (0.4 * FRAC_2_SQRT_PI * (1.0 + e));
    Parts { kinetic, contact: x * kinetic * (0.8 * (1.0 + e)) + bulk }
}

/// The parts of `F3`.
#[must_use]
#[inline]
pub fn conductivity<T: Real>(phi: T, g0: T, e: f64) -> Parts<T> {
    let x = phi * g0;
    let below = (1.0 + e) * (1.0 - 7.0 / 16.0 * (1.0 - e));
    let above = x * (0.6 * (1.0 + e) * (1.0 + e) * (2.0 * e - 1.0)) + 1.0;
    let kinetic = above * (25.0 * PI.sqrt() / 64.0) / (g0 * below);
    let bulk = phi * x * (FRAC_2_SQRT_PI * (1.0 + e));
    Parts { kinetic, contact: x * kinetic * (1.2 * (1.0 + e)) + bulk }
}

/// `F4/phi` for the restitution `e` that dissipates, the effective one where friction counts.
#[must_use]
pub fn dissipation_per_grain<T: Real>(phi: T, g0: T, e: f64) -> T {
    phi * g0 * (6.0 * FRAC_2_SQRT_PI * (1.0 - e * e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::kinetic::Radial;
    use crate::numerics::dual::Dual;
    use approx::assert_relative_eq;

    fn sum(parts: Parts<f64>) -> f64 {
        parts.kinetic + parts.contact
    }

    #[test]
    fn dilute_elastic_limits_are_those_of_a_gas() {
        // 5 sqrt(pi)/96 and 75 sqrt(pi)/384: the viscosity and conductivity of a dilute gas of hard spheres.
        assert_relative_eq!(sum(viscosity(1e-12, 1.0, 1.0)), 0.092_315_3, max_relative = 1e-6);
        assert_relative_eq!(sum(conductivity(1e-12, 1.0, 1.0)), 0.346_182_4, max_relative = 1e-6);
        // Their ratio is that of Eucken, 15/4.
        assert_relative_eq!(
            sum(conductivity(1e-12, 1.0, 1.0)) / sum(viscosity(1e-12, 1.0, 1.0)),
            3.75,
            max_relative = 1e-9
        );
        assert_relative_eq!(pressure(1e-9, 1.0, 0.7) / 1e-9, 1.0, max_relative = 1e-8);
    }

    #[test]
    fn dense_limits() {
        // g0 -> infinity: F1 -> 2 (1 + e) phi^2 g0, and F2 and F3 go with g0 too.
        let (phi, g0) = (0.6, 1e9);
        assert_relative_eq!(pressure(phi, g0, 0.7), 2.0 * 1.7 * 0.36 * g0, max_relative = 1e-8);
        // Enskog's elastic viscosity over pressure: (12/25 + ...) by hand: (4/5 2 phi x)(5 sqrt(pi)/96)(8/5) + 8/(5 sqrt(pi)).
        let by_hand = 0.36 * g0 * (1.6 * 1.6 * 5.0 * PI.sqrt() / 96.0 + 1.6 / PI.sqrt());
        assert_relative_eq!(sum(viscosity(phi, g0, 1.0)), by_hand, max_relative = 1e-8);
        assert!(conductivity(phi, g0, 0.3).kinetic < 0.0 && sum(conductivity(phi, g0, 0.3)) > 0.0);
        assert!(viscosity(phi, g0, 0.3).kinetic < 0.0 && sum(viscosity(phi, g0, 0.3)) > 0.0);
    }

    #[test]
    fn where_the_conductivity_turns_negative() {
        // e = 0.3, friction 0.4, from phi = 0.384 on.
        let law = Radial::Frictional;
        let kinetic = |phi: f64| conductivity(phi, law.contact(phi, 0.635 - phi, law.coefficient(0.4)), 0.3).kinetic;
        assert!(kinetic(0.383) > 0.0 && kinetic(0.385) < 0.0);
    }

    #[test]
    fn dissipation_vanishes_for_elastic_grains() {
        assert_eq!(dissipation_per_grain(0.4, 3.0, 1.0), 0.0);
        // 12/sqrt(pi) 0.51 0.4 3.
        assert_relative_eq!(dissipation_per_grain(0.4, 3.0, 0.7), 4.143_408, max_relative = 1e-6);
    }

    #[test]
    fn derivatives_against_differences() {
        let law = Radial::Frictional;
        let value = |phi: f64| {
            let g0 = law.contact(phi, 0.635 - phi, 2.5);
            sum(viscosity(phi, g0, 0.7)) + sum(conductivity(phi, g0, 0.7)) + pressure(phi, g0, 0.7)
        };
        for phi in [0.01, 0.3, 0.6] {
            let x = Dual::<1>::variable(phi, 0);
            let g0 = law.contact(x, -x + 0.635, 2.5);
            let (eta, kappa) = (viscosity(x, g0, 0.7), conductivity(x, g0, 0.7));
            let slope = (eta.kinetic + eta.contact + kappa.kinetic + kappa.contact + pressure(x, g0, 0.7)).slope[0];
            let h = 1e-6;
            assert_relative_eq!(slope, (value(phi + h) - value(phi - h)) / (2.0 * h), max_relative = 1e-6);
        }
    }
}
