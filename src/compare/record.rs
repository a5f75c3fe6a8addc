//! A comparison as JSON and as a table.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Align, Comparison, NormRow, Side};
use crate::result::{Cost, Provenance, Status};

/// What the user asked for: two comparisons with equal requests are the same comparison.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Request {
    /// cases and run folders, as typed
    pub subjects: Vec<String>,
    /// models of the cases, as typed
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub models: Vec<String>,
    /// `--set` arguments, for every case
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<String>,
    /// profile CSVs, as typed
    pub data: Vec<String>,
    /// where z is 0
    pub align: Align,
    /// whether values are divided by scales
    pub scale: bool,
}

impl Comparison {
    /// Layout version of `compare.json`.
    pub const FORMAT: u32 = 1;

    /// `compare.json`: everything, in SI or in the units that `units` names. Only `cost` and `provenance` may differ
    /// between identical comparisons.
    #[must_use]
    pub fn to_json(&self, request: &Request, cost: &Cost, provenance: &Provenance) -> Value {
        let name = |i: usize| self.subjects.get(i).map(|s| s.name.as_str());
        let subjects = self.subjects.iter().zip(&self.views).map(|(subject, view)| {
            json!({
                "name": subject.name,
                "label": subject.label,
                "kind": subject.kind,
                "source": subject.source,
                "notes": subject.notes,
                "levels": subject.profile.rows(),
                "shift_m": view.shift_m,
                "scales": view.scales,
                "results": subject.results,
                "regime": subject.regime,
                "validity": subject.validity,
                "scene": subject.stated.as_ref().map(|stated| &stated.scene),
                "solid_volume_m": subject.solid_volume(),
            })
        });
        let norms = self.norms.iter().map(|row| self.norm(row));
        let numbers = self.numbers.iter().map(|row| {
            json!({
                "name": row.quantity.name,
                "unit": self.unit(row.quantity),
                "relative_to": name(row.base),
                "values": row.values.iter().map(|v| v.map(|(value, _)| value)).collect::<Vec<_>>(),
                "stderr": row.values.iter().map(|v| v.and_then(|(_, error)| error)).collect::<Vec<_>>(),
                "relative_differences": row.differences,
            })
        });
        json!({
            "format": Self::FORMAT,
            "status": Status::Done,
            "request": request,
            "reference": name(0),
            "datum": self.align.datum(),
            "subjects": subjects.collect::<Vec<_>>(),
            "norms": norms.collect::<Vec<_>>(),
            "numbers": numbers.collect::<Vec<_>>(),
            "inputs": self.inputs.iter().map(|row| json!({ "path": row.path, "values": row.values })).collect::<Vec<_>>(),
            "warnings": self.warnings(),
            "cost": cost,
            "provenance": provenance,
        })
    }

    fn norm(&self, row: &NormRow) -> Value {
        let d = row.deviation.as_ref();
        json!({
            "subject": self.subjects.get(row.subject).map(|s| s.name.as_str()),
            "column": row.quantity.name,
            "unit": self.unit(row.quantity),
            "levels": d.map_or(0, |d| d.levels),
            "levels_of": d.and_then(|d| self.coarser(row, d.coarser)),
            "z_low": d.map(|d| d.between.0),
            "z_high": d.map(|d| d.between.1),
            "l2_relative": d.and_then(|d| d.l2_relative),
            "linf": d.map(|d| d.linf),
            "linf_at": d.map(|d| d.linf_at),
            "linf_relative": d.and_then(|d| d.linf_relative),
            "bias": d.map(|d| d.bias),
            "rms_sigma": row.sigmas.map(|s| s.rms),
            "levels_with_errors": row.sigmas.map(|s| s.levels),
        })
    }

    /// Name of the subject at whose levels a norm is taken.
    pub(super) fn coarser(&self, row: &NormRow, side: Side) -> Option<&str> {
        let index = if side == Side::Reference { 0 } else { row.subject };
        self.subjects.get(index).map(|s| s.name.as_str())
    }

    /// `norms.csv`: one row per column and subject, under `# ` lines with its origin. An undefined value is an empty field.
    ///
    /// # Errors
    /// Whatever the writer returns.
    pub fn write_norms(&self, mut to: impl Write, provenance: &Provenance) -> io::Result<()> {
        let reference = self.subjects.first().map_or("", |s| s.name.as_str());
        let mut comments: Vec<String> = provenance.lines().into_iter().take(1).collect();
        comments.extend([provenance.source.clone(), format!("reference {reference}; {}", self.align.datum())]);
        comments.push(format!("started {}", provenance.started_utc));
        for comment in comments {
            writeln!(to, "# {}", comment.replace(['\n', '\r'], " "))?;
        }
        let mut writer = csv::Writer::from_writer(to);
        let mut headed = false;
        for row in &self.norms {
            let Value::Object(fields) = self.norm(row) else { continue };
            if !headed {
                writer.write_record(fields.keys())?;
                headed = true;
            }
            writer.write_record(fields.values().map(|value| match value {
                Value::Null => String::new(),
                Value::String(text) => text.clone(),
                number => number.to_string(),
            }))?;
        }
        writer.flush()
    }
}
