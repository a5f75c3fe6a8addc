//! A checked problem: immutable values in SI, whatever the model. After this nothing is out of range and no unit remains.

use std::any::Any;
use std::sync::Arc;

use super::{Description, Solve};
use crate::case::checks::Class;
use crate::case::{Case, Fault};
use crate::result::{Context, Failure, Outcome, quantity};

/// Relative residual of a balance from which on a result has lost its digits: it is round-off otherwise.
const LARGEST_IMBALANCE: f64 = 1e-3;

/// A checked problem.
#[derive(Clone, Debug)]
pub struct Problem {
    /// stem of the case
    pub name: String,
    /// the question
    pub title: String,
    /// `kind` or `kind/solution` of the model
    pub kind: &'static str,
    /// whether its results are means of fluctuating quantities
    pub stochastic: bool,
    solver: Arc<dyn Solve>,
}

/// A case and the problem that it states.
pub type Checked = (Case, Problem);

impl Problem {
    pub(super) fn new(case: &Case, stochastic: bool, solver: Arc<dyn Solve>) -> Self {
        Self { name: case.name.clone(), title: case.about().title.clone(), kind: case.model, stochastic, solver }
    }

    /// Solves it. A result that is not a finite number is a failure, and so is a balance that does not close.
    ///
    /// # Errors
    /// [`Failure`]: why the method failed, with the numbers that say so and the last good state.
    pub fn run(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        self.solver.solve(context)?.trusted(LARGEST_IMBALANCE)
    }

    /// Its equations and laws.
    #[must_use]
    pub fn describe(&self) -> Description {
        self.solver.describe()
    }

    /// Number of levels of the profile, or of mobile grains.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.solver.cells()
    }

    /// What is solved, whatever its type.
    #[must_use]
    pub fn solver(&self) -> &dyn Solve {
        self.solver.as_ref()
    }

    /// What is solved, if it is a `T`.
    #[must_use]
    pub fn get<T: Solve>(&self) -> Option<&T> {
        let any: &dyn Any = self.solver.as_ref();
        any.downcast_ref()
    }

    /// The model in words, with its form where it has one.
    #[must_use]
    pub fn model_name(&self) -> String {
        match self.describe().form {
            Some(form) => format!("{}, {form}", self.kind),
            None => self.kind.to_owned(),
        }
    }
}

/// Checks name catalogued results, or columns at a level; a limit is along a key of a table of the case.
pub(super) fn checks(case: &Case, faults: &mut Vec<(String, Fault)>) {
    if let Some(limit) = case.limit() {
        let key =
            limit.over.split_once('=').and_then(|(key, values)| Some((key.trim().split_once('.')?, values.trim())));
        if key.is_none_or(|((table, name), values)| table.is_empty() || name.is_empty() || values.is_empty()) {
            faults.push(("limit.over".into(), Fault::LimitKey { over: limit.over.clone() }));
        }
        if limit.beyond == Class::Holds {
            faults.push(("limit.beyond".into(), Fault::LimitHolds));
        }
    }
    for (i, check) in case.checks().iter().enumerate() {
        let column = check.quantity.strip_prefix("profile.");
        let list = if column.is_some() { quantity::COLUMNS } else { quantity::RESULTS };
        let name = column.unwrap_or(&check.quantity);
        if quantity::find(list, name).is_none() {
            let nearest = crate::case::nearest(name, list.iter().map(|q| q.name));
            let prefix = if column.is_some() { "profile." } else { "" };
            let fault = Fault::UnknownQuantity {
                name: check.quantity.clone(),
                nearest: nearest.map(|n| format!("{prefix}{n}")),
            };
            faults.push((format!("check.{i}.quantity"), fault));
        } else if column.is_some() != check.at.is_some() {
            let fault = Fault::CheckLevel { name: check.quantity.clone(), column: column.is_some() };
            faults.push((format!("check.{i}.quantity"), fault));
        }
    }
}
