//! The neutral law: grains keep the solid fraction of the bed.

use schemars::JsonSchema;

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "dilatancy",
    law: "none",
    equation: "φ = φ_bed",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// The solid fraction of the bed, sheared or not.
#[derive(JsonSchema)]
pub struct None;
