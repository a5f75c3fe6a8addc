//! The largest of the three times.

use schemars::JsonSchema;

use super::{Clock, Grain, Regime};
use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "rearrangement",
    law: "largest",
    equation: "t = max(d (ρ_p/P_p)^½, η/P_p, d (ρ_f C/P_p)^½)",
    source: "Cassar, Nicolas & Pouliquen (2005); Revil-Baudard & Chauchat (2013), sec. 2.1.3",
    ranges: &[],
    standing: Standing::Validated,
};

/// The largest of the free-fall, viscous and turbulent times.
#[derive(JsonSchema)]
pub struct Largest;

impl Clock for Largest {
    fn rate<T: Real>(&self, grain: &Grain, p: T, w: T) -> T {
        let [free, viscous, turbulent] = grain.rates(p, w);
        free.min(viscous).min(turbulent)
    }

    fn regime(&self, grain: &Grain, p: f64, w: f64) -> Regime {
        let [free, viscous, turbulent] = grain.rates(p, w);
        if free <= viscous && free <= turbulent {
            Regime::FreeFall
        } else if viscous <= turbulent {
            Regime::Viscous
        } else {
            Regime::Turbulent
        }
    }
}
