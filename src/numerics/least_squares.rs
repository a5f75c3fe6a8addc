//! Nonlinear least squares by Levenberg-Marquardt (Moré 1978, doi:10.1007/BFb0067700), and what the residuals say of the
//! parameters.
//!
//! The derivative is taken by central differences, in parallel. A step to where the model has no answer counts as one that
//! is far too long: it is damped. The iteration has converged when the step that is left is a small share of a standard error
//! (Bates & Watts 1981, doi:10.1080/00401706.1981.10486254), which, unlike the change from step to step, tells a minimum from
//! a place where it is stuck.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector, Dyn, Owned, SVD};
use rayon::prelude::*;

/// Half of the distance over which the derivative is taken: round-off of 1e-11 then costs 1e-7 of it.
const STEP: f64 = 1e-4;
/// Relative changes of the sum of squares, and of the parameters, at which the iteration ends.
const TOLERANCE: f64 = 1e-10;
/// Most trials per parameter.
const PATIENCE: usize = 40;
/// Largest remaining step of a minimum, in standard errors.
const OFFSET: f64 = 0.05;
/// Residuals below this share of those at the start are none.
const EXACT: f64 = 1e-9;

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

/// What the residuals at a minimum say of the parameters.
#[derive(Clone, Debug)]
pub struct Statistics {
    /// sum of squares
    pub chi2: f64,
    /// residuals less parameters
    pub freedom: usize,
    /// standard error of each parameter; infinite where nothing is known of it
    pub errors: Vec<f64>,
    /// correlation of each pair
    pub correlations: Vec<Vec<f64>>,
    /// singular values of the derivative, descending
    pub singular: Vec<f64>,
    /// direction of unit length in which the parameters are known least, and its standard error
    pub weakest: (Vec<f64>, f64),
}

/// Minimises the sum of squares of `residuals` from `start`; `see` is told its root after each better trial.
///
/// # Errors
/// That of `residuals` at the start. Further failures are in [`Fit::ended`].
pub fn minimise<E: Clone + Send>(
    start: &[f64],
    residuals: &(impl Fn(&[f64]) -> Result<Vec<f64>, E> + Sync),
    see: &dyn Fn(f64),
) -> Result<Fit<E>, E> {
    let first = DVector::from_vec(residuals(start)?);
    let x = DVector::from_column_slice(start);
    let before = first.norm();
    let search = Search {
        residuals,
        see,
        penalty: 1e3 * (1.0 + before),
        best: (x.clone(), first.clone()),
        here: (x, Ok(first)),
        refused: None,
        evaluations: 1,
        derivatives: std::cell::Cell::new(0),
    };
    let method = LevenbergMarquardt::new().with_ftol(TOLERANCE).with_xtol(TOLERANCE).with_gtol(TOLERANCE);
    let (mut search, report) = method.with_patience(PATIENCE).minimize(search);
    let (x, r) = search.best.clone();
    let iterations = search.derivatives.get();
    search.here = (x.clone(), Ok(r.clone()));
    let jacobian = search.derivative();
    let evaluations = search.evaluations + 2 * x.len() * search.derivatives.get();
    let (jacobian, blocked) = match jacobian {
        Ok(jacobian) => (Some(jacobian), None),
        Err(error) => (None, Some(error)),
    };
    let offset = jacobian.as_ref().map_or(f64::INFINITY, |jacobian| offset(jacobian, &r));
    let still = jacobian.as_ref().and_then(|j| j.column_iter().position(|column| column.norm() == 0.0));
    let exact = r.norm() <= EXACT * before || r.norm() == 0.0;
    // What no machine can improve on is as good as converged, if the offset says so.
    let halted = report.termination.was_successful()
        || matches!(report.termination, TerminationReason::NoImprovementPossible(_));
    let ended = match (still, blocked.or(search.refused)) {
        (Some(parameter), _) => Err(Ended::NoInfluence(parameter)),
        _ if jacobian.is_some() && (exact || (halted && offset <= OFFSET)) => Ok(()),
        (None, Some(error)) => Err(Ended::Blocked(error)),
        (None, None) => Err(Ended::NotConverged),
    };
    Ok(Fit { x: x.data.into(), residuals: r.data.into(), before, jacobian, iterations, evaluations, offset, ended })
}

