//! `chart`: speed against accuracy of everything that can answer one scene.
//!
//! The scene is a case; further cases are other models of the same scene. Each is solved with every setting of its ladder.
//! The error is that of one number against the best reference there is: a finished run that is given (its standard error is a
//! band that no model need beat), the closed form, a much finer solution, or the longest run of the grains. The cost is the median of
//! repeated solutions; beside it stand the units of work. A setting is worth its cost if none is both
//! cheaper and better (the Pareto front). What failed is drawn where its cost ended, at the top.

use std::path::Path;

use serde_json::json;

use super::Assess;
use super::curves::error_text;
use super::ladder::{KEY, accepted, overrides_of, rungs};
use super::{Assessment, Plan, Point, Row, StudyError};
use crate::model::{Problem, Registry};
use crate::output::read_run;
use crate::result::Status;
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Level, Marker, Panel};
use crate::units::{readable_known, significant};

/// What is assessed unless another number is asked for: the first of these that the reference has.
const ASSESSED: &[&Quantity] = &[
    &q::TRANSPORT_RATE,
    &q::BED_FLUX,
    &q::STREAM_MAX,
    &q::FLOW_RATE,
    &q::PLUG_VELOCITY,
    &q::DISCHARGE,
    &q::MEAN_VELOCITY,
    &q::U_MAX,
    &q::ROUGHNESS_LENGTH,
];
/// Errors below this are round-off and drawn there.
const ROUND_OFF: f64 = 1e-16;
/// Solutions of which the median is taken, where they are fast.
const REPEATS: usize = 5;
/// Series of the point that the others are measured against.
const REFERENCE: &str = "reference";
/// Accuracies that a user may want.
const WANTED: [f64; 4] = [0.1, 1e-2, 1e-4, 1e-6];
/// A point that costs this many times more than one with no larger error is reported as not worth its cost.
const EXCESS: f64 = 2.0;

/// What the user asks for.
#[derive(Clone, Debug)]
pub struct Request {
    /// the scene, and other models of it: files or shipped cases
    pub cases: Vec<String>,
    /// `--set` arguments, for the first and other models of its file
    pub overrides: Vec<String>,
    /// name of the number that is assessed
    pub quantity: Option<String>,
    /// folder of a finished run, `exact` or `finest`
    pub reference: Option<String>,
}

/// The number that errors are measured against.
#[derive(Clone, Debug)]
struct ReferenceValue {
    quantity: &'static Quantity,
    value: f64,
    /// its standard error
    error: Option<f64>,
    words: String,
}

/// A point that has an error and a cost.
#[derive(Clone, Copy, Debug)]
struct Assessed {
    row: usize,
    cost: f64,
    error: f64,
}

/// The plan of a chart, and how to assess it.
///
/// # Errors
/// [`StudyError::Case`] if any case is wrong as it stands; [`StudyError::BadReference`].
pub fn plan(registry: &Registry, request: &Request) -> Result<(Plan, Assess), StudyError> {
    let Some((first, others)) = request.cases.split_first() else {
        return Err(StudyError::BadOver { argument: String::new(), reason: "there is no case".into() });
    };
    let overrides = overrides_of(&request.cases, &request.overrides, first);
    let (_, problem) = registry.load(first, &overrides).map_err(Box::new)?;
    let mut points = accepted(registry, rungs(None, &problem), first, &overrides);
    for case in others {
        let overrides = overrides_of(&request.cases, &request.overrides, case);
        let problem = registry.load(case, &overrides).map_err(Box::new)?.1;
        let mut more = accepted(registry, rungs(Some(case), &problem), case, &overrides);
        more.iter_mut().for_each(|point| point.overrides = [&overrides, point.overrides.as_slice()].concat());
        let alone = more.iter().all(|point| point.series == problem.kind);
        for point in &mut more {
            point.series = if alone { case.clone() } else { format!("{case}, {}", point.series) };
        }
        points.extend(more);
    }
    let (given, exact) = requested(request, &problem)?;
    if given.is_none()
        && exact.is_none()
        && let Some((words, overrides)) = problem.solver().study().finest
    {
        points.insert(0, Point { case: None, series: REFERENCE.into(), values: vec![words], overrides });
    }
    let mut options: Vec<(String, String)> = others.iter().map(|case| ("case".into(), case.clone())).collect();
    options.extend(request.quantity.iter().map(|name| ("quantity".into(), name.clone())));
    options.extend(request.reference.iter().map(|name| ("reference".into(), name.clone())));
    let plan = Plan {
        verb: "chart",
        case: first.clone(),
        overrides,
        options,
        varied: vec![KEY.into()],
        points,
        repeats: REPEATS,
    };
    let name = request.quantity.clone();
    Ok((plan, Box::new(move |rows: &[Row]| assess(rows, name.as_deref(), given.or(exact).as_ref()))))
}

