//! `[[check]]` rows: what a case claims of its own results.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::result::Class;

/// A number that the case must give: it makes the case its own test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Check {
    /// Key of a result in summary.json, or "profile." and the name of a column.
    pub quantity: String,
    /// Elevation at which a column is read, by linear interpolation; only with a column.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m"))]
    pub at: Option<f64>,
    /// The expected value, in SI.
    pub expect: f64,
    /// Largest accepted deviation relative to the expected value, such as 1e-3 or "0.1 %"; absolute where that is 0.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 1e6))]
    pub tolerance: f64,
    /// What kind of agreement this is.
    pub kind: CheckKind,
    /// Where the expected value comes from.
    pub source: String,
    /// When the row is run.
    #[serde(default)]
    pub tier: Tier,
}

/// Where the method of the case ends: it makes the case a test of its own limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Limit {
    /// The key that is varied and its values, as `stability --over` takes them.
    pub over: String,
    /// The predicted limit, in the unit of `over`.
    pub expect: f64,
    /// Largest accepted deviation of the limit found, relative to the expected one.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 1e6))]
    pub tolerance: f64,
    /// What becomes of the method beyond it.
    pub beyond: Class,
    /// Largest error of an answer that is accepted, where there is a closed form.
    #[serde(default = "one_per_cent")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub within: f64,
    /// What kind of agreement this is.
    pub kind: CheckKind,
    /// Where the expected limit comes from.
    pub source: String,
    /// When the row is run.
    #[serde(default)]
    pub tier: Tier,
}

fn one_per_cent() -> f64 {
    0.01
}

/// What kind of agreement a check claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CheckKind {
    /// Against an exact or independently computed solution of the same equations.
    Verification,
    /// Against measurements or published results.
    Validation,
    /// Against this program's own result, from finer grids or before: it shows that nothing has changed, and no more.
    Regression,
    /// A claim that is not reproduced: both numbers are shown, and the row is never red.
    Finding,
}

/// When a check is run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Tier {
    /// With every test run.
    #[default]
    Quick,
    /// By hand: it takes long.
    Full,
}
