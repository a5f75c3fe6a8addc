//! The laminar bed that is solved numerically: its case and its problem.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{equations, run, study};

use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::regularisation::Regularisation;
use crate::closures::role::choice;
use crate::closures::{dilatancy, friction};
use crate::model::{
    ClosedForm, Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, OwnCase, Solve, SteadyDrive,
    StudyPlan, Term, TermTest,
};
use crate::models::exact::bed::{BedDrag, BedLaws, Form, LaminarBed, einstein, laminar_bed};
use crate::models::yielding::{RegularisationTable, YieldGrid, size};
use crate::part;
use crate::result::Context;
use crate::result::Premise;
use crate::result::Results;
use crate::result::{Failure, Outcome};
use crate::scene::BedScene;
use crate::scene::Scene;
use crate::units::significant;

/// Laws of the laminar bed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LaminarClosures {
    /// Friction of the grains.
    #[serde(default = "coulomb")]
    pub friction: LaminarFriction,
    /// Effective viscosity of the mixture.
    #[serde(default = "einstein")]
    pub mixture_viscosity: MixtureViscosity,
    /// Drag between the phases; only the two-fluid form has it.
    #[serde(default)]
    pub drag: BedDrag,
    /// Solid fraction of sheared grains; only with friction by mu(I_v).
    #[serde(default)]
    pub dilatancy: LaminarDilatancy,
}

fn coulomb() -> LaminarFriction {
    LaminarFriction::Coulomb(friction::Coulomb::default())
}

impl Default for LaminarClosures {
    fn default() -> Self {
        Self {
            friction: coulomb(),
            mixture_viscosity: einstein(),
            drag: BedDrag::default(),
            dilatancy: LaminarDilatancy::default(),
        }
    }
}

choice! {
    /// Friction of the grains.
    pub enum LaminarFriction from friction {
        coulomb::Coulomb(..),
        mu_iv::MuIv(..),
    }
}

choice! {
    /// Solid fraction of sheared grains.
    #[derive(Default)]
    pub enum LaminarDilatancy from dilatancy {
        #[default]
        none::None,
        phi_iv::PhiIv(..),
    }
}

impl From<&LaminarClosures> for BedLaws {
    fn from(closures: &LaminarClosures) -> Self {
        let (friction, rise) = match closures.friction {
            LaminarFriction::Coulomb(law) => (law, None),
            LaminarFriction::MuIv(law) => (friction::Coulomb { mu_s: law.mu_s }, Some(law)),
        };
        let dilatancy = match closures.dilatancy {
            LaminarDilatancy::None => None,
            LaminarDilatancy::PhiIv(law) => Some(law),
        };
        Self { friction, rise, viscosity: closures.mixture_viscosity, drag: closures.drag, dilatancy }
    }
}

part! {
    /// Laminar flow over a bed of grains between two planes: regularised, or with the exact yield.
    pub struct Laminar {
        /// One velocity for fluid and grains, or two.
        #[serde(default)]
        form: Form,
        /// Laws.
        #[serde(default)]
        closures: LaminarClosures,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the solver.
        #[serde(default)]
        grid: YieldGrid,
    }
}

/// A laminar bed that is solved numerically.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegularisedBed {
    /// the bed
    pub bed: LaminarBed,
    /// how the yield stress is smoothed; lambda in units of (rho_p - rho_f) g H/eta
    pub regularisation: Regularisation,
    /// whether a node lies on the yield level
    pub yield_node: bool,
}

impl Model for OnMesh<RegularisedBed> {
    const INFO: ModelInfo = ModelInfo::new("laminar")
        .taking(&["pressure_gradient", "discharge", "mean_velocity", "shields", "u_star"])
        .under(&["plane"]);
    type Scene = BedScene;
    type Table = Laminar;

    fn build(scene: &BedScene, table: &Laminar, faults: &mut Faults) -> Option<Self> {
        let Laminar { form, closures, grid, .. } = table;
        let bed = laminar_bed(scene, closures.into(), *form, Self::INFO.name, faults);
        let size = size(&table.regularisation, faults);
        let bed = bed?;
        let lambda = size?.to_scaled(bed.velocity_scale() / bed.h);
        let regularisation = Regularisation { law: table.regularisation.law, lambda };
        let problem = RegularisedBed { bed, regularisation, yield_node: grid.yield_node };
        Some(Self { problem, cells: grid.cells })
    }

    fn offer(flow: &Flow, _: f64) -> Option<Offer> {
        let Flow::Laminar(scene) = flow else { return None };
        // Only a case of this model has what no closed form holds.
        if scene.kind != Self::INFO.name || scene.walls || scene.mu_2.is_none() && !scene.dilates {
            return None;
        }
        let form = if scene.k_ck.is_some() { "two-fluid form" } else { "mixed form" };
        Some(Offer {
            effort: Effort::Milliseconds,
            because: format!("friction or solid fraction change with the shear rate: no closed form; {form}"),
            off: "3 to 29 % from what was measured (Aussillous et al. 2013; docs/validation.md)",
            case: OwnCase::Scene(Vec::new()),
        })
    }
}

impl Solve for OnMesh<RegularisedBed> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        let bed = &self.problem.bed;
        Description { form: Some(bed.form_name()), equations: equations(&self.problem), laws: bed.laws() }
    }

    fn study(&self) -> StudyPlan {
        study::plan(&self.problem.bed, self.cells)
    }

    fn closed_form(&self) -> Option<Box<dyn ClosedForm>> {
        study::closed_form(&self.problem)
    }

    fn drive(&self) -> Option<SteadyDrive> {
        Some(SteadyDrive::of(self.problem.bed.velocity_scale(), "more grid.cells"))
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        Ok(Some(self.problem.bed.scene(Self::INFO.name)))
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        self.problem.bed.premises(results)
    }

    fn terms(&self) -> Vec<Term> {
        let solve = |what, source, change: &[&str], left, free| {
            let change = change.iter().map(|&c| c.to_owned()).collect();
            Term { what, source, test: TermTest::Solve { change, left, free }, dropped: None }
        };
        let mut terms: Vec<Term> = self.problem.bed.slip().into_iter().collect();
        let exact = ["regularisation.law=none", "regularisation.lambda=", "regularisation.lambda_scaled="];
        let source = "Chauchat & Medale (2010), section 3.2";
        terms.push(solve("smoothing of the yield", source, &exact, "the exact yield", true));
        if self.problem.bed.rise.is_some() {
            let mu_s = significant(self.problem.bed.friction.mu_s, 12);
            let constant = format!("closures.friction={{ law = \"coulomb\", mu_s = {mu_s} }}");
            let change = [constant.as_str(), "closures.dilatancy="];
            let what = "rise of the friction with the shear rate";
            terms.push(solve(what, "Aussillous et al. (2013)", &change, "a constant friction", false));
        }
        terms
    }
}
