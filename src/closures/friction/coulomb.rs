//! Coulomb friction: `tau_p = mu_s P_p` wherever the grains shear.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `tau_p` | intergranular shear stress | Pa |
//! | `P_p` | particle pressure | Pa |
//! | `mu_s` | static friction coefficient | 1 |
//!
//! Source: Chauchat & Medale (2010), Comput. Methods Appl. Mech. Engrg. 199, 439-449, eq. (11), after Ouriemi et al. (2009).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "friction",
    law: "coulomb",
    equation: "τ_p = μ_s P_p",
    source: "Chauchat & Medale (2010), eq. (11); Ouriemi, Aussillous & Guazzelli (2009)",
    ranges: &[],
    standing: Standing::Validated,
};

/// One friction coefficient at any shear rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Coulomb {
    /// Static friction coefficient of the grains, the tangent of their angle of repose.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
}

/// Of spheres: Chauchat & Medale (2010), as read in docs/theory.md.
impl Default for Coulomb {
    fn default() -> Self {
        Self { mu_s: 0.43 }
    }
}

impl Coulomb {
    /// Largest shear stress \[Pa] that grains under the pressure `p_p` \[Pa] carry at rest, and the stress at which they shear.
    #[must_use]
    pub fn stress(&self, p_p: f64) -> f64 {
        self.mu_s * p_p
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stress_is_proportional_to_pressure() {
        let law = Coulomb { mu_s: 0.43 };
        assert_eq!(law.stress(0.0), 0.0);
        assert_eq!(law.stress(2.0), 0.86);
    }
}
