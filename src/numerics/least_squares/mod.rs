//! Nonlinear least squares by Levenberg-Marquardt (Moré 1978, doi:10.1007/BFb0067700), and what the residuals say of the
//! parameters.
//!
//! The derivative is taken by central differences, in parallel. A step to where the model has no answer counts as one that
//! is far too long: it is damped. The iteration has converged when the step that is left is a small share of a standard error
//! (Bates & Watts 1981, doi:10.1080/00401706.1981.10486254), which, unlike the change from step to step, tells a minimum from
//! a place where it is stuck.
//!
//! Bounds: the residuals are those of the nearest point within. There a parameter beyond its bound has no influence and stays,
//! while the others are fitted. One whose sum of squares falls inwards is let go again.

mod statistics;
#[cfg(test)]
mod tests;

use std::cell::Cell;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector, Dyn, Owned, SVD};
use rayon::prelude::*;

pub use statistics::Statistics;

/// Half of the distance over which the derivative is taken: round-off of 1e-11 then costs 1e-7 of it.
const STEP: f64 = 1e-4;
/// Relative changes of the sum of squares, and of the parameters, at which the iteration ends.
const TOLERANCE: f64 = 1e-10;
/// Share of the derivative that is exact.
const ACCURATE: f64 = 1e-6;
/// Most trials per parameter.
const PATIENCE: usize = 40;
/// Largest remaining step of a minimum, in standard errors.
const OFFSET: f64 = 0.05;
/// Residuals below this share of those at the start are none.
const EXACT: f64 = 1e-9;
/// How often a parameter is let go from its bound, at most, per parameter.
const RELEASES: usize = 3;

/// Where the iteration ended, well or not: the best parameters that it saw.
#[derive(Clone, Debug)]
pub struct Fit<E> {
    /// parameters
    pub x: Vec<f64>,
    /// residuals there
    pub residuals: Vec<f64>,
    /// their Euclidean norm at the start
    pub before: f64,
    /// derivative of the residuals there, one column per parameter; `None` if the model has no answer beside it
    pub jacobian: Option<DMatrix<f64>>,
    /// derivatives that were taken on the way
    pub iterations: usize,
    /// how often the residuals were computed
    pub evaluations: usize,
    /// how often the model had no answer
    pub refusals: usize,
    /// whether a parameter is at its bound
    pub at_bound: Vec<bool>,
    /// the remaining step in standard errors
    pub offset: f64,
    /// whether this is a minimum
    pub ended: Result<(), Ended<E>>,
}

/// Why an iteration ended without a minimum.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended<E> {
    /// it wants to go on to where the model has no answer, and why that has none
    Blocked(E),
    /// the residuals do not depend on the parameter with this index
    NoInfluence(usize),
    /// it came to a halt, or took too many trials, before the minimum
    NotConverged,
}

