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
pub(crate) mod format1;
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
pub use kind::{FlowTables, Kind, Kinds, Part, text};
pub use reference::reference;
pub use render::printable;
pub use scene::for_model;
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
    /// name of the model
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

/// The models to choose from for a case.
#[derive(Clone, Copy, Debug)]
pub struct Choices<'a> {
    /// those of which it has tables, or all that solve its kind of scene
    pub models: &'a [String],
    /// whether it is a scene alone
    pub alone: bool,
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

    /// The text of its file, as it was read.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.document.texts[0].content
    }

    /// Its `--set` arguments that change the flow, not the model.
    #[must_use]
    pub fn overrides_of_the_flow(&self) -> Vec<String> {
        self.overrides.iter().filter(|argument| scene::of_the_flow(argument)).cloned().collect()
    }

    /// Its tables in SI, every default filled in.
    #[must_use]
    pub fn tables(&self) -> &serde_json::Value {
        &self.content.tables
    }

    /// Its scene, the same for every model of the flow, and the table of its model, as the texts of case files.
    #[must_use]
    pub fn parts(&self) -> [String; 2] {
        let of_the_scene = |key: &String| ![self.model, "format", "case"].contains(&key.as_str());
        let tables = self.content.tables.as_object().into_iter().flatten();
        let (scene, rest): (Vec<_>, Vec<_>) = tables.partition(|(key, _)| of_the_scene(key));
        let text_of = |entries: Vec<(&String, &serde_json::Value)>| {
            text(
                entries
                    .into_iter()
                    .map(|(key, value)| (key.clone(), value.clone()))
                    .collect::<serde_json::Map<_, _>>()
                    .into(),
            )
        };
        [text_of(scene), text_of(rest.into_iter().filter(|(key, _)| *key == self.model).collect())]
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
        // A key of the model is one of `--set`, without the name of the model.
        let own = |path: String| match path.strip_prefix(self.model).and_then(|own| own.strip_prefix('.')) {
            Some(own) => own.to_owned(),
            None => path,
        };
        let numbers = numbers.into_iter().map(|(path, x)| (own(path), x)).collect();
        (numbers, others.into_iter().map(own).collect())
    }

    /// Whether the file has a table of its model; a scene alone has none.
    #[must_use]
    pub fn has_table(&self) -> bool {
        scene::is_written(&self.document, self.model)
    }

    /// Whether the file or a `--set` argument gives `key`, named as in `--set`.
    #[must_use]
    pub fn gives(&self, key: &str) -> bool {
        self.document.node(&self.place(key)).is_some()
    }

    /// What the file does not say, and the values that are taken: defaults, by key as in `--set`.
    #[must_use]
    pub fn defaults(&self) -> Vec<(String, serde_json::Value)> {
        let mut found = Vec::new();
        let mut open = vec![(String::new(), &self.content.tables)];
        while let Some((path, value)) = open.pop() {
            let join = |key: &String| if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            match value {
                serde_json::Value::Object(table) => {
                    open.extend(table.iter().rev().map(|(key, value)| (join(key), value)))
                }
                serde_json::Value::Null | serde_json::Value::Array(_) => {}
                value if self.document.node(&path).is_none() && !self.is_a_word(&path) => {
                    let own = path.strip_prefix(self.model).and_then(|own| own.strip_prefix('.')).unwrap_or(&path);
                    found.push((own.to_owned(), value.clone()));
                }
                _ => {}
            }
        }
        found
    }

    /// Whether `path` is the law of a table that the file writes as a word.
    fn is_a_word(&self, path: &str) -> bool {
        path.strip_suffix(".law").is_some_and(|table| self.document.node(table).is_some())
    }

    /// The case as an error: faults that only a comparison of its values shows, by path.
    #[must_use]
    pub fn refuse(self, kinds: &Kinds, faults: Vec<(String, Arc<dyn CaseFault>)>) -> CaseError {
        // Drives that do not go together say enough of what is missing.
        let drives: Vec<String> = faults
            .iter()
            .filter(|(_, fault)| matches!(fault.downcast_ref(), Some(Fault::Drives { .. })))
            .map(|(path, _)| format!("{path}."))
            .collect();
        let said = |path: &str| drives.iter().any(|table| path.starts_with(table.as_str()));
        let violations = faults
            .into_iter()
            .filter(|(path, fault)| !(matches!(fault.downcast_ref(), Some(Fault::Needed)) && said(path)))
            .map(|(path, fault)| {
                let missing = matches!(fault.downcast_ref(), Some(Fault::Needed));
                let fault = if missing { Arc::new(kinds.missing(self.model, &path)) } else { fault };
                // Drives that are too many are shown one by one.
                let drives = match fault.downcast_ref() {
                    Some(Fault::Drives { given, .. }) => given.as_slice(),
                    _ => &[],
                };
                let mut spans: Vec<Span> =
                    drives.iter().filter_map(|drive| self.document.key(&format!("{path}.{drive}"))).collect();
                if spans.is_empty() {
                    spans.push(self.document.locate(&path));
                }
                Violation { fault, path, spans }
            })
            .collect();
        CaseError { document: self.document, violations, draft: None }
    }
}

impl CaseError {
    /// The models to choose from, where nothing is wrong but that the case does not say which one solves it.
    #[must_use]
    pub fn choices(&self) -> Option<Choices<'_>> {
        match self.violations.as_slice() {
            [one] => match one.fault.downcast_ref()? {
                Fault::WhichModel { given: None, allowed, alone, .. } => {
                    Some(Choices { models: allowed, alone: *alone })
                }
                _ => None,
            },
            _ => None,
        }
    }

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

    /// Both errors of one case; where they point at the same value, or where a misspelt key is what is missing, the first one says enough.
    #[must_use]
    pub fn and(mut self, more: Self) -> Self {
        let meant = |known: &Violation, path: &str, fault: Option<&Fault>| {
            let Some(Fault::Unknown { nearest: Some(name), .. }) = known.fault.downcast_ref() else { return false };
            let table = known.path.rsplit_once('.').map_or("", |(table, _)| table);
            match fault {
                Some(Fault::Missing { .. }) => path == format!("{table}.{name}"),
                Some(Fault::Drives { allowed, .. }) => {
                    path == table && allowed.iter().any(|drives| drives.split(' ').any(|drive| drive == name))
                }
                _ => false,
            }
        };
        let news = more.violations.into_iter().filter(|v| {
            // A drive that cannot be read is given all the same.
            let drive = |known: &Violation| match (v.fault.downcast_ref(), known.path.rsplit_once('.')) {
                (Some(Fault::Drives { allowed, .. }), Some((table, name))) => {
                    table == v.path && allowed.iter().any(|drives| drives.split(' ').any(|drive| drive == name))
                }
                _ => false,
            };
            let known = |known: &Violation| {
                known.path == v.path || drive(known) || meant(known, &v.path, v.fault.downcast_ref())
            };
            !self.violations.iter().any(known)
        });
        let news: Vec<Violation> = news.collect();
        self.violations.extend(news);
        self
    }
}
