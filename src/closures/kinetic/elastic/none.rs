//! The neutral law: grains touch in collisions only.

use schemars::JsonSchema;

use super::Enduring;
use crate::closures::{Constant, Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "elastic",
    law: "none",
    equation: "p_el = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// Grains touch in collisions only.
#[derive(JsonSchema)]
pub struct None;

impl Enduring for None {
    fn constants(&self) -> Vec<Constant> {
        Vec::new()
    }
}
