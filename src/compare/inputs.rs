//! In what the flows and the models of a comparison differ, and how much sediment each holds.

use serde_json::{Map, Value};

use super::{CompareError, Comparison, Subject};
use crate::plot::{Cell, Section};
use crate::result::quantity as q;
use crate::result::{SceneRecord, differences, flatten};
use crate::units::{readable, significant};

/// Tables of a case that state the flow, whatever the model.
const OF_THE_FLOW: [&str; 4] = ["fluid.", "grains.", "bed.", "flow."];
/// What in a case says neither what flows nor how it is solved.
const BESIDE: [&str; 5] = ["format", "scene", "case.", "check", "limit."];
/// Amounts of sediment that differ by less are the same for a reader.
const SAME_AMOUNT: f64 = 5e-3;

/// The flow of a subject, and how it was solved.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Stated {
    /// the model
    pub model: String,
    /// the flow
    pub scene: SceneRecord,
    /// every value of the resolved case by dotted path
    pub inputs: Map<String, Value>,
}

impl Stated {
    /// The flow of a case: its model, its scene, its resolved tables.
    #[must_use]
    pub fn new(model: &str, scene: SceneRecord, tables: &Value) -> Self {
        let mut inputs = Map::new();
        flatten("", tables, &mut inputs);
        // In a case of format 2 the table of the model has its name.
        let own = format!("{model}.");
        let known =
            inputs.into_iter().map(|(path, value)| (path.strip_prefix(&own).map(str::to_owned).unwrap_or(path), value));
        let inputs = known.filter(|(path, _)| !BESIDE.iter().any(|beside| path.starts_with(beside))).collect();
        Self { model: model.into(), scene, inputs }
    }

    /// The values that can differ from those of `other`: all of them in one model; the flow, and what both models have, in two.
    fn beside(&self, other: &Self) -> Map<String, Value> {
        if self.model == other.model {
            return self.inputs.clone();
        }
        let own = self
            .inputs
            .iter()
            .filter(|(path, _)| !of_the_flow(path) && !path.starts_with("model.") && other.inputs.contains_key(*path));
        let own = own.map(|(path, value)| (path.clone(), value.clone()));
        self.scene.inputs.clone().into_iter().chain(own).collect()
    }
}

fn of_the_flow(path: &str) -> bool {
    OF_THE_FLOW.iter().any(|table| path.starts_with(table))
}

/// An input that is not the same in all subjects.
#[derive(Clone, Debug, PartialEq)]
pub struct InputRow {
    /// its dotted path
    pub path: String,
    /// its value in each subject; `None` where it has none, or nothing is known of its inputs
    pub values: Vec<Option<Value>>,
}

/// The inputs in which subjects differ from the first of them.
pub(super) fn rows(subjects: &[Subject]) -> Vec<InputRow> {
    let Some(reference) = subjects.first().and_then(|first| first.stated.as_ref()) else { return Vec::new() };
    let mut rows: Vec<InputRow> = Vec::new();
    for (i, other) in subjects.iter().enumerate().skip(1) {
        let Some(other) = &other.stated else { continue };
        for difference in differences(&reference.beside(other), &other.beside(reference)) {
            let known = rows.iter().position(|row| row.path == difference.path);
            let at = known.unwrap_or_else(|| {
                rows.push(InputRow { path: difference.path, values: vec![None; subjects.len()] });
                rows.len() - 1
            });
            if let Some(row) = rows.get_mut(at) {
                if let Some(first) = row.values.first_mut() {
                    *first = difference.first;
                }
                if let Some(value) = row.values.get_mut(i) {
                    *value = difference.second;
                }
            }
        }
    }
    // What is the same in the reference and a third one was left out above.
    for row in &mut rows {
        for (value, subject) in row.values.iter_mut().zip(subjects) {
            if let (None, Some(stated)) = (&*value, &subject.stated) {
                *value = stated.scene.inputs.get(&row.path).or_else(|| stated.inputs.get(&row.path)).cloned();
            }
        }
    }
    rows
}

/// Refuses flows that have nothing to do with each other: each by its name and the kind of its scene.
///
/// # Errors
/// [`CompareError::DifferentKinds`] with the first two.
pub fn of_one_kind(mut kinds: impl Iterator<Item = (String, String)>) -> Result<(), CompareError> {
    let Some((reference, kind)) = kinds.next() else { return Ok(()) };
    match kinds.find(|(_, other)| *other != kind) {
        None => Ok(()),
        Some((other, other_kind)) => Err(CompareError::DifferentKinds { reference, kind, other, other_kind }),
    }
}