/// A value with its standard error, if a reference has it.
type Value = Box<dyn Fn(&Quantity) -> Option<(f64, Option<f64>)> + Send>;

/// Numbers of a reference: their place in words, and each with its value and standard error.
struct Numbers(String, Value);

/// The reference that was asked for, or the closed form of the scene.
fn requested(request: &Request, problem: &Problem) -> Result<(Option<Numbers>, Option<Numbers>), StudyError> {
    let bad = |argument: &str, reason: String| StudyError::BadReference { argument: argument.into(), reason };
    let exact = || {
        let form = problem.solver().closed_form()?;
        Some(Numbers("the closed form".into(), Box::new(move |q| Some((form.results().get(q.name)?, None)))))
    };
    match request.reference.as_deref() {
        None => Ok((None, exact())),
        Some("finest") => Ok((None, None)),
        Some("exact") => match exact() {
            Some(form) => Ok((None, Some(form))),
            None => Err(bad("exact", format!("{} has no closed form", problem.kind))),
        },
        Some(folder) => {
            let (summary, _) = read_run(Path::new(folder)).map_err(|error| bad(folder, error.to_string()))?;
            if summary.status != Status::Done && summary.status != Status::Stopped {
                return Err(bad(folder, format!("it is {}", summary.status)));
            }
            let of = move |q: &Quantity| {
                let (_, reported) = summary.results.iter().find(|(name, _)| *name == q.name)?;
                Some((reported.value?, reported.stderr))
            };
            Ok((Some(Numbers(format!("the run in {folder}"), Box::new(of))), None))
        }
    }
}

/// What the rows are measured against.
fn reference(rows: &[Row], wanted: Option<&str>, numbers: Option<&Numbers>) -> Option<ReferenceValue> {
    // Without a reference of its own, the finest point, else the last one of the first series that is done.
    let first = rows.first().map(|row| row.point.series.as_str());
    let done = |row: &&Row| row.status == Status::Done;
    let point = rows
        .iter()
        .find(|row| row.point.series == REFERENCE)
        .filter(done)
        .or_else(|| rows.iter().rfind(|row| Some(row.point.series.as_str()) == first && done(row)));
    let of = |quantity: &'static Quantity| -> Option<ReferenceValue> {
        let (value, error, words) = match numbers {
            Some(Numbers(words, of)) => of(quantity).map(|(value, error)| (value, error, words.clone()))?,
            None => {
                let row = point?;
                let (_, reported) = row.results.iter().find(|(name, _)| *name == quantity.name)?;
                (reported.value?, reported.stderr, row.point.values.first().cloned().unwrap_or_default())
            }
        };
        (value != 0.0).then_some(ReferenceValue { quantity, value, error, words })
    };
    let named = wanted.and_then(|name| q::find(q::RESULTS, name));
    match wanted {
        Some(_) => of(named?),
        None => ASSESSED.iter().find_map(|quantity| of(quantity)),
    }
}

/// Cells times iterations, or grains times steps, as the run counted them.
fn work(row: &Row) -> Option<f64> {
    Some(row.cost.work_units).filter(|work| *work > 0.0)
}

