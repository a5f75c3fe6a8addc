//! Where a method ends: what came of a point, and the limit between two of which one holds.

use super::curves::error_text;
use super::range::{Varied, number_and_unit, parse};
use super::{Row, StudyError};
use crate::case::CaseError;
use crate::model::ClosedForm;
use crate::model::Registry;
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Class, Context, Results, Verdict};

/// What is assessed: the first of these that a point and its closed form have.
const ASSESSED: &[&Quantity] = &[&q::TRANSPORT_RATE, &q::PLUG_VELOCITY, &q::RESTITUTION, &q::FLOW_RATE];
/// A point whose neighbour holds is solved again between them if it takes no longer than this \[s].
const PATIENCE: f64 = 30.0;
/// Relative width to which a limit is bisected.
const WIDTH: f64 = 1e-3;
/// Errors below this are round-off and drawn there.
const ROUND_OFF: f64 = 1e-16;
/// Most solutions for one limit.
const HALVINGS: usize = 24;

/// What the user asks for.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Request {
    /// file or shipped case
    pub case: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// one or two `--over` arguments
    pub over: Vec<String>,
    /// largest error of an answer that holds
    pub tolerance: f64,
    /// the limit that the case predicts, in the unit of the first key
    pub predicted: Option<f64>,
}

impl Request {
    /// The case as it stands over one key or two, with answers that hold within 1 %.
    #[must_use]
    pub fn new(case: &str, over: Vec<String>) -> Self {
        Self { case: case.into(), overrides: Vec::new(), over, tolerance: 0.01, predicted: None }
    }
}

/// A point with its class, the error of its answer, and why it fails.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub class: Class,
    pub error: Option<f64>,
    pub reason: String,
}

/// A limit along the first key.
#[derive(Clone, Debug)]
pub struct Limit {
    /// values of the other key
    pub series: String,
    /// value with which the method holds
    pub holds: f64,
    /// value with which it does not
    pub fails: f64,
    /// what it is then
    pub class: Class,
    /// and why
    pub reason: String,
}

/// The class of what was solved; `broken` is whether a premise of its model is.
pub(super) fn solved(request: &Request, form: Option<Box<dyn ClosedForm>>, results: &Results, broken: bool) -> Found {
    let rate = q::TRANSPORT_RATE.name;
    if let Some(reason) = results.reason(rate).filter(|_| broken && results.get(rate).is_none()) {
        return Found { class: Class::Unphysical, error: None, reason: reason.to_owned() };
    }
    let error = form.and_then(|form| {
        let of = |q: &&&Quantity| Some((results.get(q.name)?, form.results().get(q.name).filter(|x| *x != 0.0)?));
        ASSESSED.iter().find_map(|q| of(&q)).map(|(value, exact)| (value / exact - 1.0).abs().max(ROUND_OFF))
    });
    if let Some(c) = results.get(q::WELL_POSEDNESS.name).filter(|c| *c > 0.0) {
        let reason = format!("ill-posed in two and three dimensions, C = {c:.3}: this flow in one dimension hides it");
        return Found { class: Class::Unphysical, error, reason };
    }
    let class = if error.is_some_and(|e| e > request.tolerance) { Class::Inaccurate } else { Class::Holds };
    let reason = error.map(|e| format!("error {}", error_text(e))).unwrap_or_default();
    Found { class, error, reason }
}

/// Runs the case with one more value, without a folder.
fn attempt(registry: &Registry, request: &Request, overrides: &[String]) -> Found {
    let failed = |class, reason: String| Found { class, error: None, reason };
    let load = || -> Result<_, CaseError> {
        registry.load(&request.case, &[&request.overrides[..], overrides].concat()).map(|(_, problem)| problem)
    };
    match load() {
        Err(error) => {
            let reason = error.reports().into_iter().next().map(|r| r.message).unwrap_or_default();
            failed(Class::Refused, reason)
        }
        Ok(problem) => match Context::quiet(|context| problem.run(context)) {
            Ok(outcome) => {
                let broken = outcome.regime.iter().any(|premise| premise.verdict == Verdict::Broken);
                solved(request, problem.solver().closed_form(), &outcome.results, broken)
            }
            Err(failure) => failed(failure.error.class(), failure.error.to_string()),
        },
    }
}

