//! The mu(I) rheology of dense granular flow.
//!
//! `mu(I) = mu_s + (mu_2 - mu_s) / (I_0/I + 1)`, with `I = d |du_p/dz| sqrt(rho_p/P_p)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `I` | inertial number | 1 |
//! | `mu_s`, `mu_2` | friction at vanishing and at large I | 1 |
//! | `I_0` | inertial number at which mu is half-way | 1 |
//!
//! Source: Jop, Forterre & Pouliquen (2006), Nature 441, 727-730; as used by Revil-Baudard & Chauchat (2013),
//! J. Geophys. Res. Oceans 118, eq. (20).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Where the dense-flow law holds; below it the flow is quasi-static, above it collisional.
pub const INERTIAL_RANGE: Range = Range { variable: "inertial_number", min: 0.0, max: 2.0 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "friction",
    law: "mu-i",
    equation: "μ(I) = μ_s + (μ_2 - μ_s)/(I_0/I + 1)",
    source: "Jop, Forterre & Pouliquen (2006); Revil-Baudard & Chauchat (2013), eq. (20)",
    ranges: &[INERTIAL_RANGE],
    standing: Standing::Validated,
};

/// Friction that grows with the inertial number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MuI {
    /// Friction coefficient at vanishing inertial number.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
    /// Friction coefficient at large inertial number; more than mu_s.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 3.0))]
    pub mu_2: f64,
    /// Inertial number at which the friction is half-way between mu_s and mu_2.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub i_0: f64,
}

impl MuI {
    /// Friction coefficient at the inertial number `i`.
    #[must_use]
    pub fn mu(&self, i: f64) -> f64 {
        self.mu_s + (self.mu_2 - self.mu_s) * i / (self.i_0 + i)
    }

    /// The inertial number at which the friction is `mu`: 0 up to mu_s, `None` from mu_2 on.
    #[must_use]
    pub fn inertial_number(&self, mu: f64) -> Option<f64> {
        if mu <= self.mu_s {
            Some(0.0)
        } else if mu < self.mu_2 {
            Some(self.i_0 * (mu - self.mu_s) / (self.mu_2 - mu))
        } else {
            None
        }
    }

    /// The inertial number at which the regularised friction `mu(I) I/(I + creep)` is `r`, between 0 and mu_2; `creep` is
    /// the regularisation lambda times the rearrangement time. Closed form, and for `creep = 0` the exact yield: the
    /// positive root of `(mu_2 - r) I^2 - (I_0 (r - mu_s) + r creep) I - r creep I_0 = 0`.
    #[must_use]
    pub fn mobilised<T: Real>(&self, r: T, creep: T) -> T {
        let a = -r + self.mu_2;
        let above = (r - self.mu_s) * self.i_0;
        if creep.value() == 0.0 {
            return if above.value() > 0.0 { above / a } else { T::constant(0.0) };
        }
        let (b, c) = (above + r * creep, r * creep * self.i_0);
        let root = (b * b + a * c * 4.0).sqrt();
        // The form without a difference of nearly equal numbers.
        if b.value() >= 0.0 { (b + root) / (a * 2.0) } else { c * 2.0 / (root - b) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAW: MuI = MuI { mu_s: 0.38, mu_2: 0.64, i_0: 0.279 };

    #[test]
    fn limits() {
        assert_eq!(LAW.mu(0.0), 0.38);
        assert_relative_eq!(LAW.mu(LAW.i_0), 0.51, max_relative = 1e-15);
        assert_relative_eq!(LAW.mu(1e12), 0.64, max_relative = 1e-12);
    }

    #[test]
    fn inverse() {
        for i in [1e-6, 1e-3, 0.1, 1.0, 30.0] {
            assert_relative_eq!(LAW.inertial_number(LAW.mu(i)).unwrap(), i, max_relative = 1e-9);
        }
        assert_eq!(LAW.inertial_number(0.1), Some(0.0));
        assert_eq!(LAW.inertial_number(0.64), None);
    }

    #[test]
    fn mobilised_is_the_inverse_of_the_regularised_law() {
        for creep in [1e-14, 1e-9, 1e-3, 1.0] {
            for r in [1e-3, 0.2, 0.379, 0.38, 0.381, 0.5, 0.63] {
                let i = LAW.mobilised(r, creep);
                assert_relative_eq!(LAW.mu(i) * i / (i + creep), r, max_relative = 1e-11);
            }
        }
        assert_eq!(LAW.mobilised(0.3, 0.0), 0.0);
        assert_eq!(Some(LAW.mobilised(0.5, 0.0)), LAW.inertial_number(0.5));
        assert_relative_eq!(LAW.mobilised(0.5, 1e-15), LAW.mobilised(0.5, 0.0), max_relative = 1e-13);
    }
}
