//! Smooth grains in simple shear: Chialvo & Sundaresan (2013).

use schemars::JsonSchema;

use super::{A_0, AtContact, DENSE, diverging};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.radial",
    law: "chialvo-sundaresan",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³) + 0.58 φ²/(φ_max - φ)^(3/2)",
    source: "Chialvo & Sundaresan (2013); Chassagne et al. (2023), eq. (2.23)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};

/// Smooth grains in simple shear.
#[derive(JsonSchema)]
pub struct ChialvoSundaresan;

impl AtContact for ChialvoSundaresan {
    fn coefficient(&self, _: f64) -> f64 {
        A_0
    }

    fn contact<T: Real>(&self, phi: T, gap: T, a: f64) -> T {
        diverging(phi, gap, a)
    }
}
