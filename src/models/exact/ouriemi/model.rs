//! The case of the closed form.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{equations, run};
use crate::case::tables::{Bed, Fluid, Grains, Grid, only};
use crate::model::{Description, Effort, Faults, Flow, LaminarScene, Model, ModelInfo, Offer, OnMesh, Solve, Term};
use crate::models::exact::ExactKind;
use crate::models::exact::bed::{BedClosures, Form, LaminarBed, LaminarFlow, laminar_bed};
use crate::result::Context;
use crate::result::{Failure, Outcome};
use crate::scene::BedScene;
use crate::{part, tables};

/// The model: Ouriemi's bed in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OuriemiModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Newtonian fluid over a Coulomb bed between two planes.
    pub solution: OuriemiSolution,
    /// One velocity for fluid and grains, or two.
    pub form: Form,
}

only!(
    /// Newtonian fluid over a Coulomb bed between two planes.
    OuriemiSolution,
    Ouriemi
);

tables! {
    /// Newtonian fluid over a Coulomb bed between two planes, in closed form.
    pub struct OuriemiTables {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: Bed,
        /// Geometry and drive.
        flow: LaminarFlow,
        /// The model.
        model: OuriemiModel,
        /// Laws.
        closures: BedClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

part! {
    /// Laminar flow over a bed of grains between two planes, in closed form.
    pub struct LaminarExact {
        /// One velocity for fluid and grains, or two.
        form: Form,
        /// Laws.
        closures: BedClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

impl Model for OnMesh<LaminarBed> {
    const INFO: ModelInfo = ModelInfo { name: "exact/ouriemi", table: "laminar-exact", stochastic: false };
    type Scene = BedScene;
    type Table = LaminarExact;
    type Tables = OuriemiTables;

    fn split(tables: &OuriemiTables) -> (BedScene, LaminarExact) {
        let OuriemiTables { fluid, grains, bed, flow, model, closures, grid, check, limit, .. } = tables.clone();
        let table = LaminarExact { form: model.form, closures, grid, check, limit };
        (flow.over((&fluid, &grains, &bed)), table)
    }

    fn build(scene: &BedScene, table: &LaminarExact, faults: &mut Faults) -> Option<Self> {
        let LaminarExact { form, closures, grid, .. } = table;
        let problem = laminar_bed(scene, closures.into(), *form, Self::INFO.name, faults)?;
        Some(Self { problem, cells: grid.cells })
    }

    fn offer(flow: &Flow, _: f64) -> Option<Offer> {
        let Flow::Laminar(scene) = flow else { return None };
        if scene.mu_2.is_some() || scene.dilates {
            return None;
        }
        let slips = scene.k_ck.is_some();
        let same = scene.kind == Self::INFO.name && slips == scene.two_velocities;
        let form = if slips { "two-fluid form" } else { "mixed form" };
        Some(Offer {
            effort: Effort::None,
            because: format!("constant friction and viscosity have a closed form; {form}"),
            template: if slips { "exact_1d_ouriemi" } else { "exact_1d_ouriemi_mixed" },
            overrides: (!same).then(|| keys(scene)),
        })
    }
}

/// The flow in the keys of the case.
fn keys(scene: &LaminarScene) -> Vec<String> {
    let mut set = vec![
        format!("fluid.density={:?}", scene.rho_f),
        format!("fluid.viscosity={:?}", scene.eta),
        format!("grains.diameter={:?}", scene.d),
        format!("grains.density={:?}", scene.rho_p),
        format!("bed.level={:?}", scene.h_p),
        format!("bed.phi={:?}", scene.phi),
        format!("flow.height={:?}", scene.h),
        format!("flow.gravity={:?}", scene.g),
        format!("closures.friction.mu_s={:?}", scene.mu_s),
    ];
    match scene.drive {
        Ok(fall) => set.push(format!("flow.pressure_gradient={fall:?}")),
        Err(theta) => set.extend([format!("flow.shields={theta:?}"), "flow.pressure_gradient=".into()]),
    }
    set.extend(scene.k_ck.map(|k_ck| format!("closures.drag.k_ck={k_ck:?}")));
    set
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

    fn terms(&self) -> Vec<Term> {
        self.problem.slip().into_iter().collect()
    }
}
