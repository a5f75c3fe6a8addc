//! The family of granular stresses: the classical kinetic theory, the one with friction and saltation, and mu(I)/phi(I).
//!
//! | | classical | frictional and collisional |
//! |---|---|---|
//! | `g_0` | Chialvo & Sundaresan | with a(mu_p) |
//! | dissipation | with e | with e_eff(e, mu_p) |
//! | kinetic parts of F2, F3 | of the theory | harmonic sum with saltation |
//! | drag work | 3 K T | (3 + 2 C_inf/C_D) K T |
//!
//! Each of the four changes can be taken back alone. Source: Chassagne et al. (2023), Table 1.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Dissipation, DragWork, Inertial, Radial, Saltation, garzo_dufty, inertial, saltation};
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static FRICTIONAL_COLLISIONAL: Info = Info {
    family: "granular",
    law: "frictional-collisional",
    equation: "as garzo-dufty with g₀(φ; μ_p), e_eff in F₄, harmonic saltation in F₂ and F₃, J = -φ (1 - φ) K (3 + 2 C_∞/C_D) T",
    source: "Chassagne et al. (2023), Table 1, right column",
    ranges: &[garzo_dufty::RESTITUTION_RANGE, Range { variable: "friction", min: 0.0, max: 1.5 }],
    standing: Standing::Validated,
};

/// Stresses of grains that move.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Granular {
    /// The classical kinetic theory of frictionless grains.
    GarzoDufty(GarzoDufty),
    /// Kinetic theory with the friction between grains, and with saltation.
    FrictionalCollisional(FrictionalCollisional),
    /// Dense granular flow: mu(I) and phi(I).
    MuI(Inertial),
}

/// The classical kinetic theory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GarzoDufty {
    /// Radial distribution function.
    #[serde(default = "smooth")]
    pub radial: Radial,
}

/// Kinetic theory with friction and saltation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrictionalCollisional {
    /// Radial distribution function.
    #[serde(default = "frictional")]
    pub radial: Radial,
    /// Restitution in the dissipation.
    #[serde(default = "jenkins_zhang")]
    pub dissipation: Dissipation,
    /// Tangential restitution coefficient, in the effective restitution.
    #[serde(default)]
    #[schemars(extend("x-unit" = "1", "minimum" = -0.9, "maximum" = 1.0))]
    pub e_t: f64,
    /// What limits the kinetic parts of viscosity and conductivity.
    #[serde(default)]
    pub saltation: Limit,
    /// Correlations left out in the average over saltating grains: 5 in water, 20 in air.
    #[serde(default = "c_0")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub c_0: f64,
    /// Viscosity over conductivity of saltation.
    #[serde(default = "sigma")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub sigma: f64,
    /// Work of the drag on the velocity fluctuations.
    #[serde(default = "quadratic")]
    pub drag_work: DragWork,
}

/// What limits the kinetic parts of viscosity and conductivity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Limit {
    /// Nothing.
    None,
    /// The drag on grains that fly one by one.
    #[default]
    Harmonic,
}

fn smooth() -> Radial {
    Radial::ChialvoSundaresan
}

fn frictional() -> Radial {
    Radial::Frictional
}

fn jenkins_zhang() -> Dissipation {
    Dissipation::JenkinsZhang
}

fn quadratic() -> DragWork {
    DragWork::Quadratic
}

fn c_0() -> f64 {
    Saltation::default().c_0
}

fn sigma() -> f64 {
    Saltation::default().sigma
}

impl Granular {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::GarzoDufty(_) => &garzo_dufty::INFO,
            Self::FrictionalCollisional(_) => &FRICTIONAL_COLLISIONAL,
            Self::MuI(_) => &inertial::INFO,
        }
    }

    /// Catalogue entries of the laws that it is made of.
    #[must_use]
    pub fn parts(&self) -> Vec<&'static Info> {
        match self {
            Self::GarzoDufty(law) => vec![law.radial.info()],
            Self::FrictionalCollisional(law) => {
                let mut parts = vec![law.radial.info(), law.dissipation.info(), law.drag_work.info()];
                parts.extend((law.saltation == Limit::Harmonic).then_some(&saltation::INFO));
                parts
            }
            Self::MuI(_) => Vec::new(),
        }
    }
}

impl Default for GarzoDufty {
    /// As published.
    fn default() -> Self {
        Self { radial: smooth() }
    }
}

impl Default for FrictionalCollisional {
    /// As published.
    fn default() -> Self {
        Self {
            radial: frictional(),
            dissipation: jenkins_zhang(),
            e_t: 0.0,
            saltation: Limit::default(),
            c_0: c_0(),
            sigma: sigma(),
            drag_work: quadratic(),
        }
    }
}

impl GarzoDufty {
    /// The theory of grains with the restitution `e`; the friction `mu_p` counts in the frictional `g_0` alone.
    #[must_use]
    pub fn kinetic(&self, e: f64, mu_p: f64) -> Kinetic {
        Kinetic {
            e,
            e_eff: e,
            radial: self.radial,
            a: self.radial.coefficient(mu_p),
            saltation: None,
            drag_work: DragWork::Linear,
        }
    }
}

impl FrictionalCollisional {
    /// The theory of grains with the restitution `e` and the friction `mu_p`.
    #[must_use]
    pub fn kinetic(&self, e: f64, mu_p: f64) -> Kinetic {
        let saltation = (self.saltation == Limit::Harmonic).then_some(Saltation { c_0: self.c_0, sigma: self.sigma });
        Kinetic {
            e,
            e_eff: self.dissipation.restitution(e, mu_p, self.e_t),
            radial: self.radial,
            a: self.radial.coefficient(mu_p),
            saltation,
            drag_work: self.drag_work,
        }
    }
}

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
