//! The mu(I_v) rheology of dense suspensions: friction that grows with the viscous number.
//!
//! `mu(I_v) = mu_s + (mu_2 - mu_s) / (I_0/I_v + 1)`, with `I_v = eta |du_p/dz| / P_p`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `I_v` | viscous number | 1 |
//! | `mu_s`, `mu_2` | friction at vanishing and at large I_v | 1 |
//! | `I_0` | viscous number at which mu is half-way | 1 |
//!
//! Source: Boyer, Guazzelli & Pouliquen (2011), Phys. Rev. Lett. 107, 188301, without the hydrodynamic part, which the mixture
//! viscosity carries; Aussillous et al. (2013), J. Fluid Mech. 736, 594-615.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};

/// Where the law was measured.
pub const VISCOUS_RANGE: Range = Range { variable: "viscous_number", min: 0.0, max: 0.2 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "friction",
    law: "mu-iv",
    equation: "μ(I_v) = μ_s + (μ_2 - μ_s)/(I_0/I_v + 1),  I_v = η |du_p/dz|/P_p",
    source: "Boyer, Guazzelli & Pouliquen (2011); Aussillous et al. (2013)",
    ranges: &[VISCOUS_RANGE],
    standing: Standing::Validated,
};

/// Friction that grows with the viscous number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MuIv {
    /// Friction coefficient at vanishing viscous number.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
    /// Friction coefficient at large viscous number; more than mu_s.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 3.0))]
    pub mu_2: f64,
    /// Viscous number at which the friction is half-way between mu_s and mu_2.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub i_0: f64,
}

impl MuIv {
    /// What the friction exceeds mu_s by, as stress \[Pa] and its derivative with respect to the shear rate [Pa s], for the
    /// particle pressure `p_p` \[Pa] and the strain rate times viscosity `s` \[Pa].
    #[must_use]
    pub fn rise(&self, p_p: f64, s: f64) -> (f64, f64) {
        let half = self.i_0 * p_p;
        let sum = half + s.abs();
        let mu = self.mu_2 - self.mu_s;
        if sum == 0.0 { (0.0, 0.0) } else { (mu * p_p * s / sum, mu * p_p * half / (sum * sum)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAW: MuIv = MuIv { mu_s: 0.32, mu_2: 0.94, i_0: 0.0077 };

    #[test]
    fn limits_and_half_way() {
        assert_eq!(LAW.rise(2.0, 0.0).0, 0.0);
        assert_relative_eq!(LAW.rise(2.0, 0.0077 * 2.0).0, 2.0 * 0.31, max_relative = 1e-14);
        assert_relative_eq!(LAW.rise(2.0, 1e9).0, 2.0 * 0.62, max_relative = 1e-9);
        assert_eq!(LAW.rise(0.0, 0.0), (0.0, 0.0));
        assert_eq!(LAW.rise(2.0, -0.3).0, -LAW.rise(2.0, 0.3).0);
    }

    #[test]
    fn derivative_by_differences() {
        let (s, h) = (0.02, 1e-7);
        let difference = (LAW.rise(2.0, s + h).0 - LAW.rise(2.0, s - h).0) / (2.0 * h);
        assert_relative_eq!(LAW.rise(2.0, s).1, difference, max_relative = 1e-6);
    }
}
