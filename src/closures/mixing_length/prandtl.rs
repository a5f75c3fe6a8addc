//! Prandtl's mixing length at a wall: `l_m = kappa z`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `l_m` | mixing length | m |
//! | `kappa` | von Karman's constant | 1 |
//! | `z` | distance from the wall | m |
//!
//! Source: Prandtl (1925); gives the logarithmic law where the stress is constant.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Length, above_zero, karman};
use crate::closures::{Constant, Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixing_length",
    law: "prandtl",
    equation: "l_m = κ z",
    source: "Prandtl (1925)",
    ranges: &[],
    standing: Standing::Validated,
};

/// Proportional to the distance from the wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Prandtl {
    /// Von Karman's constant.
    #[serde(default = "karman")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.2, "maximum" = 0.6))]
    pub kappa: f64,
}

impl Length for Prandtl {
    fn constants(&self) -> Vec<Constant> {
        vec![("κ", self.kappa, "")]
    }

    fn fill(&self, faces: &[f64], _: &[f64], lengths: &mut [f64]) {
        let wall = faces.first().copied().unwrap_or_default();
        faces.iter().zip(lengths).for_each(|(z, length)| *length = self.kappa * (z - wall));
    }

    fn clearance<T: Real>(&self, _: T) -> T {
        T::constant(1.0)
    }

    fn length<T: Real>(&self, integral: T, _: T) -> T {
        above_zero(integral, self.kappa)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vanishes_at_the_wall_and_grows_by_kappa() {
        let law = Prandtl { kappa: 0.4 };
        assert_eq!(law.length(0.0, 0.0), 0.0);
        assert_eq!(law.length(2.0, 0.0), 0.8);
    }
}
