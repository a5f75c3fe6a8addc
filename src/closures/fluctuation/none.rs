//! No fluctuations.

use schemars::JsonSchema;

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "fluctuation",
    law: "none",
    equation: "u' = 0",
    source: "neutral",
    ranges: &[],
    standing: Standing::Validated,
};

/// Grains meet the mean flow.
#[derive(JsonSchema)]
pub struct None;
