//! The case of the Bingham fluid between two planes, and the problem that its closed form and its solver share.

use super::bingham::{equations, run};
use crate::case::tables::{BinghamFluid, BinghamModel, Grid, PlaneFlow};
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::tables;

tables! {
    /// Bingham fluid between two planes, in closed form.
    pub struct BinghamPlaneTables {
        /// The material.
        fluid: BinghamFluid,
        /// Geometry and drive.
        flow: PlaneFlow,
        /// The model.
        model: BinghamModel,
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

/// The plane of these tables; `None` where they have no drive.
pub(in crate::models) fn plane(fluid: &BinghamFluid, flow: &PlaneFlow) -> Option<BinghamPlane> {
    let drive = match (flow.pressure_gradient, flow.mean_velocity) {
        (Some(gradient), _) => BinghamDrive::PressureGradient(gradient),
        (None, Some(mean)) => BinghamDrive::MeanVelocity(mean),
        (None, None) => return None,
    };
    Some(BinghamPlane { rho: fluid.density, eta: fluid.viscosity, tau_0: fluid.yield_stress, h: flow.height, drive })
}

impl Model for OnMesh<BinghamPlane> {
    const INFO: ModelInfo = ModelInfo { name: "exact/bingham-plane", stochastic: false };
    type Tables = BinghamPlaneTables;

    fn build(tables: &BinghamPlaneTables, _: &mut Faults) -> Option<Self> {
        let problem = plane(&tables.fluid, &tables.flow)?;
        Some(Self { problem, cells: tables.grid.cells })
    }
}

impl Solve for OnMesh<BinghamPlane> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: Vec::new() }
    }

    fn cells(&self) -> usize {
        self.cells
    }
}
