//! No fluctuations.

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
