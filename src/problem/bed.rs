//! A laminar flow between two planes over a bed of grains.

use super::Faults;
use crate::case::Fault;
use crate::case::scene::Ouriemi;
use crate::case::tables::Form;
use crate::closures::drag::{self, CarmanKozeny, Drag};
use crate::closures::friction::{self, Coulomb, Friction};
use crate::closures::mixture_viscosity::MixtureViscosity;

/// What drives the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    PressureGradient(f64),
    /// wanted Shields number
    Shields(f64),
}

/// A laminar flow between two planes, the lower part filled with grains. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminarBed {
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains [m]
    pub d: f64,
    /// bed level [m]
    pub h_p: f64,
    /// solid fraction of the bed
    pub phi: f64,
    /// flow height [m]
    pub h: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// what drives the flow
    pub drive: Drive,
    /// friction of the grains
    pub friction: Coulomb,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases: the two-fluid form; `None`: one velocity, the mixed form
    pub drag: Option<CarmanKozeny>,
}

impl LaminarBed {
    /// Stress scale (rho_p - rho_f) g H [Pa] of Chauchat & Medale (2010).
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.rho_p - self.rho_f) * self.g * self.h
    }

    /// Velocity scale (rho_p - rho_f) g H^2/eta [m/s].
    #[must_use]
    pub fn velocity_scale(&self) -> f64 {
        self.stress_scale() * self.h / self.eta
    }

    /// `mixed` or `two-fluid`.
    #[must_use]
    pub fn form_name(&self) -> &'static str {
        if self.drag.is_some() { "two-fluid" } else { "mixed" }
    }
}

pub(super) fn ouriemi(scene: &Ouriemi, model: &str, faults: &mut Faults) -> Option<LaminarBed> {
    let Ouriemi { fluid, grains, bed, flow, closures, .. } = scene;
    if bed.level >= flow.height {
        faults.push(("bed.level", Fault::NoRoomForFlow { level: bed.level, height: flow.height }));
    }
    if bed.level < grains.diameter {
        faults.push(("bed.level", Fault::ThinnerThanAGrain { level: bed.level, diameter: grains.diameter }));
    }
    if grains.density <= fluid.density {
        faults.push(("grains.density", Fault::Floating { grains: grains.density, fluid: fluid.density }));
    }
    if let MixtureViscosity::Boyer(law) = closures.mixture_viscosity
        && bed.phi >= law.phi_max
    {
        faults.push(("bed.phi", Fault::Jammed { phi: bed.phi, phi_max: law.phi_max }));
    }
    let mismatch = |family, law, model: String, allowed| Fault::LawMismatch { family, law, model, allowed };
    let friction = match closures.friction {
        Friction::Coulomb(law) => Some(law),
        other => {
            let fault = mismatch("friction", other.law(), model.into(), vec![friction::coulomb::INFO.law]);
            faults.push(("closures.friction.law", fault));
            None
        }
    };
    let drag = match (scene.model.form, closures.drag) {
        (Form::Mixed, Drag::None) => None,
        (Form::TwoFluid, Drag::CarmanKozeny(law)) => Some(law),
        (Form::Mixed, law) => {
            let fault =
                mismatch("drag", law.info().law, format!("{model} in the mixed form"), vec![drag::none::INFO.law]);
            faults.push(("closures.drag.law", fault));
            None
        }
        (Form::TwoFluid, law) => {
            let allowed = vec![drag::carman_kozeny::INFO.law];
            let fault = mismatch("drag", law.info().law, format!("{model} in the two-fluid form"), allowed);
            faults.push(("closures.drag.law", fault));
            None
        }
    };
    let drive = match (flow.pressure_gradient, flow.shields) {
        (Some(gradient), _) => Drive::PressureGradient(gradient),
        (None, Some(shields)) => Drive::Shields(shields),
        (None, None) => return None,
    };
    Some(LaminarBed {
        rho_f: fluid.density,
        eta: fluid.viscosity,
        rho_p: grains.density,
        d: grains.diameter,
        h_p: bed.level,
        phi: bed.phi,
        h: flow.height,
        g: flow.gravity,
        drive,
        friction: friction?,
        viscosity: closures.mixture_viscosity,
        drag,
    })
}
