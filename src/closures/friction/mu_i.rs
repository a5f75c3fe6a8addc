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
}
