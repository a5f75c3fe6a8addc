//! `calibrate`: numbers of a case fitted to a measured profile, and how well they are known.
//!
//! ```text
//! minimise over ln p   Σ ((model(p, z_i) - data_i)/σ_i)²          Levenberg-Marquardt, [`least_squares`]
//! covariance of ln p   s² (Jᵀ J)⁻¹,  J = d residual/d ln p         s² = 1 where σ is known, else χ² per degree of freedom
//! standard error of p  p times that of ln p
//! ```
//!
//! The parameters are positive and often span decades, hence the logarithms. Two whose correlation is beyond [`ALIKE`] cannot
//! be told apart by the data, one whose standard error is more than its value is not determined.

mod judge;
mod target;

use std::ops::ControlFlow;

pub use target::{Column, Level, Target};

use super::converge::Judge;
use super::{Judgement, Next, Observer, Plan, Point, StudyError};
use crate::case::nearest;
use crate::compare::{Subject, data};
use crate::numerics::least_squares::{self, Fit, Statistics};
use crate::output::fingerprint;
use crate::problem::Problem;
use crate::result::quantity::Quantity;
use crate::result::{ErrorReport, Profile, Quiet, Snapshot, Watch};

/// Magnitude of the correlation from which two parameters cannot be told apart.
pub const ALIKE: f64 = 0.95;

/// What progress shows.
static MISFIT: Quantity = Quantity {
    name: "misfit",
    title: "misfit",
    symbol: "χ/√N",
    unit: "1",
    definition: "root mean square of the weighted residuals",
};

/// What the user asks for.
#[derive(Clone, Debug)]
pub struct Request {
    /// file or shipped case
    pub case: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// profile CSV
    pub data: String,
    /// keys that are fitted, `table.key`
    pub fit: Vec<String>,
    /// columns of the data that are fitted; empty for all that the model has
    pub columns: Vec<String>,
    /// one sigma for values without one: a number, or `column=number` [SI]
    pub sigma: Vec<String>,
}

/// The numbers of a case that are fitted.
#[derive(Clone, Debug)]
pub struct Parameters {
    case: String,
    overrides: Vec<String>,
    /// `table.key`
    pub keys: Vec<String>,
    /// the shortest endings of the keys that tell them apart
    pub names: Vec<String>,
    /// values of the case [SI]
    pub start: Vec<f64>,
}

impl Parameters {
    /// Finds what `request` wants to fit in its case.
    ///
    /// # Errors
    /// [`StudyError::Case`], and [`StudyError::BadFit`] for a key that holds no positive number.
    pub fn of(request: &Request) -> Result<Self, StudyError> {
        let (case, _) = Problem::load(&request.case, &request.overrides).map_err(Box::new)?;
        let (numbers, others) = case.numbers();
        // What describes the file, the mesh or the method is no property of the scene.
        let apart = |key: &str| ["case.", "check.", "grid.", "solver.", "output."].iter().any(|t| key.starts_with(t));
        let known: Vec<&str> = numbers.iter().map(|n| n.0.as_str()).filter(|key| !apart(key)).collect();
        let mut start = Vec::new();
        for (i, key) in request.fit.iter().enumerate() {
            let bad = |reason: &str, hint: String| {
                Err(StudyError::BadFit { key: key.clone(), reason: reason.to_owned(), hint })
            };
            let all = || format!("numbers of this case: {}", known.join(", "));
            if request.fit[..i].contains(key) {
                return bad("given twice", "leave one out".into());
            }
            match numbers.iter().find(|(known, _)| known == key) {
                Some((_, value)) if known.contains(&key.as_str()) && *value > 0.0 => start.push(*value),
                Some((_, value)) if known.contains(&key.as_str()) => {
                    let reason = format!("it is {value}, and the logarithm of a number is fitted");
                    return bad(&reason, format!("start from a positive one: --set {key}=..."));
                }
                None if others.contains(key) => return bad("not a number, or a count", all()),
                None if case.resolved().contains(&format!("[{key}]")) => return bad("a table, not a number", all()),
                Some(_) => return bad("no property of the scene", all()),
                None => {
                    let near = nearest(key, known.iter().copied());
                    let meant = near.map(|near| format!("did you mean {near}? ")).unwrap_or_default();
                    return bad("the case has no such number", meant + &all());
                }
            }
        }
        let names = request.fit.iter().map(|key| short(key, &request.fit)).collect();
        let (case, overrides) = (request.case.clone(), request.overrides.clone());
        Ok(Self { case, overrides, keys: request.fit.clone(), names, start })
    }

    /// What is set in the case for these logarithms.
    #[must_use]
    pub fn settings(&self, ln: &[f64]) -> Vec<String> {
        self.keys.iter().zip(ln).map(|(key, x)| format!("{key}={:e}", x.exp())).collect()
    }

    /// The profile of the case with these logarithms.
    ///
    /// # Errors
    /// Why the case is refused, or fails.
    pub fn profile(&self, ln: &[f64], watch: &mut dyn Watch) -> Result<Profile, ErrorReport> {
        let overrides = [&self.overrides[..], &self.settings(ln)].concat();
        let (_, problem) = Problem::load(&self.case, &overrides).map_err(|error| {
            error.reports().into_iter().next().unwrap_or_else(|| report("refused", error.to_string()))
        })?;
        let outcome = crate::run(&problem, watch).map_err(|failure| ErrorReport {
            hint: Some(failure.error.hint()),
            ..report(failure.error.code(), failure.error.to_string())
        })?;
        outcome.profile.ok_or_else(|| report("no-profile", "the model has no profile".into()))
    }

