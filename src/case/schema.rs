//! The JSON Schema of case files: generated from the tables, used by the diagnostics, published for editors.

use serde_json::{Map, Value, json};

use super::kind::Kinds;

/// Name of each model, the kind of flow that it solves, and its one-line description.
pub fn models(kinds: &Kinds) -> impl Iterator<Item = (&'static str, &'static str, &str)> {
    kinds.iter().map(|kind| (kind.name, kind.scene, text(&kind.schema, "description")))
}

/// The published schema: `oneOf` the kinds of flow, each with the tables of all models that solve it; quantities as numbers or texts.
#[must_use]
pub fn published(kinds: &Kinds) -> Value {
    let scene = |word: &str| {
        let mut of = kinds.iter().filter(|kind| kind.scene == word);
        let mut schema = of.next().map(|kind| kind.schema.clone()).unwrap_or_default();
        for kind in of {
            schema["properties"][kind.name] = kind.schema["properties"][kind.name].clone();
        }
        // Which of the models a case has is its choice.
        if let Some(Value::Array(required)) = schema.get_mut("required") {
            required.retain(|key| !kinds.iter().any(|kind| key == kind.name));
        }
        schema["title"] = format!("scene {word}").into();
        schema["description"] = format!("A case whose scene is of the kind {word}.").into();
        quantities(&mut schema);
        angles(&mut schema);
        laws(&mut schema);
        schema
    };
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "bedload case",
        "description": "A case file of bedload, format 2: a flow, and the tables of the models that solve it. A quantity is a number in SI or a text with a unit; x-unit is its SI unit.",
        "oneOf": kinds.scenes().into_iter().map(scene).collect::<Vec<_>>(),
    })
}

/// A law that needs nothing else may be written as a word.
fn laws(schema: &mut Value) {
    if let Some(choices) = alternatives(schema) {
        let bare = choices.iter().filter(|(_, law)| {
            law.get("required").and_then(Value::as_array).is_none_or(|keys| keys.iter().all(|key| key == "law"))
        });
        let words: Vec<Value> = bare.map(|(law, _)| json!(law)).collect();
        if !words.is_empty()
            && let Some(Value::Array(choices)) = schema.get_mut("oneOf")
        {
            choices.push(json!({ "type": "string", "enum": words }));
        }
    }
    match schema {
        Value::Object(object) => object.values_mut().for_each(laws),
        Value::Array(items) => items.iter_mut().for_each(laws),
        _ => {}
    }
}

fn quantities(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            if object.contains_key("x-unit") && object.get("type").is_some_and(|t| t == "number") {
                object.insert("type".into(), json!(["number", "string"]));
                object.insert("pattern".into(), "^\\s*[-+\u{2212}]?(\\d+\\.?\\d*|\\.\\d+)([eE][-+]?\\d+)?.*$".into());
            }
            object.values_mut().for_each(quantities);
        }
        Value::Array(items) => items.iter_mut().for_each(quantities),
        _ => {}
    }
}

/// A slope that is given as an angle needs no definition, and contradicts every other.
fn angles(schema: &mut Value) {
    let Some(tables) = schema.get_mut("properties").and_then(Value::as_object_mut) else { return };
    for table in tables.values_mut() {
        let slope = properties(table).find(|(_, slope)| slope.get("x-angle").is_some());
        let Some((name, key)) = slope.map(|(name, slope)| (name.clone(), text(slope, "x-angle").to_owned())) else {
            continue;
        };
        let Some(table) = table.as_object_mut() else { continue };
        // A slope of 0 needs none either, which an editor may say.
        let number = json!({ "if": { "required": [name] }, "then": { "required": [key] } });
        let angle = json!({ "type": "string", "pattern": "(deg|rad|\u{b0})\\s*$" });
        table.insert("if".into(), json!({ "required": [name], "properties": { name: angle } }));
        table.insert("then".into(), json!({ "properties": { key: { "const": "angle" } } }));
        table.insert("else".into(), number);
    }
}

