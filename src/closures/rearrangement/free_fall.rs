//! The free-fall time alone: `t_micro = d sqrt(rho_p/P_p)`.

use schemars::JsonSchema;

use super::{Clock, Grain, Regime};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "rearrangement",
    law: "free-fall",
    equation: "t = d (ρ_p/P_p)^½",
    source: "GDR MiDi (2004), Eur. Phys. J. E 14, 341-365",
    ranges: &[],
    standing: Standing::Validated,
};

/// The free-fall time alone, as in dry grains.
#[derive(JsonSchema)]
pub struct FreeFall;

impl Clock for FreeFall {
    fn rate<T: Real>(&self, grain: &Grain, p: T, _: T) -> T {
        (p / grain.rho_p).sqrt() / grain.d
    }

    fn regime(&self, _: &Grain, _: f64, _: f64) -> Regime {
        Regime::FreeFall
    }
}
