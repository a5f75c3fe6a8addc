//! Einstein's viscosity of a dilute suspension: `eta_e = eta (1 + 5/2 phi)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `eta`, `eta_e` | viscosity of the fluid and of the mixture | Pa s |
//! | `phi` | solid fraction | 1 |
//!
//! Source: Einstein (1906), Ann. Phys. 19, 289-306, exact to first order in phi. Chauchat & Medale (2010), eq. (8), and
//! Ouriemi et al. (2009) apply it in the bed, far outside that range, and so do the cases that repeat them.

use schemars::JsonSchema;

use super::RelativeViscosity;
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixture_viscosity",
    law: "einstein",
    equation: "η_e = η (1 + 5/2 φ)",
    source: "Einstein (1906); Chauchat & Medale (2010), eq. (8)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.05 }],
    standing: Standing::Validated,
};

/// Einstein's dilute viscosity, which the papers use in dense beds too.
#[derive(JsonSchema)]
pub struct Einstein;

impl RelativeViscosity for Einstein {
    fn relative(&self, phi: f64) -> f64 {
        1.0 + 2.5 * phi
    }

    fn fluidity<T: Real>(&self, phi: T) -> T {
        T::constant(1.0) / (phi * 2.5 + 1.0)
    }

    fn phi_max(&self) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn clear_fluid_and_slope() {
        assert_eq!(Einstein.relative(0.0), 1.0);
        assert_relative_eq!((Einstein.relative(1e-3) - Einstein.relative(0.0)) / 1e-3, 2.5, max_relative = 1e-10);
    }
}
