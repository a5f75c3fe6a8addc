//! Effective viscosity of a fluid with grains, relative to the clear fluid.

use super::Constant;
use super::role::role;
use crate::numerics::dual::Real;

role! {
    /// Law of the effective viscosity eta_e of the mixture.
    pub enum MixtureViscosity {
        clear::Clear,
        einstein::Einstein,
        boyer::Boyer(..),
    }

    /// What the laws of the viscosity answer.
    pub trait RelativeViscosity {
        /// `eta_e/eta` at the solid fraction `phi`.
        #[must_use]
        fn relative(&self, phi: f64) -> f64;
        /// `eta/eta_e` at the solid fraction `phi`; 0 where the viscosity diverges.
        #[must_use]
        fn fluidity<T: Real>(&self, phi: T) -> T;
        /// Solid fraction at which the viscosity diverges; infinite where it does not.
        #[must_use]
        fn phi_max(&self) -> f64;
    }
}

impl MixtureViscosity {
    /// Constants of the law.
    #[must_use]
    pub fn constants(&self) -> Vec<Constant> {
        let phi_max = self.phi_max();
        if phi_max.is_finite() { vec![("φ_max", phi_max, "")] } else { Vec::new() }
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
