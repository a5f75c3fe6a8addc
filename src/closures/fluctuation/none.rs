//! No fluctuations.

use schemars::JsonSchema;

use super::Eddies;
use crate::closures::{Info, Standing};
use crate::runtime::rng::Stream;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "fluctuation",
    law: "none",
    equation: "u' = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// Grains meet the mean flow.
#[derive(JsonSchema)]
pub struct None;

impl Eddies for None {
    fn are_drawn(&self) -> bool {
        false
    }

    fn deviation(&self, _: f64, _: f64, _: f64) -> f64 {
        0.0
    }

    fn draw(&self, _: &mut Stream, _: f64) -> [f64; 3] {
        [0.0; 3]
    }
}