fn assess(rows: &[Row], wanted: Option<&str>, numbers: Option<&Numbers>) -> Assessment {
    let Some(reference) = reference(rows, wanted, numbers) else {
        let text = "no point gives the number that is assessed, or the reference has none".to_owned();
        return Assessment { findings: vec![("no chart".into(), text)], ..Assessment::default() };
    };
    let error = |row: &Row| {
        let value = row.result(reference.quantity.name).filter(|_| row.status == Status::Done)?;
        let itself = row.point.series == REFERENCE
            || numbers.is_none() && row.point.values.first() == Some(&reference.words) && value == reference.value;
        (!itself).then(|| (value / reference.value - 1.0).abs().max(ROUND_OFF))
    };
    let errors: Vec<Option<f64>> = rows.iter().map(error).collect();
    let assessed: Vec<Assessed> = rows
        .iter()
        .zip(&errors)
        .enumerate()
        .filter_map(|(row, (of, error))| Some(Assessed { row, cost: of.cost.solve_s, error: (*error)? }))
        .collect();
    let front = front(&assessed);
    let on = |i: usize| f64::from(u8::from(front.iter().any(|j| j.row == i)));
    let mut assessment = Assessment {
        subtitle: format!(
            "Error of the {} against {}: {}. Times are medians of up to {REPEATS} solutions.",
            reference.quantity.title,
            reference.words,
            readable_known(reference.value, reference.error, reference.quantity.unit),
        ),
        measures: vec![
            ("error".into(), errors.clone()),
            ("on_front".into(), errors.iter().enumerate().map(|(i, e)| e.map(|_| on(i))).collect()),
            ("work".into(), rows.iter().map(work).collect()),
            ("spread_s".into(), rows.iter().map(|row| row.cost.spread_s).collect()),
        ],
        ..Assessment::default()
    };
    assessment.findings = findings(rows, &assessed, &front, &reference);
    assessment.facts.insert("quantity".into(), json!(reference.quantity.name));
    assessment.facts.insert(
        "reference".into(),
        json!({ "value": reference.value, "stderr": reference.error, "what": reference.words }),
    );
    assessment.facts.insert("front".into(), front.iter().map(|j| json!(name(&rows[j.row]))).collect());
    assessment.figures.push(figure(rows, &assessed, &front, &reference));
    assessment
}

fn name(row: &Row) -> String {
    let setting = row.point.values.first().map_or("", String::as_str);
    format!("{}, {setting}", row.point.series)
}

/// Those that none beats in both, from the cheapest on.
fn front(assessed: &[Assessed]) -> Vec<Assessed> {
    let mut by_cost = assessed.to_vec();
    by_cost.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.error.total_cmp(&b.error)));
    let mut front: Vec<Assessed> = Vec::new();
    for one in by_cost {
        if front.last().is_none_or(|last| one.error < last.error) {
            front.push(one);
        }
    }
    front
}

/// A time for readers: `53.1 µs`, `2.20 ms`, `14.0 s`.
pub(super) fn time_text(seconds: f64) -> String {
    let (factor, unit) = match seconds {
        s if s < 1e-3 => (1e6, "µs"),
        s if s < 1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    format!("{} {unit}", significant(factor * seconds, 3))
}

fn findings(
    rows: &[Row],
    assessed: &[Assessed],
    front: &[Assessed],
    reference: &ReferenceValue,
) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut last = usize::MAX;
    for wanted in WANTED {
        let Some(one) = front.iter().find(|j| j.error <= wanted).filter(|j| j.row != last) else { continue };
        last = one.row;
        let text = format!("{} ({}) in {}", name(&rows[one.row]), error_text(one.error), time_text(one.cost));
        found.push((format!("for {}", error_text(wanted)), text));
    }
    let excess = |j: &Assessed| {
        let better = front.iter().find(|f| f.error <= j.error)?;
        (better.row != j.row).then_some((j.cost / better.cost, *j, *better))
    };
    let worst = assessed.iter().filter_map(excess).max_by(|a, b| a.0.total_cmp(&b.0)).filter(|w| w.0 > EXCESS);
    if let Some((times, bad, good)) = worst {
        let text = format!(
            "{} takes {} for {}: {} is as good in {}, {} times faster",
            name(&rows[bad.row]),
            time_text(bad.cost),
            error_text(bad.error),
            name(&rows[good.row]),
            time_text(good.cost),
            significant(times, 2)
        );
        found.push(("not worth its cost".into(), text));
    }
    if let Some(error) = reference.error {
        let inside = assessed.iter().filter(|j| j.error <= (error / reference.value).abs()).count();
        found.push(("within the error of the reference".into(), format!("{inside} of {} points", assessed.len())));
    }
    found
}

