//! Diagnostics as a person reads them: the line, a caret, what is allowed, what to do.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

use super::render::{MAX_REPORTED, brief};
use super::{CaseError, Document, Violation, printable};

/// Lines longer than this are cut around the place.
const LONG: usize = 160;

impl CaseError {
    /// All violations as text with carets, in colour if asked for.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        let handler = GraphicalReportHandler::new_themed(theme).with_width(110).with_links(false);
        let mut text = String::new();
        for violation in self.violations.iter().take(MAX_REPORTED) {
            let report = Report::new(&self.document, violation);
            if handler.render_report(&mut text, &report).is_err() {
                text += &format!("{}\n", violation.fault);
            }
        }
        if self.violations.len() > MAX_REPORTED {
            text += &format!("  ... and {} more\n", self.violations.len() - MAX_REPORTED);
        }
        text
    }
}

/// One violation with the piece of text that it points into.
#[derive(Debug)]
struct Report {
    message: String,
    code: &'static str,
    help: Option<String>,
    source: Option<NamedSource<String>>,
    labels: Vec<LabeledSpan>,
}

impl Report {
    fn new(document: &Document, violation: &Violation) -> Self {
        let fault = &violation.fault;
        let mut help = Vec::new();
        help.extend(fault.allowed().filter(|a| !a.is_empty()).map(|a| format!("allowed: {a}")));
        help.extend(fault.hint());
        let mut report = Self {
            message: brief(&fault.to_string()),
            code: fault.code(),
            help: (!help.is_empty()).then(|| brief(&help.join("\n"))),
            source: None,
            labels: Vec::new(),
        };
        let Some(main) = violation.spans.first() else { return report };
        let text = document.text(main);
        if text.content.is_empty() {
            return report;
        }
        let content = printable(&text.content);
        let same_text = violation.spans.iter().filter(|s| s.text == main.text).map(|s| within(&content, &s.bytes));
        let spans: Vec<Range<usize>> = same_text.collect();
        let (name, content, shift) = excerpt(&printable(&text.name), content, &spans[0]);
        report.labels = spans
            .into_iter()
            .filter(|s| s.start >= shift && s.start - shift <= content.len())
            .map(|s| {
                let end = (s.end - shift).min(content.len()).max(s.start - shift);
                LabeledSpan::new_with_span(Some("here".into()), s.start - shift..end)
            })
            .collect();
        report.source = Some(NamedSource::new(name, content));
        report
    }
}

/// A span cut to the text, on character boundaries, and no longer than its first line.
fn within(content: &str, span: &Range<usize>) -> Range<usize> {
    let mut start = span.start.min(content.len());
    while !content.is_char_boundary(start) {
        start -= 1;
    }
    let mut end = span.end.clamp(start, content.len());
    while !content.is_char_boundary(end) {
        end += 1;
    }
    let first_line = content[start..end].find('\n').unwrap_or(end - start);
    start..start + first_line
}

/// The text, or a piece of a line that is too long to show; with the offset of the piece.
fn excerpt(name: &str, content: String, span: &Range<usize>) -> (String, String, usize) {
    let line_start = content[..span.start].rfind('\n').map_or(0, |i| i + 1);
    let line_end = content[span.start..].find('\n').map_or(content.len(), |i| span.start + i);
    let before = content[..line_start.saturating_sub(1)].rfind('\n').map_or(0, |i| i + 1);
    let after = content
        .get(line_end + 1..)
        .map_or(line_end, |rest| rest.find('\n').map_or(content.len(), |i| line_end + 1 + i));
    let longest = content[before..after].lines().map(str::len).max().unwrap_or(0);
    if longest <= LONG {
        return (name.to_owned(), content, 0);
    }
    let floor = |mut i: usize| {
        while !content.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let from = floor(span.start.saturating_sub(60).max(line_start));
    let to = floor((span.start + 60).min(line_end)).max(from);
    let line = 1 + content[..line_start].matches('\n').count();
    (format!("{name}, line {line}"), content[from..to].to_owned(), from)
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Report {}

impl Diagnostic for Report {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.code))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|h| Box::new(h) as Box<dyn fmt::Display>)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.source.as_ref().map(|_| Box::new(self.labels.iter().cloned()) as Box<dyn Iterator<Item = LabeledSpan>>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|s| s as &dyn SourceCode)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_cut_around_the_place() {
        let content = format!("x = 1\n{}!{}\n", "é".repeat(500), "b".repeat(500));
        let at = content.find('!').unwrap();
        let (name, piece, shift) = excerpt("f", content.clone(), &(at..at + 1));
        assert!(piece.len() <= 121 && piece[at - shift..].starts_with('!'), "{piece}");
        assert_eq!(name, "f, line 2");
    }
}
