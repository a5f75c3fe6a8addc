//! A turbulent flow over a bed that shears: the two-layer sheet flow.

use std::f64::consts::FRAC_PI_2;

use super::Faults;
use crate::case::Fault;
use crate::case::scene::SheetFlow as Scene;
use crate::case::sheet::SheetSmoothing;
pub use crate::case::sheet::{BedReading, SheetMethod};
use crate::case::tables::SlopeDefinition;
use crate::closures::dilatancy::{self, Dilatancy, PhiI};
use crate::closures::drag::{self, Dallavalle, Drag};
use crate::closures::friction::{self, Friction, MuI};
use crate::closures::lid::Lid;
use crate::closures::mixing_length::{self, BelowPacked, LiSawamoto, MixingLength};
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::rearrangement::Rearrangement;
use crate::closures::suspension::Suspension;

/// A sheet flow. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetFlow {
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains [m]
    pub d: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// flow height [m]
    pub height: f64,
    /// bed level [m]
    pub level: f64,
    /// what the bed level is
    pub reading: BedReading,
    /// wanted fluid stress at the bed level [Pa]
    pub tau_b: Option<f64>,
    /// sine of the slope
    pub sine: Option<f64>,
    /// top of the flow
    pub lid: Lid,
    /// friction of the grains
    pub friction: MuI,
    /// dilatancy of the grains
    pub dilatancy: PhiI,
    /// rearrangement time of the grains
    pub rearrangement: Rearrangement,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases
    pub drag: Dallavalle,
    /// mixing length of the turbulence
    pub mixing_length: LiSawamoto,
    /// grains in suspension
    pub suspension: Suspension,
    /// regularisation [1/s]; 0 for the exact yield
    pub lambda: f64,
    /// solid volume under the interface without the buoyancy of the viscous stress [m]
    pub cut: f64,
    /// whether it becomes deeper where the equations change type below it
    pub deepen_cut: bool,
    /// how it is solved
    pub method: SheetMethod,
    /// step of pseudo-time [s], relative residual and number of turns of the iteration
    pub pace: (f64, f64, usize),
}

impl SheetFlow {
    /// Stress scale (rho_p - rho_f) g d [Pa].
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.rho_p - self.rho_f) * self.g * self.d
    }

    /// Velocity scale sqrt((rho_p/rho_f - 1) g d) [m/s].
    #[must_use]
    pub fn velocity_scale(&self) -> f64 {
        (self.stress_scale() / self.rho_f).sqrt()
    }
}

/// Drives, and those that were given.
const DRIVES: [&str; 3] = ["shields", "u_star", "slope"];

