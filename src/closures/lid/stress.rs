//! A lid whose stress is known.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Top;
use crate::closures::{Constant, Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "lid",
    law: "stress",
    equation: "τ_top given",
    source: "measured, or from another model",
    ranges: &[],
    standing: Standing::Validated,
};

/// A lid whose stress is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stress {
    /// Shear stress that the lid takes from the fluid.
    #[schemars(extend("x-unit" = "Pa", "minimum" = 0.0, "maximum" = 1e6))]
    pub stress: f64,
}

impl Top for Stress {
    fn constants(&self) -> Vec<Constant> {
        vec![("τ_top", self.stress, "Pa")]
    }
}
