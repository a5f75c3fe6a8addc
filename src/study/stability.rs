//! `stability`: where a method holds, and how it fails beyond.
//!
//! The case is run at every value of one key or a grid of two. Each point falls into one class: it holds, it holds but its answer is
//! wrong, its iteration does not converge, it leaves the numbers, it finds that no such flow exists, or the case is refused before it
//! is run. Between two neighbours along the first key of which only one holds, the limit is found by bisection.

use std::collections::BTreeMap;

use serde_json::json;

use super::Assess;
use super::curves::error_text;
pub use super::limits::Request;
use super::limits::{Found, limits, solved};
use super::range::{MAX_POINTS, Varied, number_and_unit, parse};
use super::{Assessment, Plan, Point, Row, StudyError, stability_figure};
use crate::model::Registry;
use crate::result::{Class, Status};
use crate::units::significant;

/// The plan of a map of stability, and how to assess it.
///
/// # Errors
/// [`StudyError::BadOver`] with the argument that cannot be read; [`StudyError::Case`].
pub fn plan(registry: &Registry, request: &Request) -> Result<(Plan, Assess), StudyError> {
    let bad = |reason: &str| StudyError::BadOver { argument: request.over.join(" --over "), reason: reason.into() };
    let varied: Vec<Varied> = request.over.iter().map(|argument| parse(argument)).collect::<Result<_, _>>()?;
    let (first, second) = match &varied[..] {
        [first] => (first, None),
        [first, second] => (first, Some(second)),
        _ => return Err(bad("one key or two")),
    };
    if first.values.len() * second.map_or(1, |v| v.values.len()) > MAX_POINTS {
        return Err(bad("the grid is too large"));
    }
    if first.values.iter().any(|v| number_and_unit(v).is_none()) {
        return Err(bad("the first key takes numbers: its limit is bisected"));
    }
    let rows = second.map_or_else(|| vec![None], |v| v.values.iter().map(Some).collect());
    let point = |row: Option<&String>, value: &String| {
        let mut overrides = vec![format!("{}={value}", first.key)];
        overrides.extend(second.zip(row).map(|(second, row)| format!("{}={row}", second.key)));
        Point {
            case: None,
            series: second.zip(row).map(|(second, row)| format!("{} = {row}", last(&second.key))).unwrap_or_default(),
            values: std::iter::once(value).chain(row).cloned().collect(),
            overrides,
        }
    };
    let points = rows.iter().flat_map(|row| first.values.iter().map(|value| point(*row, value))).collect();
    let plan = Plan {
        verb: "stability",
        case: request.case.clone(),
        overrides: request.overrides.clone(),
        options: request.over.iter().map(|argument| ("over".into(), argument.clone())).collect(),
        varied: varied.iter().map(|v| v.key.clone()).collect(),
        points,
        repeats: 1,
    };
    let (registry, request) = (registry.clone(), request.clone());
    Ok((plan, Box::new(move |rows: &[Row]| assess(&registry, &request, &varied, rows))))
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// The class of a row, of which only the results are known.
fn classify(registry: &Registry, request: &Request, row: &Row) -> Found {
    let failed = |class: Class| Found { class, error: None, reason: row.reason() };
    match row.status {
        Status::Failed => failed(row.class.unwrap_or(Class::Refused)),
        _ => {
            let overrides = [&request.overrides[..], &row.point.overrides].concat();
            let problem = registry.load(&request.case, &overrides).ok();
            let form = problem.and_then(|(_, problem)| problem.solver().closed_form());
            solved(request, form, &row.results, !row.broken.is_empty())
        }
    }
}

fn assess(registry: &Registry, request: &Request, varied: &[Varied], rows: &[Row]) -> Assessment {
    let found: Vec<Found> = rows.iter().map(|row| classify(registry, request, row)).collect();
    let keys: Vec<&str> = varied.iter().map(|v| v.key.as_str()).collect();
    let unit = rows.first().and_then(|row| row.point.values.first()).and_then(|v| number_and_unit(v)).map(|p| p.1);
    let unit = unit.filter(|u| !u.is_empty()).map(|u| format!(" {u}")).unwrap_or_default();
    let limits = limits(registry, request, varied, rows, &found);
    let mut findings: Vec<(String, String)> = Vec::new();
    for limit in &limits {
        let label = if limit.series.is_empty() { "limit".into() } else { format!("limit, {}", limit.series) };
        let side = if limit.holds < limit.fails { "up to" } else { "from" };
        let mut text = format!(
            "holds {side} {} = {}{unit}; at {}{unit} {}: {}",
            last(keys.first().copied().unwrap_or_default()),
            significant(limit.holds, 4),
            significant(limit.fails, 4),
            limit.class.name(),
            limit.reason
        );
        if let Some(predicted) = request.predicted {
            text += &format!(" (predicted {}{unit})", significant(predicted, 4));
        }
        findings.push((label, text));
    }
    let mut modes: BTreeMap<Class, (usize, &Row, &str)> = BTreeMap::new();
    for (row, what) in rows.iter().zip(&found) {
        modes.entry(what.class).or_insert((0, row, &what.reason)).0 += 1;
    }
    for (class, (count, row, reason)) in &modes {
        let first = format!("first at {}", row.point.name(&names(varied)));
        let why = if reason.is_empty() { String::new() } else { format!(": {reason}") };
        findings.push((class.name().into(), format!("{count} of {} points, {first}{why}", rows.len())));
    }
    let class = |what: &Found| Class::ALL.iter().position(|c| *c == what.class).map(|i| i as f64);
    let mut assessment = Assessment {
        subtitle: format!("Over {}; an answer holds within {}.", keys.join(" and "), error_text(request.tolerance)),
        measures: vec![
            ("class".into(), found.iter().map(class).collect()),
            ("error".into(), found.iter().map(|what| what.error).collect()),
        ],
        findings,
        ..Assessment::default()
    };
    let facts = limits.iter().map(|l| {
        json!({ "series": l.series, "holds": l.holds, "fails": l.fails, "class": l.class.name(), "reason": l.reason })
    });
    assessment.facts.insert("limits".into(), facts.collect());
    assessment.facts.insert("predicted".into(), json!(request.predicted));
    assessment.facts.insert("classes".into(), Class::ALL.map(Class::name).to_vec().into());
    assessment.figures.push(stability_figure::figure(varied, rows, &found, &limits, request.predicted));
    assessment
}

fn names(varied: &[Varied]) -> Vec<String> {
    varied.iter().map(|v| v.key.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(case: &str, over: &[&str]) -> Request {
        Request {
            case: case.into(),
            overrides: Vec::new(),
            over: over.iter().map(|o| (*o).to_owned()).collect(),
            tolerance: 0.01,
            predicted: None,
        }
    }

    #[test]
    fn one_or_two_numbers_are_varied() {
        for (over, words) in [
            (&["form=mixed,two-fluid"][..], "takes numbers"),
            (&["grid.cells=1,2", "flow.slope=1,2", "bed.thickness=1,2"], "one key or two"),
        ] {
            let said = plan(&crate::models::builtin(), &request("bed_ouriemi-laminar", over))
                .err()
                .map(|e| e.to_string())
                .unwrap_or_default();
            assert!(said.contains(words), "{said}");
        }
        let (plan, _) = plan(
            &crate::models::builtin(),
            &request("bed_ouriemi-laminar", &["grid.cells=24,48", "form=mixed,two-fluid"]),
        )
        .unwrap();
        assert_eq!(plan.points.len(), 4);
        assert_eq!(plan.points[3].series, "form = two-fluid");
    }
}
