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
//!
//! In two and three dimensions the equations of a flow with this law are ill-posed where
//! `C = 4 n^2 - 4 n + mu^2 (1 - n/2)^2 > 0` with `n = I mu'/mu`: disturbances grow the faster the shorter they are. In one
//! dimension nothing of it is seen. Source: Barker, Schaeffer, Bohorquez & Gray (2015), J. Fluid Mech. 779, 794-818.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FrictionLaw, INERTIAL_RANGE};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

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

/// Of spheres: Maurin et al. (2016), J. Fluid Mech. 804, 490-512.
impl Default for MuI {
    fn default() -> Self {
        Self { mu_s: 0.35, mu_2: 0.97, i_0: 0.69 }
    }
}

impl MuI {
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

impl FrictionLaw for MuI {
    fn mu<T: Real>(&self, i: T) -> T {
        i * (self.mu_2 - self.mu_s) / (i + self.i_0) + self.mu_s
    }

    fn least(&self) -> f64 {
        self.mu_s
    }

    fn most(&self) -> f64 {
        self.mu_2
    }

    fn half_way(&self) -> f64 {
        self.i_0
    }

    fn with_half_way(self, i_0: f64) -> Self {
        Self { i_0, ..self }
    }

    fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![("μ_s", self.mu_s), ("μ_2", self.mu_2), ("I_0", self.i_0)]
    }

    /// In closed form: the positive root of `(mu_2 - r) I^2 - (I_0 (r - mu_s) + r creep) I - r creep I_0 = 0`.
    fn mobilised<T: Real>(&self, r: T, creep: T) -> T {
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

    fn well_posedness(&self, i: f64) -> f64 {
        let mu = self.mu(i);
        let n = (self.mu_2 - self.mu_s) * self.i_0 * i / ((self.i_0 + i).powi(2) * mu);
        4.0 * n * (n - 1.0) + (mu * (1.0 - 0.5 * n)).powi(2)
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
    fn published_constants_are_well_posed_in_an_interval_or_nowhere() {
        // mu_s, mu_2, I_0 and the interval, from an independent evaluation of the condition
        for (mu_s, mu_2, i_0, wanted) in [
            (0.35, 0.97, 0.69, Some((0.01375, 1.740))),
            (0.38, 0.64, 0.279, Some((0.01913, 0.8634))),
            (0.38, 0.64, 0.30, Some((0.02057, 0.9284))),
            (0.342, 0.557, 0.069, Some((0.003972, 0.2802))),
            (0.51, 0.70, 0.30, None),
            (0.30, 0.64, 0.30, Some((0.0067, 1.417))),
            (0.52, 0.96, 0.60, Some((0.08393, 0.7035))),
            (0.63, 1.13, 0.60, None),
            (0.40, 0.68, 0.40, Some((0.03068, 1.078))),
        ] {
            let found = MuI { mu_s, mu_2, i_0 }.well_posed();
            match (found, wanted) {
                (Some((low, high)), Some((a, b))) => {
                    assert_relative_eq!(low, a, max_relative = 2e-3);
                    assert_relative_eq!(high, b, max_relative = 2e-3);
                }
                (found, wanted) => assert_eq!(found, wanted, "{mu_s} {mu_2} {i_0}"),
            }
        }
        // By hand: at I = I_0 the friction is 0.51, n = 0.13/(2 0.51).
        let n: f64 = 0.065 / 0.51;
        let c = 4.0 * n * n - 4.0 * n + 0.51_f64.powi(2) * (1.0 - n / 2.0).powi(2);
        assert_relative_eq!(LAW.well_posedness(LAW.i_0), c, max_relative = 1e-13);
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
