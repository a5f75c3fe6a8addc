//! Cases of format 2: a flow, and the tables of the models that solve it.

use serde_json::Value;

use super::Case;
use super::diagnose::{Walk, nearest};
use super::document::{Data, Document, Node};
use super::fault::Fault;
use super::kind::{Kind, Kinds, SCENE, SHARED};
use super::wording::choices;
use super::{angle, schema};
use crate::units::{UnitError, parse_quantity};

/// Whether the document is one of format 2.
pub(super) fn is_scene(document: &Document) -> bool {
    let second = matches!(document.node("format").map(|node| &node.data), Some(Data::Integer(2)));
    second || document.node(SCENE).is_some()
}

/// The models of which the document has a table.
fn present<'k>(document: &Document, kinds: &'k Kinds) -> Vec<&'k Kind> {
    kinds.scenes().filter(|kind| document.node(kind.name).is_some()).collect()
}

/// The model of a case of format 2: the one that was chosen, or the only one that it has; else those that it has.
pub(super) fn choice<'k>(document: &Document, kinds: &'k Kinds) -> Result<&'k Kind, Vec<&'k str>> {
    let present = present(document, kinds);
    let chosen = kinds.chosen.as_deref().map(|name| kinds.scenes().find(|kind| kind.name == name));
    match (chosen, present.as_slice()) {
        (Some(Some(kind)), _) => Ok(kind),
        (None, [only]) => Ok(only),
        _ => Err(present.iter().map(|kind| kind.name).collect()),
    }
}

/// The name of that model, if it is known.
pub(super) fn chosen(document: &Document, kinds: &Kinds) -> Option<&'static str> {
    is_scene(document).then(|| choice(document, kinds).ok().map(|kind| kind.name)).flatten()
}

/// The name of a case: its stem, with the model where it has the tables of several.
pub(super) fn named(stem: &str, document: &Document, kinds: &Kinds) -> String {
    match chosen(document, kinds) {
        Some(model) if present(document, kinds).len() > 1 => format!("{stem}-{model}"),
        _ => stem.to_owned(),
    }
}

/// A `--set` argument of a case of format 2: what is no table of the flow is a key of the model.
pub(super) fn within(model: &str, argument: &str) -> String {
    let first = argument.split(['.', '=']).next().unwrap_or_default().trim();
    if SHARED.contains(&first) || first == model {
        return argument.to_owned();
    }
    format!("{model}.{}", argument.trim_start().strip_prefix("model.").unwrap_or(argument.trim_start()))
}

/// The document without the tables of other models.
pub(super) fn view(document: &Document, kinds: &Kinds, kind: &Kind) -> Node {
    let mut root = document.root.clone();
    if let Data::Table(entries) = &mut root.data {
        entries.retain(|(name, _)| name == kind.name || kinds.scenes().all(|other| other.name != name));
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
    let number = text.trim().strip_suffix('d')?;
    let number: f64 = number.strip_suffix(char::is_whitespace)?.trim_end().parse().ok()?;
    Some(number * d)
}

impl<'k> Walk<'k> {
    /// The model of a case of format 2, if it solves the kind of flow that the case has; says what is wrong if there is none.
    pub(super) fn choose_model(&mut self, document: &Document) -> Option<&'k Kind> {
        let mut scenes: Vec<&str> = self.kinds.scenes().filter_map(|kind| kind.scene).collect();
        scenes.sort_unstable();
        scenes.dedup();
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
        let solvers: Vec<&str> =
            self.kinds.scenes().filter(|kind| kind.scene == Some(&word)).map(|kind| kind.name).collect();
        match choice(document, self.kinds) {
            Ok(kind) if kind.scene == Some(&word) => Some(kind),
            Ok(kind) => {
                let fault = Fault::OtherScene { model: kind.name.into(), scene: word, allowed: owned(&solvers) };
                self.report(fault, kind.name, &document.locate(kind.name));
                None
            }
            Err(present) => {
                let given = self.kinds.chosen.clone().into_iter().collect::<Vec<_>>();
                let allowed = if present.is_empty() { owned(&solvers) } else { owned(&present) };
                self.report(Fault::WhichModel { given: given.join(", "), allowed }, "", &document.root.value);
                None
            }
        }
    }

    /// What a text says of a number; in format 2 a length may be one in diameters of the grains.
    pub(super) fn quantity(&self, text: &str, schema: &Value) -> Result<f64, UnitError> {
        let length = schema::text(schema, "x-unit") == "m" && self.kind.is_some_and(|kind| kind.scene.is_some());
        let scaled = self.diameter.filter(|_| length).and_then(|d| diameters(text, d));
        scaled.map_or_else(|| angle::quantity(text, schema), Ok)
    }
}

impl Case {
    /// Whether it is of format 2: a flow, and the table of its model.
    #[must_use]
    pub fn is_scene(&self) -> bool {
        self.content.tables.get(SCENE).is_some()
    }

    /// Where the value that a model knows as `path` stands in this case: in format 2 what is no table of the flow is in the table of the
    /// model, and level and height of format 1 have other names.
    #[must_use]
    pub fn place(&self, path: &str) -> String {
        if !self.is_scene() {
            return path.to_owned();
        }
        match path {
            "bed.level" => "bed.thickness".into(),
            "flow.height" => "flow.depth".into(),
            _ => within(self.model, path),
        }
    }
}
