//! What a run is of, in words: its case, the equations that are solved and the laws in them.

use serde::{Deserialize, Serialize};

use super::SceneRecord;

/// The equations that are solved, and the laws in them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Statement {
    /// the equations as text, numbers filled in
    pub equations: String,
    /// the laws in them
    pub laws: Vec<StatedLaw>,
}

/// A law as a reader meets it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct StatedLaw {
    /// its role: `friction`
    pub family: String,
    /// its name in the case file: `mu-i`
    pub law: String,
    /// the equation in the papers' symbols
    pub equation: String,
    /// citation
    pub source: String,
    /// where the source gives it, in words
    pub ranges: Vec<String>,
}

/// What is known of a run before it is solved.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// name of the case
    pub case: String,
    /// the question that the case answers
    pub title: String,
    /// the model in words: `laminar-exact, two-fluid`
    pub model: String,
    /// the flow, where a case states it
    pub scene: Option<SceneRecord>,
    /// file or shipped case, as the user named it
    pub source: String,
    /// changes to it, as after `--set`
    pub overrides: Vec<String>,
    /// the resolved case as the text of a case file
    pub resolved: String,
    /// its scene and the table of its model, as texts
    pub parts: [String; 2],
    /// threads of the run
    pub threads: usize,
    /// equations and laws
    pub statement: Statement,
}
