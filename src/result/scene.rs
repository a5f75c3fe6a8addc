//! The flow of a run as its folder keeps it, and in what two of them differ.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A scene as `summary.json` keeps it: without types, so that a run of another version can be read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRecord {
    /// `bed`, `channel`, `granular` or `benchmark`
    pub kind: String,
    /// its inputs by dotted path, in SI
    pub inputs: Map<String, Value>,
    /// its numbers by name: `value` in SI and `definition`
    pub numbers: Map<String, Value>,
    /// solid volume of the bed at rest per area \[m]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_volume_m: Option<f64>,
}

/// One input in which two scenes differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// its dotted path
    pub path: String,
    /// the value in the first, if it has one
    pub first: Option<Value>,
    /// the value in the second, if it has one
    pub second: Option<Value>,
}

/// Numbers that differ by less than this share are the same input: a depth that followed from a Shields number differs from
/// the same depth given by a unit in the last place.
const SAME: f64 = 1e-12;

impl SceneRecord {
    /// Every input in which two scenes differ, in the order of the first.
    #[must_use]
    pub fn differences(&self, other: &Self) -> Vec<Difference> {
        differences(&self.inputs, &other.inputs)
    }
}

/// Every value by dotted path in which two sets of tables differ: those of the first in its order, then what only the second has.
#[must_use]
pub fn differences(first: &Map<String, Value>, second: &Map<String, Value>) -> Vec<Difference> {
    let same = |a: &Value, b: &Value| match (a.as_f64(), b.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()),
        _ => a == b,
    };
    let known = first.iter().filter_map(|(path, value)| {
        let there = second.get(path);
        (!there.is_some_and(|there| same(value, there))).then_some((path, Some(value), there))
    });
    let only_second = second.iter().filter(|(path, _)| !first.contains_key(*path));
    known
        .chain(only_second.map(|(path, value)| (path, None, Some(value))))
        .map(|(path, first, second)| Difference { path: path.clone(), first: first.cloned(), second: second.cloned() })
        .collect()
}

/// Nested tables by dotted path.
pub fn flatten(at: &str, value: &Value, to: &mut Map<String, Value>) {
    match value {
        Value::Object(table) => {
            for (key, value) in table {
                let path = if at.is_empty() { key.clone() } else { format!("{at}.{key}") };
                flatten(&path, value, to);
            }
        }
        Value::Null => {}
        value => {
            to.insert(at.to_owned(), value.clone());
        }
    }
}
