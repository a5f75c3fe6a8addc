//! The neutral law: the flow is as wide as wide can be.

use schemars::JsonSchema;

use super::{Friction, WallFriction};
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

/// No side walls.
#[derive(JsonSchema)]
pub struct None;

impl WallFriction for None {
    fn friction(&self, _: f64) -> Friction {
        Friction { times_reynolds: 0.0, slope: 0.0 }
    }
}
