//! The case reference, written from the schema.

use std::fmt::Write;

use serde_json::Value;

use super::kind::{Kind, Kinds};
use super::schema;

/// All tables and keys, as Markdown: the flow of each kind once, then the models that solve it.
#[must_use]
pub fn reference(kinds: &Kinds) -> String {
    let mut text = String::from(
        "# Case reference\n\nWritten by `bedload schema --reference` from the types of the program; do not edit.\n\n\
         A case is a flow of one kind, `scene`, and the tables of the models that solve it. A quantity is a number in SI or a text with a unit: \
         `0.002` or `\"2 mm\"`; a length may be one in diameters of the grains: `\"12.5 d\"`. Keys with a default may be left out. \
         A table or key that neither the flow nor a model has is an error.\n\n\
         | `scene` | model | what is solved |\n|---|---|---|\n",
    );
    for scene in kinds.scenes() {
        for kind in of(kinds, scene) {
            let _ = writeln!(text, "| `{scene}` | [`{0}`](#model-{0}) | {1} |", kind.name, about(kind));
        }
    }
    text += "\n## In every case\n";
    for (name, table) in kinds.iter().take(1).flat_map(|kind| schema::properties(&kind.schema)) {
        if ["format", "case"].contains(&name.as_str()) {
            part(&mut text, name, table);
        }
    }
    for scene in kinds.scenes() {
        let _ = write!(text, "\n## Scene `{scene}`\n");
        let Some(first) = of(kinds, scene).next() else { continue };
        for (name, table) in schema::properties(&first.schema) {
            if !["format", "scene", "case", first.name].contains(&name.as_str()) {
                part(&mut text, name, table);
            }
        }
        for kind in of(kinds, scene) {
            let _ = write!(
                text,
                "\n## Model `{}`\n\n{} It solves a scene of the kind `{scene}`.\n",
                kind.name,
                about(kind)
            );
            part(&mut text, kind.name, &kind.schema["properties"][kind.name]);
        }
    }
    text
}

/// The models that solve a kind of flow.
fn of<'k>(kinds: &'k Kinds, scene: &'k str) -> impl Iterator<Item = &'k Kind> {
    kinds.iter().filter(move |kind| kind.scene == scene)
}

fn about(kind: &Kind) -> &str {
    schema::text(&kind.schema, "description")
}

/// A table, an array of tables, or a key at the top of the file.
fn part(text: &mut String, path: &str, table: &Value) {
    let keys = table.get("items").unwrap_or(table);
    if schema::properties(keys).next().is_none() {
        let _ = write!(text, "\n### `{path}`\n\n{} {}.\n", schema::text(table, "description"), what(table));
        return;
    }
    let title = if table.get("items").is_some() { format!("[[{path}]]") } else { format!("[{path}]") };
    // The table of a model is described under its heading.
    let description = if table.get("title").is_some() { "" } else { schema::text(table, "description") };
    let _ = write!(text, "\n### `{title}`\n");
    if !description.is_empty() {
        let _ = write!(text, "\n{description}\n");
    }
    let is_part = |schema: &Value| {
        schema::properties(schema.get("items").unwrap_or(schema)).next().is_some()
            || schema::alternatives(schema).is_some()
    };
    if schema::properties(keys).any(|(_, schema)| !is_part(schema)) {
        rows(text, keys, is_part);
    }
    for (name, schema) in schema::properties(keys).filter(|(_, schema)| is_part(schema)) {
        let path = format!("{path}.{name}");
        match schema::alternatives(schema) {
            Some(laws) => family(text, &path, schema, &laws),
            None => part(text, &path, schema),
        }
    }
}

/// The laws that a key may name.
fn family(text: &mut String, path: &str, schema: &Value, laws: &[(&str, &Value)]) {
    let _ = write!(text, "\n**`{path}`** {}\n", schema::text(schema, "description"));
    let usual = schema.get("default").and_then(|usual| usual.get("law").unwrap_or(usual).as_str());
    for (law, alternative) in laws {
        let default = if usual == Some(law) { " (default)" } else { "" };
        let _ = write!(text, "\n`law = \"{law}\"`{default}: {}\n", schema::text(alternative, "description"));
        if schema::properties(alternative).count() > 1 {
            rows(text, alternative, |_| false);
        }
    }
}

fn rows(text: &mut String, table: &Value, skipped: impl Fn(&Value) -> bool) {
    let required: Vec<&str> =
        table.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
    text.push_str("\n| key | needed | what | allowed |\n|---|---|---|---|\n");
    for (key, schema) in schema::properties(table).filter(|(_, s)| s.get("const").is_none() && !skipped(s)) {
        let angle = schema::properties(table).find(|(_, slope)| schema::text(slope, "x-angle") == key);
        let need = if let (Some((slope, _)), true) = (angle, required.contains(&key.as_str())) {
            format!("required unless `{slope}` is an angle")
        } else if required.contains(&key.as_str()) {
            "required".to_owned()
        } else {
            schema.get("default").map_or_else(|| "optional".into(), |d| format!("default {}", plain(d)))
        };
        let _ = writeln!(text, "| `{key}` | {need} | {} | {} |", schema::text(schema, "description"), what(schema));
    }
}

fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), |s| format!("`\"{s}\"`"))
}

/// What a value may be.
fn what(schema: &Value) -> String {
    if let Some(constants) = schema::constants(schema) {
        let choices: Vec<String> = constants
            .iter()
            .map(|(c, about)| {
                if about.is_empty() || constants.len() == 1 {
                    format!("`\"{c}\"`")
                } else {
                    format!("`\"{c}\"`: {}", about.trim_end_matches('.'))
                }
            })
            .collect();
        return choices.join("; ");
    }
    match schema::text(schema, "type") {
        "number" | "integer" => schema::range(schema),
        "string" => "a text".into(),
        other => other.into(),
    }
}
