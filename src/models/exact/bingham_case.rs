//! The case of the Bingham fluid between two planes, and the problem that its closed form and its solver share.

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use super::ExactKind;
use super::bingham::{equations, run};
use crate::case::tables::{BinghamFluid, Grid, one_of, only};
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::{ChannelFlow, ChannelScene};
use crate::{part, tables};

/// A flow between two planes. Exactly one drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(transform = plane_drives)]
pub struct PlaneFlow {
    /// Flow height H: distance between the two planes.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: fall of pressure along the flow, -dp/dx.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub pressure_gradient: Option<f64>,
    /// Drive: wanted mean velocity; the pressure gradient that gives it is solved for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub mean_velocity: Option<f64>,
}

fn plane_drives(schema: &mut Schema) {
    one_of(schema, &["pressure_gradient", "mean_velocity"]);
}

/// The model: Bingham plane Poiseuille flow in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BinghamModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Bingham fluid between two planes.
    pub solution: BinghamSolution,
}

only!(
    /// Bingham fluid between two planes.
    BinghamSolution,
    BinghamPlane
);

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

impl PlaneFlow {
    /// This flow of a fluid.
    pub(in crate::models) fn of(&self, fluid: &BinghamFluid) -> ChannelScene {
        let (pressure_gradient, mean_velocity) = (self.pressure_gradient, self.mean_velocity);
        ChannelScene {
            fluid: fluid.into(),
            flow: ChannelFlow { pressure_gradient, mean_velocity, ..ChannelFlow::new(self.height) },
        }
    }
}

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
    const INFO: ModelInfo = ModelInfo { name: "exact/bingham-plane", table: "bingham-exact", stochastic: false };
    type Scene = ChannelScene;
    type Table = BinghamExact;
    type Tables = BinghamPlaneTables;

    fn split(tables: &BinghamPlaneTables) -> (ChannelScene, BinghamExact) {
        let BinghamPlaneTables { fluid, flow, grid, check, limit, .. } = tables.clone();
        (flow.of(&fluid), BinghamExact { grid, check, limit })
    }

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

    fn cells(&self) -> usize {
        self.cells
    }
}
