//! What a model is: the trait, the registry of models, and the checked problem that the rest of the program handles.
//!
//! ```text
//!  case (text) ─► Registry ─► Model::build (tables ─► problem in SI) ─► Solve::solve ─► Outcome
//! ```
//!
//! Everything above this module, the studies and the command line, knows these traits and never one model. A model is written
//! with its own types ([`Model`]) and loses them once a run ([`Solve`] is object-safe).

mod offer;
mod problem;
mod registry;
mod simulation;
mod study;
mod takes;

use std::fmt::Debug;
use std::sync::Arc;

use crate::case::{CaseFault, Fault, FlowTables, Part};
use crate::closures::Info;
use crate::result::{CheckpointError, Context, Failure, Figure, Outcome, Premise, Results};
use crate::scene::Scene;

pub use offer::{
    BULK_FRICTION, COLLISIONS, Effort, Flow, LaminarScene, Offer, OwnCase, PACKED, Term, TermTest, TurbulentScene,
};
pub use problem::{Checked, Problem};
pub use registry::{Entry, Registry, checked, read};
pub use simulation::Simulation;
pub use study::{ClosedForm, Focus, Law, Meshes, Number, ONE_KIND, Rule, Rung, Sizes, Smoothed, StudyPlan, number};

/// Faults found while values are compared with each other, by path in the case.
#[derive(Clone, Debug, Default)]
pub struct Faults(Vec<(String, Arc<dyn CaseFault>)>);

impl Faults {
    /// None so far.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A fault of the value at `path`, such as `bed.thickness`.
    pub fn push(&mut self, (path, fault): (impl Into<String>, impl CaseFault)) {
        self.0.push((path.into(), Arc::new(fault)));
    }

    /// A value of the flow, or a table of it, that the model cannot do without: a fault where it is missing.
    pub fn needed<T>(&mut self, path: &str, value: Option<T>) -> Option<T> {
        if value.is_none() {
            self.push((path, Fault::Needed));
        }
        value
    }

    /// Those of `more` at places where nothing is wrong yet.
    pub(crate) fn also(&mut self, more: Self) {
        let known: Vec<String> = self.0.iter().map(|(path, _)| path.clone()).collect();
        self.0.extend(more.0.into_iter().filter(|(path, _)| !known.contains(path)));
    }

    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// What a model is called and how it behaves, before there is a problem.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct ModelInfo {
    /// its name, which is that of its table in a case
    pub name: &'static str,
    /// whether its results are means of fluctuating quantities
    pub stochastic: bool,
    /// what it solves of what not every model of its kind of scene does, as keys of the flow; `None`: all of it
    pub takes: Option<&'static [&'static str]>,
    /// tops of a flow that it solves; `None`: all of them
    pub tops: Option<&'static [&'static str]>,
}

impl ModelInfo {
    /// A model of this name whose results do not fluctuate, and which solves whatever drives or bounds a flow.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self { name, stochastic: false, takes: None, tops: None }
    }

    /// The same, which solves of what not every model does these keys of the flow alone.
    #[must_use]
    pub const fn taking(self, keys: &'static [&'static str]) -> Self {
        Self { takes: Some(keys), ..self }
    }

    /// The same, which solves flows under these tops alone.
    #[must_use]
    pub const fn under(self, tops: &'static [&'static str]) -> Self {
        Self { tops: Some(tops), ..self }
    }

    /// The same, whose results are means of fluctuating quantities.
    #[must_use]
    pub const fn stochastic(self) -> Self {
        Self { stochastic: true, ..self }
    }
}

/// A model: a checked problem in SI, and how the tables of its cases become one. [`Entry::of`] registers it.
pub trait Model: Solve + Sized {
    /// Its name.
    const INFO: ModelInfo;
    /// The kind of flow that it solves: a scene of [`crate::scene`].
    type Scene: FlowTables + Into<Scene>;
    /// Its table: how the flow is solved.
    type Table: Part;

    /// Checks what no schema can, values against each other, and makes the problem. `None` where a fault leaves none.
    fn build(scene: &Self::Scene, table: &Self::Table, faults: &mut Faults) -> Option<Self>;

