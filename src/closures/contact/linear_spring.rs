//! Linear spring and dashpot along the normal, linear spring with a Coulomb slider across it.
//!
//! `f_n = k_n δ - c v_n`, `c = 2 ζ sqrt(m k_n)`, `1/m = 1/m_1 + 1/m_2`; `|f_t| = min(k_s |s|, μ max(f_n, 0))`, `ds/dt = v_t`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `δ`, `v_n`, `v_t` | overlap; normal and tangential velocity at the contact | m, m/s |
//! | `s` | elongation of the tangential spring, in the plane of contact | m |
//! | `ζ` | damping ratio that gives `e_n` for the pair's own masses, in the convention `tension` | 1 |
//!
//! Source: Cundall & Strack (1979), as used by Maurin et al. (2015), section II.A.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Tension;
use crate::closures::{Info, Range, Standing};

/// Overlap up to which the grains count as rigid, relative to the diameter.
pub const RIGID_RANGE: Range = Range { variable: "overlap over d", min: 0.0, max: 0.01 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "contact",
    law: "linear-spring",
    equation: "f_n = k_n δ - c v_n,  c = 2 ζ sqrt(m k_n),  ζ from e_n,  |f_t| = min(k_s |s|, μ max(f_n, 0))",
    source: "Cundall & Strack (1979); Maurin et al. (2015) section II.A",
    ranges: &[RIGID_RANGE],
    standing: Standing::Validated,
};

/// Linear springs and a dashpot, Coulomb slider.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LinearSpring {
    /// Normal stiffness of the contact.
    #[schemars(extend("x-unit" = "N/m", "exclusiveMinimum" = 0.0, "maximum" = 1e12))]
    pub k_n: f64,
    /// Tangential stiffness of the contact; 0 is without friction.
    #[schemars(extend("x-unit" = "N/m", "minimum" = 0.0, "maximum" = 1e12))]
    pub k_s: f64,
    /// Friction coefficient.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 10.0))]
    pub mu: f64,
    /// Restitution coefficient of a head-on impact, met in the convention that tension says.
    #[schemars(extend("x-unit" = "1", "minimum" = 1e-3, "maximum" = 1.0))]
    pub e_n: f64,
    /// Whether the dashpot may pull while grains part.
    #[serde(default)]
    pub tension: Tension,
}

#[cfg(test)]
mod tests {
    use super::super::restitution::{coefficient, damping_ratio};
    use super::*;

    #[test]
    fn the_conventions_differ_where_the_source_of_the_table_says() {
        let kept = damping_ratio(0.5, Tension::Kept).unwrap();
        approx::assert_relative_eq!(coefficient(kept, Tension::Cut), 0.55028, max_relative = 1e-5);
        assert_eq!(Tension::default(), Tension::Cut);
    }
}
