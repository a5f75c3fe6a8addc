//! The neutral law: impacts lose what smooth grains lose.

use schemars::JsonSchema;

use super::EffectiveRestitution;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.dissipation",
    law: "plain",
    equation: "e_eff = e",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};

/// That of the grains.
#[derive(JsonSchema)]
pub struct Plain;

impl EffectiveRestitution for Plain {
    fn restitution(&self, e: f64, _: f64, _: f64) -> f64 {
        e
    }
}
