//! The case of the logarithmic law.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::log_law::{equations, run};
use crate::case::tables::Grid;
use crate::closures::mixing_length::{self, Prandtl};
use crate::closures::role::Only;
use crate::closures::wall::{self, Rough};
use crate::model::{Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, OwnCase, Solve};
use crate::models::exact::ExactFault;
use crate::models::premises;
use crate::part;
use crate::result::Context;
use crate::result::{Failure, Outcome, Premise, Results, quantity as q};
use crate::scene::{ChannelScene, Scene};
use crate::units::significant;

/// Shields number at which the first grains move: intercept of Q*^(2/3), with eddies (docs/coupled.md).
const ONSET: f64 = 0.045;

/// Laws of the turbulent layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallClosures {
    /// Mixing length.
    pub mixing_length: Only<Prandtl>,
    /// Roughness of the wall.
    pub wall: Only<Rough>,
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
    const INFO: ModelInfo = ModelInfo::new("log-law").taking(&["u_star"]);
    type Scene = ChannelScene;
    type Table = LogLaw;

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
            off: "0 below the onset, which was read from the rates of grains (docs/coupled.md)",
            case: OwnCase::Other(format!(
                "format = 2\nscene = \"channel\"\n[case]\ntitle = \"The flow over a bed at rest\"\n\
                 [fluid]\ndensity = {:?}\nviscosity = {:?}\n[flow]\ndepth = {:?}\nu_star = {:?}\n\
                 [log-law.closures]\nmixing_length = {{ law = \"prandtl\" }}\nwall = {{ law = \"rough\", k_s = {:?} }}\n",
                scene.rho_f,
                scene.nu * scene.rho_f,
                scene.depth,
                scene.u_star(),
                scene.d,
            )),
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

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        let RoughWall { h, wall, .. } = self.problem;
        let found = [
            premises::ROUGH_WALL.maybe(results.get(q::REYNOLDS_ROUGHNESS.name)),
            premises::SHALLOW_ROUGHNESS.maybe(Some(wall.k_s / h)),
        ];
        found.into_iter().flatten().collect()
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
