//! A case is a flow, and the tables of the models that solve it.

use serde_json::Value;

use super::Case;
use super::diagnose::{Walk, nearest};
use super::document::{Data, Document, Node};
use super::fault::Fault;
use super::kind::{Kind, Kinds, SCENE, SHARED};
use super::wording::choices;
use super::{angle, schema};
use crate::units::{UnitError, parse_quantity};

/// The models of which the file has a table.
fn present<'k>(document: &Document, kinds: &'k Kinds) -> Vec<&'k Kind> {
    kinds.iter().filter(|kind| document.node(kind.name).is_some() && is_written(document, kind.name)).collect()
}

/// The model of which `--set` alone has a key, if there is one.
fn set_alone<'k>(document: &Document, kinds: &'k Kinds) -> Option<&'k str> {
    let set = |kind: &&Kind| document.node(kind.name).is_some() && !is_written(document, kind.name);
    kinds.iter().find(set).map(|kind| kind.name)
}

/// Whether the file itself has a table of `model`.
pub(super) fn is_written(document: &Document, model: &str) -> bool {
    document.written.iter().any(|name| name == model)
}

/// The model of a case: the one that was chosen, or the only one that it has; else those that it has.
pub(super) fn choice<'k>(document: &Document, kinds: &'k Kinds) -> Result<&'k Kind, Vec<&'k str>> {
    let present = present(document, kinds);
    let chosen = kinds.chosen.as_deref().map(|name| kinds.iter().find(|kind| kind.name == name));
    match (chosen, present.as_slice()) {
        (Some(Some(kind)), _) => Ok(kind),
        (None, [only]) => Ok(only),
        _ => Err(present.iter().map(|kind| kind.name).collect()),
    }
}

/// The name of that model, if it is known.
pub(super) fn chosen(document: &Document, kinds: &Kinds) -> Option<&'static str> {
    choice(document, kinds).ok().map(|kind| kind.name)
}

/// The name of a case: its stem, with the model where that is not the only one that it has.
pub(super) fn named(stem: &str, document: &Document, kinds: &Kinds) -> String {
    let only = |model: &str| matches!(present(document, kinds).as_slice(), [kind] if kind.name == model);
    match chosen(document, kinds) {
        Some(model) if !only(model) && !kinds.partial => format!("{stem}-{model}"),
        _ => stem.to_owned(),
    }
}

/// Whether a `--set` argument is of the flow.
pub(super) fn of_the_flow(argument: &str) -> bool {
    SHARED.contains(&argument.split(['.', '=']).next().unwrap_or_default().trim())
}

/// A `--set` argument: what is no table of the flow is a key of the model.
pub(super) fn within(model: &str, argument: &str) -> String {
    let first = argument.split(['.', '=']).next().unwrap_or_default().trim();
    // One whose key has an empty part stays as it was typed, to be shown.
    let key = argument.split('=').next().unwrap_or_default();
    if of_the_flow(argument) || first == model || key.split('.').any(|part| part.trim().is_empty()) {
        return argument.to_owned();
    }
    format!("{model}.{}", argument.trim_start())
}

/// The `--set` arguments that are for `model` where several `models` solve one case: not those that begin with the name of another.
#[must_use]
pub fn for_model(model: &str, models: &[String], overrides: &[String]) -> Vec<String> {
    let first = |argument: &String| argument.split(['.', '=']).next().unwrap_or_default().trim().to_owned();
    let of_another = |argument: &&String| models.iter().any(|other| other != model && *other == first(argument));
    overrides.iter().filter(|argument| !of_another(argument)).cloned().collect()
}

/// The document without the tables of other models.
pub(super) fn view(document: &Document, kinds: &Kinds, kind: &Kind) -> Node {
    let mut root = document.root.clone();
    if let Data::Table(entries) = &mut root.data {
        let of_another =
            |name: &str| kinds.iter().any(|other| other.name == name) || kinds.partial && !SHARED.contains(&name);
        entries.retain(|(name, _)| name == kind.name || !of_another(name));
    }
    root
}

/// Diameter of the grains \[m], if it can be read.
pub(super) fn diameter(document: &Document) -> Option<f64> {
    match &document.node("grains.diameter")?.data {
        Data::Text(text) => parse_quantity(text, "m").ok(),
        Data::Float(d) => Some(*d),
        Data::Integer(d) => Some(*d as f64),
        _ => None,
    }
}

/// A length in diameters of the grains, `12.5 d`, in metres.
pub(super) fn diameters(text: &str, d: f64) -> Option<f64> {
    let number: f64 = text.trim().strip_suffix('d')?.trim_end().parse().ok()?;
    Some(number * d)
}

