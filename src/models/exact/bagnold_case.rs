//! The case of the granular film.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bagnold::{equations, run};
use crate::case::tables::Grid;
use crate::closures::friction::{self, MuI};
use crate::closures::role::Only;
use crate::model::{Description, Faults, Model, ModelInfo, OnMesh, Solve};
use crate::models::BedFault;
use crate::part;
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::GranularScene;

/// Laws of the granular film.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmClosures {
    /// Friction of the grains.
    pub friction: Only<MuI>,
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
    const INFO: ModelInfo = ModelInfo::new("bagnold-film").taking(&[]);
    type Scene = GranularScene;
    type Table = BagnoldFilm;

    fn build(scene: &GranularScene, table: &BagnoldFilm, faults: &mut Faults) -> Option<Self> {
        let (GranularScene { grains, bed, flow }, BagnoldFilm { closures, grid, .. }) = (scene, table);
        let beta = flow.angle().map_err(|fault| faults.push(("flow.slope", fault))).ok();
        let thickness = faults.needed("bed.thickness", bed.thickness);
        let friction = closures.friction.0;
        if friction.mu_2 <= friction.mu_s {
            faults
                .push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s: friction.mu_s, mu_2: friction.mu_2 }));
        }
        let problem = GranularFilm {
            rho_p: grains.density,
            d: grains.diameter,
            phi: bed.phi().value(),
            h: thickness?,
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
