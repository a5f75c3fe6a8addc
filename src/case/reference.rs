//! The case reference, written from the schema.

use std::fmt::Write;

use serde_json::Value;

use super::kind::Kinds;
use super::schema;

/// All tables and keys of all models, as Markdown: what every model has comes once, first.
#[must_use]
pub fn reference(kinds: &Kinds) -> String {
    let mut text = String::from(
        "# Case reference\n\nWritten by `bedload schema --reference` from the types of the program; do not edit.\n\n\
         A quantity is a number in SI or a text with a unit: `0.002` or `\"2 mm\"`. Keys with a default may be left out. \
         A table or key that the model of the case does not have is an error.\n\n\
         | `kind`/`solution` | what is solved | tables beside those of every model |\n|---|---|---|\n",
    );
    for kind in kinds.iter() {
        let own: Vec<String> =
            own(kinds, &kind.schema).map(|(name, table)| format!("`{}`", title(name, table))).collect();
        let _ =
            writeln!(text, "| `{}` | {} | {} |", kind.name, schema::text(&kind.schema, "description"), own.join(" "));
    }
    text += "\n## In every model\n";
    let shared = kinds.first().into_iter().flat_map(|kind| schema::properties(&kind.schema));
    for (name, table) in shared.filter(|(name, table)| common(kinds, name, table)) {
        part(&mut text, name, table);
    }
    for kind in kinds.iter() {
        let _ = write!(text, "\n## Model `{}`\n\n{}\n", kind.name, schema::text(&kind.schema, "description"));
        for (name, table) in own(kinds, &kind.schema) {
            part(&mut text, name, table);
        }
    }
    text
}

/// Whether every model has the table `name`, and the same one.
fn common(kinds: &Kinds, name: &str, table: &Value) -> bool {
    kinds.iter().all(|kind| schema::properties(&kind.schema).any(|(n, t)| n == name && t == table))
}

/// The tables of a model that not every model has.
fn own<'k>(kinds: &'k Kinds, kind: &'k Value) -> impl Iterator<Item = (&'k String, &'k Value)> {
    schema::properties(kind).filter(|(name, table)| !common(kinds, name, table))
}

/// The table as a case file writes it.
fn title(name: &str, table: &Value) -> String {
    match (table.get("items"), schema::properties(table).next()) {
        (Some(_), _) => format!("[[{name}]]"),
        (None, Some(_)) => format!("[{name}]"),
        (None, None) => name.to_owned(),
    }
}

/// A table, an array of tables, or a key at the top of the file.
fn part(text: &mut String, name: &str, table: &Value) {
    let keys = table.get("items").unwrap_or(table);
    if schema::properties(keys).next().is_some() {
        section(text, &title(name, table), table, keys);
    } else {
        let _ = write!(text, "\n### `{name}`\n\n{} {}.\n", schema::text(table, "description"), what(table));
    }
}

fn section(text: &mut String, title: &str, about: &Value, table: &Value) {
    let _ = write!(text, "\n### `{title}`\n\n{}\n", schema::text(about, "description"));
    let families: Vec<_> = schema::properties(table).filter(|(_, s)| schema::alternatives(s).is_some()).collect();
    if families.is_empty() {
        rows(text, table);
    }
    for (family, schema) in families {
        let _ = write!(text, "\n**`[closures.{family}]`** {}\n", schema::text(schema, "description"));
        for (law, alternative) in schema::alternatives(schema).unwrap_or_default() {
            let default = schema.pointer("/default/law").and_then(Value::as_str) == Some(law);
            let default = if default { " (default)" } else { "" };
            let _ = write!(text, "\n`law = \"{law}\"`{default}: {}\n", schema::text(alternative, "description"));
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
    text.push_str("\n| key | needed | what | allowed |\n|---|---|---|---|\n");
    for (key, schema) in schema::properties(table).filter(|(_, s)| s.get("const").is_none()) {
        let angle = schema::properties(table).find(|(_, slope)| schema::text(slope, "x-angle") == key);
        let need = if let (Some((slope, _)), true) = (angle, required.contains(&key.as_str())) {
            format!("required unless `{slope}` is an angle")
        } else if required.contains(&key.as_str()) {
            "required".to_owned()
        } else if drives.contains(&key.as_str()) {
            "one of the drives".to_owned()
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
