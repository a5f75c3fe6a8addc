//! The models that a program knows, as a value: `models::builtin().with(Entry::of::<Mine>())`.

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::problem::checks;
use super::{Checked, Faults, Flow, Model, ModelInfo, Offer, Problem, Solve};
use crate::case::{Case, CaseError, CaseFault, FlowTables, Kind, Kinds};
use crate::scene::Scene;

/// The flow of a case and a problem of some model, if its values allow one; or that the tables are none of the model's.
type Built = Result<(Scene, Option<Arc<dyn Solve>>), serde_json::Error>;

/// A model without its types.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// what it is called
    pub info: ModelInfo,
    kinds: fn() -> [Kind; 2],
    build: fn(&Case, &mut Faults) -> Built,
    convert: fn(&Case) -> Option<Value>,
    offer: fn(&Flow, f64) -> Option<Offer>,
}

impl Entry {
    /// The model `M`.
    #[must_use]
    pub fn of<M: Model>() -> Self {
        let kinds = || [Kind::of::<M::Tables>(M::INFO.name), Kind::of_scene::<M::Scene, M::Table>(M::INFO.table)];
        Self { info: M::INFO, kinds, build: build::<M>, convert: convert::<M>, offer: M::offer }
    }

    /// The case with which the model would answer `flow` to the relative error `tolerance`, if it can.
    #[must_use]
    pub fn offer(&self, flow: &Flow, tolerance: f64) -> Option<Offer> {
        (self.offer)(flow, tolerance)
    }
}

/// The flow of a case of the model `M`, and its table.
fn parts<M: Model>(case: &Case) -> Result<(M::Scene, M::Table), serde_json::Error> {
    let mut tables = case.tables().clone();
    if !case.is_scene() {
        return serde_json::from_value(tables).map(|tables| M::split(&tables));
    }
    let own = tables.as_object_mut().and_then(|tables| tables.shift_remove(M::INFO.table));
    Ok((serde_json::from_value(tables)?, serde_json::from_value(own.unwrap_or_default())?))
}

fn build<M: Model>(case: &Case, faults: &mut Faults) -> Built {
    let (scene, table) = parts::<M>(case)?;
    let model = M::build(&scene, &table, faults).map(|model| Arc::new(model) as Arc<dyn Solve>);
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
        (entry.kinds)().into_iter().for_each(|kind| Arc::make_mut(&mut self.kinds).push(kind));
        self
    }

    /// The models, in the order of their registration.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter()
    }

    /// The same models, where a case with several is that of `model`.
    #[must_use]
    pub fn choosing(mut self, model: &str) -> Self {
        self.kinds = Arc::new(Kinds::clone(&self.kinds).choosing(model));
        self
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

    /// The model of a case.
    fn entry(&self, case: &Case) -> Option<&Entry> {
        let named = |entry: &&Entry| [entry.info.name, entry.info.table][usize::from(case.is_scene())] == case.model;
        self.entries.iter().find(named)
    }

    /// The case in format 2: the flow, and the table of its model. Quantities are in SI, every default is filled in.
    #[must_use]
    pub fn converted(&self, case: &Case) -> Option<String> {
        self.entry(case).and_then(|entry| (entry.convert)(case)).map(crate::case::text)
    }

    /// Checks what no schema can: values against each other, laws against the model, checks against the results.
    fn problem(&self, case: &Case) -> Result<Problem, CaseError> {
        let mut faults = Faults::new();
        let entry = self.entry(case);
        // The tables were read once: that this fails cannot happen to a case that this registry read.
        let built = entry.and_then(|entry| (entry.build)(case, &mut faults).ok());
        checks(case, &mut faults);
        match (built, entry) {
            (Some((scene, Some(solver))), Some(entry)) if faults.is_empty() => {
                Ok(Problem::new(case, scene, entry.info, solver))
            }
            _ => Err(case.clone().refuse(placed(case, faults))),
        }
    }
}

/// Faults at the places that they have in this case.
fn placed(case: &Case, faults: Faults) -> Vec<(String, Arc<dyn CaseFault>)> {
    faults.0.into_iter().map(|(path, fault)| (case.place(&path), fault)).collect()
}

/// The typed problem of a case of the model `M`: a file or a shipped case, with `--set` overrides.
///
/// # Errors
/// Every violation, as [`Registry::load`].
pub fn read<M: Model>(name: &str, overrides: &[String]) -> Result<M, CaseError> {
    let kinds = [Kind::of::<M::Tables>(M::INFO.name), Kind::of_scene::<M::Scene, M::Table>(M::INFO.table)];
    let case = Case::load(&Kinds::new(kinds.into()), name, overrides)?;
    from_case::<M>(&case)
}

fn from_case<M: Model>(case: &Case) -> Result<M, CaseError> {
    let mut faults = Faults::new();
    match parts::<M>(case).ok().and_then(|(scene, table)| M::build(&scene, &table, &mut faults)) {
        Some(problem) if faults.is_empty() => Ok(problem),
        _ => Err(case.clone().refuse(placed(case, faults))),
    }
}

/// A flow and a table of the model `M` as the tables of a case.
fn written<M: Model>(about: &impl Serialize, scene: &M::Scene, table: &M::Table) -> Value {
    let of = |value: Result<Value, serde_json::Error>| value.unwrap_or_default();
    let mut tables = Map::new();
    tables.insert("format".into(), 2.into());
    tables.insert("scene".into(), M::Scene::KIND.into());
    tables.insert("case".into(), of(serde_json::to_value(about)));
    tables.extend(of(serde_json::to_value(scene)).as_object().cloned().unwrap_or_default());
    tables.insert(M::INFO.table.into(), of(serde_json::to_value(table)));
    Value::Object(tables)
}

fn convert<M: Model>(case: &Case) -> Option<Value> {
    let (scene, table) = parts::<M>(case).ok()?;
    Some(written::<M>(case.about(), &scene, &table))
}

/// The problem of a flow and a table that were made without a case file, checked as a file is: ranges of the schema, then values
/// against each other.
///
/// # Errors
/// Every violation; its places point into the two written as a case.
pub fn checked<M: Model>(title: &str, scene: &M::Scene, table: &M::Table) -> Result<M, CaseError> {
    let tables = written::<M>(&json!({ "title": title }), scene, table);
    let kinds = Kinds::new(vec![Kind::of_scene::<M::Scene, M::Table>(M::INFO.table)]);
    from_case::<M>(&Case::parse(&kinds, title, "tables", crate::case::text(tables), &[])?)
}