impl<'k> Walk<'k> {
    /// The model of a case, if it solves the kind of flow that the case has; says what is wrong if there is none.
    pub(super) fn choose_model(&mut self, document: &Document) -> Option<&'k Kind> {
        let scenes = self.kinds.scenes();
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let span = document.locate(SCENE);
        let word = match document.node(SCENE).map(|node| &node.data) {
            Some(Data::Text(word)) if scenes.contains(&word.as_str()) => word.clone(),
            found => {
                let fault = match found {
                    Some(Data::Text(word)) => Fault::UnknownWord {
                        name: SCENE.into(),
                        word: word.clone(),
                        nearest: nearest(word, scenes.iter().copied()),
                        allowed: owned(&scenes),
                    },
                    Some(other) => Fault::WrongType {
                        name: SCENE.into(),
                        found: other.kind(),
                        expected: choices(scenes.iter().copied()),
                    },
                    None => Fault::Missing {
                        what: "key",
                        name: SCENE.into(),
                        description: "the kind of flow".into(),
                        allowed: scenes.join(", "),
                    },
                };
                self.report(fault, SCENE, &span);
                return None;
            }
        };
        let solvers: Vec<&str> = self.kinds.iter().filter(|kind| kind.scene == word).map(|kind| kind.name).collect();
        // A table of a model that solves another kind of flow is wrong whichever model is chosen.
        let strangers: Vec<&Kind> =
            present(document, self.kinds).into_iter().filter(|kind| kind.scene != word).collect();
        for kind in strangers.iter().filter(|kind| self.kinds.chosen.as_deref() != Some(kind.name)) {
            let fault = Fault::OtherScene { model: kind.name.into(), scene: word.clone(), allowed: owned(&solvers) };
            self.report(fault, kind.name, &document.locate(kind.name));
        }
        match choice(document, self.kinds) {
            Ok(kind) if kind.scene == word => Some(kind),
            Ok(kind) if strangers.iter().any(|other| other.name == kind.name) && self.kinds.chosen.is_none() => None,
            Ok(kind) => {
                let fault = Fault::OtherScene { model: kind.name.into(), scene: word, allowed: owned(&solvers) };
                self.report(fault, kind.name, &document.locate(kind.name));
                None
            }
            Err(_) if !strangers.is_empty() && self.kinds.chosen.is_none() => None,
            Err(present) => {
                let given = self.kinds.chosen.clone();
                let alone = present.is_empty() || given.is_some();
                let allowed = if alone { owned(&solvers) } else { owned(&present) };
                let set = set_alone(document, self.kinds).map(str::to_owned);
                self.report(Fault::WhichModel { given, allowed, alone, set }, "", &document.root.value);
                None
            }
        }
    }

    /// What a text says of a number; a length may be one in diameters of the grains.
    pub(super) fn quantity(&self, text: &str, schema: &Value) -> Result<f64, UnitError> {
        let length = schema::text(schema, "x-unit") == "m";
        let scaled = self.diameter.filter(|_| length).and_then(|d| diameters(text, d));
        let read = || angle::quantity(text, schema);
        scaled.map_or_else(read, Ok).map_err(|error| match error {
            // `d` is a unit of lengths.
            UnitError::UnknownUnit { ref symbol, .. } if symbol == "d" && !length => {
                match angle::quantity(&text.replace('d', "m"), schema) {
                    Err(UnitError::WrongDimension { found, expected, .. }) => {
                        UnitError::WrongDimension { unit: "d".into(), found, expected }
                    }
                    _ => error,
                }
            }
            UnitError::UnknownUnit { symbol, .. } if symbol == "D" && length => {
                UnitError::UnknownUnit { symbol, nearest: Some("d".into()) }
            }
            other => other,
        })
    }

    /// Whether a text is a length in diameters of grains whose diameter is missing or wrong, which is reported there.
    pub(super) fn of_unknown_grains(&self, text: &str, path: &str, schema: &Value) -> bool {
        let unknown = self.diameter.is_none_or(|d| d <= 0.0);
        unknown && self.takes_diameters(path, schema) && diameters(text, 1.0).is_some()
    }

    /// Whether a number is a length of a flow that has grains, and not their diameter itself.
    pub(super) fn takes_diameters(&self, path: &str, schema: &Value) -> bool {
        const DIAMETER: &str = "grains.diameter";
        let required = |kind: &Kind| {
            let required = kind.schema.get("required").and_then(Value::as_array);
            required.is_some_and(|required| required.iter().any(|table| table == "grains"))
        };
        // Where grains are a choice, they are there or there are none.
        let of = |kind: &Kind| schema::has(&kind.schema, DIAMETER) && (self.has_grains || required(kind));
        self.kind.is_some_and(of) && path != DIAMETER && schema::text(schema, "x-unit") == "m"
    }
}

impl Case {
    /// Where the value that a model knows as `path` stands in the case: what is no table of the flow is in the table of the model.
    #[must_use]
    pub fn place(&self, path: &str) -> String {
        within(self.model, path)
    }
}