/// Minimises the sum of squares of `residuals` from `start` within `bounds`; `see` receives its root after each better trial.
///
/// # Errors
/// That of `residuals` at the start. Further failures are in [`Fit::ended`].
pub fn minimise<E: Clone + Send>(
    start: &[f64],
    bounds: &[(f64, f64)],
    residuals: &(impl Fn(&[f64]) -> Result<Vec<f64>, E> + Sync),
    see: &dyn Fn(f64),
) -> Result<Fit<E>, E> {
    let first = DVector::from_vec(residuals(start)?);
    let x = DVector::from_column_slice(start);
    let before = first.norm();
    let mut search = Search {
        residuals,
        bounds,
        see,
        penalty: 1e3 * (1.0 + before),
        best: (x.clone(), first.clone()),
        here: (x, Ok(first)),
        refused: None,
        evaluations: 1,
        counted: Cell::default(),
    };
    let method = LevenbergMarquardt::new().with_ftol(TOLERANCE).with_xtol(TOLERANCE).with_gtol(TOLERANCE);
    let method = method.with_patience(PATIENCE);
    let mut releases = RELEASES * start.len();
    let (halted, jacobian, at_bound) = loop {
        let (ended, report) = method.minimize(search);
        search = ended;
        // What no machine can improve on is as good as converged, if the offset confirms it.
        let halted = report.termination.was_successful()
            || matches!(report.termination, TerminationReason::NoImprovementPossible(_));
        let (x, r) = search.best.clone();
        search.here = (x, Ok(r));
        match search.derivative() {
            Err(error) => break (halted, Err(error), vec![false; start.len()]),
            Ok(jacobian) => match search.at_bounds(&jacobian) {
                (_, true) if releases > 0 => releases -= 1,
                (at_bound, _) => break (halted, Ok(jacobian), at_bound),
            },
        }
    };
    let (x, r) = search.best;
    let (jacobian, blocked) = match jacobian {
        Ok(jacobian) => (Some(jacobian), None),
        Err(error) => (None, Some(error)),
    };
    let offset = jacobian.as_ref().map_or(f64::INFINITY, |jacobian| offset(&free(jacobian, &at_bound), &r));
    let still = jacobian.as_ref().and_then(|j| j.column_iter().position(|column| column.norm() == 0.0));
    let exact = r.norm() <= EXACT * before || r.norm() == 0.0;
    let ended = match (still, blocked.or(search.refused)) {
        (Some(parameter), _) => Err(Ended::NoInfluence(parameter)),
        _ if jacobian.is_some() && (exact || (halted && offset <= OFFSET)) => Ok(()),
        (None, Some(error)) => Err(Ended::Blocked(error)),
        (None, None) => Err(Ended::NotConverged),
    };
    let (derivatives, refusals) = search.counted.get();
    Ok(Fit {
        iterations: derivatives,
        evaluations: search.evaluations + 2 * x.len() * derivatives,
        refusals,
        x: x.data.into(),
        residuals: r.data.into(),
        before,
        jacobian,
        at_bound,
        offset,
        ended,
    })
}

/// The columns of the parameters that are not at their bound.
fn free(jacobian: &DMatrix<f64>, at_bound: &[bool]) -> DMatrix<f64> {
    let columns: Vec<usize> = (0..at_bound.len()).filter(|&i| !at_bound[i]).collect();
    jacobian.select_columns(&columns)
}

/// The remaining step: what of the residuals still lies along the derivative, per parameter, over what does not. Directions
/// that the residuals do not depend on have none left.
fn offset(jacobian: &DMatrix<f64>, residuals: &DVector<f64>) -> f64 {
    let (rows, columns) = jacobian.shape();
    if columns == 0 {
        return 0.0;
    }
    let svd = SVD::new(jacobian.clone(), true, false);
    let Some(u) = svd.u else { return f64::INFINITY };
    let floor = ACCURATE * svd.singular_values.max();
    let known = u.column_iter().zip(svd.singular_values.iter()).filter(|(_, s)| **s > floor);
    let along = known.map(|(u, _)| u.dot(residuals).powi(2)).sum::<f64>();
    // Residuals in units of their standard error are not smaller than it.
    let across = (residuals.norm_squared() - along).max(0.0) / rows.saturating_sub(columns).max(1) as f64;
    if along == 0.0 { 0.0 } else { (along / columns as f64 / across).sqrt() }
}

/// The state of the search, as the method wants to see it.
struct Search<'a, F, E> {
    residuals: &'a F,
    bounds: &'a [(f64, f64)],
    see: &'a dyn Fn(f64),
    /// what each residual is where the model has no answer
    penalty: f64,
    /// not within the bounds, but the residuals are those of the nearest point that is
    here: (DVector<f64>, Result<DVector<f64>, E>),
    best: (DVector<f64>, DVector<f64>),
    /// why the last trial since the best one had no answer
    refused: Option<E>,
    evaluations: usize,
    /// derivatives, and trials without an answer
    counted: Cell<(usize, usize)>,
}