/// Properties of an object schema.
pub(super) fn properties(schema: &Value) -> impl Iterator<Item = (&String, &Value)> {
    schema.get("properties").and_then(Value::as_object).into_iter().flat_map(Map::iter)
}

/// The text of a schema keyword, or "".
pub(super) fn text<'a>(schema: &'a Value, keyword: &str) -> &'a str {
    schema.get(keyword).and_then(Value::as_str).unwrap_or_default()
}

/// The choices of a `oneOf` of constants, with their descriptions.
pub(super) fn constants(schema: &Value) -> Option<Vec<(&str, &str)>> {
    let choices = schema.get("oneOf")?.as_array()?;
    choices.iter().map(|c| Some((c.get("const")?.as_str()?, text(c, "description")))).collect()
}

/// The alternatives of a tagged table: the value of its `law` and the schema of the rest.
pub(super) fn alternatives(schema: &Value) -> Option<Vec<(&str, &Value)>> {
    let choices = schema.get("oneOf")?.as_array()?;
    choices.iter().map(|c| Some((c.pointer("/properties/law/const")?.as_str()?, c))).collect()
}

/// The range of a number in words: `more than 0 and at most 2 kg/m3`.
pub(super) fn range(schema: &Value) -> String {
    let bound = |keyword: &str| schema.get(keyword).and_then(Value::as_f64);
    let number = |x: f64| if x.abs() >= 1e7 { format!("{x:e}") } else { x.to_string() };
    let ends = [
        ("exclusiveMinimum", "more than"),
        ("minimum", "at least"),
        ("exclusiveMaximum", "less than"),
        ("maximum", "at most"),
    ];
    let parts: Vec<String> =
        ends.iter().filter_map(|(keyword, words)| Some(format!("{words} {}", number(bound(keyword)?)))).collect();
    let unit = text(schema, "x-unit");
    let unit = if unit.is_empty() || unit == "1" { String::new() } else { format!(" {unit}") };
    let words = match parts.len() {
        0 if unit.is_empty() => "a finite number".into(),
        0 => format!("a finite number in{unit}"),
        _ if bound("minimum").is_some() && bound("minimum") == bound("maximum") => {
            format!("{}{unit}", bound("minimum").unwrap_or_default())
        }
        _ => parts.join(" and ") + &unit,
    };
    words + if schema.get("x-angle").is_some() { ", or an angle such as \"2 deg\"" } else { "" }
}

/// Whether a number is inside the range of its schema.
pub(super) fn inside(schema: &Value, x: f64) -> bool {
    let bound = |keyword: &str| schema.get(keyword).and_then(Value::as_f64);
    bound("exclusiveMinimum").is_none_or(|b| x > b)
        && bound("minimum").is_none_or(|b| x >= b)
        && bound("exclusiveMaximum").is_none_or(|b| x < b)
        && bound("maximum").is_none_or(|b| x <= b)
}

/// Whether a schema has something at `path`, in any alternative of a tagged table.
pub(super) fn has(schema: &Value, path: &str) -> bool {
    let (first, rest) = path.split_once('.').map_or((path, None), |(a, b)| (a, Some(b)));
    if first.bytes().all(|b| b.is_ascii_digit()) {
        return schema.get("items").is_some_and(|items| rest.is_none_or(|rest| has(items, rest)));
    }
    let here = schema.get("properties").and_then(|p| p.get(first));
    here.is_some_and(|s| rest.is_none_or(|rest| has(s, rest)))
        || alternatives(schema).is_some_and(|a| a.iter().any(|(_, s)| has(s, path)))
}

/// The table of the kind that has a key of this name, where it is not the table of `path`.
pub(super) fn elsewhere(schema: &Value, name: &str, path: &str) -> Option<String> {
    properties(schema)
        .filter(|(table, s)| table.as_str() != path && properties(s).any(|(k, _)| k == name))
        .map(|(table, s)| if s.get("items").is_some() { format!("[[{table}]]") } else { format!("[{table}]") })
        .next()
        .or_else(|| {
            properties(schema).any(|(k, _)| k == name && !path.is_empty()).then(|| "the top of the file".into())
        })
}
