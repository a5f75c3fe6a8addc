//! The neutral law: the phases move together and exchange whatever that takes.

use schemars::JsonSchema;

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "drag",
    law: "none",
    equation: "u_f = u_p",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// The phases move together; nothing is computed.
#[derive(JsonSchema)]
pub struct None;
