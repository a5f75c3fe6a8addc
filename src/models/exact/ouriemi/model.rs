//! The case of the closed form.

use super::{equations, run};
use crate::case::tables::Grid;
use crate::model::{Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, OwnCase, Solve, Term};
use crate::result::Premise;
use crate::result::Results;
use crate::scene::Scene;

use crate::models::exact::bed::{BedClosures, Form, LaminarBed, laminar_bed};
use crate::part;
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::BedScene;

part! {
    /// Laminar flow over a bed of grains between two planes, in closed form.
    pub struct LaminarExact {
        /// One velocity for fluid and grains, or two.
        #[serde(default)]
        form: Form,
        /// Laws.
        #[serde(default)]
        closures: BedClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

impl Model for OnMesh<LaminarBed> {
    const INFO: ModelInfo = ModelInfo::new("laminar-exact")
        .taking(&["pressure_gradient", "discharge", "mean_velocity", "shields", "u_star"])
        .under(&["plane"]);
    type Scene = BedScene;
    type Table = LaminarExact;

    fn build(scene: &BedScene, table: &LaminarExact, faults: &mut Faults) -> Option<Self> {
        let LaminarExact { form, closures, grid, .. } = table;
        let problem = laminar_bed(scene, closures.into(), *form, Self::INFO.name, faults)?;
        Some(Self { problem, cells: grid.cells })
    }

    fn offer(flow: &Flow, _: f64) -> Option<Offer> {
        let Flow::Laminar(scene) = flow else { return None };
        if scene.mu_2.is_some() || scene.dilates || scene.walls {
            return None;
        }
        let (form, words) =
            if scene.k_ck.is_some() { ("two-fluid", "two-fluid form") } else { ("mixed", "mixed form") };
        let mut own = vec![
            format!("form={form}"),
            format!("closures.friction.mu_s={:?}", scene.mu_s),
            format!("closures.mixture_viscosity={}", scene.viscosity_law),
            // Side walls that were found not to matter.
            "flow.section=".to_owned(),
        ];
        let drag = scene.k_ck.map(|k_ck| format!("{{ law = \"carman-kozeny\", k_ck = {k_ck:?} }}"));
        own.push(format!("closures.drag={}", drag.unwrap_or_else(|| "none".into())));
        Some(Offer {
            effort: Effort::None,
            because: format!("constant friction and viscosity have a closed form; {words}"),
            off: "not known; where the friction rises with the shear rate, a constant one carries 2 to 3 times what was measured \
                  (Aussillous et al. 2013; docs/validation.md)",
            case: OwnCase::Scene(own),
        })
    }
}

impl Solve for OnMesh<LaminarBed> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        let bed = &self.problem;
        Description { form: Some(bed.form_name()), equations: equations(bed), laws: bed.laws() }
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        Ok(Some(self.problem.scene(Self::INFO.name)))
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        self.problem.premises(results)
    }

    fn terms(&self) -> Vec<Term> {
        self.problem.slip().into_iter().collect()
    }
}