/// The remaining step: what of the residuals still lies along the derivative, per parameter, over what does not.
fn offset(jacobian: &DMatrix<f64>, residuals: &DVector<f64>) -> f64 {
    let (rows, columns) = jacobian.shape();
    let Some(u) = SVD::new(jacobian.clone(), true, false).u else { return f64::INFINITY };
    let along = (u.transpose() * residuals).norm_squared();
    // Residuals in units of their standard error are not smaller than it.
    let across = (residuals.norm_squared() - along).max(0.0) / rows.saturating_sub(columns).max(1) as f64;
    if along == 0.0 { 0.0 } else { (along / columns as f64 / across).sqrt() }
}

impl Statistics {
    /// Each pair of parameters with its correlation.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let n = self.errors.len();
        (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j, self.correlations[i][j])))
    }

    /// Standard errors and correlations from `residuals` with their derivative. Residuals are in units of their standard
    /// error if that is `known`; else it is taken from them. `None` without a degree of freedom to take it from, and where
    /// a number is not finite.
    #[must_use]
    pub fn of(residuals: &[f64], jacobian: &DMatrix<f64>, known: bool) -> Option<Self> {
        let n = jacobian.ncols();
        let freedom = residuals.len().checked_sub(n)?;
        let chi2 = residuals.iter().map(|r| r * r).sum::<f64>();
        let variance = match (known, freedom) {
            (true, _) => 1.0,
            (false, 0) => return None,
            (false, freedom) => chi2 / freedom as f64,
        };
        if !jacobian.iter().all(|x| x.is_finite()) || !variance.is_finite() {
            return None;
        }
        let svd = SVD::new(jacobian.clone(), false, true);
        let rows = svd.v_t?;
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| svd.singular_values[j].total_cmp(&svd.singular_values[i]));
        let singular: Vec<f64> = order.iter().map(|&i| svd.singular_values[i]).collect();
        // Below this share of the largest a singular value is round-off, but stays the least that is known.
        let floor = f64::EPSILON * singular.first()?;
        let mut covariance = DMatrix::<f64>::zeros(n, n);
        for &i in &order {
            let direction = rows.row(i).transpose();
            covariance += &direction * direction.transpose() * (variance / svd.singular_values[i].max(floor).powi(2));
        }
        let deviation = |i: usize| covariance[(i, i)].sqrt();
        let correlation = |i, j| if i == j { 1.0 } else { covariance[(i, j)] / (deviation(i) * deviation(j)) };
        let weakest = *order.last()?;
        Some(Self {
            chi2,
            freedom,
            errors: (0..n).map(deviation).collect(),
            correlations: (0..n).map(|i| (0..n).map(|j| correlation(i, j)).collect()).collect(),
            weakest: (
                rows.row(weakest).iter().copied().collect(),
                variance.sqrt() / svd.singular_values[weakest].max(floor),
            ),
            singular,
        })
    }
}

/// The state of the search, as the method wants to see it.
struct Search<'a, F, E> {
    residuals: &'a F,
    see: &'a dyn Fn(f64),
    /// what each residual is where the model has no answer
    penalty: f64,
    here: (DVector<f64>, Result<DVector<f64>, E>),
    best: (DVector<f64>, DVector<f64>),
    /// why the last trial since the best one had no answer
    refused: Option<E>,
    evaluations: usize,
    derivatives: std::cell::Cell<usize>,
}

