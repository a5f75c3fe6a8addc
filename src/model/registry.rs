//! The models that a program knows, as a value: `models::builtin().with(Entry::of::<Mine>())`.

use std::sync::Arc;

use serde_json::Value;

use super::problem::checks;
use super::{Checked, Faults, Flow, Model, ModelInfo, Offer, Problem, Solve};
use crate::case::{Case, CaseError, Kind, Kinds, Tables};
use crate::scene::Scene;

/// The flow of a case and a problem of some model, if its values allow one; or that the tables are none of the model's.
type Built = Result<(Scene, Option<Arc<dyn Solve>>), serde_json::Error>;

/// A model without its types.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// what it is called
    pub info: ModelInfo,
    kind: fn() -> Kind,
    build: fn(Value, &mut Faults) -> Built,
    offer: fn(&Flow, f64) -> Option<Offer>,
}

impl Entry {
    /// The model `M`.
    #[must_use]
    pub fn of<M: Model>() -> Self {
        Self { info: M::INFO, kind: || Kind::of::<M::Tables>(M::INFO.name), build: build::<M>, offer: M::offer }
    }

    /// The case with which the model would answer `flow` to the relative error `tolerance`, if it can.
    #[must_use]
    pub fn offer(&self, flow: &Flow, tolerance: f64) -> Option<Offer> {
        (self.offer)(flow, tolerance)
    }
}

fn build<M: Model>(tables: Value, faults: &mut Faults) -> Built {
    let tables: M::Tables = serde_json::from_value(tables)?;
    let scene = M::scene(&tables);
    let model = M::build(&scene, &tables, faults).map(|model| Arc::new(model) as Arc<dyn Solve>);
    Ok((scene.into(), model))
}

/// The models that a program knows.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    entries: Vec<Entry>,
    kinds: Arc<Kinds>,
}

impl Registry {
    /// One more model. A name that is there already is replaced.
    #[must_use]
    pub fn with(mut self, entry: Entry) -> Self {
        self.entries.retain(|known| known.info.name != entry.info.name);
        self.entries.push(entry);
        Arc::make_mut(&mut self.kinds).push((entry.kind)());
        self
    }

    /// The models, in the order of their registration.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter()
    }

    /// The kinds of case that the models take.
    #[must_use]
    pub fn kinds(&self) -> &Kinds {
        &self.kinds
    }

    /// Loads a case, a file or a shipped one, and checks it whole: its text, and its values against each other.
    ///
    /// # Errors
    /// Every violation of both kinds, as far as the values could be read.
    pub fn load(&self, name: &str, overrides: &[String]) -> Result<Checked, CaseError> {
        self.check(Case::load(&self.kinds, name, overrides))
    }

    /// The same of the text of a case: `name` is its stem, `source` what diagnostics call it.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn parse(&self, name: &str, source: &str, text: String, overrides: &[String]) -> Result<Checked, CaseError> {
        self.check(Case::parse(&self.kinds, name, source, text, overrides))
    }

    /// Checks a case that was just read; one that is wrong already is checked as far as its values could be read.
    fn check(&self, case: Result<Case, CaseError>) -> Result<Checked, CaseError> {
        match case {
            Ok(case) => self.problem(&case).map(|problem| (case, problem)),
            Err(error) => Err(match error.draft().map(|draft| self.problem(draft)) {
                Some(Err(more)) => error.and(more),
                _ => error,
            }),
        }
    }

    /// Checks what no schema can: values against each other, laws against the model, checks against the results.
    fn problem(&self, case: &Case) -> Result<Problem, CaseError> {
        let mut faults = Faults::new();
        let entry = self.entries.iter().find(|entry| entry.info.name == case.model);
        // The tables were read once: that this fails cannot happen to a case that this registry read.
        let built = entry.and_then(|entry| (entry.build)(case.tables().clone(), &mut faults).ok());
        checks(case, &mut faults);
        match (built, entry) {
            (Some((scene, Some(solver))), Some(entry)) if faults.is_empty() => {
                Ok(Problem::new(case, scene, entry.info.stochastic, solver))
            }
            _ => Err(case.clone().refuse(faults.0)),
        }
    }
}

/// The typed problem of a case of the model `M`: a file or a shipped case, with `--set` overrides.
///
/// # Errors
/// Every violation, as [`Registry::load`].
pub fn read<M: Model>(name: &str, overrides: &[String]) -> Result<M, CaseError> {
    let case = Case::load(&Kinds::new(vec![Kind::of::<M::Tables>(M::INFO.name)]), name, overrides)?;
    from_case::<M>(&case)
}

fn from_case<M: Model>(case: &Case) -> Result<M, CaseError> {
    let mut faults = Faults::new();
    let tables: Option<M::Tables> = serde_json::from_value(case.tables().clone()).ok();
    match tables.and_then(|tables| M::build(&M::scene(&tables), &tables, &mut faults)) {
        Some(problem) if faults.is_empty() => Ok(problem),
        _ => Err(case.clone().refuse(faults.0)),
    }
}

/// The problem of tables that were made without a case file, checked as a file is: ranges of the schema, then values against
/// each other.
///
/// # Errors
/// Every violation; its places point into the tables written as a case.
pub fn checked<M: Model>(tables: &M::Tables) -> Result<M, CaseError> {
    let text = crate::case::text(serde_json::to_value(tables).unwrap_or_default());
    let kinds = Kinds::new(vec![Kind::of::<M::Tables>(M::INFO.name)]);
    from_case::<M>(&Case::parse(&kinds, &tables.about().title, "tables", text, &[])?)
}
