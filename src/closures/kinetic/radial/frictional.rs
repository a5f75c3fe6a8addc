//! Grains with friction: Chassagne et al. (2023), eq. (3.2)-(3.3).

use schemars::JsonSchema;

use super::{A_0, AtContact, DENSE, diverging};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Frictional coefficient of the divergence, and the friction at which it saturates: eq. (3.3).
const A_MAX: f64 = 3.70;
const DELTA: f64 = 0.54;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.radial",
    law: "frictional",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³) + (0.58 + 3.12 tanh(μ_p/0.54)) φ²/(φ_max - φ)^(3/2)",
    source: "Chassagne et al. (2023), eq. (3.2)-(3.3)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};

/// Grains with friction.
#[derive(JsonSchema)]
pub struct Frictional;

impl AtContact for Frictional {
    fn coefficient(&self, mu_p: f64) -> f64 {
        A_0 + (A_MAX - A_0) * (mu_p / DELTA).tanh()
    }

    fn contact<T: Real>(&self, phi: T, gap: T, a: f64) -> T {
        diverging(phi, gap, a)
    }
}
