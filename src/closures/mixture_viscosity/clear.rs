//! The neutral law: `eta_e = eta`. The grains do not change the viscosity.

use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixture_viscosity",
    law: "clear",
    equation: "η_e = η",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// `eta_e/eta`, 1 at any solid fraction.
#[must_use]
pub fn relative(_phi: f64) -> f64 {
    1.0
}
