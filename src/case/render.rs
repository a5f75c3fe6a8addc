//! Violations as programs read them, and their words for a terminal.

use super::{CaseError, Violation};
use crate::result::ErrorReport;

/// More violations than this are counted, not reported.
pub(super) const MAX_REPORTED: usize = 40;
/// Messages longer than this \[characters] lose their middle: a word of the file may be of any length.
const LONG_MESSAGE: usize = 400;

impl CaseError {
    /// The violations as they stand in the answer of `--json`.
    #[must_use]
    pub fn reports(&self) -> Vec<ErrorReport> {
        let report = |v: &Violation| ErrorReport {
            code: v.fault.code().into(),
            message: brief(&v.fault.to_string()),
            path: (!v.path.is_empty()).then(|| v.path.clone()),
            line: v
                .spans
                .first()
                .filter(|_| !self.document.texts[0].content.is_empty())
                .and_then(|s| self.document.line(s)),
            allowed: v.fault.allowed(),
            hint: v.fault.hint(),
        };
        self.violations.iter().map(report).collect()
    }
}

/// A message without control characters and no longer than a person reads.
pub(super) fn brief(message: &str) -> String {
    let message = printable(message);
    let n = message.chars().count();
    if n <= LONG_MESSAGE {
        return message;
    }
    let head: String = message.chars().take(LONG_MESSAGE / 2).collect();
    let tail: String = message.chars().skip(n - LONG_MESSAGE / 4).collect();
    format!("{head} ... {tail}")
}

/// Control characters replaced byte for byte, so that no file can write to the terminal what it likes.
#[must_use]
pub fn printable(text: &str) -> String {
    let plain = |c: char| if c.is_control() && !matches!(c, '\n' | '\t') { '?' } else { c };
    // C1 controls are two bytes long: keep the offsets.
    text.chars()
        .map(plain)
        .zip(text.chars())
        .flat_map(|(to, from)| std::iter::repeat_n(to, if to == '?' && from != '?' { from.len_utf8() } else { 1 }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_keep_their_width() {
        let hostile = "a\u{1b}[31mb\u{9b}c\tq?";
        let shown = printable(hostile);
        assert_eq!(shown.len(), hostile.len());
        assert!(!shown.contains(['\u{1b}', '\u{9b}']));
        assert!(shown.ends_with("c\tq?"));
    }
}
