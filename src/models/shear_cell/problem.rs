//! Problems of grains between two walls that move.

use super::case::{Colliding, ShearCellTable};
use super::{equations, run, study};
use crate::case::Fault;
use crate::closures::Info;
use crate::closures::kinetic::{Granular, Kinetic, Stresses};
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve, StudyPlan};
use crate::models::BedFault;
use crate::models::premises;
use crate::result::Context;
use crate::result::{Failure, Outcome, Premise, Results};
use crate::scene::{BenchmarkScene, Scene};

/// Grains between two walls, without fluid or gravity. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearCell {
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains \[m]
    pub d: f64,
    /// distance of the walls \[m]
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

impl Model for OnMesh<ShearCell> {
    const INFO: ModelInfo = ModelInfo::new("shear-cell").taking(&["grains"]);
    type Scene = BenchmarkScene;
    type Table = ShearCellTable;

    fn build(scene: &BenchmarkScene, table: &ShearCellTable, faults: &mut Faults) -> Option<Self> {
        let (grains, ShearCellTable { geometry: flow, closures, .. }) = (faults.needed("grains", scene.grains)?, table);
        if flow.phi >= flow.phi_max {
            let allowed = format!("less than geometry.phi_max = {}", flow.phi_max);
            faults.push(("geometry.phi", Fault::OutOfRange { name: "phi".into(), value: flow.phi, allowed }));
        }
        if flow.height < grains.diameter {
            let fault = BedFault::ThinnerThanAGrain { level: flow.height, diameter: grains.diameter };
            faults.push(("geometry.height", fault));
        }
        let (e, mu_p) = (grains.restitution().value(), grains.friction().value());
        let (granular, kinetic) = match closures.granular {
            Colliding::GarzoDufty(law) => (Granular::GarzoDufty(law), law.kinetic(e, mu_p)),
            Colliding::FrictionalCollisional(law) => (Granular::FrictionalCollisional(law), law.kinetic(e, mu_p)),
        };
        let problem = ShearCell {
            rho_p: grains.density,
            d: grains.diameter,
            h: flow.height,
            phi: flow.phi,
            phi_max: flow.phi_max,
            velocity: [flow.velocity_lower, flow.velocity_upper],
            temperature: [flow.temperature_lower, flow.temperature_upper],
            granular,
            // Nothing but the collisions ends the flight of a grain here.
            kinetic: Kinetic { saltation: None, ..kinetic },
        };
        Some(Self { problem, cells: table.grid.cells })
    }
}

impl Solve for OnMesh<ShearCell> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: laws(&self.problem) }
    }

    fn study(&self) -> StudyPlan {
        study::plan(&self.problem)
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn premises(&self, scene: &Scene, _: &Results) -> Vec<Premise> {
        let Scene::Benchmark(BenchmarkScene { grains: Some(grains), .. }) = scene else { return Vec::new() };
        let (e, mu_p) = (grains.restitution().value(), grains.friction().value());
        vec![premises::KINETIC_RESTITUTION.of(e), premises::KINETIC_FRICTION.of(mu_p)]
    }
}

fn laws(cell: &ShearCell) -> Vec<&'static Info> {
    let mut laws = vec![cell.granular.info()];
    laws.extend(cell.granular.parts());
    laws
}
