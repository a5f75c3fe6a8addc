//! A study as JSON and as a table.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::{Assessment, Numbers, Plan, Row};
use crate::output::StudyFolder;
use crate::result::{Cost, Provenance, Status};

/// Layout version of `study.json`.
const FORMAT: u32 = 1;

/// What is known of a study before its first point is run.
pub(super) struct Head<'a> {
    /// what is run
    pub plan: &'a Plan,
    /// stem of the case
    pub name: &'a str,
    /// fingerprint of the plan
    pub identity: &'a str,
    /// the command that makes it
    pub command: &'a str,
}

impl Head<'_> {
    fn object(&self, status: Status) -> Map<String, Value> {
        let Plan { verb, case, overrides, options, varied, .. } = self.plan;
        let options: Map<String, Value> = options.iter().map(|(k, v)| (k.clone(), v.as_str().into())).collect();
        let head = json!({
            "format": FORMAT,
            "status": status,
            "verb": verb,
            "case": self.name,
            "source": case,
            "overrides": overrides,
            "options": options,
            "varied": varied,
            "command": self.command,
            "plan_sha256": self.identity,
        });
        if let Value::Object(object) = head { object } else { Map::new() }
    }

    /// `study.json` of a study that has just begun.
    pub fn running(&self, provenance: &Provenance) -> Value {
        let mut object = self.object(Status::Running);
        object.insert("provenance".into(), json!(provenance));
        object.into()
    }

    /// `study.json`. Only `cost` and `provenance`, here and in the points, may differ between identical studies.
    pub fn complete(
        &self,
        status: Status,
        rows: &[Row],
        assessment: &Assessment,
        cost: &Cost,
        provenance: &Provenance,
    ) -> Value {
        let mut object = self.object(status);
        if let Some(failure) = &assessment.failure {
            object.insert("error".into(), json!(failure));
        }
        object.insert("facts".into(), assessment.facts.clone().into());
        let points = rows.iter().enumerate().map(|(i, row)| self.point(i, row, assessment));
        object.insert("points".into(), points.collect::<Vec<_>>().into());
        object.insert("cost".into(), json!(cost));
        object.insert("provenance".into(), json!(provenance));
        object.into()
    }

    fn point(&self, i: usize, row: &Row, assessment: &Assessment) -> Value {
        let values = self.plan.varied.iter().zip(&row.point.values).filter(|(_, v)| !v.is_empty());
        let values: Map<String, Value> = values.map(|(k, v)| (k.clone(), v.as_str().into())).collect();
        let measured = assessment.measures.iter();
        let measures: Map<String, Value> =
            measured.map(|(name, all)| (name.clone(), json!(all.get(i).copied().flatten()))).collect();
        json!({
            "series": row.point.series,
            "values": values,
            "status": row.status,
            "case_sha256": row.sha256,
            "folder": row.sha256.as_deref().map(StudyFolder::point_name),
            "measures": measures,
            "results": row.results,
            "iterations": row.iterations,
            "error": row.error,
            "cost": row.cost,
        })
    }
}

/// `points.csv`: one row per point, under `# ` lines with `comments`. An undefined value is an empty field.
///
/// # Errors
/// Whatever the writer returns.
pub(super) fn write_table(
    to: &mut dyn Write,
    plan: &Plan,
    rows: &[Row],
    assessment: &Assessment,
    comments: &[String],
) -> io::Result<()> {
    for comment in comments {
        writeln!(to, "# {}", comment.replace(['\n', '\r'], " "))?;
    }
    let results = result_names(rows);
    let mut writer = csv::Writer::from_writer(to);
    let fixed = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    let mut header = fixed(&["series"]);
    header.extend(plan.varied.iter().cloned());
    header.extend(fixed(&["status", "iterations"]));
    header.extend(assessment.measures.iter().map(|(name, _)| name.clone()));
    header.extend(results.iter().map(|name| (*name).to_owned()));
    header.extend(fixed(&["solve_s", "reason", "folder"]));
    writer.write_record(&header)?;
    for (i, row) in rows.iter().enumerate() {
        let number = |x: Option<f64>| x.map(|x| format!("{x:?}")).unwrap_or_default();
        let mut fields = vec![row.point.series.clone()];
        fields.extend(row.point.values.iter().cloned());
        fields.extend([row.status.to_string(), row.iterations.map(|n| n.to_string()).unwrap_or_default()]);
        fields.extend(assessment.measures.iter().map(|(_, all)| number(all.get(i).copied().flatten())));
        fields.extend(results.iter().map(|name| number(row.result(name))));
        let ran = row.status == Status::Done;
        fields.push(number(ran.then_some(row.cost.solve_s)));
        fields.push(row.reason());
        fields.push(row.sha256.as_deref().map(StudyFolder::point_name).unwrap_or_default());
        writer.write_record(&fields)?;
    }
    writer.flush()
}

/// `parameters.csv`: a table of words and numbers under `# ` lines with `comments`. What is not known is an empty field.
///
/// # Errors
/// Whatever the writer returns.
pub(super) fn write_numbers(to: &mut dyn Write, table: &Numbers, comments: &[String]) -> io::Result<()> {
    for comment in comments {
        writeln!(to, "# {}", comment.replace(['\n', '\r'], " "))?;
    }
    let mut writer = csv::Writer::from_writer(to);
    writer.write_record(&table.head)?;
    for (name, values) in &table.rows {
        let values = values.iter().map(|x| x.map(|x| format!("{x:?}")).unwrap_or_default());
        writer.write_record(std::iter::once(name.clone()).chain(values))?;
    }
    writer.flush()
}

/// Names of the results that any row has, in the order in which they are reported.
fn result_names(rows: &[Row]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flat_map(|row| row.results.iter()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}
