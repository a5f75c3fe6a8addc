//! Hard spheres that freeze: Torquato (1995), Phys. Rev. E 51, 3170.

use schemars::JsonSchema;

use super::{AtContact, DENSE, FREEZING, hard_spheres};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.radial",
    law: "torquato",
    equation: "g₀ by Carnahan-Starling up to φ_f = 0.49, then g₀(φ_f) (φ_max - φ_f)/(φ_max - φ)",
    source: "Torquato (1995)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};

/// Hard spheres, frozen ones too.
#[derive(JsonSchema)]
pub struct Torquato;

impl AtContact for Torquato {
    fn coefficient(&self, _: f64) -> f64 {
        0.0
    }

    fn contact<T: Real>(&self, phi: T, gap: T, _: f64) -> T {
        if phi.value() <= FREEZING {
            return hard_spheres(phi);
        }
        let frozen = phi + gap - FREEZING;
        frozen / gap * hard_spheres(FREEZING)
    }
}
