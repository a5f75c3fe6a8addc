//! The case of the granular film.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ExactKind;
use super::bagnold::{equations, run};
use crate::case::tables::{Grains, Grid, SlopeDefinition, only};
use crate::closures::friction::{self, MuI};
use crate::closures::role::Only;
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::models::BedFault;
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::{self, GranularFlow, GranularScene};
use crate::{part, tables};

/// A film of grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Film {
    /// Solid fraction of the film, the same at every depth.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi: f64,
}

/// A film that flows down a slope under its own weight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmFlow {
    /// Thickness H of the film, normal to the slope.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: the slope, as slope_definition says, or an angle.
    #[schemars(extend("x-unit" = "1", "x-angle" = "slope_definition", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub slope: f64,
    /// What the number given as slope is: papers differ. With a slope such as "2 deg" it is the angle.
    pub slope_definition: SlopeDefinition,
    /// Acceleration of gravity.
    #[serde(default = "crate::case::tables::standard_gravity")]
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub gravity: f64,
}

/// The model: Bagnold's granular film in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BagnoldModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Dry grains down a slope.
    pub solution: BagnoldSolution,
}

only!(
    /// Dry grains down a slope.
    BagnoldSolution,
    BagnoldFilm
);

/// Laws of the granular film.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmClosures {
    /// Friction of the grains.
    pub friction: Only<MuI>,
}

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

part! {
    /// Dry grains down a slope, in closed form.
    pub struct BagnoldFilm {
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
    /// diameter of the grains \[m]
    pub d: f64,
    /// solid fraction
    pub phi: f64,
    /// thickness of the film \[m]
    pub h: f64,
    /// slope angle \[rad]
    pub beta: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// friction of the grains
    pub friction: MuI,
}

impl Model for OnMesh<GranularFilm> {
    const INFO: ModelInfo = ModelInfo { name: "exact/bagnold-film", table: "bagnold-film", stochastic: false };
    type Scene = GranularScene;
    type Table = BagnoldFilm;
    type Tables = BagnoldFilmTables;

    fn split(tables: &BagnoldFilmTables) -> (GranularScene, BagnoldFilm) {
        let BagnoldFilmTables { grains, bed, flow, closures, grid, check, limit, .. } = tables.clone();
        let FilmFlow { height, slope, slope_definition, gravity } = flow;
        let scene = GranularScene {
            grains: scene::Grains::new(grains.diameter, grains.density),
            bed: scene::Bed { thickness: Some(height), phi: Some(bed.phi) },
            flow: GranularFlow { slope, slope_definition, gravity, width: None },
        };
        (scene, BagnoldFilm { closures, grid, check, limit })
    }

    fn build(scene: &GranularScene, table: &BagnoldFilm, faults: &mut Faults) -> Option<Self> {
        let (GranularScene { grains, bed, flow }, BagnoldFilm { closures, grid, .. }) = (scene, table);
        let beta = flow.angle().map_err(|fault| faults.push(("flow.slope", fault))).ok();
        let friction = closures.friction.0;
        if friction.mu_2 <= friction.mu_s {
            faults
                .push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s: friction.mu_s, mu_2: friction.mu_2 }));
        }
        let problem = GranularFilm {
            rho_p: grains.density,
            d: grains.diameter,
            phi: bed.phi?,
            h: bed.thickness?,
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
