//! Kinetic theory of grains with friction: four changes of the classical one, of which each can be taken back alone.
//!
//! | | classical | frictional and collisional |
//! |---|---|---|
//! | `g_0` | Chialvo & Sundaresan | with a(mu_p) |
//! | dissipation | with e | with e_eff(e, mu_p) |
//! | kinetic parts of F2, F3 | of the theory | harmonic sum with saltation |
//! | drag work | 3 K T | (3 + 2 C_inf/C_D) K T |
//!
//! Source: Chassagne et al. (2023), Table 1.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Dissipation, DragWork, Kinetic, Limit, Moving, Radial, Saltation, Stresses, garzo_dufty, saltation};
use crate::closures::kinetic::dissipation::EffectiveRestitution;
use crate::closures::kinetic::radial::AtContact;
use crate::closures::{Info, Range, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular",
    law: "frictional-collisional",
    equation: "p_kin = ρ_p F₁ T,  η = ρ_p d F₂ T^½,  κ = ρ_p d F₃ T^½,  Γ = -(ρ_p/d) F₄ T^(3/2),  F₁ to F₄ of garzo-dufty with g₀(φ; μ_p), e_eff in F₄, saltation in F₂ and F₃",
    source: "Chassagne et al. (2023), Table 1, right column",
    ranges: &[garzo_dufty::RESTITUTION_RANGE, Range { variable: "friction", min: 0.0, max: 1.5 }],
    standing: Standing::Validated,
};

/// Kinetic theory with the friction between grains, and with saltation.
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

impl Stresses for FrictionalCollisional {
    fn moving(&self, e: f64, mu_p: f64) -> Moving {
        Moving::Kinetic(self.kinetic(e, mu_p))
    }

    fn parts(&self) -> Vec<&'static Info> {
        let mut parts = vec![self.radial.info(), self.dissipation.info(), self.drag_work.info()];
        parts.extend((self.saltation == Limit::Harmonic).then_some(&saltation::INFO));
        parts
    }
}
