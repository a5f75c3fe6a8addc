//! Studies: one case at many points, run in parallel into ordinary run folders, and what the points say together.
//!
//! ```text
//! converge, sweep, chart, stability, calibrate ─► Plan (points: overrides of one case) ─► conduct: run, assess, write ─► study.json, points.csv, page
//! ```
//!
//! A verb makes a [`Plan`] and assesses its [`Row`]s: measures per point, findings in words, figures. Everything else is the
//! same for all: [`conduct`] runs the points, skips those that are done, turns a failure into a row, and writes the folder.

pub mod calibrate;
pub mod chart;
pub mod converge;
mod coupled;
mod curves;
mod errors;
mod ladder;
pub mod limits;
mod mesh;
pub mod orders;
mod page;
pub mod range;
mod record;
mod regularisation;
mod runner;
mod sheet;
pub mod stability;
mod stability_figure;
pub mod sweep;

use std::error::Error;
use std::path::PathBuf;

use serde_json::{Map, Value};

use crate::case::{CaseError, nearest};
use crate::compare::DataError;
use crate::output::{OutputError, default_folder};
use crate::result::Premise;
use crate::result::{Class, Cost, ErrorReport, Field, Figure, Profile, Results, Status, codes};

pub use errors::Reference;
pub use runner::{BROKEN, Conducted, Next, Observer, Settings, conduct};

/// Code of a point that the user stopped.
pub(crate) const STOPPED: &str = "stopped";

/// What is run: points of one case.
#[derive(Clone, Debug)]
pub struct Plan {
    /// `converge`, `sweep`, `chart`, `stability` or `calibrate`
    pub verb: &'static str,
    /// file or shipped case, as typed
    pub case: String,
    /// its `--set` arguments
    pub overrides: Vec<String>,
    /// what else was asked for, by option: tells studies of one case apart
    pub options: Vec<(String, String)>,
    /// keys that are varied, `table.key`
    pub varied: Vec<String>,
    /// in the order of the table
    pub points: Vec<Point>,
    /// how often a point that is solved in no time is solved, for the median of its cost; 1 for once
    pub repeats: usize,
}

/// One point of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// the case, file or shipped, if it is another than that of the plan
    pub case: Option<String>,
    /// the curve that it lies on; empty where there is only one
    pub series: String,
    /// value of each varied key, as it is set; empty where the key has none here
    pub values: Vec<String>,
    /// what is changed in the case, after the plan's own `--set`s where the case is its own
    pub overrides: Vec<String>,
}

/// One point with what came of it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Row {
    /// the point
    pub point: Point,
    /// SHA-256 of the resolved case; `None` where the case is refused
    pub sha256: Option<String>,
    /// done, failed or stopped
    pub status: Status,
    /// why it failed
    pub error: Option<ErrorReport>,
    /// what that says of the method; `None` where the case is refused
    pub class: Option<Class>,
    /// its numbers \[SI]
    pub results: Results,
    /// premises of its model that are broken
    pub broken: Vec<Premise>,
    /// evaluations of the residual, where something was iterated
    pub iterations: Option<usize>,
    /// what it cost when it was run
    pub cost: Cost,
    /// columns over z \[SI]
    pub profile: Option<Profile>,
    /// fields over the section
    pub field: Option<Field>,
}

/// Reads what the rows say.
pub type Assess = Box<dyn FnOnce(&[Row]) -> Assessment + Send>;

/// What the rows say together.
#[derive(Clone, Debug, Default)]
pub struct Assessment {
    /// a sentence under the title
    pub subtitle: String,
    /// columns that the verb adds to each row: name, and one value per row
    pub measures: Vec<(String, Vec<Option<f64>>)>,
    /// label and text of what a reader wants to know first
    pub findings: Vec<(String, String)>,
    /// the same for programs
    pub facts: Map<String, Value>,
    /// drawn in this order
    pub figures: Vec<Figure>,
    /// parameters that were fitted
    pub parameters: Option<Numbers>,
    /// why the study failed, whatever its points say
    pub failure: Option<ErrorReport>,
}

/// A table whose rows are a name and numbers.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// its heading on the page
    pub heading: &'static str,
    /// a sentence before it
    pub lead: String,
    /// heads of the columns, that of the names first
    pub head: Vec<String>,
    /// name and numbers; `None` is not known
    pub rows: Vec<(String, Vec<Option<f64>>)>,
}

