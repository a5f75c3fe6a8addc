//! Closed forms: the least that a scene can cost, and the reference for the solvers of the same equations.

pub mod bagnold;
mod bagnold_case;
pub mod bed;
pub(in crate::models) mod bed_results;
pub mod bingham;
mod bingham_case;
mod brinkman;
mod error;
pub mod log_law;
mod log_law_case;
pub mod ouriemi;

pub(in crate::models) use error::no_root;
pub use error::{ExactError, ExactFault};

use std::ops::ControlFlow;

use crate::models::premises::outside;
use crate::result::{
    Balance, Failure, Outcome, Profile, Quantity, Results, Series, Snapshot, Status, Validity, Watch, quantity,
};
use bed_results::closure_name;

/// Levels between two looks at the watch.
const BETWEEN_LOOKS: usize = 512;

/// A column of the profile: its quantity and its value at an elevation \[m].
pub(in crate::models) type Column<'a> = (&'static Quantity, Box<dyn Fn(f64) -> Option<f64> + 'a>);

/// Evaluates `columns` at the levels `z` \[m]. `None` if the watch asked to stop.
pub(in crate::models) fn tabulate(
    z: Vec<f64>,
    columns: &[Column<'_>],
    watch: &mut dyn Watch,
) -> Result<Option<Profile>, Failure> {
    let mut values: Vec<Vec<Option<f64>>> = columns.iter().map(|_| Vec::with_capacity(z.len())).collect();
    for (i, &level) in z.iter().enumerate() {
        if i % BETWEEN_LOOKS == 0 {
            let snapshot = Snapshot { stage: "profile", fraction: i as f64 / z.len() as f64, quantity: None };
            if watch.see(&snapshot) == ControlFlow::Break(()) {
                return Ok(None);
            }
        }
        for (column, (_, value)) in values.iter_mut().zip(columns) {
            column.push(value(level));
        }
    }
    let mut profile = Profile::new(z)?;
    for ((quantity, _), values) in columns.iter().zip(values) {
        profile.push(quantity, values)?;
    }
    Ok(Some(profile))
}

/// The outcome of a closed form; stopped if there is no profile.
pub(in crate::models) fn outcome(
    profile: Option<Profile>,
    history: Vec<f64>,
    results: Results,
    balances: Vec<Balance>,
    validity: Vec<Validity>,
) -> Result<Outcome, Failure> {
    let series = if history.is_empty() { None } else { Some(residuals(history)?) };
    let status = if profile.is_some() { Status::Done } else { Status::Stopped };
    Ok(Outcome { status, profile, series, results, balances, validity, ..Outcome::stopped() })
}

/// The residual history of a root finder.
fn residuals(history: Vec<f64>) -> Result<Series, Failure> {
    let mut series = Series::new((1..=history.len()).map(|i| i as f64).collect())?;
    series.push(&quantity::RESIDUAL, history.into_iter().map(|r| Some(r.abs())).collect())?;
    Ok(series)
}

pub(in crate::models) fn balance(name: &str, relative: f64, how: &str) -> Balance {
    Balance { name: name.into(), relative, how: how.into() }
}
