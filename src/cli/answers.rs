//! What `--json` prints.

use std::cell::RefCell;
use std::io;

use serde_json::Value;

use super::{CliError, say};

/// Where answers of `--json` go: to standard output one by one, or together as an array where there are several models.
#[derive(Debug, Default)]
pub(super) struct Answers(Option<RefCell<Vec<Value>>>);

impl Answers {
    /// Those of several models.
    pub fn several() -> Self {
        Self(Some(RefCell::default()))
    }

    /// One more.
    pub fn give(&self, value: &Value) -> io::Result<()> {
        match &self.0 {
            Some(kept) => kept.borrow_mut().push(value.clone()),
            None => answer(value)?,
        }
        Ok(())
    }

    /// The last one was given.
    pub fn end(self) -> io::Result<()> {
        self.0.map_or(Ok(()), |kept| answer(&Value::Array(kept.into_inner())))
    }
}

/// Writes one JSON object to standard output.
fn answer(value: &Value) -> io::Result<()> {
    // Control characters above 0x7e are legal in JSON as they are, and safer escaped.
    let escaped = |c: char| if matches!(c, '\u{7f}'..='\u{9f}') { format!("\\u{:04x}", c as u32) } else { c.into() };
    say(&format!("{value:#}\n").chars().map(escaped).collect::<String>())
}

/// Whether `--json` is among arguments that cannot be read as a whole.
pub(super) fn wants_json() -> bool {
    std::env::args_os().skip(1).take_while(|argument| argument != "--").any(|argument| argument == "--json")
}

/// An argument that clap does not accept: its first paragraph is what is wrong, the others are what to do.
pub(super) fn usage(error: &clap::Error) -> CliError {
    let text = error.render().to_string();
    let words = |part: &str| part.split_whitespace().collect::<Vec<_>>().join(" ");
    let (message, hint) = text.split_once("\n\n").unwrap_or((&text, ""));
    CliError::Usage { message: words(message.trim_start_matches("error: ")), hint: words(hint) }
}