/// Why a study cannot be made. Points that fail are rows, not errors.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// the model has nothing of the kind to vary
    #[error("{model} has no {over} to converge over: only {allowed} have")]
    NoSuchSetting {
        /// what was asked for
        over: &'static str,
        /// the model of the case
        model: String,
        /// models that have it
        allowed: String,
    },
    /// what errors are to be measured against cannot be used
    #[error("--reference {argument}: {reason}")]
    BadReference {
        /// as typed
        argument: String,
        /// what is wrong with it
        reason: String,
    },
    /// nothing exact to measure against
    #[error("{model}: this case has no {what} to converge to")]
    NoClosedForm {
        /// the model
        model: String,
        /// `closed form` or `exact yield`
        what: &'static str,
    },
    /// an argument of `--over` that cannot be read
    #[error("--over {argument}: {reason}")]
    BadOver {
        /// as typed
        argument: String,
        /// what is wrong with it
        reason: String,
    },
    /// a `--fit` that is no number of the case
    #[error("--fit {key}: {reason}")]
    BadFit {
        /// as typed
        key: String,
        /// what is wrong with it
        reason: String,
        /// what to give
        hint: String,
    },
    /// a `--sigma` that cannot be used
    #[error("--sigma {argument}: {reason}")]
    BadSigma {
        /// as typed
        argument: String,
        /// what is wrong with it
        reason: String,
    },
    /// measurements that the model says nothing of
    #[error("{file}: {reason}")]
    BadData {
        /// the file
        file: String,
        /// what is wrong with it
        reason: String,
        /// what to give
        hint: String,
    },
    /// a profile CSV that cannot be used
    #[error(transparent)]
    Data(#[from] DataError),
    /// the case is wrong at every point
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// the folder is refused, or writing it broke
    #[error(transparent)]
    Output(#[from] OutputError),
    /// the system gives no threads
    #[error("the system gives no {wanted} threads: {error}")]
    Threads {
        /// how many were asked for
        wanted: usize,
        /// what it says
        #[source]
        error: Box<dyn Error + Send + Sync>,
    },
}

codes!(StudyError {
    Self::NoSuchSetting { .. } => "no-such-setting",
    Self::NoClosedForm { .. } => "no-closed-form",
    Self::BadReference { .. } => "bad-reference",
    Self::BadOver { .. } => "bad-over",
    Self::BadFit { .. } => "bad-fit",
    Self::BadSigma { .. } => "bad-sigma",
    Self::BadData { .. } => "bad-data",
    Self::Case(_) => "case",
    Self::Threads { .. } => "no-threads",
} nested {
    Self::Data(error) => error.fault.code(),
    Self::Output(error) => error.code(),
});

impl StudyError {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::NoSuchSetting { .. } => "give a case of such a model: `bedload list cases`".into(),
            Self::NoClosedForm { .. } => {
                "--reference finest measures against the finest mesh, or the smallest regularisation".into()
            }
            Self::BadReference { .. } => "give the folder of a finished run, `exact` or `finest`".into(),
            Self::BadOver { argument, .. } => over_hint(argument),
            Self::BadFit { hint, .. } | Self::BadData { hint, .. } => hint.clone(),
            Self::BadSigma { .. } => "give one sigma in SI, or COLUMN=sigma; it holds where the data have none".into(),
            Self::Data(error) => error.fault.hint(),
            Self::Case(_) => String::new(),
            Self::Output(error) => error.hint().unwrap_or_default(),
            Self::Threads { .. } => "ask for fewer with --threads".into(),
        }
    }
}

fn over_hint(argument: &str) -> String {
    let first = argument.split(['=', '.']).next().unwrap_or_default();
    let tables = ["fluid", "grains", "bed", "flow", "model", "closures", "regularisation", "grid", "solver"];
    let near = nearest(first, tables).filter(|near| near != first);
    let near = near.map(|near| format!("did you mean [{near}]? ")).unwrap_or_default();
    format!(
        "{near}give table.key=a,b,c or table.key=from:to:count or table.key=from:to:count:log, with a unit at the end"
    )
}

impl Plan {
    /// The folder that a study of the case `name` goes into unless another is given.
    #[must_use]
    pub fn folder(&self, name: &str) -> PathBuf {
        let variant = self.options.iter().find(|(option, _)| option == "over" && self.verb == "converge");
        let variant = variant.map(|(_, value)| format!("-{value}")).unwrap_or_default();
        default_folder(&format!("{}-{name}{variant}", self.verb))
    }
}

impl Row {
    /// One of its numbers \[SI].
    #[must_use]
    pub fn result(&self, name: &str) -> Option<f64> {
        self.results.get(name)
    }

    /// Why there is nothing, in one sentence; empty if there is something.
    #[must_use]
    pub fn reason(&self) -> String {
        self.error.as_ref().map(|error| error.message.clone()).unwrap_or_default()
    }
}

impl Point {
    /// The point in words: `simple, regularisation.lambda_scaled = 1e-4`.
    #[must_use]
    pub fn name(&self, varied: &[String]) -> String {
        let values = varied.iter().zip(&self.values).filter(|(_, v)| !v.is_empty());
        let values = values.map(|(key, value)| format!("{key} = {value}"));
        let series = Some(self.series.clone()).filter(|s| !s.is_empty());
        series.into_iter().chain(values).collect::<Vec<_>>().join(", ")
    }
}