/// The limit between two values of a key of which one holds.
fn bisect(
    registry: &Registry,
    request: &Request,
    (key, unit): (&str, &str),
    rest: &[String],
    ends: [(f64, &Found); 2],
    halvings: usize,
) -> Limit {
    let [(a, x), (b, y)] = ends;
    let (mut holds, mut fails, mut worst) = if x.class == Class::Holds { (a, b, y.clone()) } else { (b, a, x.clone()) };
    let whole = halvings > 0 && takes_whole_numbers(registry, request, key);
    for _ in 0..halvings {
        let mut middle = if holds > 0.0 && fails > 0.0 { (holds * fails).sqrt() } else { 0.5 * (holds + fails) };
        if whole {
            middle = middle.round();
        }
        if (holds - fails).abs() <= WIDTH * holds.abs().max(fails.abs()) || middle == holds || middle == fails {
            break;
        }
        let mut overrides = vec![format!("{key}={middle:e} {unit}").trim().to_owned()];
        overrides.extend_from_slice(rest);
        let one = attempt(registry, request, &overrides);
        if one.class == Class::Holds {
            holds = middle;
        } else {
            (fails, worst) = (middle, one);
        }
    }
    Limit { series: String::new(), holds, fails, class: worst.class, reason: worst.reason }
}

/// Whether the key of the case is a whole number.
fn takes_whole_numbers(registry: &Registry, request: &Request, key: &str) -> bool {
    let Ok((case, _)) = registry.load(&request.case, &request.overrides) else { return false };
    let Ok(table) = case.resolved().parse::<toml::Table>() else { return false };
    let value = key.split('.').try_fold(toml::Value::Table(table), |value, part| value.get(part).cloned());
    value.is_some_and(|value| value.is_integer())
}

/// What is found along a key.
#[derive(Clone, Debug)]
pub enum Along {
    /// the first limit
    Ends(Limit),
    /// every value holds
    Holds,
    /// none does, the first for this reason
    Fails(String),
}

/// The first limit along the one key of a request, without a folder.
///
/// # Errors
/// [`StudyError::BadOver`] with what is wrong in the argument.
pub fn first(registry: &Registry, request: &Request) -> Result<Along, StudyError> {
    let bad = |reason: &str| StudyError::BadOver { argument: request.over.join(" --over "), reason: reason.into() };
    let [over] = &request.over[..] else { return Err(bad("one key")) };
    let varied = parse(over)?;
    let mut last: Option<(f64, Found)> = None;
    for value in &varied.values {
        let (number, unit) = number_and_unit(value).ok_or_else(|| bad("the key takes numbers"))?;
        let found = attempt(registry, request, &[format!("{}={value}", varied.key)]);
        if let Some((before, known)) = &last
            && (known.class == Class::Holds) != (found.class == Class::Holds)
        {
            let ends = [(*before, known), (number, &found)];
            return Ok(Along::Ends(bisect(registry, request, (&varied.key, unit), &[], ends, HALVINGS)));
        }
        last = Some((number, found));
    }
    Ok(match last {
        Some((_, Found { class: Class::Holds, .. })) => Along::Holds,
        Some((_, Found { reason, .. })) => Along::Fails(reason),
        None => Along::Holds,
    })
}

/// The limits between neighbours of a series, each bisected.
pub(super) fn limits(
    registry: &Registry,
    request: &Request,
    varied: &[Varied],
    rows: &[Row],
    found: &[Found],
) -> Vec<Limit> {
    let Some(key) = varied.first() else { return Vec::new() };
    let place = |row: &'_ Row| -> Option<(f64, String)> {
        row.point.values.first().and_then(|v| number_and_unit(v)).map(|(x, unit)| (x, unit.to_owned()))
    };
    let mut limits = Vec::new();
    for (pair, what) in rows.windows(2).zip(found.windows(2)) {
        let ([a, b], [x, y]) = (pair, what) else { continue };
        let alike = a.point.series == b.point.series && (x.class == Class::Holds) != (y.class == Class::Holds);
        let (Some((va, unit)), Some((vb, _))) = (place(a), place(b)) else { continue };
        if !alike {
            continue;
        }
        let patient = a.cost.solve_s.max(b.cost.solve_s) < PATIENCE;
        let rest = a.point.overrides.get(1..).unwrap_or_default();
        let ends = [(va, x), (vb, y)];
        let halvings = if patient { HALVINGS } else { 0 };
        limits.push(Limit {
            series: a.point.series.clone(),
            ..bisect(registry, request, (&key.key, &unit), rest, ends, halvings)
        });
    }
    limits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_has_the_class_of_its_error_and_a_bad_case_is_refused() {
        let request = Request {
            case: "bed_ouriemi-laminar".into(),
            overrides: Vec::new(),
            over: Vec::new(),
            tolerance: 0.5,
            predicted: None,
        };
        let class = |set: &str| attempt(&crate::models::builtin(), &request, &[set.to_owned()]).class;
        assert_eq!(class("grid.cells=48"), Class::Holds);
        assert_eq!(class("flow.pressure_gradient=1e5"), Class::Unphysical);
        assert_eq!(class("bed.phi=0.9"), Class::Refused);
    }
}
