//! What an unfinished validation has found: cases that were run are not run again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::result::Provenance;

/// What was found of each case, in the order of its checks and its limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Partial {
    /// version and commit of the program that ran them
    bedload: String,
    cases: BTreeMap<String, Case>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Case {
    /// every value of it
    resolved: String,
    found: Vec<Found>,
}

/// A value in SI, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
enum Found {
    Value(f64),
    Reason(String),
}

impl Default for Partial {
    fn default() -> Self {
        let made = Provenance::of_this_program();
        Self { bedload: format!("{} ({})", made.bedload, made.commit), cases: BTreeMap::new() }
    }
}

impl Partial {
    /// What an earlier validation by this very program kept; nothing where that cannot be read.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let read = serde_json::from_str::<Self>(text).ok();
        read.filter(|read| read.bedload == Self::default().bedload).unwrap_or_default()
    }

    /// As a file.
    #[must_use]
    pub fn text(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// What was found of the case `name`, where it has not changed since.
    pub(super) fn found(&self, name: &str, resolved: &str) -> Option<Vec<Result<f64, String>>> {
        let case = self.cases.get(name).filter(|case| case.resolved == resolved)?;
        let one = |found: &Found| match found {
            Found::Value(value) => Ok(*value),
            Found::Reason(reason) => Err(reason.clone()),
        };
        Some(case.found.iter().map(one).collect())
    }

    pub(super) fn keep(&mut self, name: &str, resolved: String, found: impl Iterator<Item = Result<f64, String>>) {
        let found = found.map(|found| found.map_or_else(Found::Reason, Found::Value)).collect();
        self.cases.insert(name.into(), Case { resolved, found });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_kept_is_read_back_for_the_same_case_and_version() {
        let mut kept = Partial::default();
        kept.keep("a", "0123".into(), [Ok(0.1 + 0.2), Err("no layer moves".into())].into_iter());
        let read = Partial::read(&kept.text());
        assert_eq!(read, kept);
        assert_eq!(read.found("a", "0123"), Some(vec![Ok(0.1 + 0.2), Err("no layer moves".into())]));
        assert_eq!((read.found("a", "4567"), read.found("b", "0123")), (None, None));
        let older = kept.text().replace(&kept.bedload, "0.1.0 (another commit)");
        assert_eq!(Partial::read(&older), Partial::default());
        assert_eq!(Partial::read("{ \"half"), Partial::default());
    }
}
