//! A slope may be given as an angle.
//!
//! `x-angle` in the schema of a slope names the key that says what its number is: tangent, sine or angle. A text such as
//! "24 deg" is the angle itself: it needs no such key, and contradicts one that says anything else.

use std::sync::Arc;

use serde_json::Value;

use super::document::{Data, Node};
use super::fault::Fault;
use super::schema;
use super::violation::Violation;
use super::{Case, wording};
use crate::units::{Dimension, UnitError, parse_quantity, significant};

/// The word for an angle among the definitions of a slope.
pub(super) const ANGLE: &str = "angle";

/// What a text says of a number.
pub(super) fn quantity(text: &str, schema: &Value) -> Result<f64, UnitError> {
    if schema.get("x-angle").is_some() {
        match parse_quantity(text, "rad") {
            Err(UnitError::NoUnit { .. } | UnitError::WrongDimension { .. }) => {}
            angle => return angle,
        }
    }
    parse_quantity(text, schema::text(schema, "x-unit"))
}

/// What to write instead of a text that is no such quantity.
pub(super) fn meant(text: &str, error: &UnitError, schema: &Value) -> Option<String> {
    match error {
        UnitError::WrongDimension { found: Dimension::ANGLE, expected: Dimension::NONE, .. } => {
            let angle = parse_quantity(text, "rad").ok()?;
            let [tangent, sine] = [angle.tan(), angle.sin()].map(|ratio| significant(ratio, 5));
            Some(format!("write the number itself: the tangent of {text} is {tangent}, its sine {sine}"))
        }
        UnitError::WrongDimension { .. } if schema.get("x-angle").is_some() => {
            Some("or an angle, such as \"2 deg\"".into())
        }
        _ => None,
    }
}

/// What a slope that is given as a text says of the key that defines it.
pub(super) enum Definition {
    /// the key is `angle`, though it is not there
    Implied(String),
    /// the two contradict each other
    Contradicted(Violation),
}

/// Compares the slope of a table, if it is a text, with the key that defines it.
pub(super) fn definition(entries: &[(String, Node)], schema: &Value, path: &str) -> Option<Definition> {
    let entry = |name: &str| entries.iter().find(|(known, _)| known == name).map(|(_, node)| node);
    let (name, slope) = schema::properties(schema).find(|(_, slope)| slope.get("x-angle").is_some())?;
    let (key, given) = (schema::text(slope, "x-angle"), entry(name)?);
    let Data::Text(text) = &given.data else { return None };
    let angle = parse_quantity(text, "rad");
    let said = match entry(key).map(|node| (node, &node.data)) {
        None => return angle.is_ok().then(|| Definition::Implied(key.into())),
        Some((node, Data::Text(word))) => (node, word.as_str()),
        Some(_) => return None,
    };
    let named = wording::shown(&format!("{path}.{name}"));
    let fault = match (angle, said.1) {
        (Err(error @ (UnitError::NoUnit { .. } | UnitError::WrongDimension { .. })), ANGLE)
            if parse_quantity(text, "1").is_ok() =>
        {
            Fault::Unit { name: named, error, unit: "rad".into(), diameters: false, meant: None }
        }
        (Ok(angle), word @ ("tangent" | "sine")) => {
            let ratio = significant(if word == "sine" { angle.sin() } else { angle.tan() }, 5);
            let error = parse_quantity(text, "1").err()?;
            let meant = format!("write {key} = \"angle\", or leave it out; or the {word} itself: {name} = {ratio}");
            Fault::Unit { name: named, error, unit: "1".into(), diameters: false, meant: Some(meant) }
        }
        _ => return None,
    };
    let spans = vec![given.value.clone(), said.0.value.clone()];
    Some(Definition::Contradicted(Violation { fault: Arc::new(fault), path: format!("{path}.{name}"), spans }))
}

impl Case {
    /// What `--set` takes to give the number `key` of this case the value `value` \[SI]: a slope that is an angle stays one.
    #[must_use]
    pub fn setting(&self, key: &str, value: f64) -> String {
        let unit = if self.angles.iter().any(|angle| angle == key) { " rad" } else { "" };
        format!("{key}={value:e}{unit}")
    }
}

/// The slopes of checked tables that are angles: `table.key`.
pub(super) fn angles(schema: &Value, tables: &Value) -> Vec<String> {
    let mut found = Vec::new();
    for (table, keys) in schema::properties(schema) {
        for (name, slope) in schema::properties(keys) {
            let definition = slope.get("x-angle").and_then(Value::as_str);
            if definition.is_some_and(|key| tables[table][key] == ANGLE) {
                found.push(format!("{table}.{name}"));
            }
        }
    }
    found
}