impl Subject {
    /// Solid volume per area \[m]: as reported, or of the bed at rest.
    #[must_use]
    pub fn solid_volume(&self) -> Option<f64> {
        let result = |quantity: &q::Quantity| self.results.get(quantity.name);
        let parts = || Some(result(&q::SOLID_VOLUME_BED)? + result(&q::SOLID_VOLUME_SUSPENSION)?);
        result(&q::SOLID_VOLUME).or_else(parts).or_else(|| self.stated.as_ref()?.scene.solid_volume_m)
    }
}

impl Comparison {
    /// In what the flows of the subjects differ, with the values in SI, in one sentence; that they do not; `None` where nothing is
    /// known of them.
    #[must_use]
    pub fn flows_that_differ(&self) -> Option<String> {
        // The others are compared with the first; of data nothing is known.
        let (first, others) = self.subjects.split_first().filter(|(first, _)| first.stated.is_some())?;
        let known: Vec<&str> = others.iter().filter(|s| s.stated.is_some()).map(|s| s.name.as_str()).collect();
        let same = match known.len() {
            0 => None,
            n if n == others.len() => Some("the same in all".to_owned()),
            _ => Some(format!("the same in {} and {}; of the others it is not known", first.name, known.join(", "))),
        };
        self.named(&|path| of_the_flow(path)).or(same)
    }

    /// In what the models and their numerics differ, with the values in SI; `None` where nothing is known to.
    #[must_use]
    pub fn models_that_differ(&self) -> Option<String> {
        self.named(&|path| !of_the_flow(path))
    }

    /// The first inputs of a kind that differ, with their values.
    fn named(&self, of: &dyn Fn(&str) -> bool) -> Option<String> {
        const NAMED: usize = 4;
        const VALUES: usize = 3;
        let short = |value: &Option<Value>| match value {
            None => "none".to_owned(),
            Some(Value::Number(number)) if number.is_f64() => {
                number.as_f64().map_or_else(String::new, |x| significant(x, 4))
            }
            Some(Value::String(text)) => text.clone(),
            Some(other) => other.to_string(),
        };
        let rows: Vec<&InputRow> = self.inputs.iter().filter(|row| of(&row.path)).collect();
        let one = |row: &&InputRow| match row.values.len() {
            n if n > VALUES => row.path.clone(),
            _ => format!("{} {}", row.path, row.values.iter().map(short).collect::<Vec<_>>().join(" | ")),
        };
        let named: Vec<String> = rows.iter().take(NAMED).map(one).collect();
        let more = rows.len().saturating_sub(NAMED);
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        (!named.is_empty()).then(|| format!("{}{rest}", named.join("; ")))
    }

    /// That the subjects do not hold the same amount of sediment, with the amounts.
    pub(super) fn amounts(&self) -> Option<String> {
        let known = self.subjects.iter().filter_map(|s| Some((s.name.as_str(), s.solid_volume()?)));
        let known: Vec<(&str, f64)> = known.collect();
        let (low, high) = known.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), (_, v)| (a.min(*v), b.max(*v)));
        let text = |(name, volume): &(&str, f64)| format!("{name} {}", readable(*volume, "m"));
        (high - low > SAME_AMOUNT * high).then(|| {
            let each: Vec<String> = known.iter().map(text).collect();
            format!("They hold different amounts of sediment, as solid volume per area: {}.", each.join(", "))
        })
    }

    /// The inputs that differ, as a table.
    pub(super) fn inputs_section(&self) -> Section<'static> {
        let shown = |value: &Option<Value>| match value {
            None => Cell::Empty("not an input"),
            Some(Value::Number(whole)) if !whole.is_f64() => {
                Cell::Number { shown: whole.to_string(), full: whole.to_string() }
            }
            Some(Value::Number(number)) => {
                let value = number.as_f64().unwrap_or(f64::NAN);
                Cell::Number { shown: significant(value, 5), full: number.to_string() }
            }
            Some(Value::String(text)) => Cell::Text(text.clone()),
            Some(other) => Cell::Text(other.to_string()),
        };
        let row = |row: &InputRow| {
            let values = row.values.iter().map(shown);
            std::iter::once(Cell::Text(row.path.clone())).chain(values).collect()
        };
        let head = std::iter::once("input, in SI").chain(self.subjects.iter().map(|s| s.name.as_str()));
        let lead = "Of two models, the flow and what both have; of one model, every value of its resolved case.";
        let lead = if self.inputs.is_empty() { "No input differs, as far as inputs are known." } else { lead };
        Section::Table {
            heading: "Inputs that differ",
            lead: lead.into(),
            head: head.map(str::to_owned).collect(),
            rows: self.inputs.iter().map(row).collect(),
        }
    }
}