/// Error over time and over work; the failed at the top.
fn figure(rows: &[Row], assessed: &[Assessed], front: &[Assessed], reference: &ReferenceValue) -> Figure {
    let mut series: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| row.point.series != REFERENCE) {
        if !series.contains(&row.point.series.as_str()) {
            series.push(&row.point.series);
        }
    }
    let top = 3.0 * assessed.iter().map(|j| j.error).fold(1.0 / 3.0, f64::max);
    let note = |row: &Row, error: f64| {
        let work = work(row).map(|w| format!(", {} units of work", significant(w, 3))).unwrap_or_default();
        format!("{}: {} in {}{work}", name(row), error_text(error), time_text(row.cost.solve_s))
    };
    let panel = |x: Axis, cost: &dyn Fn(&Row) -> Option<f64>, named: bool| {
        let mut curves: Vec<Curve> = Vec::new();
        let along = front.iter().filter_map(|j| Some((cost(&rows[j.row])?, j.error)));
        curves.push(Curve {
            name: if named { "Pareto front".into() } else { String::new() },
            points: if named { along.map(Some).collect() } else { Vec::new() },
            line: named.then_some(Dash::Dotted),
            ..Curve::default()
        });
        for (i, series_name) in series.iter().enumerate() {
            let of = assessed.iter().filter(|j| rows[j.row].point.series == **series_name);
            let mut of: Vec<(f64, f64, String)> =
                of.filter_map(|j| Some((cost(&rows[j.row])?, j.error, note(&rows[j.row], j.error)))).collect();
            of.sort_by(|a, b| a.0.total_cmp(&b.0));
            curves.push(Curve {
                name: if named { (*series_name).to_owned() } else { String::new() },
                points: of.iter().map(|p| Some((p.0, p.1))).collect(),
                notes: of.into_iter().map(|p| p.2).collect(),
                colour: i + 1,
                marker: Some([Marker::Circle, Marker::Square, Marker::Triangle][i % 3]),
                ..Curve::default()
            });
        }
        let failed: Vec<&Row> = rows.iter().filter(|row| row.status == Status::Failed).collect();
        let placed = |row: &&Row| Some((cost(row).filter(|c| *c > 0.0)?, top));
        if failed.iter().any(|row| placed(row).is_some()) {
            curves.push(Curve {
                name: if named { "failed, where it ended".into() } else { String::new() },
                points: failed.iter().map(placed).collect(),
                notes: failed.iter().map(|row| format!("{}: {}", name(row), row.reason())).collect(),
                marker: Some(Marker::Cross),
                ..Curve::default()
            });
        }
        Panel { x, curves }
    };
    let panels = vec![
        panel(Axis::log("time to solve", "s"), &|row| Some(row.cost.solve_s).filter(|s| *s > 0.0), true),
        panel(Axis::log("work: cells × iterations, grains × steps", "1"), &work, false),
    ];
    let band = reference.error.map(|e| (e / reference.value).abs()).filter(|e| *e > 0.0);
    Figure {
        stem: "chart".into(),
        caption: format!(
            "Error of the {} against {}, over (a) the time of one solution and (b) the units of work. Dotted: the points that none beats in both.",
            reference.quantity.title, reference.words
        ),
        y: Axis::log(&format!("error of the {}", reference.quantity.title), "1"),
        panels,
        levels: band.map(|y| Level { y, label: "error of the reference".into() }).into_iter().collect(),
        tint_below: band,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_none_beats() {
        let of = |(row, &(cost, error)): (usize, &(f64, f64))| Assessed { row, cost, error };
        let points = [(1.0, 0.5), (2.0, 0.6), (3.0, 0.1), (3.0, 0.2), (9.0, 0.1), (10.0, 0.01)];
        let assessed: Vec<Assessed> = points.iter().enumerate().map(of).collect();
        let found: Vec<usize> = front(&assessed).iter().map(|j| j.row).collect();
        assert_eq!(found, [0, 2, 5]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn what_cannot_be_a_reference_is_refused() {
        let request = |case: &str, reference: &str| {
            let (cases, reference) = (vec![case.into()], Some(reference.into()));
            Request { cases, overrides: Vec::new(), quantity: None, reference }
        };
        for (case, reference, words) in [
            ("sheet_1d_sumer91", "exact", "sheet-flow has no closed form"),
            ("sheet_1d_sumer91", "no/such/folder", "no/such/folder"),
        ] {
            let error = plan(&crate::models::builtin(), &request(case, reference)).err().unwrap().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
