//! What `bedload migrate` moves: comments, laws, and the depth that a height leaves over its bed.

use std::ops::Range;
use std::path::Path;

use toml_edit::{Decor, Document, InlineTable, Item, Key, RawString, Table, Value};

use super::CliError;
use crate::case::format1::RESULTS;
use crate::closures::dilatancy::PhiI;
use crate::units::parse_quantity;

/// Where a key stands, as the begin of a message; nothing where that cannot be said.
pub(super) fn line(text: &str, path: &str) -> String {
    let Ok(document) = Document::parse(text) else { return String::new() };
    let item = path.split('.').try_fold(document.as_item(), |item, name| item.get(name));
    let span = item.and_then(Item::span);
    span.map_or_else(String::new, |span| format!("line {}: ", text[..span.start].matches('\n').count() + 1))
}

/// As text; none where there is nothing.
pub(super) fn raw(part: Option<&RawString>) -> &str {
    part.and_then(RawString::as_str).unwrap_or_default()
}

/// The comments in it, a line each.
fn lines(part: &str) -> String {
    part.lines().map(str::trim).filter(|line| line.starts_with('#')).map(|line| format!("{line}\n")).collect()
}

/// The comments before and behind, a line each.
pub(super) fn comments(decor: &Decor) -> String {
    lines(raw(decor.prefix())) + &lines(raw(decor.suffix()))
}

/// The text with at most one empty line in a row; in texts of several lines they stay.
pub(super) fn without_gaps(text: &str) -> String {
    let mut kept = Vec::new();
    if let Ok(document) = Document::parse(text) {
        texts(document.as_item(), &mut kept);
    }
    kept.sort_by_key(|span: &Range<usize>| span.start);
    let (mut found, mut at) = (String::with_capacity(text.len()), 0);
    for span in kept.into_iter().chain(std::iter::once(text.len()..text.len())) {
        let mut between = text[at..span.start].to_owned();
        while between.contains("\n\n\n") {
            between = between.replace("\n\n\n", "\n\n");
        }
        found += &between;
        found += &text[span.clone()];
        at = span.end;
    }
    found
}

/// Where the texts in it stand.
fn texts(item: &Item, found: &mut Vec<Range<usize>>) {
    match item {
        Item::Value(value) => texts_in(value, found),
        Item::Table(table) => table.iter().for_each(|(_, item)| texts(item, found)),
        Item::ArrayOfTables(rows) => rows.iter().flat_map(Table::iter).for_each(|(_, item)| texts(item, found)),
        Item::None => {}
    }
}

fn texts_in(value: &Value, found: &mut Vec<Range<usize>>) {
    match value {
        Value::String(text) => found.extend(text.span()),
        Value::Array(values) => values.iter().for_each(|value| texts_in(value, found)),
        Value::InlineTable(table) => table.iter().for_each(|(_, value)| texts_in(value, found)),
        _ => {}
    }
}

/// What stands before and behind a key and its value, or the header of a table.
pub(super) fn decor_of(key: Option<&Key>, item: &Item) -> Decor {
    match item {
        Item::Table(table) if !table.is_dotted() => {
            Decor::new(lines(raw(table.decor().prefix())), raw(table.decor().suffix()))
        }
        // A dotted key has its comments at its last part.
        Item::Table(_) => Decor::default(),
        _ => {
            let prefix = raw(key.and_then(|key| key.leaf_decor().prefix()));
            // In a table on one line it is but a space.
            let prefix = if prefix.contains(['\n', '#']) { prefix } else { "" };
            Decor::new(prefix, raw(item.as_value().and_then(|value| value.decor().suffix())))
        }
    }
}

/// What stands over a table, after an empty line.
pub(super) fn spaced(decor: &Decor) -> Decor {
    Decor::new(format!("\n{}", raw(decor.prefix()).trim_start_matches('\n')), raw(decor.suffix()))
}

/// Comments over what stands over a table already.
pub(super) fn over(table: &mut Table, left: &str) {
    let prefix = raw(table.decor().prefix()).trim_start_matches('\n').to_owned();
    table.decor_mut().set_prefix(format!("\n{left}{prefix}"));
}

/// Puts what stood behind a key behind its value; what has no place there is returned, to stand over it.
pub(super) fn behind(value: &mut Value, decor: &Decor) -> String {
    let (own, behind) = (raw(value.decor().suffix()).to_owned(), raw(decor.suffix()));
    if !own.contains('#') {
        value.decor_mut().set_suffix(behind.trim_end());
    } else if own != behind {
        return lines(behind);
    }
    String::new()
}