    /// Fits the parameters to `target`, from the values of the case.
    ///
    /// # Errors
    /// Why the start has no answer. Further failures are in [`Fit::ended`].
    pub fn fit(&self, target: &Target, observer: &dyn Observer) -> Result<Fit<ErrorReport>, ErrorReport> {
        let residuals = |ln: &[f64]| {
            if observer.stop() {
                return Err(report("stopped", "stopped by the user".into()));
            }
            target.residuals(&self.profile(ln, &mut Listening(observer))?)
        };
        let start: Vec<f64> = self.start.iter().map(|p| p.ln()).collect();
        let (count, first) = ((target.count() as f64).sqrt(), std::cell::Cell::new(None));
        let see = |norm: f64| {
            let before = first.get().unwrap_or(norm);
            first.set(Some(before));
            let fraction = if before > 0.0 { 1.0 - norm / before } else { 1.0 };
            observer.see(&Snapshot { stage: "fit", fraction, quantity: Some((&MISFIT, norm / count)) });
        };
        least_squares::minimise(&start, &residuals, &see)
    }
}

/// The last segments of a key, as many as tell it from all others.
fn short(key: &str, all: &[String]) -> String {
    let ending = |key: &str, n: usize| key.rsplit('.').take(n).map(str::to_owned).collect::<Vec<_>>();
    let alone = |n: &usize| all.iter().filter(|other| ending(other, *n) == ending(key, *n)).count() <= 1;
    let mut parts = ending(key, (1..4).find(alone).unwrap_or(4));
    parts.reverse();
    parts.join(".")
}

fn report(code: &str, message: String) -> ErrorReport {
    ErrorReport { code: code.into(), message, path: None, line: None, allowed: None, hint: None }
}

/// Asks a run to stop when the study is asked to.
struct Listening<'a>(&'a dyn Observer);

impl Watch for Listening<'_> {
    fn see(&mut self, _: &Snapshot<'_>) -> ControlFlow<()> {
        if self.0.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The plan of a calibration, the case as it is, and what follows from it: the fit, its case, and what it says.
///
/// # Errors
/// [`StudyError::Case`], [`StudyError::BadFit`], [`StudyError::BadSigma`], [`StudyError::BadData`], [`StudyError::Data`].
pub fn plan(request: &Request) -> Result<(Plan, Next), StudyError> {
    let parameters = Parameters::of(request)?;
    let measured = data::read(request.data.as_ref())?;
    let text = std::fs::read(&request.data).unwrap_or_default();
    let start: Vec<f64> = parameters.start.iter().map(|p| p.ln()).collect();
    let next: Next = match parameters.profile(&start, &mut Quiet) {
        Ok(profile) => {
            let target = Target::of(&measured, &profile, &request.columns, &request.sigma, parameters.keys.len())?;
            let parameters = parameters.clone();
            Box::new(move |_, observer| follow(parameters, measured, target, observer))
        }
        // The first point says why.
        Err(_) => Box::new(|_, _| (Vec::new(), Box::new(|_| Judgement::default()))),
    };
    let listed = |name: &str, list: &[String]| (!list.is_empty()).then(|| (name.to_owned(), list.join(", ")));
    let mut options = vec![("data".to_owned(), request.data.clone())];
    options.push(("data_sha256".into(), fingerprint(&String::from_utf8_lossy(&text))));
    options.extend(
        [("fit", &request.fit), ("column", &request.columns), ("sigma", &request.sigma)]
            .iter()
            .filter_map(|(n, l)| listed(n, l)),
    );
    let plan = Plan {
        verb: "calibrate",
        case: request.case.clone(),
        overrides: request.overrides.clone(),
        options,
        varied: parameters.keys.clone(),
        points: vec![point(&parameters, "start", &start)],
        repeats: 1,
    };
    Ok((plan, next))
}

fn point(parameters: &Parameters, series: &str, ln: &[f64]) -> Point {
    let overrides = parameters.settings(ln);
    let value = |set: &String| set.split_once('=').map(|(_, value)| value.to_owned()).unwrap_or_default();
    let values = overrides.iter().map(value).collect();
    Point { case: None, series: series.into(), values, overrides }
}

/// The fit: the point where it ended, and what is to be said of it.
fn follow(parameters: Parameters, data: Subject, target: Target, observer: &dyn Observer) -> (Vec<Point>, Judge) {
    let nothing = |error: ErrorReport| -> (Vec<Point>, Judge) {
        (Vec::new(), Box::new(move |_| Judgement { failure: Some(error), ..Judgement::default() }))
    };
    match parameters.fit(&target, observer) {
        Err(error) => nothing(error),
        Ok(fit) => {
            let series = if fit.ended.is_ok() { "fitted" } else { "last" };
            let point = point(&parameters, series, &fit.x);
            let known = target.known;
            let statistics = fit.jacobian.as_ref().and_then(|j| Statistics::of(&fit.residuals, j, known));
            let found = judge::Found { parameters, data, target, fit, statistics };
            (vec![point], Box::new(move |rows| found.judge(rows)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_as_short_as_they_can_be() {
        let keys = ["closures.friction.mu_2", "closures.dilatancy.phi_max", "closures.mixing_length.phi_max"];
        let keys = keys.map(str::to_owned);
        let names: Vec<String> = keys.iter().map(|key| short(key, &keys)).collect();
        assert_eq!(names, ["mu_2", "dilatancy.phi_max", "mixing_length.phi_max"]);
    }
}
