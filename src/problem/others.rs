//! The smaller problems: a yield-stress fluid, a granular film, a rough wall.

use std::f64::consts::FRAC_PI_2;

use super::Faults;
use super::bed::size;
use crate::case::Fault;
use crate::case::scene::{BagnoldFilm, Bingham, BinghamPlane as BinghamScene, LogLaw};
use crate::case::tables::SlopeDefinition;
use crate::case::tables::{BinghamFluid, PlaneFlow};
use crate::closures::friction::{self, Friction, MuI};
use crate::closures::mixing_length::{self, MixingLength, Prandtl};
use crate::closures::regularisation::Regularisation;
use crate::closures::wall::{Rough, Wall};

/// Name of the scene of the rough wall.
const LOG_LAW: &str = "exact/log-law";

/// What drives the Bingham fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BinghamDrive {
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    PressureGradient(f64),
    /// wanted mean velocity [m/s]
    MeanVelocity(f64),
}

/// A Bingham fluid between two planes. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinghamPlane {
    /// density [kg/m3]
    pub rho: f64,
    /// plastic viscosity [Pa s]
    pub eta: f64,
    /// yield stress [Pa]
    pub tau_0: f64,
    /// distance of the planes [m]
    pub h: f64,
    /// what drives the flow
    pub drive: BinghamDrive,
}

/// Dry grains that flow down a slope. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GranularFilm {
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains [m]
    pub d: f64,
    /// solid fraction
    pub phi: f64,
    /// thickness of the film [m]
    pub h: f64,
    /// slope angle [rad]
    pub beta: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// friction of the grains
    pub friction: MuI,
}

/// A turbulent layer of constant stress over a rough wall. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughWall {
    /// density [kg/m3]
    pub rho_f: f64,
    /// viscosity [Pa s]
    pub eta: f64,
    /// height up to which the profile is given [m]
    pub h: f64,
    /// friction velocity [m/s]
    pub u_star: f64,
    /// mixing length
    pub mixing_length: Prandtl,
    /// roughness
    pub wall: Rough,
}

/// A Bingham fluid that is solved numerically.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegularisedPlane {
    /// the flow
    pub plane: BinghamPlane,
    /// how the yield stress is smoothed; lambda in units of [`BinghamPlane::shear_scale`]
    pub regularisation: Regularisation,
    /// whether nodes lie on the edges of the plug
    pub yield_node: bool,
}

impl BinghamPlane {
    /// Unit of the shear rate [1/s]: U_m/H where the mean velocity is given, G H/eta where the gradient is.
    #[must_use]
    pub fn shear_scale(&self) -> f64 {
        match self.drive {
            BinghamDrive::PressureGradient(gradient) => gradient * self.h / self.eta,
            BinghamDrive::MeanVelocity(mean) => mean / self.h,
        }
    }
}

pub(super) fn bingham_plane(scene: &BinghamScene) -> Option<BinghamPlane> {
    plane(&scene.fluid, &scene.flow)
}

pub(super) fn bingham(scene: &Bingham, faults: &mut Faults) -> Option<RegularisedPlane> {
    let size = size(&scene.regularisation, faults);
    let plane = plane(&scene.fluid, &scene.flow)?;
    let regularisation = Regularisation { law: scene.regularisation.law, lambda: size?.to_scaled(plane.shear_scale()) };
    Some(RegularisedPlane { plane, regularisation, yield_node: scene.grid.yield_node })
}

fn plane(fluid: &BinghamFluid, flow: &PlaneFlow) -> Option<BinghamPlane> {
    let drive = match (flow.pressure_gradient, flow.mean_velocity) {
        (Some(gradient), _) => BinghamDrive::PressureGradient(gradient),
        (None, Some(mean)) => BinghamDrive::MeanVelocity(mean),
        (None, None) => return None,
    };
    Some(BinghamPlane { rho: fluid.density, eta: fluid.viscosity, tau_0: fluid.yield_stress, h: flow.height, drive })
}

pub(super) fn bagnold(scene: &BagnoldFilm, model: &str, faults: &mut Faults) -> Option<GranularFilm> {
    let BagnoldFilm { grains, bed, flow, closures, .. } = scene;
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
    let friction = match closures.friction {
        Friction::MuI(law) => law,
        other => {
            let allowed = vec![friction::mu_i::INFO.law];
            let fault = Fault::LawMismatch { family: "friction", law: other.law(), model: model.into(), allowed };
            faults.push(("closures.friction.law", fault));
            return None;
        }
    };
    if friction.mu_2 <= friction.mu_s {
        faults.push(("closures.friction.mu_2", Fault::FrictionFalls { mu_s: friction.mu_s, mu_2: friction.mu_2 }));
    }
    Some(GranularFilm {
        rho_p: grains.density,
        d: grains.diameter,
        phi: bed.phi,
        h: flow.height,
        beta,
        g: flow.gravity,
        friction,
    })
}

pub(super) fn log_law(scene: &LogLaw, faults: &mut Faults) -> Option<RoughWall> {
    let LogLaw { fluid, flow, closures, .. } = scene;
    let mixing_length = match closures.mixing_length {
        MixingLength::Prandtl(law) => law,
        other => {
            let (law, allowed) = (other.info().law, vec![mixing_length::prandtl::INFO.law]);
            let fault = Fault::LawMismatch { family: "mixing_length", law, model: LOG_LAW.into(), allowed };
            faults.push(("closures.mixing_length.law", fault));
            return None;
        }
    };
    let Wall::Rough(wall) = closures.wall;
    if wall.roughness_length() >= flow.height {
        let fault = Fault::RoughnessAboveFlow { length: wall.roughness_length(), height: flow.height };
        faults.push(("closures.wall.k_s", fault));
    }
    Some(RoughWall {
        rho_f: fluid.density,
        eta: fluid.viscosity,
        h: flow.height,
        u_star: flow.u_star,
        mixing_length,
        wall,
    })
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::problem::Problem;

    #[test]
    fn the_log_law_takes_the_mixing_length_of_a_wall_only() {
        let with = |settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
            let case = Case::load("exact_1d_loglaw", &settings).unwrap();
            Problem::new(&case)
        };
        assert!(with(&["closures.mixing_length.law=prandtl"]).is_ok());
        let refused =
            with(&["closures.mixing_length={ law = \"li-sawamoto\", phi_max = 0.6, below_packed = \"zero\" }"]);
        let message = format!("{:?}", refused.unwrap_err());
        assert!(message.contains("LawMismatch") && message.contains("li-sawamoto"), "{message}");
    }
}
