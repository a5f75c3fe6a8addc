//! A Bingham fluid between two planes, solved numerically, regularised or with the exact yield.

mod solve;
mod study;

use solve::{equations, run};

use crate::closures::regularisation::Regularisation;
use crate::model::{ClosedForm, Description, Faults, Model, ModelInfo, OnMesh, Solve, SteadyDrive, StudyPlan};
use crate::models::exact::bingham::PLANE;
use crate::models::exact::bingham::{BinghamPlane, plane};
use crate::models::premises;
use crate::models::yielding::{RegularisationTable, YieldGrid, size};
use crate::part;
use crate::result::Context;
use crate::result::Premise;
use crate::result::Results;
use crate::result::{Failure, Outcome};
use crate::scene::ChannelScene;
use crate::scene::Scene;

part! {
    /// Bingham fluid between two planes: regularised, or with the exact yield.
    pub struct Bingham {
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the solver.
        #[serde(default)]
        grid: YieldGrid,
    }
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

impl Model for OnMesh<RegularisedPlane> {
    const INFO: ModelInfo = ModelInfo::new("bingham").taking(&PLANE);
    type Scene = ChannelScene;
    type Table = Bingham;

    fn build(scene: &ChannelScene, tables: &Bingham, faults: &mut Faults) -> Option<Self> {
        let size = size(&tables.regularisation, faults);
        let plane = plane(scene)?;
        let lambda = size?.to_scaled(plane.shear_scale());
        let regularisation = Regularisation { law: tables.regularisation.law, lambda };
        let problem = RegularisedPlane { plane, regularisation, yield_node: tables.grid.yield_node };
        Some(Self { problem, cells: tables.grid.cells })
    }
}

impl Solve for OnMesh<RegularisedPlane> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: Vec::new() }
    }

    fn study(&self) -> StudyPlan {
        study::plan(&self.problem.plane, self.cells)
    }

    fn closed_form(&self) -> Option<Box<dyn ClosedForm>> {
        study::closed_form(&self.problem.plane)
    }

    fn drive(&self) -> Option<SteadyDrive> {
        let plane = &self.problem.plane;
        Some(SteadyDrive::of(plane.shear_scale() * plane.h, "more grid.cells"))
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        premises::laminar(&premises::LAMINAR, results).into_iter().collect()
    }

    fn cells(&self) -> usize {
        self.cells
    }
}
