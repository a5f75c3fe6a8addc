//! The neutral law: `eta_e = eta`. The grains do not change the viscosity.

use schemars::JsonSchema;

use super::RelativeViscosity;
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixture_viscosity",
    law: "clear",
    equation: "η_e = η",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// The grains do not change the viscosity.
#[derive(JsonSchema)]
pub struct Clear;

impl RelativeViscosity for Clear {
    fn relative(&self, _: f64) -> f64 {
        1.0
    }

    fn fluidity<T: Real>(&self, _: T) -> T {
        T::constant(1.0)
    }

    fn phi_max(&self) -> f64 {
        f64::INFINITY
    }
}
