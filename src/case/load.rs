//! From a file, a shipped case or a text to a checked case.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::diagnose::{Diagnosis, diagnose, nearest};
use super::document::{Document, Text};
use super::fault::Fault;
use super::kind::{Content, Kind};
use super::shipped::{self, Shipped};
use super::violation::{Span, Violation};
use super::{Case, CaseError, Kinds, angle, scene};

/// Largest accepted case file \[bytes].
const LIMIT: u64 = 1 << 20;

impl Case {
    /// Loads `name`, a file or a shipped case, `name:model` with a model of it, applies `--set` overrides and checks it as one of `kinds`.
    ///
    /// # Errors
    /// Every violation of the file, or why it cannot be read.
    pub fn load(kinds: &Kinds, name: &str, overrides: &[String]) -> Result<Self, CaseError> {
        let is_case = |file: &str| Path::new(file).exists() || shipped::find(file).is_some();
        let is_model = |model: &str| kinds.iter().any(|kind| kind.name == model);
        // What follows a case is meant as a model, also where there is none of that name.
        let of_a_model =
            name.rsplit_once(':').filter(|(file, model)| is_model(model) || is_case(file) && !Path::new(name).exists());
        let (file, model) = of_a_model.map_or((name, None), |(file, model)| (file, Some(model)));
        let path = Path::new(file);
        if path.exists() || file.contains(['/', '\\']) {
            let content = read(path).map_err(|fault| CaseError::without_text(file, fault))?;
            let stem = path.file_stem().map_or_else(|| "case".into(), |s| s.to_string_lossy().into_owned());
            let kinds = chosen(kinds, file, model)?;
            return Self::parse(&kinds, &stem, file, content, overrides);
        }
        let stem = file.strip_suffix(".toml").unwrap_or(file);
        match shipped::find(stem) {
            Some(Shipped { file: own, content, model: named }) => {
                let kinds = chosen(kinds, file, model)?;
                let kinds = chosen(&kinds, own, named)?;
                Self::parse(&kinds, own, file, content.to_owned(), overrides)
            }
            None => {
                let names = shipped::names().chain(shipped::files());
                let fault = Fault::NoSuchCase { name: file.into(), nearest: nearest(stem, names) };
                Err(CaseError::without_text(file, fault))
            }
        }
    }

    /// Checks the text of a case: `name` is its stem, `source` what diagnostics call it.
    ///
    /// # Errors
    /// Every violation at once.
    pub fn parse(
        kinds: &Kinds,
        name: &str,
        source: &str,
        content: String,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (mut document, mut violations) = Document::parse(source, content);
        let broken: BTreeSet<usize> = violations.iter().filter_map(|v| document.line(&v.spans[0])).collect();
        // The model is chosen before anything is set: a setting in the table of a model chooses none.
        let own = scene::chosen(&document, kinds);
        let name = scene::named(name, &document, kinds);
        for argument in overrides {
            let model = own.filter(|_| argument.contains('='));
            let argument = &model.map_or_else(|| argument.clone(), |model| scene::within(model, argument));
            if let Err(violation) = document.set(argument) {
                violations.push(violation);
            }
        }
        let Diagnosis { case: found, violations: more } = diagnose(&document, kinds);
        let readable = violations.is_empty();
        let sound = readable && more.is_empty();
        // Where the syntax is broken, what is missing or mistyped may only be unreadable.
        let unreadable = |v: &Violation| match v.fault.downcast_ref() {
            Some(Fault::Missing { .. } | Fault::WhichModel { .. } | Fault::Empty) => true,
            Some(Fault::Drives { given, .. }) => given.is_empty(),
            _ => document.line(&v.spans[0]).is_some_and(|line| broken.contains(&line)),
        };
        violations.extend(more.into_iter().filter(|v| broken.is_empty() || !unreadable(v)));
        let built = found.filter(|_| readable).map(|(kind, value)| (kind, kind.content(value)));
        let case = |kind: &Kind, content: Content, document| Self {
            name: name.clone(),
            source: source.into(),
            overrides: overrides.to_vec(),
            model: kind.name,
            angles: angle::angles(&kind.schema, &content.tables),
            content,
            document,
        };
        match built {
            Some((kind, Ok(content))) if sound => Ok(case(kind, content, document)),
            Some((kind, Ok(content))) => {
                let draft = Box::new(case(kind, content, document.clone()));
                Err(CaseError { document, violations, draft: Some(draft) })
            }
            Some((_, Err(error))) if sound => {
                let fault = Fault::Syntax { message: error.to_string(), meant: None };
                let violation = Violation::new(fault, String::new(), document.root.value.clone());
                Err(CaseError { document, violations: vec![violation], draft: None })
            }
            _ => Err(CaseError { document, violations, draft: None }),
        }
    }
}

/// The kinds with the model that the name of a case chooses, if it does; another one that was chosen before contradicts it.
fn chosen<'k>(kinds: &'k Kinds, file: &str, model: Option<&str>) -> Result<Cow<'k, Kinds>, CaseError> {
    match (model, kinds.chosen.as_deref()) {
        (Some(model), None) => Ok(Cow::Owned(kinds.clone().choosing(model))),
        (Some(model), Some(other)) if model != other => {
            let fault = Fault::TwoModels { named: model.into(), given: other.into(), file: file.into() };
            Err(CaseError::without_text(file, fault))
        }
        _ => Ok(Cow::Borrowed(kinds)),
    }
}

/// Reads a case file as text.
fn read(path: &Path) -> Result<String, Fault> {
    let unreadable = |error: io::Error| Fault::Unreadable { file: path.display().to_string(), error };
    if path.is_dir() {
        return Err(unreadable(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
    }
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(LIMIT + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LIMIT {
        return Err(Fault::TooLarge { limit: LIMIT });
    }
    if let Some(offset) = bytes.iter().position(|b| *b == 0) {
        return Err(Fault::Binary { offset });
    }
    String::from_utf8(bytes).map_err(|error| Fault::NotUtf8 { offset: error.utf8_error().valid_up_to() })
}

impl CaseError {
    /// A fault of the file as a whole, of which there is nothing to show.
    fn without_text(name: &str, fault: Fault) -> Self {
        let (mut document, _) = Document::parse(name, String::new());
        document.texts = vec![Text { name: name.into(), content: String::new() }];
        let violation = Violation::new(fault, String::new(), Span { text: 0, bytes: 0..0 });
        Self { document, violations: vec![violation], draft: None }
    }
}
