//! How diagnostics name places and choices.

use serde_json::Value;

use super::schema;

/// What a value of this schema may be, in words.
pub(super) fn expected(schema: &Value) -> String {
    if let Some(constants) = schema::constants(schema) {
        return constants.iter().map(|(c, _)| *c).collect::<Vec<_>>().join(", ");
    }
    match schema::text(schema, "type") {
        "number" if schema.get("x-unit").is_some() => schema::range(schema),
        "number" => "a number".into(),
        "integer" => format!("a whole number, {}", schema::range(schema)),
        "string" => "a text".into(),
        "object" => "a table".into(),
        _ => schema::text(schema, "description").into(),
    }
}

/// The words to choose from, as they are written in the file.
pub(super) fn choices<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(" or ")
}

/// The table at `path` as its header is written: `[closures.friction]`, `[[check]] number 2`.
pub(super) fn header(path: &str) -> String {
    match path.rsplit_once('.').and_then(|(list, i)| Some((list, i.parse::<usize>().ok()?))) {
        Some((list, i)) => format!("[[{list}]] number {}", i + 1),
        None => format!("[{path}]"),
    }
}

/// Path as shown to a reader: `check[0].expect`.
pub(super) fn shown(path: &str) -> String {
    let mut text = String::new();
    for segment in path.split('.') {
        if segment.bytes().all(|b| b.is_ascii_digit()) {
            text += &format!("[{segment}]");
        } else {
            if !text.is_empty() {
                text.push('.');
            }
            text += segment;
        }
    }
    text
}
