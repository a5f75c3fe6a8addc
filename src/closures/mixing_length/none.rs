//! The neutral law: no turbulence.

use schemars::JsonSchema;

use super::Length;
use crate::closures::{Constant, Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixing_length",
    law: "none",
    equation: "l_m = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// No turbulence.
#[derive(JsonSchema)]
pub struct None;

impl Length for None {
    fn constants(&self) -> Vec<Constant> {
        Vec::new()
    }

    fn fill(&self, _: &[f64], _: &[f64], lengths: &mut [f64]) {
        lengths.fill(0.0);
    }

    fn clearance<T: Real>(&self, _: T) -> T {
        T::constant(0.0)
    }

    fn length<T: Real>(&self, _: T, _: T) -> T {
        T::constant(0.0)
    }
}
