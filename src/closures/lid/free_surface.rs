//! The neutral law: a free surface.

use schemars::JsonSchema;

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "lid",
    law: "free-surface",
    equation: "τ_top = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// A free surface.
#[derive(JsonSchema)]
pub struct FreeSurface;
