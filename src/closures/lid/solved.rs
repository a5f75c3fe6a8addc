//! A lid whose stress is an unknown of the flow.

use schemars::JsonSchema;

use super::Top;
use crate::closures::{Constant, Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "lid",
    law: "solved",
    equation: "τ_top such that the slope gives the wanted stress at the bed",
    source: "momentum of the whole layer above the bed",
    ranges: &[],
    standing: Standing::Validated,
};

/// A lid whose stress follows from the slope and the wanted Shields number or friction velocity.
#[derive(JsonSchema)]
pub struct Solved;

impl Top for Solved {
    fn constants(&self) -> Vec<Constant> {
        Vec::new()
    }
}
