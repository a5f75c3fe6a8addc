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
//! Holds for creeping flow between the grains, Re_p below about 1, in a packed bed. At the top of a bed that dilates phi falls to
//! 0 within less than a grain, K grows like 1/phi^2, and grains would slip without bound: `phi_min` keeps the permeability of
//! that solid fraction below it. 0 is the law as published; a bed that dilates needs more. Between 0.1 and 0.4 the
//! transport rate changes by 2 % at a Shields number of 0.63, and by more nearer to the threshold.
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

/// Darcy's law with the permeability of Carman and Kozeny.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CarmanKozeny {
    /// Kozeny constant.
    #[serde(default = "kozeny")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub k_ck: f64,
    /// Solid fraction below which the permeability no longer grows; a bed that dilates needs more than 0.
    #[serde(default)]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 0.6))]
    pub phi_min: f64,
}

fn kozeny() -> f64 {
    180.0
}

impl CarmanKozeny {
    /// Permeability K \[m2] of a bed of solid fraction `phi` and grain diameter `d` \[m].
    #[must_use]
    pub fn permeability(&self, phi: f64, d: f64) -> f64 {
        let phi = phi.max(self.phi_min);
        let eps = 1.0 - phi;
        eps * eps * eps * d * d / (self.k_ck * phi * phi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn permeability_of_the_paper() {
        let law = CarmanKozeny { k_ck: 180.0, phi_min: 0.0 };
        assert_relative_eq!(law.permeability(0.55, 1.0), 1.673_553_719e-3, max_relative = 1e-9);
        assert_relative_eq!(law.permeability(0.55, 2.0) / law.permeability(0.55, 1.0), 4.0, max_relative = 1e-15);
        assert_eq!(law.permeability(1.0, 1.0), 0.0);
    }

    #[test]
    fn what_is_left_out_is_as_published() {
        let law: CarmanKozeny = toml::from_str("").unwrap();
        assert_eq!(law, CarmanKozeny { k_ck: 180.0, phi_min: 0.0 });
    }

    #[test]
    fn the_permeability_stops_growing() {
        let law = CarmanKozeny { k_ck: 180.0, phi_min: 0.3 };
        let published = CarmanKozeny { phi_min: 0.0, ..law };
        assert_eq!(law.permeability(0.55, 1.0), published.permeability(0.55, 1.0));
        assert_eq!(law.permeability(0.01, 1.0), published.permeability(0.3, 1.0));
    }
}
