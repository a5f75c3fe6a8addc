//! Compares a document with the schema of its model: every violation at once, each with its place.

use serde_json::{Map, Value, json};

use super::angle::{self, Definition};
use super::document::{Data, Document, Node};
use super::fault::Fault;
use super::kind::{Kind, Kinds};
use super::violation::{Span, Violation};
use super::wording::{choices, expected, header, shown};
use super::{format1, scene, schema};
use crate::closures::catalogue;

/// What a document says, and what is wrong with it.
pub(super) struct Diagnosis<'k> {
    /// kind of the case and the document in plain SI: complete if there are no violations
    pub case: Option<(&'k Kind, Value)>,
    pub violations: Vec<Violation>,
}

/// Reads a document as the kind of case that it names.
pub(super) fn diagnose<'k>(document: &Document, kinds: &'k Kinds) -> Diagnosis<'k> {
    let mut walk = Walk {
        kinds,
        kind: None,
        diameter: scene::diameter(document),
        has_grains: document.node("grains").is_some(),
        violations: Vec::new(),
        complete: true,
    };
    if matches!(&document.root.data, Data::Table(entries) if entries.is_empty()) {
        walk.report(Fault::Empty, "", &document.root.value);
        return Diagnosis { case: None, violations: walk.violations };
    }
    if format1::is_old(document) {
        return Diagnosis { case: None, violations: format1::refused(document) };
    }
    walk.kind = walk.choose_model(document);
    let case = walk.kind.map(|kind| (kind, walk.value(&scene::view(document, kinds, kind), &kind.schema, "")));
    if case.is_none() {
        walk.without_kind(document);
    }
    let case = case.filter(|_| walk.complete);
    Diagnosis { case, violations: walk.violations }
}

/// The name in `candidates` that `word` most likely stands for, if one is close.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let word = word.to_lowercase();
    candidates
        .into_iter()
        .map(|c| (strsim::damerau_levenshtein(&word, &c.to_lowercase()), c))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, c)| *distance <= (c.chars().count().max(word.chars().count()) / 3).max(1))
        .map(|(_, c)| c.to_owned())
}

/// The schema of the constants of a law that need not be given, for `usual` has them.
fn beside(usual: &Map<String, Value>, schema: &Value) -> Value {
    let mut schema = schema.clone();
    if let Some(Value::Array(required)) = schema.get_mut("required") {
        required.retain(|key| !key.as_str().is_some_and(|key| usual.contains_key(key)));
    }
    schema
}

/// The fault of a missing key or table of the table `path`.
fn missing(name: &str, schema: &Value, path: &str) -> Fault {
    let is_table = schema.get("properties").is_some() || path.is_empty() && schema::alternatives(schema).is_some();
    let allowed = if is_table {
        let keys: Vec<&str> = schema::properties(schema).map(|(k, _)| k.as_str()).collect();
        format!("a table with {}", keys.join(", "))
    } else {
        expected(schema)
    };
    Fault::Missing {
        what: if is_table { "table" } else { "key" },
        name: match (is_table, path) {
            (true, _) => format!("[{}]", join(path, name)),
            (false, "") => name.into(),
            (false, table) => format!("{name} in {}", header(table)),
        },
        description: schema::text(schema, "description").into(),
        allowed,
    }
}

impl Kinds {
    /// The fault of a value of a case of `model` that is missing at `path`.
    pub(super) fn missing(&self, model: &str, path: &str) -> Fault {
        let schema = self.iter().find(|kind| kind.name == model).map(|kind| &kind.schema);
        let parts = path.split('.').map(|name| format!("/properties/{name}"));
        let schema = schema.and_then(|schema| schema.pointer(&parts.collect::<String>()));
        let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
        missing(name, schema.unwrap_or(&Value::Null), table)
    }
}

