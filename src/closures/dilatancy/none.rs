//! The neutral law: grains keep the solid fraction of the bed.

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
