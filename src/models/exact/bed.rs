//! A laminar flow between two planes over a bed of grains, as its closed form, its solver and its cross-section take it.

use crate::case::Fault;
use crate::case::tables::{Bed, BedClosures, Fluid, Form, Grains, LaminarFlow};
use crate::closures::Info;
use crate::closures::dilatancy::{self, Dilatancy, PhiIv};
use crate::closures::drag::{self, CarmanKozeny, Drag};
use crate::closures::friction::{self, Coulomb, Friction, MuIv};
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::model::{Faults, Flow, LaminarScene, Term, TermTest};
use crate::models::BedFault;
use crate::models::exact::ExactFault;

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
    /// friction of the grains at vanishing shear rate
    pub friction: Coulomb,
    /// rise of the friction with the viscous number; `None` for a constant friction
    pub rise: Option<MuIv>,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases: the two-fluid form; `None`: one velocity, the mixed form
    pub drag: Option<CarmanKozeny>,
    /// fall of the solid fraction with the viscous number; `None`: the same everywhere
    pub dilatancy: Option<PhiIv>,
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

    /// The laws of the bed.
    #[must_use]
    pub fn laws(&self) -> Vec<&'static Info> {
        let friction = if self.rise.is_some() { &friction::mu_iv::INFO } else { &friction::coulomb::INFO };
        let mut laws = vec![friction, self.viscosity.info()];
        laws.extend(self.drag.map(|_| &drag::carman_kozeny::INFO));
        laws.extend(self.dilatancy.map(|_| &dilatancy::phi_iv::INFO));
        laws
    }
}

/// Source of what a term of the bed is worth.
const CHAUCHAT: &str = "Chauchat & Medale (2010), section 3.2";

impl LaminarBed {
    /// The flow of which the model `kind` has this bed.
    #[must_use]
    pub fn scene(&self, kind: &'static str) -> Flow {
        Flow::Laminar(LaminarScene {
            kind,
            rho_f: self.rho_f,
            eta: self.eta,
            rho_p: self.rho_p,
            d: self.d,
            h_p: self.h_p,
            phi: self.phi,
            h: self.h,
            g: self.g,
            drive: match self.drive {
                Drive::PressureGradient(fall) => Ok(fall),
                Drive::Shields(theta) => Err(theta),
            },
            friction: (self.friction.mu_s, self.rise.map(|rise| rise.mu_2)),
            dilates: self.dilatancy.is_some(),
            viscosity: self.viscosity.relative(self.phi),
            two_velocities: self.drag.is_some(),
            k_ck: self.drag.map(|drag| drag.k_ck),
        })
    }

    /// The slip between the phases, if there are two velocities.
    pub(in crate::models) fn slip(&self) -> Option<Term> {
        self.drag.map(|_| Term {
            what: "slip between the phases",
            source: CHAUCHAT,
            test: TermTest::Solve {
                change: vec!["model.form=mixed".into(), "closures.drag=".into()],
                left: "one velocity for both",
                free: false,
            },
            dropped: Some(|flow| {
                if let Flow::Laminar(scene) = flow {
                    scene.k_ck = None;
                }
            }),
        })
    }
}

/// The tables of a laminar bed.
pub(in crate::models) type Tables<'a> = (&'a Fluid, &'a Grains, &'a Bed, &'a LaminarFlow, &'a BedClosures);

pub(in crate::models) fn laminar_bed(
    tables: Tables<'_>,
    form: Form,
    model: &str,
    laws: &[&'static str],
    faults: &mut Faults,
) -> Option<LaminarBed> {
    let (fluid, grains, bed, flow, closures) = tables;
    if bed.level >= flow.height {
        faults.push(("bed.level", BedFault::NoRoomForFlow { level: bed.level, height: flow.height }));
    }
    if bed.level < grains.diameter {
        faults.push(("bed.level", BedFault::ThinnerThanAGrain { level: bed.level, diameter: grains.diameter }));
    }
    if grains.density <= fluid.density {
        faults.push(("grains.density", BedFault::Floating { grains: grains.density, fluid: fluid.density }));
    }
    if let MixtureViscosity::Boyer(law) = closures.mixture_viscosity
        && bed.phi >= law.phi_max
    {
        faults.push(("bed.phi", ExactFault::Jammed { phi: bed.phi, phi_max: law.phi_max }));
    }
    let mismatch = |family, law, model: String, allowed| Fault::LawMismatch { family, law, model, allowed };
    let (friction, rise) = match closures.friction {
        Friction::Coulomb(law) if laws.contains(&friction::coulomb::INFO.law) => (Some(law), None),
        Friction::MuIv(law) if laws.contains(&friction::mu_iv::INFO.law) => {
            if law.mu_2 <= law.mu_s {
                faults.push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s: law.mu_s, mu_2: law.mu_2 }));
            }
            (Some(Coulomb { mu_s: law.mu_s }), Some(law))
        }
        other => {
            faults.push(("closures.friction.law", mismatch("friction", other.law(), model.into(), laws.to_vec())));
            (None, None)
        }
    };
    let drag = match (form, closures.drag) {
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
    let dilatancy = match closures.dilatancy {
        Dilatancy::None => None,
        Dilatancy::PhiIv(law) if rise.is_some() => Some(law),
        Dilatancy::PhiI(_) => {
            let allowed = vec![dilatancy::none::INFO.law, dilatancy::phi_iv::INFO.law];
            let fault = mismatch("dilatancy", dilatancy::phi_i::INFO.law, model.into(), allowed);
            faults.push(("closures.dilatancy.law", fault));
            None
        }
        Dilatancy::PhiIv(_) => {
            let model = format!("{model} unless the friction is {}", friction::mu_iv::INFO.law);
            let allowed = vec![dilatancy::none::INFO.law];
            faults.push(("closures.dilatancy.law", mismatch("dilatancy", dilatancy::phi_iv::INFO.law, model, allowed)));
            None
        }
    };
    if dilatancy.is_some() && drag.is_some_and(|law: CarmanKozeny| law.phi_min == 0.0) {
        let model = format!("{model} with closures.dilatancy, unless closures.drag.phi_min is more than 0");
        let law = drag::carman_kozeny::INFO.law;
        faults.push(("closures.drag.law", mismatch("drag", law, model, vec![law])));
    }
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
        rise,
        viscosity: closures.mixture_viscosity,
        drag,
        dilatancy,
    })
}