pub(super) struct Walk<'k> {
    pub(super) kinds: &'k Kinds,
    pub(super) kind: Option<&'k Kind>,
    /// diameter of the grains \[m], the unit `d` of a length
    pub(super) diameter: Option<f64>,
    /// whether there is a table of them
    pub(super) has_grains: bool,
    violations: Vec<Violation>,
    /// whether every value could be read that is not reported
    complete: bool,
}

impl<'k> Walk<'k> {
    pub(super) fn report(&mut self, fault: Fault, path: &str, span: &Span) {
        self.violations.push(Violation::new(fault, path.to_owned(), span.clone()));
    }

    /// Without a model only the names of tables can be checked.
    fn without_kind(&mut self, document: &Document) {
        if document.node("format").is_none() {
            let schema = self.kinds.iter().next().map(|kind| &kind.schema["properties"]["format"]);
            self.missing("format", schema.unwrap_or(&Value::Null), "", &document.root.value);
        }
        let Data::Table(entries) = &document.root.data else { return };
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in self.kinds.iter().flat_map(|s| schema::properties(&s.schema)) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        for (name, node) in entries.iter().filter(|(name, _)| !names.contains(&name.as_str())) {
            let fault = Fault::Unknown {
                what: if matches!(node.data, Data::Table(_)) { "table" } else { "key" },
                name: name.clone(),
                place: String::new(),
                nearest: nearest(name, names.iter().copied()),
                elsewhere: None,
                allowed: names.iter().map(|&n| n.to_owned()).collect(),
            };
            // A misspelt model is why no model was found.
            if matches!(&fault, Fault::Unknown { nearest: Some(name), .. } if self.kinds.iter().any(|kind| kind.name == name))
            {
                self.violations.retain(|v| !matches!(v.fault.downcast_ref(), Some(Fault::WhichModel { .. })));
            }
            self.report(fault, name, &node.key);
        }
    }

    /// The value of `node` in plain SI; reports whatever is wrong on the way.
    fn value(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        if let Some(alternatives) = schema::alternatives(schema) {
            return self.tagged(node, &alternatives, schema.get("default"), path);
        }
        if let Some(constants) = schema::constants(schema) {
            return self.word(node, &constants, path);
        }
        match schema::text(schema, "type") {
            "object" => self.table(node, schema, path),
            "array" => self.array(node, schema, path),
            "number" => self.number(node, schema, path),
            "integer" => self.integer(node, schema, path),
            "string" => match &node.data {
                Data::Text(text) => Value::String(text.clone()),
                _ => self.wrong(node, path, "a text"),
            },
            _ => match node.data {
                Data::Boolean(b) => Value::Bool(b),
                _ => self.wrong(node, path, "true or false"),
            },
        }
    }

    fn wrong(&mut self, node: &Node, path: &str, expected: &str) -> Value {
        let fault = Fault::WrongType { name: shown(path), found: node.data.kind(), expected: expected.into() };
        self.report(fault, path, &node.value);
        Value::Null
    }

    fn word(&mut self, node: &Node, constants: &[(&str, &str)], path: &str) -> Value {
        let allowed = || constants.iter().map(|(c, _)| (*c).to_owned()).collect::<Vec<_>>();
        match &node.data {
            Data::Text(word) if constants.iter().any(|(c, _)| c == word) => Value::String(word.clone()),
            Data::Text(word) => {
                let fault = Fault::UnknownWord {
                    name: shown(path),
                    word: word.clone(),
                    nearest: nearest(word, constants.iter().map(|(c, _)| *c)),
                    allowed: allowed(),
                };
                self.report(fault, path, &node.value);
                Value::Null
            }
            _ => self.wrong(node, path, &choices(constants.iter().map(|(c, _)| *c))),
        }
    }

