//! Case files: from text to typed tables in SI, with every violation at once. The only module that knows TOML.
//!
//! ```text
//! text ─► document (tree with spans, --set applied) ─► diagnose (against the schema) ─► tables (typed, SI)
//! ```
//!
//! The schema is generated from the structs of the tables, and the same schema checks the files, so the two cannot drift.

mod advice;
mod angle;
#[cfg(feature = "cli")]
mod carets;
pub mod checks;
mod diagnose;
mod document;
mod fault;
mod kind;
mod load;
mod reference;
mod render;
mod scene;
pub mod schema;
pub mod shipped;
pub mod tables;
mod violation;
mod wording;

pub use diagnose::nearest;
pub use document::{Document, Text};
pub use fault::Fault;
pub use kind::{FlowTables, Kind, Kinds, Part, Tables, text};
pub use reference::reference;
pub use render::printable;
pub use violation::{CaseFault, Span, Violation};

use std::sync::Arc;

use checks::{Check, Limit};
use kind::Content;
use tables::About;

/// A case that its schema accepts: its tables, and the text they came from.
#[derive(Clone, Debug)]
pub struct Case {
    /// stem of the file or name of the shipped case
    pub name: String,
    /// file or shipped case as the user named it
    pub source: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// `kind` or `kind/solution`
    pub model: &'static str,
    content: Content,
    /// slopes that are angles: `table.key`
    angles: Vec<String>,
    document: Document,
}

/// A case that cannot be used: the text and everything that is wrong with it.
#[derive(Debug, thiserror::Error)]
#[error("{} in {}{}", count(violations.len()), document.texts[0].name, listed(violations))]
pub struct CaseError {
    document: Document,
    /// what is wrong, in the order of the checks
    pub violations: Vec<Violation>,
    /// the case as far as it could be read, if every value that it needs could be
    draft: Option<Box<Case>>,
}

fn count(n: usize) -> String {
    if n == 1 { "1 error".into() } else { format!("{n} errors") }
}

/// What is wrong, a line each, for those who print the error without its text.
fn listed(violations: &[Violation]) -> String {
    let line = |v: &Violation| format!("\n  {}: {}", if v.path.is_empty() { "case" } else { &v.path }, v.fault);
    let reported: String = violations.iter().take(render::MAX_REPORTED).map(line).collect();
    printable(&reported)
}

impl Case {
    /// The case with every default filled in, in SI: equal texts are equal cases.
    #[must_use]
    pub fn resolved(&self) -> String {
        self.content.resolved.clone()
    }

    /// Its tables in SI, every default filled in.
    #[must_use]
    pub fn tables(&self) -> &serde_json::Value {
        &self.content.tables
    }

    /// What the case is about.
    #[must_use]
    pub fn about(&self) -> &About {
        &self.content.about
    }

    /// Numbers that the case must give.
    #[must_use]
    pub fn checks(&self) -> &[Check] {
        &self.content.checks
    }

    /// Where its method ends.
    #[must_use]
    pub fn limit(&self) -> Option<&Limit> {
        self.content.limit.as_ref()
    }

    /// The numbers of the case that are no counts, by key, `table.key`, in SI, defaults filled in; and the keys that hold
    /// anything else.
    #[must_use]
    pub fn numbers(&self) -> (Vec<(String, f64)>, Vec<String>) {
        let (mut numbers, mut others) = (Vec::new(), Vec::new());
        let mut open = vec![(String::new(), self.content.tables.clone())];
        while let Some((path, value)) = open.pop() {
            match value {
                serde_json::Value::Object(table) => open.extend(
                    table
                        .into_iter()
                        .rev()
                        .map(|(key, value)| (if path.is_empty() { key } else { format!("{path}.{key}") }, value)),
                ),
                serde_json::Value::Number(x) if x.is_f64() => numbers.push((path, x.as_f64().unwrap_or(f64::NAN))),
                serde_json::Value::Null => {}
                _ => others.push(path),
            }
        }
        (numbers, others)
    }

    /// The case as an error: faults that only a comparison of its values shows, by path.
    #[must_use]
    pub fn refuse(self, faults: Vec<(String, Arc<dyn CaseFault>)>) -> CaseError {
        let violations = faults
            .into_iter()
            .map(|(path, fault)| {
                let spans = vec![self.document.locate(&path)];
                Violation { fault, path, spans }
            })
            .collect();
        CaseError { document: self.document, violations, draft: None }
    }
}

impl CaseError {
    /// The text that a span of a violation points into.
    #[must_use]
    pub fn text(&self, span: &Span) -> &Text {
        self.document.text(span)
    }

    /// The case as far as it could be read, if every value that it needs could be: more may be wrong with it.
    #[must_use]
    pub fn draft(&self) -> Option<&Case> {
        self.draft.as_deref()
    }

    /// Both errors of one case; where they point at the same value, the first one says enough.
    #[must_use]
    pub fn and(mut self, more: Self) -> Self {
        let news = more.violations.into_iter().filter(|v| self.violations.iter().all(|known| known.path != v.path));
        let news: Vec<Violation> = news.collect();
        self.violations.extend(news);
        self
    }
}