impl<F: Fn(&[f64]) -> Result<Vec<f64>, E> + Sync, E: Clone + Send> Search<'_, F, E> {
    fn derivative(&self) -> Result<DMatrix<f64>, E> {
        let (x, here) = &self.here;
        let n = x.len();
        self.derivatives.set(self.derivatives.get() + 1);
        let residuals = self.residuals;
        let at = |(i, sign): (usize, f64)| {
            let mut beside = x.clone();
            beside[i] += sign * STEP;
            residuals(beside.as_slice()).map(DVector::from_vec)
        };
        let sides: Vec<(usize, f64)> = (0..n).flat_map(|i| [(i, 1.0), (i, -1.0)]).collect();
        let found: Vec<Result<DVector<f64>, E>> = sides.into_par_iter().map(at).collect();
        let mut columns = Vec::with_capacity(n);
        for pair in found.chunks_exact(2) {
            let [up, down] = pair else { continue };
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
        let found = (self.residuals)(x.as_slice()).map(DVector::from_vec);
        match &found {
            Ok(r) if r.norm() < self.best.1.norm() => {
                (self.see)(r.norm());
                self.best = (x.clone(), r.clone());
                self.refused = None;
            }
            Ok(_) => {}
            Err(error) => self.refused = Some(error.clone()),
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

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn fit(start: &[f64], f: impl Fn(&[f64]) -> Result<Vec<f64>, &'static str> + Sync) -> Fit<&'static str> {
        minimise(start, &f, &|_| ()).unwrap()
    }

    #[test]
    fn a_straight_line_has_the_errors_of_the_textbook() {
        // y = a + b x at x = 0, 1, 2, 3 with residuals by hand: a = 1.3, b = 0.9, sum of squares 0.3
        let y = [1.0, 2.5, 3.0, 4.0 + 0.1];
        let line = |p: &[f64]| Ok((0..4).map(|i| p[0] + p[1] * f64::from(i) - y[i as usize]).collect());
        let found = fit(&[5.0, -3.0], line);
        assert_eq!(found.ended, Ok(()));
        let (mean, slope) = (2.65, (-1.5 * 1.0 - 0.5 * 2.5 + 0.5 * 3.0 + 1.5 * 4.1) / 5.0);
        assert_relative_eq!(found.x[1], slope, epsilon = 1e-9);
        assert_relative_eq!(found.x[0], mean - 1.5 * slope, epsilon = 1e-9);
        let known = Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), true).unwrap();
        assert_eq!(known.freedom, 2);
        assert_relative_eq!(known.errors[1], (1.0_f64 / 5.0).sqrt(), max_relative = 1e-8);
        assert_relative_eq!(known.errors[0], (0.25_f64 + 2.25 / 5.0).sqrt(), max_relative = 1e-8);
        assert_relative_eq!(known.correlations[0][1], -1.5 / 3.5_f64.sqrt(), max_relative = 1e-8);
        let scaled = Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), false).unwrap();
        assert_relative_eq!(scaled.errors[1], (scaled.chi2 / 2.0 / 5.0).sqrt(), max_relative = 1e-8);
        assert_relative_eq!(scaled.weakest.1, (scaled.chi2 / 2.0).sqrt() / scaled.singular[1], max_relative = 1e-12);
    }

    #[test]
    fn a_curved_valley_is_followed_and_steps_out_of_the_model_are_damped() {
        let valley = |p: &[f64]| {
            if p[0] > 1.5 { Err("beyond") } else { Ok(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]) }
        };
        let found = fit(&[-1.2, 1.0], valley);
        assert_eq!(found.ended, Ok(()));
        assert_relative_eq!(found.x[0], 1.0, epsilon = 1e-6);
        assert!(found.iterations > 5 && found.evaluations > 5 * found.iterations, "{found:?}");
    }

    #[test]
    fn what_has_no_minimum_says_why_and_keeps_the_best() {
        let wall = |p: &[f64]| if p[0] < 1.0 { Err("wall") } else { Ok(vec![p[0], p[0] - 0.5]) };
        let found = fit(&[3.0], wall);
        assert_eq!(found.ended, Err(Ended::Blocked("wall")));
        assert!(found.x[0] < 1.01 && found.offset > 0.5, "{found:?}");
        let deaf = fit(&[3.0, 1.0], |p| Ok(vec![p[0], p[0] - 1.0, 2.0]));
        assert_eq!(deaf.ended, Err(Ended::NoInfluence(1)));
        let endless = fit(&[0.0], |p| Ok(vec![(-p[0]).exp(), 1e-9]));
        assert!(endless.residuals[0] < 1e-3, "{endless:?}");
        assert_eq!(minimise(&[1.0], &|_: &[f64]| Err::<Vec<f64>, _>("nothing"), &|_| ()).unwrap_err(), "nothing");
    }
}
