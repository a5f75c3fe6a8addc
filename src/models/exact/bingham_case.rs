//! The case of the Bingham fluid between two planes, and the problem that its closed form and its solver share.

use super::bingham::{equations, run};
use crate::case::tables::Grid;
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::models::premises;
use crate::part;
use crate::result::Context;
use crate::result::Premise;
use crate::result::Results;
use crate::result::{Failure, Outcome};
use crate::scene::ChannelScene;
use crate::scene::Scene;

part! {
    /// Bingham fluid between two planes, in closed form.
    pub struct BinghamExact {
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

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
    /// yield stress \[Pa]
    pub tau_0: f64,
    /// distance of the planes \[m]
    pub h: f64,
    /// what drives the flow
    pub drive: BinghamDrive,
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

/// What a plane flow of a yield-stress fluid takes of a channel.
pub(in crate::models) const PLANE: [&str; 3] = ["pressure_gradient", "mean_velocity", "yield_stress"];

/// The plane flow of a scene; `None` where it has no drive.
pub(in crate::models) fn plane(scene: &ChannelScene) -> Option<BinghamPlane> {
    let ChannelScene { fluid, flow } = scene;
    let drive = match (flow.pressure_gradient, flow.mean_velocity) {
        (Some(gradient), _) => BinghamDrive::PressureGradient(gradient),
        (None, Some(mean)) => BinghamDrive::MeanVelocity(mean),
        (None, None) => return None,
    };
    Some(BinghamPlane { rho: fluid.density, eta: fluid.viscosity, tau_0: fluid.yield_stress, h: flow.depth, drive })
}

impl Model for OnMesh<BinghamPlane> {
    const INFO: ModelInfo = ModelInfo::new("bingham-exact").taking(&PLANE);
    type Scene = ChannelScene;
    type Table = BinghamExact;

    fn build(scene: &ChannelScene, table: &BinghamExact, _: &mut Faults) -> Option<Self> {
        let problem = plane(scene)?;
        Some(Self { problem, cells: table.grid.cells })
    }
}

impl Solve for OnMesh<BinghamPlane> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: Vec::new() }
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        premises::laminar(&premises::LAMINAR, results).into_iter().collect()
    }

    fn cells(&self) -> usize {
        self.cells
    }
}