    fn tagged(&mut self, node: &Node, alternatives: &[(&str, &Value)], usual: Option<&Value>, path: &str) -> Value {
        // A law without parameters is a word.
        if let Data::Text(_) = &node.data {
            let (key, value) = (node.key.clone(), node.value.clone());
            let entries = vec![("law".to_owned(), node.clone())];
            return self.tagged(&Node { data: Data::Table(entries), key, value }, alternatives, usual, path);
        }
        let laws: Vec<&str> = alternatives.iter().map(|(law, _)| *law).collect();
        let Data::Table(entries) = &node.data else {
            return self.wrong(node, path, &format!("a table with law = {}", choices(laws)));
        };
        let law_path = join(path, "law");
        // A table that names no law, or the usual one, has its constants where it gives none.
        let named = entries.iter().find(|(key, _)| key == "law").map(|(_, node)| &node.data);
        if let Some(Value::Object(usual)) = usual
            && let Some(law) = usual.get("law").and_then(Value::as_str)
            && named.is_none_or(|named| matches!(named, Data::Text(word) if word == law))
            && let Some((_, schema)) = alternatives.iter().find(|(name, _)| *name == law)
        {
            let mut value = self.table(node, &beside(usual, schema), path);
            if let Value::Object(given) = &mut value {
                for (key, constant) in usual {
                    given.entry(key.clone()).or_insert_with(|| constant.clone());
                }
            }
            return value;
        }
        match entries.iter().find(|(k, _)| k == "law").map(|(_, n)| n) {
            Some(Node { data: Data::Text(law), value, .. }) => {
                if let Some((_, schema)) = alternatives.iter().find(|(name, _)| name == law) {
                    return self.table(node, schema, path);
                }
                let allowed = laws.iter().map(|&l| l.to_owned()).collect();
                let fault = match (self.kind, path.split_once("closures.").map(|(_, family)| family)) {
                    (Some(kind), Some(family)) if self.is_law(family, law) => {
                        Fault::LawMismatch { family: family.into(), law: law.clone(), model: kind.name.into(), allowed }
                    }
                    _ => Fault::UnknownWord {
                        name: shown(&law_path),
                        word: law.clone(),
                        nearest: nearest(law, laws.iter().copied()),
                        allowed,
                    },
                };
                self.report(fault, &law_path, value);
            }
            Some(other) => {
                self.wrong(other, &law_path, &choices(laws));
            }
            None => {
                let fault = Fault::Missing {
                    what: "key",
                    name: format!("law in {}", header(path)),
                    description: "the law of the closure".into(),
                    allowed: laws.join(", "),
                };
                self.report(fault, &law_path, &node.key);
            }
        }
        Value::Null
    }

