//! The drag of a grain in turbulent flow: Chassagne et al. (2023), eq. (3.13).

use schemars::JsonSchema;

use super::Damping;
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.drag_work",
    law: "quadratic",
    equation: "J = -φ (1 - φ) K (3 + 2 C_∞/C_D) T",
    source: "Chassagne et al. (2023), eq. (3.13)",
    ranges: &[],
    standing: Standing::Validated,
};

/// With the quadratic part of the drag.
#[derive(JsonSchema)]
pub struct Quadratic;

impl Damping for Quadratic {
    fn factor<T: Real>(&self, share: T) -> T {
        share * 2.0 + 3.0
    }
}
