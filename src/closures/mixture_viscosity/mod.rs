//! Effective viscosity of a fluid with grains, relative to the clear fluid.

pub mod boyer;
pub mod clear;
pub mod einstein;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
use crate::numerics::dual::Real;
pub use boyer::Boyer;

/// Law of the effective viscosity eta_e of the mixture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MixtureViscosity {
    /// The grains do not change the viscosity.
    Clear,
    /// Einstein's dilute viscosity, which the papers use in dense beds too.
    Einstein,
    /// Viscosity of a dense suspension, diverging at phi_max.
    Boyer(Boyer),
}

impl MixtureViscosity {
    /// `eta_e/eta` at the solid fraction `phi`.
    #[must_use]
    pub fn relative(&self, phi: f64) -> f64 {
        match self {
            Self::Clear => clear::relative(phi),
            Self::Einstein => einstein::relative(phi),
            Self::Boyer(law) => law.relative(phi),
        }
    }

    /// `eta/eta_e` at the solid fraction `phi`; 0 where the viscosity diverges.
    #[must_use]
    pub fn fluidity<T: Real>(&self, phi: T) -> T {
        match self {
            Self::Clear => T::constant(1.0),
            Self::Einstein => T::constant(1.0) / (phi * 2.5 + 1.0),
            Self::Boyer(law) => {
                let gap = -phi / law.phi_max + 1.0;
                gap / (gap + phi * 2.5)
            }
        }
    }

    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::Clear => &clear::INFO,
            Self::Einstein => &einstein::INFO,
            Self::Boyer(_) => &boyer::INFO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn fluidity_is_the_inverse_of_the_viscosity() {
        for law in
            [MixtureViscosity::Clear, MixtureViscosity::Einstein, MixtureViscosity::Boyer(Boyer { phi_max: 0.6 })]
        {
            for phi in [0.0, 0.2, 0.599] {
                assert_relative_eq!(law.fluidity(phi) * law.relative(phi), 1.0, max_relative = 1e-14);
            }
        }
        assert_eq!(MixtureViscosity::Boyer(Boyer { phi_max: 0.6 }).fluidity(0.6), 0.0);
    }
}
