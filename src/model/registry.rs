//! The models that a program knows, as a value: `models::builtin().with(Entry::of::<Mine>())`.

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::problem::checks;
use super::takes::takes;
use super::{Checked, Faults, Flow, Model, ModelInfo, Offer, Problem, Solve};
use crate::case::{Case, CaseError, CaseFault, Fault, FlowTables, Kind, Kinds, Violation, for_model};
use crate::scene::Scene;

/// The flow of a case and a problem of some model, if its values allow one; or that the tables are none of the model's.
type Built = Result<(Scene, Option<Arc<dyn Solve>>), serde_json::Error>;

/// A model without its types.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// what it is called
    pub info: ModelInfo,
    kind: fn() -> Kind,
    scene: &'static str,
    build: fn(&Case, &[(&'static str, ModelInfo)], &mut Faults) -> Built,
    offer: fn(&Flow, f64) -> Option<Offer>,
}

impl Entry {
    /// The model `M`.
    #[must_use]
    pub fn of<M: Model>() -> Self {
        let kind = || Kind::of::<M::Scene, M::Table>(M::INFO.name);
        Self { info: M::INFO, kind, scene: M::Scene::KIND, build: build::<M>, offer: M::offer }
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
    let own = tables.as_object_mut().and_then(|tables| tables.shift_remove(M::INFO.name));
    Ok((serde_json::from_value(tables)?, serde_json::from_value(own.unwrap_or_default())?))
}

fn build<M: Model>(case: &Case, others: &[(&'static str, ModelInfo)], faults: &mut Faults) -> Built {
    let (scene, table) = parts::<M>(case)?;
    let model = built::<M>(&scene, &table, others, faults).map(|model| Arc::new(model) as Arc<dyn Solve>);
    Ok((scene.into(), model))
}

/// What is wrong with the flow itself, then with the flow and the table together; where both point at the same value, the flow's fault says
/// enough.
fn built<M: Model>(
    scene: &M::Scene,
    table: &M::Table,
    others: &[(&'static str, ModelInfo)],
    faults: &mut Faults,
) -> Option<M> {
    takes(scene, &M::INFO, others, faults);
    let mut own = Faults::new();
    for (path, fault) in scene.faults() {
        match fault {
            // Which drives there should be is clear when those that the model does not solve are gone.
            Fault::Drives { .. } if !faults.is_empty() => {}
            Fault::Drives { given, allowed } => {
                let allowed = allowed.into_iter().filter(|drives| M::INFO.solves_all(drives)).collect();
                own.push((path, Fault::Drives { given, allowed }));
            }
            fault => own.push((path, fault)),
        }
    }
    faults.also(own);
    let mut own = Faults::new();
    let model = M::build(scene, table, &mut own);
    faults.also(own);
    model
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
        self.check(Case::load(&self.kinds, name, overrides)).map_err(|error| match error.choices() {
            Some(choices) if choices.alone => self.of_the_flow(name, overrides, choices.models).unwrap_or(error),
            _ => error,
        })
    }

    /// What is wrong with a scene alone: what every one of `models` says of it, if none of them takes it.
    fn of_the_flow(&self, name: &str, overrides: &[String], models: &[String]) -> Option<CaseError> {
        let with = |model: &String| self.of(model, models, name, overrides).err();
        let mut errors: Vec<CaseError> = models.iter().map(with).collect::<Option<_>>()?;
        let mut first = errors.pop()?;
        let same = |a: &Violation, b: &Violation| a.path == b.path && a.fault.to_string() == b.fault.to_string();
        first.violations.retain(|v| errors.iter().all(|error| error.violations.iter().any(|other| same(v, other))));
        (!first.violations.is_empty()).then_some(first)
    }

    /// The cases that `name` stands for, as names that [`Self::load`] takes: with each of `models`; without any with those that the case
    /// has, or with all that take a scene alone.
    ///
    /// # Errors
    /// The case is wrong, or no model takes it.
    pub fn cases_of(&self, name: &str, overrides: &[String], models: &[String]) -> Result<Vec<String>, Box<CaseError>> {
        let with = |model: &str| format!("{name}:{model}");
        if !models.is_empty() {
            return Ok(models.iter().map(|model| with(model)).collect());
        }
        let error = match self.load(name, overrides) {
            Ok(_) => return Ok(vec![name.to_owned()]),
            Err(error) => Box::new(error),
        };
        let Some(choices) = error.choices() else { return Err(error) };
        let alone = choices.alone;
        let takes = |model: &&String| !alone || self.of(model, choices.models, name, overrides).is_ok();
        let cases: Vec<String> = choices.models.iter().filter(takes).map(|model| with(model)).collect();
        if cases.is_empty() { Err(error) } else { Ok(cases) }
    }

    /// The case with each model that takes its scene, from least to most.
    pub fn takers<'a>(&'a self, name: &'a str, overrides: &'a [String]) -> impl Iterator<Item = Checked> + 'a {
        let models: Vec<String> = self.entries.iter().map(|entry| entry.info.name.to_owned()).collect();
        self.entries.iter().filter_map(move |entry| self.of(entry.info.name, &models, name, overrides).ok())
    }

    /// The case with one of several models: what is set in the table of another is not for it.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn of(&self, model: &str, models: &[String], name: &str, overrides: &[String]) -> Result<Checked, CaseError> {
        self.clone().choosing(model).load(name, &for_model(model, models, overrides))
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
        self.entries.iter().find(|entry| entry.info.name == case.model)
    }

    /// Checks what no schema can: values against each other, laws against the model, checks against the results.
    fn problem(&self, case: &Case) -> Result<Problem, CaseError> {
        let mut faults = Faults::new();
        let entry = self.entry(case);
        // The tables were read once: that this fails cannot happen to a case that this registry read.
        let others: Vec<_> = self.entries.iter().map(|entry| (entry.scene, entry.info)).collect();
        let built = entry.and_then(|entry| (entry.build)(case, &others, &mut faults).ok());
        checks(case, &mut faults);
        match (built, entry) {
            (Some((scene, Some(solver))), Some(entry)) if faults.is_empty() => {
                Ok(Problem::new(case, scene, entry.info, solver))
            }
            _ => Err(case.clone().refuse(&self.kinds, placed(case, faults))),
        }
    }
}

/// Faults at the places that they have in this case.
fn placed(case: &Case, faults: Faults) -> Vec<(String, Arc<dyn CaseFault>)> {
    faults.0.into_iter().map(|(path, fault)| (case.place(&path), fault)).collect()
}

/// The typed problem of a case of the model `M`: a file or a shipped case, with `--set` overrides. Tables of other models may stand beside.
///
/// # Errors
/// Every violation, as [`Registry::load`].
pub fn read<M: Model>(name: &str, overrides: &[String]) -> Result<M, CaseError> {
    let kinds = Kinds::new(vec![Kind::of::<M::Scene, M::Table>(M::INFO.name)]).partial();
    let case = Case::load(&kinds, name, overrides)?;
    from_case::<M>(&kinds, &case)
}

fn from_case<M: Model>(kinds: &Kinds, case: &Case) -> Result<M, CaseError> {
    let mut faults = Faults::new();
    match parts::<M>(case).ok().and_then(|(scene, table)| built::<M>(&scene, &table, &[], &mut faults)) {
        Some(problem) if faults.is_empty() => Ok(problem),
        _ => Err(case.clone().refuse(kinds, placed(case, faults))),
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
    tables.insert(M::INFO.name.into(), of(serde_json::to_value(table)));
    Value::Object(tables)
}

/// The problem of a flow and a table that were made without a case file, checked as a file is: ranges of the schema, then values
/// against each other.
///
/// # Errors
/// Every violation; its places point into the two written as a case.
pub fn checked<M: Model>(title: &str, scene: &M::Scene, table: &M::Table) -> Result<M, CaseError> {
    let tables = written::<M>(&json!({ "title": title }), scene, table);
    let kinds = Kinds::new(vec![Kind::of::<M::Scene, M::Table>(M::INFO.name)]);
    from_case::<M>(&kinds, &Case::parse(&kinds, title, "tables", crate::case::text(tables), &[])?)
}
