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

mod assessment;
mod figures;
mod parameters;
mod target;

use std::ops::ControlFlow;

pub use parameters::Parameters;
pub use target::{Column, Level, Target};

use super::Assess;
use super::{Assessment, Next, Observer, Plan, Point, StudyError};
use crate::compare::{Subject, data};
use crate::model::Registry;
use crate::numerics::least_squares::Statistics;
use crate::output::fingerprint;
use crate::result::quantity::Quantity;
use crate::result::{ErrorReport, Quiet, Snapshot, Watch, codes};

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
#[non_exhaustive]
pub struct Request {
    /// file or shipped case
    pub case: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// profile CSV
    pub data: String,
    /// numbers that are fitted: `table.key`, or an ending that only one has, with `=lower:upper` where they are bounded
    pub fit: Vec<String>,
    /// columns of the data that are fitted; empty for all that the model has
    pub columns: Vec<String>,
    /// one sigma for values without one: a number, or `column=number` \[SI]
    pub sigma: Vec<String>,
}

impl Request {
    /// The case as it stands, and all columns of the data with the errors that they state.
    #[must_use]
    pub fn new(case: &str, data: &str, fit: Vec<String>) -> Self {
        let (overrides, columns, sigma) = (Vec::new(), Vec::new(), Vec::new());
        Self { case: case.into(), overrides, data: data.into(), fit, columns, sigma }
    }
}

/// Why there is no fit, besides what its case says.
pub(crate) enum Unfit {
    NoInfluence,
    Blocked,
    NotConverged,
    Undefined,
    NoProfile,
    Refused,
}

codes!(Unfit {
    Self::NoInfluence => "no-influence",
    Self::Blocked => "fit-blocked",
    Self::NotConverged => "fit-not-converged",
    Self::Undefined => "data-undefined",
    Self::NoProfile => "no-profile",
    Self::Refused => "refused",
});

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
pub fn plan(registry: &Registry, request: &Request) -> Result<(Plan, Next), StudyError> {
    let parameters = Parameters::of(registry, request)?;
    let measured = data::read(request.data.as_ref())?;
    let text = std::fs::read(&request.data).unwrap_or_default();
    let start: Vec<f64> = parameters.start.iter().map(|p| p.ln()).collect();
    let next: Next = match parameters.profile(&start, &mut Quiet) {
        Ok(profile) => {
            let target = Target::of(&measured, &profile, &request.columns, &request.sigma, parameters.keys.len())?;
            let parameters = parameters.clone();
            Box::new(move |_, observer| follow(parameters, measured, target, observer))
        }
        Err(error) if error.code == Unfit::NoProfile.code() => {
            let hint = "fit a case with a profile".into();
            return Err(StudyError::BadData { file: request.case.clone(), reason: error.message, hint });
        }
        Err(error) => Box::new(|_, _| failed(error)),
    };
    let listed = |name: &str, list: &[String]| (!list.is_empty()).then(|| (name.to_owned(), list.join(", ")));
    let mut options = vec![("to".to_owned(), request.data.clone())];
    options.push(("to_sha256".into(), fingerprint(&String::from_utf8_lossy(&text))));
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

/// No fit at all.
fn failed(error: ErrorReport) -> (Vec<Point>, Assess) {
    (Vec::new(), Box::new(move |_| Assessment { failure: Some(error), ..Assessment::default() }))
}

/// The fit: the point where it ended, and what is reported of it.
fn follow(parameters: Parameters, data: Subject, target: Target, observer: &dyn Observer) -> (Vec<Point>, Assess) {
    match parameters.fit(&target, observer) {
        Err(error) => failed(error),
        Ok(fit) => {
            let series = if fit.ended.is_ok() { "fitted" } else { "last" };
            let point = point(&parameters, series, &fit.x);
            let known = target.known;
            let of = |j| Statistics::of(&fit.residuals, j, &fit.at_bound, known);
            let statistics = fit.jacobian.as_ref().and_then(of);
            let found = assessment::Found { parameters, data, target, fit, statistics };
            (vec![point], Box::new(move |rows| found.assess(rows)))
        }
    }
}
