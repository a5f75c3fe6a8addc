//! Grains that fly one by one: the viscosity and conductivity that the drag limits.
//!
//! ```text
//! eta_salt = rho_p phi T^(1/2)/(c_0 d K),   kap_salt = eta_salt/sigma          (over rho_p d T^(1/2), with p = rho_p phi T)
//! 1/kinetic part = 1/(that of the theory) + 1/(that of saltation)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `K` | drag coefficient: the drag on the grains is phi (1 - phi) K (u_f - u_p) | kg/(m3 s) |
//! | `c_0` | correlations left out in the average; 5 in water, 20 in air | 1 |
//! | `sigma` | ratio of the two | 1 |
//!
//! The harmonic mean has a pole where the kinetic part of the theory is negative, in dense flow below e = 1/2: there nothing
//! is limited, and the run reports it. Limits: that of the theory where drag is weak, that of saltation where grains are few.
//! Source: Jenkins, Cantat & Valance (2010), Phys. Rev. E 82, 020301; Chassagne et al. (2023), eq. (3.5)-(3.10).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.saltation",
    law: "harmonic",
    equation: "η_k → η_k η_s/(η_k + η_s),  η_s = ρ_p φ T^½/(c₀ d K),  the same for κ_k with κ_s = η_s/σ",
    source: "Jenkins, Cantat & Valance (2010); Chassagne et al. (2023), eq. (3.5)-(3.10)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.635 }],
    standing: Standing::Validated,
};

/// Catalogue entries of the role.
pub(in crate::closures) static LAWS: &[&Info] = &[&INFO];

/// What limits the kinetic parts of viscosity and conductivity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Limit {
    /// Nothing.
    None,
    /// The drag on grains that fly one by one.
    #[default]
    Harmonic,
}

/// Constants of saltation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saltation {
    /// correlations left out in the average
    pub c_0: f64,
    /// viscosity over conductivity
    pub sigma: f64,
}

impl Default for Saltation {
    /// As published for water.
    fn default() -> Self {
        Self { c_0: 5.0, sigma: 0.5 }
    }
}

impl Saltation {
    /// `eta_salt` over `rho_p d T^(1/2)`, for the drag coefficient `k` over `rho_p/d` [m/s] and the root of T [m/s].
    #[must_use]
    pub fn viscosity<T: Real>(&self, phi: T, root: T, k: T) -> T {
        phi * root / (k * self.c_0)
    }
}

/// The harmonic sum of a `kinetic` part and of that of `saltation`; the kinetic part itself where it is not positive.
#[must_use]
pub fn limited<T: Real>(kinetic: T, saltation: T) -> T {
    if kinetic.value() > 0.0 { kinetic * saltation / (kinetic + saltation) } else { kinetic }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn limits() {
        let law = Saltation::default();
        let salt = |phi: f64| law.viscosity(phi, 0.1, 2.0);
        assert_relative_eq!(limited(0.09, salt(1e-9)), salt(1e-9), max_relative = 1e-6);
        assert_relative_eq!(limited(0.09, law.viscosity(0.3, 0.1, 1e-9)), 0.09, max_relative = 1e-6);
        assert_relative_eq!(limited(0.2, 0.2), 0.1, max_relative = 1e-15);
        // Few grains carry little: the part vanishes like phi.
        assert_relative_eq!(salt(2e-7) / salt(1e-7), 2.0, max_relative = 1e-14);
    }

    #[test]
    fn no_pole_where_the_theory_is_negative() {
        assert_eq!(limited(-0.2, 0.2 + 1e-12), -0.2);
        assert_eq!(limited(0.0, 0.3), 0.0);
    }
}
