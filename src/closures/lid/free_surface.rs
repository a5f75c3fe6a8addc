//! The neutral law: a free surface.

use schemars::JsonSchema;

use super::Top;
use crate::closures::{Constant, Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "lid",
    law: "free-surface",
    equation: "τ_top = 0, a free surface",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// A free surface.
#[derive(JsonSchema)]
pub struct FreeSurface;

impl Top for FreeSurface {
    fn constants(&self) -> Vec<Constant> {
        Vec::new()
    }
}