impl<F: Fn(&[f64]) -> Result<Vec<f64>, E> + Sync, E: Clone + Send> Search<'_, F, E> {
    fn derivative(&self) -> Result<DMatrix<f64>, E> {
        let (x, here) = &self.here;
        let (n, inside) = (x.len(), self.within(x));
        let residuals = self.residuals;
        let at = |(i, sign): (usize, f64)| {
            let mut beside = inside.clone();
            beside[i] += sign * STEP;
            residuals(beside.as_slice()).map(DVector::from_vec)
        };
        let sides: Vec<(usize, f64)> = (0..n).flat_map(|i| [(i, 1.0), (i, -1.0)]).collect();
        let found: Vec<Result<DVector<f64>, E>> = sides.into_par_iter().map(at).collect();
        let (derivatives, refusals) = self.counted.get();
        self.counted.set((derivatives + 1, refusals + found.iter().filter(|r| r.is_err()).count()));
        let mut columns = Vec::with_capacity(n);
        for (i, pair) in found.chunks_exact(2).enumerate() {
            let [up, down] = pair else { continue };
            if inside[i] != x[i] {
                columns.push(DVector::zeros(self.best.1.len()));
                continue;
            }
            // At the edge of where the model has an answer, one side has to do.
            columns.push(match (up, here, down) {
                (Ok(up), _, Ok(down)) => (up - down) / (2.0 * STEP),
                (Ok(up), Ok(here), Err(_)) => (up - here) / STEP,
                (Err(_), Ok(here), Ok(down)) => (here - down) / STEP,
                (Err(error), ..) | (_, Err(error), _) => return Err(error.clone()),
            });
        }
        Ok(DMatrix::from_columns(&columns))
    }

    /// The nearest point within the bounds.
    fn within(&self, x: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(x.len(), x.iter().zip(self.bounds).map(|(x, (low, high))| x.max(*low).min(*high)))
    }

    /// Which parameters of the best point stay at their bound, and whether any stands at its bound that should leave it.
    fn at_bounds(&self, jacobian: &DMatrix<f64>) -> (Vec<bool>, bool) {
        let (x, r) = &self.best;
        let ascent = jacobian.transpose() * r;
        let at = |i: usize| (x[i] <= self.bounds[i].0, x[i] >= self.bounds[i].1);
        let at_bound: Vec<bool> =
            (0..x.len()).map(|i| (at(i).0 && ascent[i] >= 0.0) || (at(i).1 && ascent[i] <= 0.0)).collect();
        // A step that changes nothing does not count.
        let inward = |i: usize| {
            let column = jacobian.column(i).norm();
            (at(i).0 || at(i).1)
                && !at_bound[i]
                && ascent[i].abs() > OFFSET * column * r.norm() / (r.len() as f64).sqrt()
        };
        let inward = (0..x.len()).any(inward);
        (at_bound, inward)
    }
}

impl<F: Fn(&[f64]) -> Result<Vec<f64>, E> + Sync, E: Clone + Send> LeastSquaresProblem<f64, Dyn, Dyn>
    for Search<'_, F, E>
{
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        if *x == self.here.0 {
            return;
        }
        self.evaluations += 1;
        let inside = self.within(x);
        let found = (self.residuals)(inside.as_slice()).map(DVector::from_vec);
        match &found {
            Ok(r) if r.norm() < self.best.1.norm() => {
                (self.see)(r.norm());
                self.best = (inside, r.clone());
                self.refused = None;
            }
            Ok(_) => {}
            Err(error) => {
                self.refused = Some(error.clone());
                let (derivatives, refusals) = self.counted.get();
                self.counted.set((derivatives, refusals + 1));
            }
        }
        self.here = (x.clone(), found);
    }

    fn params(&self) -> DVector<f64> {
        self.here.0.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let refused = |_: &E| DVector::from_element(self.best.1.len(), self.penalty);
        Some(self.here.1.as_ref().map_or_else(refused, Clone::clone))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.derivative().ok()
    }
}
