//! Einstein's viscosity of a dilute suspension: `eta_e = eta (1 + 5/2 phi)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `eta`, `eta_e` | viscosity of the fluid and of the mixture | Pa s |
//! | `phi` | solid fraction | 1 |
//!
//! Source: Einstein (1906), Ann. Phys. 19, 289-306, exact to first order in phi. Chauchat & Medale (2010), eq. (8), and
//! Ouriemi et al. (2009) apply it in the bed, far outside that range, and so do the cases that repeat them.

use crate::closures::{Info, Range, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixture_viscosity",
    law: "einstein",
    equation: "η_e = η (1 + 5/2 φ)",
    source: "Einstein (1906); Chauchat & Medale (2010), eq. (8)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.05 }],
    standing: Standing::Validated,
};

/// `eta_e/eta` at the solid fraction `phi`.
#[must_use]
pub fn relative(phi: f64) -> f64 {
    1.0 + 2.5 * phi
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn clear_fluid_and_slope() {
        assert_eq!(relative(0.0), 1.0);
        assert_relative_eq!((relative(1e-3) - relative(0.0)) / 1e-3, 2.5, max_relative = 1e-10);
    }
}
