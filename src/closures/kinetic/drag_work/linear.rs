//! A drag that is linear in the slip: Ding & Gidaspow (1990).

use schemars::JsonSchema;

use super::Damping;
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.drag_work",
    law: "linear",
    equation: "J = -3 φ (1 - φ) K T",
    source: "Ding & Gidaspow (1990); Chassagne et al. (2023), eq. (2.25)",
    ranges: &[],
    standing: Standing::Validated,
};

/// As if the drag were linear in the slip.
#[derive(JsonSchema)]
pub struct Linear;

impl Damping for Linear {
    fn factor<T: Real>(&self, _: T) -> T {
        T::constant(3.0)
    }
}