pub(super) fn sheet_flow(scene: &Scene, model: &str, faults: &mut Faults) -> Option<SheetFlow> {
    let Scene { fluid, grains, bed, flow, closures, regularisation, solver, .. } = scene;
    if bed.level >= flow.height {
        faults.push(("bed.level", Fault::NoRoomForFlow { level: bed.level, height: flow.height }));
    }
    if bed.level < grains.diameter {
        faults.push(("bed.level", Fault::ThinnerThanAGrain { level: bed.level, diameter: grains.diameter }));
    }
    if grains.density <= fluid.density {
        faults.push(("grains.density", Fault::Floating { grains: grains.density, fluid: fluid.density }));
    }
    let dilatancy = match closures.dilatancy {
        Dilatancy::PhiI(law) => law,
        other => {
            let (law, allowed) = (other.info().law, vec![dilatancy::phi_i::INFO.law]);
            let fault = Fault::LawMismatch { family: "dilatancy", law, model: model.into(), allowed };
            faults.push(("closures.dilatancy.law", fault));
            return None;
        }
    };
    if let MixtureViscosity::Boyer(law) = closures.mixture_viscosity
        && law.phi_max < dilatancy.phi_max
    {
        let fault = Fault::PackedBeyond { law: "the viscosity", phi_max: law.phi_max, bed: dilatancy.phi_max };
        faults.push(("closures.mixture_viscosity.phi_max", fault));
    }
    let drives: Vec<String> = [flow.shields, flow.u_star, flow.slope]
        .iter()
        .zip(DRIVES)
        .filter_map(|(given, name)| given.map(|_| name.to_owned()))
        .collect();
    let solved = closures.lid == Lid::Solved;
    let complete = if solved { flow.slope.is_some() && drives.len() == 2 } else { drives.len() == 1 };
    if !complete {
        let allowed = if solved {
            vec!["slope with shields".to_owned(), "slope with u_star".to_owned()]
        } else {
            DRIVES.iter().map(|&name| name.to_owned()).collect()
        };
        faults.push(("flow", Fault::Drives { given: drives, allowed }));
    }
    let sine = flow.slope.map(|slope| slope_sine(slope, flow.slope_definition, faults));
    let mismatch =
        |family, law, allowed| Fault::LawMismatch { family, law, model: model.into(), allowed: vec![allowed] };
    let friction = match closures.friction {
        Friction::MuI(law) => Some(law),
        other => {
            faults.push(("closures.friction.law", mismatch("friction", other.law(), friction::mu_i::INFO.law)));
            None
        }
    };
    if let Some(MuI { mu_s, mu_2, .. }) = friction
        && mu_2 <= mu_s
    {
        faults.push(("closures.friction.mu_2", Fault::FrictionFalls { mu_s, mu_2 }));
    }
    let drag = match closures.drag {
        Drag::Dallavalle(law) => Some(law),
        other => {
            faults.push(("closures.drag.law", mismatch("drag", other.info().law, drag::dallavalle::INFO.law)));
            None
        }
    };
    let mixing_length = match closures.mixing_length {
        MixingLength::LiSawamoto(law) => Some(law),
        other => {
            let allowed = mixing_length::li_sawamoto::INFO.law;
            faults.push(("closures.mixing_length.law", mismatch("mixing_length", other.info().law, allowed)));
            None
        }
    };
    if let Some(law) = mixing_length
        && (law.phi_max < dilatancy.phi_max || law.below_packed == BelowPacked::Zero)
    {
        let fault = Fault::PackedBeyond { law: "the mixing length", phi_max: law.phi_max, bed: dilatancy.phi_max };
        faults.push(("closures.mixing_length.phi_max", fault));
    }
    let lambda = match (regularisation.law, regularisation.lambda) {
        (SheetSmoothing::None, None) => Some(0.0),
        (SheetSmoothing::Simple, Some(lambda)) => Some(lambda),
        (law, given) => {
            let exact = law == SheetSmoothing::None;
            faults.push(("regularisation", Fault::RegularisationSize { given: usize::from(given.is_some()), exact }));
            None
        }
    };
    if scene.model.method == SheetMethod::Iteration && lambda == Some(0.0) {
        faults.push(("model.method", Fault::IterationNeedsCreep));
    }
    let (lambda, sine) = (lambda?, sine.map_or(Some(None), |sine| sine.map(Some))?);
    Some(SheetFlow {
        rho_f: fluid.density,
        eta: fluid.viscosity,
        rho_p: grains.density,
        d: grains.diameter,
        g: flow.gravity,
        height: flow.height,
        level: bed.level,
        reading: bed.reading,
        tau_b: match (flow.shields, flow.u_star) {
            (Some(shields), _) => Some(shields * (grains.density - fluid.density) * flow.gravity * grains.diameter),
            (None, Some(u_star)) => Some(fluid.density * u_star * u_star),
            (None, None) => None,
        },
        sine,
        lid: closures.lid,
        friction: friction?,
        dilatancy,
        rearrangement: closures.rearrangement,
        viscosity: closures.mixture_viscosity,
        drag: drag?,
        mixing_length: mixing_length?,
        suspension: closures.suspension,
        lambda,
        cut: regularisation.interface_cut * grains.diameter,
        deepen_cut: regularisation.deepen_cut,
        method: scene.model.method,
        pace: (solver.time_step, solver.tolerance, solver.turns),
    })
}

/// Sine of a slope below the vertical.
fn slope_sine(slope: f64, definition: SlopeDefinition, faults: &mut Faults) -> Option<f64> {
    let (name, angle) = match definition {
        SlopeDefinition::Tangent => ("tangent", slope.atan()),
        SlopeDefinition::Sine => ("sine", slope.asin()),
        SlopeDefinition::Angle => ("angle", slope),
    };
    // The arc sine of more than 1 is not a number.
    if angle < FRAC_PI_2 {
        return Some(if definition == SlopeDefinition::Sine { slope } else { angle.sin() });
    }
    faults.push(("flow.slope", Fault::TooSteep { definition: name, value: slope }));
    None
}
