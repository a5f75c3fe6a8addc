//! Problems of single grains.

use std::f64::consts::FRAC_PI_2;

use super::Faults;
use crate::case::Fault;
use crate::case::grain_tables::{Bottom, Discrete, Target, Trial as Which};
use crate::case::scene::{GrainsBed as BedScene, Impact as ImpactScene, Trial as TrialScene};
use crate::case::tables::SlopeDefinition;
use crate::closures::contact::{Contact, LinearSpring};

/// A bed of spheres. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainBed {
    /// diameter [m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// mobile grains
    pub mobile: usize,
    /// what the bed rests on
    pub bottom: Bottom,
    /// period along x, and period or distance of walls along y [m]
    pub size: [f64; 2],
    /// whether walls bound y
    pub side_walls: bool,
    /// whether those are without friction
    pub smooth_walls: bool,
    /// slope angle [rad]
    pub beta: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// contact of the grains
    pub contact: LinearSpring,
    /// how they are moved and averaged
    pub discrete: Discrete,
}

/// The impact of one sphere. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// diameter [m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// velocity before [m/s]
    pub velocity: f64,
    /// angle with the normal [rad]
    pub angle: f64,
    /// angular velocity before [1/s]
    pub spin: f64,
    /// what it hits
    pub target: Target,
    /// contact
    pub contact: LinearSpring,
    /// steps within the duration of the contact
    pub steps_per_contact: f64,
}

/// A few grains, held against what is known exactly. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// what they are held against
    pub trial: Which,
    /// diameter [m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// velocity at the beginning [m/s]
    pub velocity: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// contact
    pub contact: LinearSpring,
    /// steps within the duration of a contact
    pub steps_per_contact: f64,
}

/// Most grains of a case: what a machine of today holds.
const MOST_GRAINS: f64 = 2e7;

pub(super) fn bed(scene: &BedScene, faults: &mut Faults) -> Option<GrainBed> {
    let BedScene { grains, bed, flow, closures, discrete, .. } = scene;
    let (definition, beta) = match flow.slope_definition {
        SlopeDefinition::Tangent => ("tangent", flow.slope.atan()),
        SlopeDefinition::Sine => ("sine", flow.slope.asin()),
        SlopeDefinition::Angle => ("angle", flow.slope),
    };
    // The arc sine of more than 1 is not a number: not (beta < pi/2) catches it.
    let upright = beta < FRAC_PI_2;
    if !upright {
        faults.push(("flow.slope", Fault::TooSteep { definition, value: flow.slope }));
    }
    let d = grains.diameter;
    let count = bed.layers * (flow.length / d) * (flow.width / d);
    let wide = |name: &'static str, length: f64, least: f64, faults: &mut Faults| {
        if length < least * d {
            faults.push((name, Fault::GrainRoom { name, value: length, least: least * d, most: 1e3 }));
        }
    };
    wide("flow.length", flow.length, 4.0, faults);
    wide("flow.width", flow.width, if flow.side_walls { 1.0 } else { 4.0 }, faults);
    let possible = (1.0..=MOST_GRAINS).contains(&count);
    if !possible {
        let name = "the number of mobile grains";
        faults.push(("bed.layers", Fault::GrainRoom { name, value: count, least: 1.0, most: MOST_GRAINS }));
    }
    let Contact::LinearSpring(contact) = closures.contact;
    Some(GrainBed {
        d,
        rho_p: grains.density,
        mobile: if possible { count.round() as usize } else { 1 },
        bottom: bed.bottom,
        size: [flow.length, flow.width],
        side_walls: flow.side_walls,
        smooth_walls: flow.smooth_walls,
        beta,
        g: flow.gravity,
        contact,
        discrete: *discrete,
    })
}

pub(super) fn trial(scene: &TrialScene) -> Trial {
    let Contact::LinearSpring(contact) = scene.closures.contact;
    Trial {
        trial: scene.model.trial,
        d: scene.grains.diameter,
        rho_p: scene.grains.density,
        velocity: scene.flow.velocity,
        g: scene.flow.gravity,
        contact,
        steps_per_contact: scene.discrete.steps_per_contact,
    }
}

pub(super) fn impact(scene: &ImpactScene) -> Impact {
    let Contact::LinearSpring(contact) = scene.closures.contact;
    Impact {
        d: scene.grains.diameter,
        rho_p: scene.grains.density,
        velocity: scene.flow.velocity,
        angle: scene.flow.angle,
        spin: scene.flow.spin,
        target: scene.flow.target,
        contact,
        steps_per_contact: scene.discrete.steps_per_contact,
    }
}
