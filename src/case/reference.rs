//! The case reference, written from the schema.

use std::fmt::Write;

use serde_json::Value;

use super::schema::{self, SCENES};

/// All tables and keys of all models, as Markdown.
#[must_use]
pub fn reference() -> String {
    let mut text = String::from(
        "# Case reference\n\nWritten by `bedload schema --reference` from the types of the program; do not edit.\n\n\
         A quantity is a number in SI or a text with a unit: `0.002` or `\"2 mm\"`. Keys with a default may be left out.\n",
    );
    for scene in SCENES.iter() {
        let _ = write!(text, "\n## Model `{}`\n\n{}\n", scene.name, schema::text(&scene.schema, "description"));
        for (name, table) in schema::properties(&scene.schema) {
            let items = table.get("items");
            match (items, schema::properties(table).next()) {
                (Some(items), _) => section(&mut text, &format!("[[{name}]]"), table, items),
                (None, Some(_)) => section(&mut text, &format!("[{name}]"), table, table),
                (None, None) => {
                    let _ = write!(text, "\n### `{name}`\n\n{} {}\n", schema::text(table, "description"), what(table));
                }
            }
        }
    }
    text
}

fn section(text: &mut String, title: &str, about: &Value, table: &Value) {
    let _ = write!(text, "\n### `{title}`\n\n{}\n\n", schema::text(about, "description"));
    let families: Vec<_> = schema::properties(table).filter(|(_, s)| schema::alternatives(s).is_some()).collect();
    if families.is_empty() {
        rows(text, table);
    }
    for (family, schema) in families {
        let _ = write!(text, "**`[closures.{family}]`** {}\n\n", schema::text(schema, "description"));
        for (law, alternative) in schema::alternatives(schema).unwrap_or_default() {
            let default = schema.pointer("/default/law").and_then(Value::as_str) == Some(law);
            let default = if default { " (default)" } else { "" };
            let _ = write!(text, "`law = \"{law}\"`{default}: {}\n\n", schema::text(alternative, "description"));
            if schema::properties(alternative).count() > 1 {
                rows(text, alternative);
            }
        }
    }
}

fn rows(text: &mut String, table: &Value) {
    let required: Vec<&str> =
        table.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
    let drives = schema::drives(table).unwrap_or_default();
    text.push_str("| key | | what | allowed |\n|---|---|---|---|\n");
    for (key, schema) in schema::properties(table).filter(|(_, s)| s.get("const").is_none()) {
        let need = if required.contains(&key.as_str()) {
            "required".to_owned()
        } else if drives.contains(&key.as_str()) {
            "one of the drives".to_owned()
        } else {
            schema.get("default").map_or_else(|| "optional".into(), |d| format!("default {}", plain(d)))
        };
        let _ = writeln!(text, "| `{key}` | {need} | {} | {} |", schema::text(schema, "description"), what(schema));
    }
    text.push('\n');
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
                    format!("`\"{c}\"`: {about}")
                }
            })
            .collect();
        return choices.join(" ");
    }
    match schema::text(schema, "type") {
        "number" | "integer" => schema::range(schema),
        "string" => "a text".into(),
        other => other.into(),
    }
}
