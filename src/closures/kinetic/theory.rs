//! A kinetic theory with its numbers, classical or not.

use super::{DragWork, Inertial, Radial, Saltation, garzo_dufty, saltation};
use crate::closures::kinetic::radial::AtContact;
use crate::numerics::dual::Real;

/// A kinetic theory with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinetic {
    /// restitution coefficient
    pub e: f64,
    /// restitution coefficient in the dissipation
    pub e_eff: f64,
    /// radial distribution function
    pub radial: Radial,
    /// coefficient of its divergence
    pub a: f64,
    /// saltation, where it limits the kinetic parts
    pub saltation: Option<Saltation>,
    /// work of the drag on the fluctuations
    pub drag_work: DragWork,
}

/// Stresses of grains that move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moving {
    /// kinetic theory
    Kinetic(Kinetic),
    /// mu(I) and phi(I): the granular temperature is then the square of the shear rate
    Inertial(Inertial),
}

impl Kinetic {
    /// `F1/phi`, at the solid fraction `phi` and its distance `gap` to phi_max.
    #[must_use]
    pub fn pressure_per_grain<T: Real>(&self, phi: T, gap: T) -> T {
        garzo_dufty::pressure_per_grain(phi, self.radial.contact(phi, gap, self.a), self.e)
    }

    /// `F4/phi`.
    #[must_use]
    pub fn dissipation_per_grain<T: Real>(&self, phi: T, gap: T) -> T {
        garzo_dufty::dissipation_per_grain(phi, self.radial.contact(phi, gap, self.a), self.e_eff)
    }

    /// `F2` and `F3`, for the root of the granular temperature `root` and the drag coefficient `k` over rho_p/d, both [m/s] or
    /// in one other unit of velocity.
    #[must_use]
    pub fn transport<T: Real>(&self, phi: T, gap: T, root: T, k: T) -> (T, T) {
        let g0 = self.radial.contact(phi, gap, self.a);
        let (eta, kappa) = (garzo_dufty::viscosity(phi, g0, self.e), garzo_dufty::conductivity(phi, g0, self.e));
        match self.saltation {
            None => (eta.kinetic + eta.contact, kappa.kinetic + kappa.contact),
            Some(law) => {
                let salt = law.viscosity(phi, root, k);
                (
                    saltation::limited(eta.kinetic, salt) + eta.contact,
                    saltation::limited(kappa.kinetic, salt / law.sigma) + kappa.contact,
                )
            }
        }
    }

    /// Whether a kinetic part is not positive at `phi`, so that saltation does not limit it.
    #[must_use]
    pub fn unlimited(&self, phi: f64, gap: f64) -> bool {
        let g0 = self.radial.contact(phi, gap, self.a);
        let parts =
            [garzo_dufty::viscosity(phi, g0, self.e).kinetic, garzo_dufty::conductivity(phi, g0, self.e).kinetic];
        self.saltation.is_some() && parts.into_iter().any(|part| part <= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::kinetic::{FrictionalCollisional, GarzoDufty};
    use approx::assert_relative_eq;

    fn classical() -> GarzoDufty {
        toml::from_str("").unwrap()
    }

    fn proposed(text: &str) -> FrictionalCollisional {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn with_every_change_taken_back_it_is_the_classical_theory() {
        let changed = proposed(
            "radial = \"chialvo-sundaresan\"\ndissipation = \"plain\"\nsaltation = \"none\"\ndrag_work = \"linear\"",
        );
        let classical = classical().kinetic(0.7, 0.4);
        assert_eq!(changed.kinetic(0.7, 0.4), classical);
        assert_ne!(proposed("").kinetic(0.7, 0.4), classical);
    }

    #[test]
    fn defaults_of_the_case_file_are_those_of_the_program() {
        assert_eq!(proposed(""), FrictionalCollisional::default());
        assert_eq!(classical(), GarzoDufty::default());
    }

    #[test]
    fn limits_of_the_frictional_column() {
        let grains = proposed("").kinetic(0.7, 0.4);
        // Few grains: the coefficients vanish with them, the pressure is that of a gas.
        let few = |phi: f64| grains.transport(phi, 0.635, 0.1, 2.0);
        // Saltation 0.1/(5 2) and collisions (4/5)(1.7)(0.0923153/0.87125), each times phi.
        assert_relative_eq!(few(1e-9).0, 1e-9 * (0.01 + 0.144_102), max_relative = 1e-5);
        // The same for heat: 0.02 and (6/5)(1.7)(0.692364/1.476875).
        assert_relative_eq!(few(1e-9).1, 1e-9 * (0.02 + 0.956_358), max_relative = 1e-5);
        assert_relative_eq!(few(2e-9).0 / few(1e-9).0, 2.0, max_relative = 1e-6);
        assert_relative_eq!(few(2e-9).1 / few(1e-9).1, 2.0, max_relative = 1e-6);
        assert_relative_eq!(grains.pressure_per_grain(1e-9, 0.635), 1.0, max_relative = 1e-8);
        // Dense: contacts carry everything, with and without saltation.
        let (with, without) = (grains, Kinetic { saltation: None, ..grains });
        let (a, b) = (with.transport(0.63, 0.005, 0.1, 2.0), without.transport(0.63, 0.005, 0.1, 2.0));
        assert_relative_eq!(a.0, b.0, max_relative = 1e-2);
        assert_relative_eq!(a.1, b.1, max_relative = 1e-2);
    }

    #[test]
    fn where_saltation_limits_nothing_is_known() {
        let unlimited = |e: f64, phi: f64| proposed("").kinetic(e, 0.4).unlimited(phi, 0.635 - phi);
        assert!(!unlimited(0.7, 0.6) && !unlimited(0.5, 0.6) && !unlimited(0.3, 0.3));
        assert!(unlimited(0.3, 0.4));
    }
}