    /// What this model needs to answer `flow` to the relative error `tolerance`, if it can.
    fn offer(_flow: &Flow, _tolerance: f64) -> Option<Offer> {
        None
    }
}

/// A problem with the number of cells on which it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnMesh<P> {
    /// what is solved
    pub problem: P,
    /// number of cells
    pub cells: usize,
}

/// What can be done with a problem, whatever its model.
pub trait Solve: Debug + Send + Sync + 'static {
    /// Solves it.
    ///
    /// # Errors
    /// [`Failure`]: why the method failed, with the numbers that say so and the last good state.
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure>;

    /// The equations that are solved, with the numbers filled in, and the laws in them.
    fn describe(&self) -> Description;

    /// What its table leaves out and follows from the flow: key, value in SI, and from what. A case that gives the key overrides it.
    fn derived(&self) -> Vec<(&'static str, f64, &'static str)> {
        Vec::new()
    }

    /// Number of levels of the profile, or of mobile grains.
    fn cells(&self) -> usize;

    /// The flow that this problem is one model of; `None` where no other model answers it.
    ///
    /// # Errors
    /// [`Failure`] where the flow is known only from its solution and there is none.
    fn flow(&self) -> Result<Option<Flow>, Failure> {
        Ok(None)
    }

    /// Which way a steady drive pulls the fluid; `None` for a flow without one, and for one that looks for itself.
    fn drive(&self) -> Option<SteadyDrive> {
        None
    }

    /// What studies may vary: what it converges over, and the ladder of its settings.
    fn study(&self) -> StudyPlan {
        StudyPlan::default()
    }

    /// Its solution under the exact yield in closed form, if it has one and that can be evaluated.
    fn closed_form(&self) -> Option<Box<dyn ClosedForm>> {
        None
    }

    /// What the model takes for granted, and what its scene and its results say of it.
    fn premises(&self, _scene: &Scene, _results: &Results) -> Vec<Premise> {
        Vec::new()
    }

    /// How long it takes on one thread \[s], about, where that is minutes and can be told beforehand.
    fn takes_s(&self) -> Option<f64> {
        None
    }

    /// What in the model that flow may not need.
    fn terms(&self) -> Vec<Term> {
        Vec::new()
    }

    /// Figures that only this model has, of a run called `name`, from what it found.
    fn figures(&self, _name: &str, _outcome: &Outcome) -> Vec<Figure> {
        Vec::new()
    }

    /// Whether an unfinished run of this problem may go on from `checkpoint`; `None` for a model without checkpoints.
    ///
    /// # Errors
    /// [`CheckpointError`]: it is of another case, another version, or damaged.
    fn accepts(&self, _checkpoint: &[u8]) -> Option<Result<(), CheckpointError>> {
        None
    }
}

/// A steady drive along x: the mean velocity of the fluid is not against it.
#[derive(Clone, Copy, Debug)]
pub struct SteadyDrive {
    /// unit of the velocity, of which round-off may leave a part where nothing moves [m/s]
    pub velocity_scale: f64,
    /// time at which the flow is looked at \[s]; `None` for a steady one
    pub at_s: Option<f64>,
    /// what a user can change where the fluid goes the other way
    pub hint: &'static str,
}

impl SteadyDrive {
    /// The drive of a steady flow.
    #[must_use]
    pub fn of(velocity_scale: f64, hint: &'static str) -> Self {
        Self { velocity_scale, at_s: None, hint }
    }
}

/// What a problem is, for readers.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Description {
    /// the form of the model where it has several: `mixed`, `two-fluid`
    pub form: Option<&'static str>,
    /// the equations as text, numbers filled in
    pub equations: String,
    /// the laws in them
    pub laws: Vec<&'static Info>,
}

impl Description {
    /// Equations, numbers filled in, and the laws in them.
    #[must_use]
    pub fn new(equations: String, laws: Vec<&'static Info>) -> Self {
        Self { form: None, equations, laws }
    }
}
