//! The case of the logarithmic law.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ExactKind;
use super::log_law::{equations, run};
use crate::case::tables::{Fluid, Grid, only};
use crate::closures::mixing_length::{self, Prandtl};
use crate::closures::role::Only;
use crate::closures::wall::{self, Rough};
use crate::model::{Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, Solve};
use crate::models::exact::ExactFault;
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::{ChannelFlow, ChannelScene};
use crate::units::significant;
use crate::{part, tables};

/// Shields number at which the first grains move: intercept of Q*^(2/3), with eddies (docs/coupled.md).
const ONSET: f64 = 0.045;

/// A turbulent flow over a wall, driven by the stress at the wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallFlow {
    /// Flow height H: elevation up to which the profile is given.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: friction velocity sqrt(tau/rho_f).
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub u_star: f64,
}

/// The model: the logarithmic law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LogLawModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Turbulent layer of constant stress over a rough wall.
    pub solution: LogLawSolution,
}

only!(
    /// Turbulent layer of constant stress over a rough wall.
    LogLawSolution,
    LogLaw
);

/// Laws of the turbulent layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallClosures {
    /// Mixing length.
    pub mixing_length: Only<Prandtl>,
    /// Roughness of the wall.
    pub wall: Only<Rough>,
}

tables! {
    /// Turbulent layer of constant stress over a rough wall, in closed form.
    pub struct LogLawTables {
        /// The fluid.
        fluid: Fluid,
        /// Geometry and drive.
        flow: WallFlow,
        /// The model.
        model: LogLawModel,
        /// Laws.
        closures: WallClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

part! {
    /// Turbulent layer of constant stress over a rough wall, in closed form.
    pub struct LogLaw {
        /// Laws.
        closures: WallClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

/// A turbulent layer of constant stress over a rough wall. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughWall {
    /// density [kg/m3]
    pub rho_f: f64,
    /// viscosity [Pa s]
    pub eta: f64,
    /// height up to which the profile is given \[m]
    pub h: f64,
    /// friction velocity [m/s]
    pub u_star: f64,
    /// mixing length
    pub mixing_length: Prandtl,
    /// roughness
    pub wall: Rough,
}

impl Model for OnMesh<RoughWall> {
    const INFO: ModelInfo = ModelInfo { name: "exact/log-law", table: "log-law", stochastic: false };
    type Scene = ChannelScene;
    type Table = LogLaw;
    type Tables = LogLawTables;

    fn split(tables: &LogLawTables) -> (ChannelScene, LogLaw) {
        let LogLawTables { fluid, flow, closures, grid, check, limit, .. } = tables.clone();
        let scene = ChannelScene {
            fluid: (&fluid).into(),
            flow: ChannelFlow { u_star: Some(flow.u_star), ..ChannelFlow::new(flow.height) },
        };
        (scene, LogLaw { closures, grid, check, limit })
    }

    fn build(scene: &ChannelScene, table: &LogLaw, faults: &mut Faults) -> Option<Self> {
        let (ChannelScene { fluid, flow }, LogLaw { closures, grid, .. }) = (scene, table);
        let (Only(mixing_length), Only(wall)) = (closures.mixing_length, closures.wall);
        if wall.roughness_length() >= flow.depth {
            let fault = ExactFault::RoughnessAboveFlow { length: wall.roughness_length(), height: flow.depth };
            faults.push(("closures.wall.k_s", fault));
        }
        let problem = RoughWall {
            rho_f: fluid.density,
            eta: fluid.viscosity,
            h: flow.depth,
            u_star: flow.u_star?,
            mixing_length,
            wall,
        };
        Some(Self { problem, cells: grid.cells })
    }

    fn offer(flow: &Flow, _: f64) -> Option<Offer> {
        let Flow::Turbulent(scene) = flow else { return None };
        let theta = significant(scene.theta, 3);
        (scene.theta < ONSET).then(|| Offer {
            effort: Effort::None,
            because: format!("θ = {theta} is below {ONSET}, where the first grains move: the flow over a bed at rest"),
            template: "exact_1d_loglaw",
            overrides: Some(vec![
                format!("fluid.density={:?}", scene.rho_f),
                format!("fluid.viscosity={:?}", scene.nu * scene.rho_f),
                format!("flow.height={:?}", scene.depth),
                format!("flow.u_star={:?}", scene.u_star()),
                format!("closures.wall.k_s={:?}", scene.d),
            ]),
        })
    }
}

impl Solve for OnMesh<RoughWall> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description {
            form: None,
            equations: equations(&self.problem),
            laws: vec![&mixing_length::prandtl::INFO, &wall::rough::INFO],
        }
    }

    fn cells(&self) -> usize {
        self.cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::read;

    #[test]
    fn the_log_law_takes_the_mixing_length_of_a_wall_only() {
        let with = |settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
            read::<OnMesh<RoughWall>>("exact_1d_loglaw", &settings)
        };
        assert!(with(&["closures.mixing_length.law=prandtl"]).is_ok());
        let refused =
            with(&["closures.mixing_length={ law = \"li-sawamoto\", phi_max = 0.6, below_packed = \"zero\" }"]);
        let message = format!("{:?}", refused.unwrap_err());
        assert!(message.contains("LawMismatch") && message.contains("li-sawamoto"), "{message}");
    }
}
