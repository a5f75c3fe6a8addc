//! `summary.json`: the numbers of a run with their units in their names.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Estimate, Provenance, Quantity, SceneRecord};
use super::{Premise, Verdict};

/// State of a run folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Status {
    /// being computed, or interrupted without a word
    Running,
    /// complete
    Done,
    /// the method failed
    Failed,
    /// stopped by the user
    Stopped,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Running => "running",
            Self::Done => "done",
            Self::Failed => "failed",
            Self::Stopped => "stopped",
        })
    }
}

/// A result: its value in SI, the standard error of a mean, and why it is missing where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Reported {
    /// SI value; `null` where it is undefined
    pub value: Option<f64>,
    /// standard error, for means of fluctuating quantities
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stderr: Option<f64>,
    /// why there is no value, or why a mean has no standard error
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Why a computed value is missing.
const OVERFLOWED: &str = "not finite";

impl Reported {
    /// Whether it was computed and is not a finite number.
    #[must_use]
    pub fn overflowed(&self) -> bool {
        self.value.is_none() && self.reason.as_deref() == Some(OVERFLOWED)
    }
}

/// Results by catalogued name, in the order in which they were reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Results(Vec<(String, Reported)>);

impl Results {
    /// Reports `value` \[SI]; a value that is not finite becomes `null` with the reason "not finite".
    pub fn set(&mut self, quantity: &'static Quantity, value: f64) {
        if value.is_finite() {
            self.put(quantity, Reported { value: Some(value), stderr: None, reason: None });
        } else {
            self.undefined(quantity, OVERFLOWED);
        }
    }

    /// Reports a mean \[SI] with its standard error, or why it has none.
    pub fn set_mean(&mut self, quantity: &'static Quantity, estimate: Estimate) {
        self.set(quantity, estimate.mean);
        let of_it = |(name, reported): &&mut (String, Reported)| name == quantity.name && reported.value.is_some();
        let Some((_, reported)) = self.0.iter_mut().find(of_it) else { return };
        match estimate.stderr {
            Ok(error) if error.is_finite() => reported.stderr = Some(error),
            Ok(_) => reported.reason = Some(OVERFLOWED.into()),
            Err(why) => reported.reason = Some(why.reason().into()),
        }
    }

    /// Reports that a quantity has no value here, and why.
    pub fn undefined(&mut self, quantity: &'static Quantity, reason: &str) {
        self.put(quantity, Reported { value: None, stderr: None, reason: Some(reason.into()) });
    }

    /// What is reported again stands where it stood.
    fn put(&mut self, quantity: &'static Quantity, reported: Reported) {
        match self.0.iter_mut().find(|(name, _)| name == quantity.name) {
            Some((_, before)) => *before = reported,
            None => self.0.push((quantity.name.into(), reported)),
        }
    }

    /// The SI value of a result, if it was reported and is defined.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(n, _)| n == name).and_then(|(_, r)| r.value)
    }

    /// Why a result has no value, if it was reported without one.
    #[must_use]
    pub fn reason(&self, name: &str) -> Option<&str> {
        let (_, reported) = self.0.iter().find(|(n, r)| n == name && r.value.is_none())?;
        reported.reason.as_deref()
    }

    /// All results in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Reported)> {
        self.0.iter().map(|(name, reported)| (name.as_str(), reported))
    }
}

impl Serialize for Results {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(n, r)| (n, r)))
    }
}

impl<'de> Deserialize<'de> for Results {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Map::<String, Value>::deserialize(deserializer)?
            .into_iter()
            .map(|(name, value)| Ok((name, serde_json::from_value(value).map_err(serde::de::Error::custom)?)))
            .collect::<Result<_, _>>()
            .map(Self)
    }
}

/// A global balance: the residual relative to the scale in its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// what is balanced: `momentum`, `transport_rate`
    pub name: String,
    /// relative residual
    pub relative: f64,
    /// how it was evaluated
    pub how: String,
}

/// A closure that was used outside the range its source gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Validity {
    /// `family/law`
    pub closure: String,
    /// the variable that left the range
    pub variable: String,
    /// its value furthest outside
    pub value: f64,
    /// the range, in words
    pub range: String,
    /// where \[m]
    pub z_m: Option<f64>,
}

/// What it cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Cost {
    /// wall time of the solver \[s]
    pub solve_s: f64,
    /// wall time of everything before the summary was written \[s]
    pub total_s: f64,
    /// peak resident memory \[MB], where the system tells
    pub peak_memory_mb: Option<f64>,
    /// levels, cells times steps, or grains times steps
    pub work_units: f64,
    /// how often it was solved, where `solve_s` is a median
    #[serde(default, skip_serializing_if = "is_one")]
    pub repeats: usize,
    /// from the first to the third quartile of those times \[s]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread_s: Option<f64>,
}

fn is_one(repeats: &usize) -> bool {
    *repeats <= 1
}

/// Why a run failed, as it stands in `summary.json` and in the answer of `--json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorReport {
    /// stable identifier
    pub code: String,
    /// one sentence with numbers
    pub message: String,
    /// dotted path in the case file
    pub path: Option<String>,
    /// line in the case file, from 1
    pub line: Option<usize>,
    /// what is allowed there
    pub allowed: Option<String>,
    /// what to do
    pub hint: Option<String>,
}

/// The content of `summary.json`. Only `cost` and `provenance` may differ between identical runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// version of this layout
    pub format: u32,
    /// state of the run
    pub status: Status,
    /// name of the case
    pub case: String,
    /// model in words: `exact/ouriemi, two-fluid`
    pub model: String,
    /// the flow: its inputs, its numbers
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneRecord>,
    /// named numbers
    pub results: Results,
    /// global balances
    pub balances: Vec<Balance>,
    /// premises of the model, and what this flow says of them
    #[serde(default)]
    pub regime: Vec<Premise>,
    /// closures used outside their range
    pub validity: Vec<Validity>,
    /// every small number that the run used
    pub regularisation: Map<String, Value>,
    /// why it failed
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorReport>,
    /// what it cost
    pub cost: Cost,
    /// where it came from
    pub provenance: Provenance,
}

impl Summary {
    /// The premises with this verdict.
    pub fn premises(&self, verdict: Verdict) -> impl Iterator<Item = &Premise> {
        self.regime.iter().filter(move |premise| premise.verdict == verdict)
    }

    /// Layout version that this program writes.
    pub const FORMAT: u32 = 1;

    /// The summary as one JSON object.
    #[must_use]
    pub fn to_json(&self) -> Value {
        serde_json::to_value(self)
            .unwrap_or_else(|error| json!({ "status": "failed", "unwritable": error.to_string() }))
    }
}
