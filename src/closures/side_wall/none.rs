//! The neutral law: the flow is as wide as wide can be.

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "side_wall",
    law: "none",
    equation: "f = 0",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};
