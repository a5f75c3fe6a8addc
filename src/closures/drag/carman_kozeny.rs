//! Darcy drag with the permeability of Carman and Kozeny.
//!
//! `n f = eta eps^2/K (u_f - u_p)`, `K = eps^3 d^2 / (k_CK phi^2)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `n f` | drag on the grains per volume | N/m3 |
//! | `K` | permeability | m2 |
//! | `eps`, `phi` | fluid and solid fraction | 1 |
//! | `d` | grain diameter | m |
//! | `k_CK` | constant, about 180 | 1 |
//!
//! Holds for creeping flow between the grains, Re_p below about 1, in a packed bed. Towards small phi it falls below Stokes'
//! drag on single grains, `n f = 18 eta phi/d^2 (u_f - u_p)`, that is `K = eps^2 d^2/(18 phi)`: where grains spread without
//! bound, at the top of a bed that dilates, they would slip without bound. `dilute = "stokes"` takes the smaller K of the two,
//! which changes nothing above phi = 1/11 (k_CK = 180).
//!
//! Source: Chauchat & Medale (2010), eq. (6)-(7), after Happel & Brenner (1973) and Goharzadeh et al. (2005).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};

/// Creeping flow between the grains.
pub const REYNOLDS_RANGE: Range = Range { variable: "particle_reynolds", min: 0.0, max: 1.0 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "drag",
    law: "carman-kozeny",
    equation: "n f = η ε²/K (u_f - u_p),  K = ε³ d²/(k_CK φ²)",
    source: "Chauchat & Medale (2010), eq. (6)-(7); Goharzadeh, Khalili & Jorgensen (2005)",
    ranges: &[REYNOLDS_RANGE],
    standing: Standing::Validated,
};

/// What is done where there are few grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Dilute {
    /// The law as it is.
    #[default]
    None,
    /// Not less than Stokes' drag on single grains.
    Stokes,
}

/// Darcy's law with the permeability of Carman and Kozeny.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CarmanKozeny {
    /// Kozeny constant.
    #[serde(default = "kozeny")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub k_ck: f64,
    /// What is done where there are few grains.
    #[serde(default)]
    pub dilute: Dilute,
}

fn kozeny() -> f64 {
    180.0
}

impl CarmanKozeny {
    /// Permeability K [m2] of a bed of solid fraction `phi` and grain diameter `d` [m].
    #[must_use]
    pub fn permeability(&self, phi: f64, d: f64) -> f64 {
        let eps = 1.0 - phi;
        let packed = eps * eps * eps * d * d / (self.k_ck * phi * phi);
        match self.dilute {
            Dilute::None => packed,
            Dilute::Stokes => packed.min(eps * eps * d * d / (18.0 * phi)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn permeability_of_the_paper() {
        let law = CarmanKozeny { k_ck: 180.0, dilute: Dilute::None };
        assert_relative_eq!(law.permeability(0.55, 1.0), 1.673_553_719e-3, max_relative = 1e-9);
        assert_relative_eq!(law.permeability(0.55, 2.0) / law.permeability(0.55, 1.0), 4.0, max_relative = 1e-15);
        assert_eq!(law.permeability(1.0, 1.0), 0.0);
    }

    #[test]
    fn few_grains_feel_stokes_drag() {
        let law = CarmanKozeny { k_ck: 180.0, dilute: Dilute::Stokes };
        let packed = CarmanKozeny { dilute: Dilute::None, ..law };
        assert_eq!(law.permeability(0.55, 1.0), packed.permeability(0.55, 1.0));
        assert_relative_eq!(
            law.permeability(1.0 / 11.0, 1.0),
            packed.permeability(1.0 / 11.0, 1.0),
            max_relative = 1e-14
        );
        // n f = eta eps^2/K = 18 eta phi/d^2
        assert_relative_eq!(0.99_f64.powi(2) / law.permeability(0.01, 2.0), 18.0 * 0.01 / 4.0, max_relative = 1e-14);
    }
}
