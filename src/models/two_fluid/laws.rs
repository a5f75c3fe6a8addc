//! The laws of a two-fluid flow in units of its grains: length d, velocity V = ((rho_p/rho_f - 1) g d)^(1/2), time d/V, density
//! rho_f, stress (rho_p - rho_f) g d = rho_f V^2, and the granular temperature in V^2.

use crate::closures::dispersion::Spread;
use crate::closures::drag::DallavalleGrain;
use crate::closures::kinetic::static_friction::Threshold;
use crate::closures::kinetic::{Elastic, JohnsonJackson, Moving, Stresses};
use crate::closures::mixing_length::{LowSubmergence, MixingLength};
use crate::models::two_fluid::{FluidStress, TwoFluid};

/// Laws, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laws {
    /// rho_p/rho_f
    pub ratio: f64,
    /// submerged weight of the grains normal to the bed, per volume of grains: the cosine of the slope
    pub weight: f64,
    /// driving force on the fluid and on the grains, per volume of each
    pub drive: [f64; 2],
    /// kinematic viscosity of the fluid
    pub nu: f64,
    /// stresses of grains that move
    pub moving: Moving,
    /// pressure of enduring contacts; a modulus of 0 where there is none
    pub elastic: JohnsonJackson,
    /// friction of enduring contacts
    pub mu_s: f64,
    /// solid fraction at which the grains jam
    pub phi_max: f64,
    /// drag on single grains
    pub drag: DallavalleGrain,
    /// mixing length of the turbulence, in diameters
    pub mixing_length: MixingLength,
    /// whether the stress of the fluid carries the factor 1 - phi
    pub share: bool,
    /// turbulent dispersion of the grains: 1 over the Schmidt number; 0 without
    pub dispersion: f64,
    /// small numbers
    pub floors: Floors,
}

/// Small numbers, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floors {
    /// granular temperature that grains in the fluid keep
    pub temperature: f64,
    /// shear rate below which enduring contacts creep
    pub rate: f64,
    /// solid fraction below which grains lose their weight
    pub phi: f64,
}

impl Laws {
    /// The time in which grains fall by their diameter, in that of the grains in the fluid: long where the fluid weighs little.
    #[must_use]
    pub fn fall(&self) -> f64 {
        self.ratio.sqrt()
    }

    /// The laws of `flow`, scaled.
    #[must_use]
    pub fn scaled(flow: &TwoFluid) -> Self {
        let (d, velocity, stress) = (flow.d, flow.velocity_scale(), flow.stress_scale());
        let ratio = flow.rho_p / flow.rho_f;
        // rho_f g sin(beta), and rho_p g sin(beta), over (rho_p - rho_f) g per volume; the second by the ratio of densities.
        let drive = flow.beta.sin() / (ratio - 1.0);
        let elastic = match flow.elastic {
            Elastic::JohnsonJackson(law) => JohnsonJackson { p_0: law.p_0 / stress, ..law },
            Elastic::None => JohnsonJackson { p_0: 0.0, phi_rlp: flow.phi_max },
        };
        Self {
            ratio,
            weight: flow.beta.cos(),
            drive: [drive; 2],
            nu: flow.eta / (flow.rho_f * velocity * d),
            moving: flow.granular.moving(flow.e, flow.mu_p),
            elastic,
            mu_s: flow.static_friction.mu_s(flow.mu_p),
            phi_max: flow.phi_max,
            drag: flow.drag,
            mixing_length: match flow.mixing_length {
                MixingLength::LowSubmergence(law) => {
                    let (scale, least) = (law.scale / d, law.least / d);
                    MixingLength::LowSubmergence(LowSubmergence { scale, least, ..law })
                }
                other => other,
            },
            share: flow.fluid_stress == FluidStress::Share,
            dispersion: flow.dispersion.strength(),
            floors: Floors {
                temperature: flow.temperature_floor / (velocity * velocity),
                rate: flow.rate_floor * d / velocity,
                phi: flow.phi_floor,
            },
        }
    }
}
