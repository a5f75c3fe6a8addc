//! Hard spheres: Carnahan & Starling (1969).

use schemars::JsonSchema;

use super::{AtContact, FREEZING, hard_spheres};
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.radial",
    law: "carnahan-starling",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³)",
    source: "Carnahan & Starling (1969)",
    ranges: &[Range { variable: "phi", min: 0.0, max: FREEZING }],
    standing: Standing::Validated,
};

/// Hard spheres up to freezing.
#[derive(JsonSchema)]
pub struct CarnahanStarling;

impl AtContact for CarnahanStarling {
    fn coefficient(&self, _: f64) -> f64 {
        0.0
    }

    fn contact<T: Real>(&self, phi: T, _: T, _: f64) -> T {
        hard_spheres(phi)
    }
}
