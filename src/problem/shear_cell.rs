//! Problems of grains between two walls that move.

use super::Faults;
use crate::case::Fault;
use crate::case::scene::ShearCell as Scene;
use crate::closures::kinetic::{FRICTIONAL_COLLISIONAL, Granular, Kinetic, garzo_dufty};

/// Grains between two walls, without fluid or gravity. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearCell {
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains [m]
    pub d: f64,
    /// distance of the walls [m]
    pub h: f64,
    /// solid fraction, mean over the gap
    pub phi: f64,
    /// solid fraction at which the grains jam
    pub phi_max: f64,
    /// velocity of the grains at the lower and the upper wall [m/s]
    pub velocity: [f64; 2],
    /// granular temperature there [m2/s2]
    pub temperature: [f64; 2],
    /// law of the grains
    pub granular: Granular,
    /// its numbers
    pub kinetic: Kinetic,
}

pub(super) fn shear_cell(scene: &Scene, model: &str, faults: &mut Faults) -> Option<ShearCell> {
    let Scene { grains, flow, closures, .. } = scene;
    if flow.phi >= flow.phi_max {
        let allowed = format!("less than flow.phi_max = {}", flow.phi_max);
        faults.push(("flow.phi", Fault::OutOfRange { name: "phi".into(), value: flow.phi, allowed }));
    }
    if flow.height < grains.diameter {
        let fault = Fault::ThinnerThanAGrain { level: flow.height, diameter: grains.diameter };
        faults.push(("flow.height", fault));
    }
    let kinetic = match closures.granular {
        Granular::GarzoDufty(law) => law.kinetic(grains.restitution, grains.friction),
        Granular::FrictionalCollisional(law) => law.kinetic(grains.restitution, grains.friction),
        Granular::MuI(_) => {
            let (law, allowed) =
                (closures.granular.info().law, vec![garzo_dufty::INFO.law, FRICTIONAL_COLLISIONAL.law]);
            let fault = Fault::LawMismatch { family: "granular", law, model: model.into(), allowed };
            faults.push(("closures.granular.law", fault));
            return None;
        }
    };
    Some(ShearCell {
        rho_p: grains.density,
        d: grains.diameter,
        h: flow.height,
        phi: flow.phi,
        phi_max: flow.phi_max,
        velocity: [flow.velocity_lower, flow.velocity_upper],
        temperature: [flow.temperature_lower, flow.temperature_upper],
        granular: closures.granular,
        // Nothing but the collisions ends the flight of a grain here.
        kinetic: Kinetic { saltation: None, ..kinetic },
    })
}
