//! The neutral law: no turbulence.

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixing_length",
    law: "none",
    equation: "l_m = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};
