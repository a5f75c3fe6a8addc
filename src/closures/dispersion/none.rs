//! The neutral law: the turbulence does not carry grains.

use schemars::JsonSchema;

use super::Spread;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "dispersion",
    law: "none",
    equation: "u_d = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// The turbulence does not carry grains.
#[derive(JsonSchema)]
pub struct None;

impl Spread for None {
    fn strength(&self) -> f64 {
        0.0
    }
}
