//! The case of the granular film.

use super::bagnold::{equations, run};
use crate::case::Fault;
use crate::case::tables::{BagnoldModel, Film, FilmClosures, FilmFlow, Grains, Grid};
use crate::closures::friction::{self, Friction, MuI};
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::models::BedFault;
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::tables;

tables! {
    /// Dry grains down a slope, in closed form.
    pub struct BagnoldFilmTables {
        /// The grains.
        grains: Grains,
        /// The film.
        bed: Film,
        /// Geometry and drive.
        flow: FilmFlow,
        /// The model.
        model: BagnoldModel,
        /// Laws.
        closures: FilmClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
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

impl Model for OnMesh<GranularFilm> {
    const INFO: ModelInfo = ModelInfo { name: "exact/bagnold-film", stochastic: false };
    type Tables = BagnoldFilmTables;

    fn build(tables: &BagnoldFilmTables, faults: &mut Faults) -> Option<Self> {
        let BagnoldFilmTables { grains, bed, flow, closures, grid, .. } = tables;
        let slope = flow.slope_definition.angle(flow.slope);
        let beta = slope.map_err(|fault| faults.push(("flow.slope", fault))).ok();
        let friction = match closures.friction {
            Friction::MuI(law) => law,
            other => {
                let allowed = vec![friction::mu_i::INFO.law];
                let fault =
                    Fault::LawMismatch { family: "friction", law: other.law(), model: Self::INFO.name.into(), allowed };
                faults.push(("closures.friction.law", fault));
                return None;
            }
        };
        if friction.mu_2 <= friction.mu_s {
            faults
                .push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s: friction.mu_s, mu_2: friction.mu_2 }));
        }
        let problem = GranularFilm {
            rho_p: grains.density,
            d: grains.diameter,
            phi: bed.phi,
            h: flow.height,
            beta: beta?,
            g: flow.gravity,
            friction,
        };
        Some(Self { problem, cells: grid.cells })
    }
}

impl Solve for OnMesh<GranularFilm> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: vec![&friction::mu_i::INFO] }
    }

    fn cells(&self) -> usize {
        self.cells
    }
}
