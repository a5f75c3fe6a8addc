//! Grains that the turbulence carries from where they are many to where they are few: a drift velocity in the drag.
//!
//! `n f = phi (1 - phi) K (u_f - u_p + u_d)`, `u_d = -(nu_t/S_c) grad(phi)/phi`
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `u_d` | drift velocity | m/s |
//! | `nu_t` | eddy viscosity | m2/s |
//! | `S_c` | Schmidt number: 1/3 in the source | 1 |
//!
//! The source prints eq. (4.4) without the minus sign, which would pile the grains up: a drift towards fewer grains is meant.
//! Source: Chassagne et al. (2023), eq. (4.3)-(4.4), after Rouse (1937) and Chauchat (2018).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Spread;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "dispersion",
    law: "gradient",
    equation: "u_d = -(ν_t/S_c) ∇φ/φ",
    source: "Chassagne et al. (2023), eq. (4.3)-(4.4); Chauchat (2018)",
    ranges: &[],
    standing: Standing::Experimental,
};

/// A drift towards fewer grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Gradient {
    /// Schmidt number S_c: eddy viscosity over the diffusivity of the grains.
    #[serde(default = "schmidt")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub schmidt: f64,
}

fn schmidt() -> f64 {
    1.0 / 3.0
}

impl Spread for Gradient {
    fn strength(&self) -> f64 {
        1.0 / self.schmidt
    }
}
