//! The neutral law: clear fluid above the bed.

use schemars::JsonSchema;

use super::Settling;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "suspension",
    law: "none",
    equation: "φ = 0 above the bed",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// Clear fluid above the bed.
#[derive(JsonSchema)]
pub struct None;

impl Settling for None {
    fn settling_velocity(&self) -> Option<f64> {
        Option::None
    }
}