pub(super) fn decorated(name: &str, prefix: &str) -> Key {
    Key::new(name).with_leaf_decor(Decor::new(prefix, " "))
}

/// A value without the spaces and comments around it.
pub(super) fn bare(value: &Value) -> Value {
    let mut value = value.clone();
    *value.decor_mut() = Decor::default();
    value
}

/// A law as a word, or on one line with what it needs; as the table that it is where a comment would be lost.
pub(super) fn law(item: &Item) -> Item {
    let Some(table) = item.as_table_like() else { return item.clone() };
    let is_bare = |decor: &Decor| comments(decor).is_empty();
    let mut line = InlineTable::new();
    let mut comment = None;
    let last = table.iter().count().saturating_sub(1);
    for (at, (key, value)) in table.iter().enumerate() {
        let Some(value) = value.as_value() else { return item.clone() };
        let own = table.key(key).is_none_or(|key| is_bare(key.leaf_decor()));
        if !own || at < last && !is_bare(value.decor()) {
            return item.clone();
        }
        if at == last && !is_bare(value.decor()) {
            comment = value.decor().suffix().cloned();
        }
        line.insert(key, bare(value));
    }
    let mut value = match (line.len(), line.get("law")) {
        (1, Some(word)) => word.clone(),
        _ => Value::InlineTable(line),
    };
    if let Some(comment) = comment {
        value.decor_mut().set_suffix(comment);
    }
    Item::Value(value)
}

/// Number and unit of a quantity.
fn parts(value: &Value) -> Option<(f64, String)> {
    match value {
        Value::String(text) => {
            let text = text.value().trim();
            let number = text.trim_end_matches(|c: char| c.is_alphabetic() || c == ' ');
            Some((number.parse().ok()?, text[number.len()..].trim().to_owned()))
        }
        Value::Integer(number) => Some((*number.value() as f64, String::new())),
        Value::Float(number) => Some((*number.value(), String::new())),
        _ => None,
    }
}

/// `height - level`, in the unit that both have, or in metres where the units differ, to 12 digits; `None` where that is no depth.
pub(super) fn difference(height: &Value, level: &Value) -> Option<Value> {
    let metres = |value: &Value| match value {
        Value::String(text) => parse_quantity(text.value(), "m").ok(),
        _ => Some(parts(value)?.0),
    };
    // Twelve digits hide what binary numbers make of decimal ones.
    let depth = |height: f64, level: f64| -> Option<f64> {
        let depth = format!("{:.11e}", height - level).parse().ok()?;
        (f64::is_finite(depth) && depth > 0.0).then_some(depth)
    };
    match (parts(height), parts(level)) {
        (Some((h, unit)), Some((l, same))) if unit == same && !unit.is_empty() => {
            Some(format!("{} {unit}", depth(h, l)?).into())
        }
        _ => depth(metres(height)?, metres(level)?).map(Value::from),
    }
}

/// Solid fraction at which the sheet flow of format 1 packed a bed at rest: phi_max of its dilatancy.
pub(super) fn packing(model: &Item) -> Option<f64> {
    let at_rest = model.get("bed_level")?.as_str() == Some("at-rest");
    let given = || model.get("closures")?.get("dilatancy")?.get("phi_max")?.as_float();
    at_rest.then(|| given().unwrap_or(PhiI::default().phi_max))
}

/// The text of a case of format 1, its results by the names that they have now.
pub(super) fn read(path: &Path) -> Result<String, CliError> {
    let text = std::fs::read_to_string(path).map_err(|error| CliError::Usage {
        message: format!("cannot read {}: {error}", path.display()),
        hint: "OLD is a file of format 1; shipped cases are of format 2 already".into(),
    })?;
    let renamed = |text: String, (old, new): &(&str, &str)| text.replace(&format!("\"{old}\""), &format!("\"{new}\""));
    Ok(RESULTS.iter().fold(text, renamed))
}

/// What is wrong with a file, and a hint.
pub(super) type Refused = (String, String);

/// That two keys are there for one thing.
pub(super) fn both(text: &str, first: &str, second: &str, why: &str) -> Refused {
    let place = line(text, second);
    (format!("{place}{first} and {second} are both there; {why}"), "take out the one that does not hold".into())
}