    /// Whether the family has a law of this name, here or in another model.
    fn is_law(&self, family: &str, law: &str) -> bool {
        let of = |kind: &'k Kind| {
            let place = format!("/properties/{}/properties/closures/properties/{family}", kind.name);
            schema::alternatives(kind.schema.pointer(&place)?)
        };
        let elsewhere = self.kinds.iter().filter_map(of).flatten();
        catalogue().any(|info| info.family == family && info.law == law) || elsewhere.into_iter().any(|(l, _)| l == law)
    }

    fn table(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        let Data::Table(entries) = &node.data else { return self.wrong(node, path, "a table") };
        let mut object = Map::new();
        // What a misspelt key stands for is not missing as well.
        let mut meant: Vec<String> = Vec::new();
        for (name, child) in entries {
            let child_path = join(path, name);
            match schema.get("properties").and_then(|p| p.get(name)) {
                Some(child_schema) if child_schema.get("const").is_some() => {
                    object.insert(name.clone(), child_schema["const"].clone());
                }
                Some(child_schema) => {
                    let value = self.value(child, child_schema, &child_path);
                    object.insert(name.clone(), value);
                }
                None => meant.extend(self.unknown(name, child, schema, path)),
            }
        }
        match angle::definition(entries, schema, path) {
            Some(Definition::Implied(key)) => drop(object.insert(key, angle::ANGLE.into())),
            Some(Definition::Contradicted(violation)) => self.violations.push(violation),
            None => {}
        }
        for name in schema.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str) {
            if !object.contains_key(name) && !meant.iter().any(|m| m == name) {
                self.missing(name, &schema["properties"][name], path, &node.key);
            }
        }
        Value::Object(object)
    }

    /// Reports a name that the table does not have; returns the one that it stands for.
    fn unknown(&mut self, name: &str, node: &Node, schema: &Value, path: &str) -> Option<String> {
        let what =
            if path.is_empty() && matches!(node.data, Data::Table(_) | Data::Array(_)) { "table" } else { "key" };
        let allowed: Vec<String> = schema::properties(schema).map(|(k, _)| k.clone()).collect();
        let child_path = join(path, name);
        // A key of the table of a model may be one of another model's table.
        let own = self.kind.and_then(|kind| child_path.strip_prefix(kind.name)?.strip_prefix('.'));
        let place = |kind: &Kind| own.map_or_else(|| child_path.clone(), |key| join(kind.name, key));
        let users = self.kinds.iter().filter(|kind| schema::has(&kind.schema, &place(kind)));
        let users: Vec<String> = users.map(|kind| kind.name.to_owned()).collect();
        let fault = match self.kind {
            Some(kind) if !users.is_empty() && !users.iter().any(|u| u == kind.name) => {
                Fault::NotUsed { what, name: name.into(), model: kind.name.into(), users, allowed }
            }
            kind => Fault::Unknown {
                what,
                name: name.into(),
                place: if path.is_empty() { String::new() } else { format!(" in {}", header(path)) },
                nearest: nearest(name, allowed.iter().map(String::as_str)),
                elsewhere: kind.and_then(|s| schema::elsewhere(&s.schema, name, path)),
                allowed,
            },
        };
        let meant = if let Fault::Unknown { nearest, elsewhere: None, .. } = &fault { nearest.clone() } else { None };
        self.report(fault, &child_path, &node.key);
        meant
    }

    fn missing(&mut self, name: &str, schema: &Value, path: &str, at: &Span) {
        self.report(missing(name, schema, path), &join(path, name), at);
    }

    fn array(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        let Data::Array(items) = &node.data else { return self.wrong(node, path, &format!("tables [[{path}]]")) };
        let items = items.iter().enumerate();
        Value::Array(items.map(|(i, item)| self.value(item, &schema["items"], &join(path, &i.to_string()))).collect())
    }

    fn number(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        let unit = schema::text(schema, "x-unit");
        let x = match &node.data {
            Data::Integer(i) => *i as f64,
            Data::Float(x) => *x,
            Data::Text(text) if self.of_unknown_grains(text, path, schema) => {
                self.complete = false;
                return Value::Null;
            }
            Data::Text(text) if !unit.is_empty() => match self.quantity(text, schema) {
                Ok(x) => x,
                Err(error) => {
                    let meant = angle::meant(text, &error, schema);
                    let diameters = self.takes_diameters(path, schema);
                    let fault = Fault::Unit { name: shown(path), error, unit: unit.into(), diameters, meant };
                    self.report(fault, path, &node.value);
                    return Value::Null;
                }
            },
            _ if unit.is_empty() => return self.wrong(node, path, &expected(schema)),
            _ => return self.wrong(node, path, &format!("a number, {}", expected(schema))),
        };
        if !x.is_finite() {
            self.report(Fault::NotFinite { name: shown(path), allowed: schema::range(schema) }, path, &node.value);
        } else if !schema::inside(schema, x) {
            let fault = Fault::OutOfRange { name: shown(path), value: x, allowed: schema::range(schema) };
            self.report(fault, path, &node.value);
        }
        json!(x)
    }

    fn integer(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        let (i, value) = match node.data {
            Data::Integer(i) => (i, i as f64),
            // A whole number that is too large for one.
            Data::Float(x) if x.is_finite() && x.abs() >= i64::MAX as f64 => (0, x),
            _ => return self.wrong(node, path, &expected(schema)),
        };
        if !schema::inside(schema, value) {
            let fault = Fault::OutOfRange { name: shown(path), value, allowed: schema::range(schema) };
            self.report(fault, path, &node.value);
            return Value::Null;
        }
        json!(i)
    }
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
