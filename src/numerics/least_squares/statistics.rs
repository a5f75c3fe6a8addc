//! What the residuals at a minimum say of the parameters.

use nalgebra::{DMatrix, SVD};

use super::free;

/// What the residuals at a minimum say of the parameters.
#[derive(Clone, Debug)]
pub struct Statistics {
    /// sum of squares
    pub chi2: f64,
    /// residuals less free parameters
    pub freedom: usize,
    /// standard error of each parameter; not a number for one at its bound
    pub errors: Vec<f64>,
    /// correlation of each pair; not a number with one at its bound
    pub correlations: Vec<Vec<f64>>,
    /// singular values of the derivative, descending
    pub singular: Vec<f64>,
    /// direction of unit length in which the parameters are known least, and its standard error
    pub weakest: (Vec<f64>, f64),
}

impl Statistics {
    /// Each pair of parameters with its correlation.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let n = self.errors.len();
        (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j, self.correlations[i][j])))
    }

    /// Standard errors and correlations from `residuals` with their derivative, of the parameters that are not `at_bound`.
    /// Residuals are in units of their standard error if that is `known`; else it is taken from them. `None` without a
    /// degree of freedom to take it from, without a free parameter, and where a number is not finite.
    #[must_use]
    pub fn of(residuals: &[f64], jacobian: &DMatrix<f64>, at_bound: &[bool], known: bool) -> Option<Self> {
        let jacobian = free(jacobian, at_bound);
        let n = jacobian.ncols();
        let freedom = residuals.len().checked_sub(n)?;
        let chi2 = residuals.iter().map(|r| r * r).sum::<f64>();
        let variance = match (known, freedom) {
            (true, _) => 1.0,
            (false, 0) => return None,
            (false, freedom) => chi2 / freedom as f64,
        };
        if n == 0 || !jacobian.iter().all(|x| x.is_finite()) || !variance.is_finite() {
            return None;
        }
        let svd = SVD::new(jacobian, false, true);
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
        // Place of each parameter among the free ones.
        let mut next = 0..n;
        let place: Vec<Option<usize>> =
            at_bound.iter().map(|at_bound| if *at_bound { None } else { next.next() }).collect();
        let deviation = |i: usize| covariance[(i, i)].sqrt();
        let correlation = |i: &Option<usize>, j: &Option<usize>| match (*i, *j) {
            (Some(i), Some(j)) if i == j => 1.0,
            (Some(i), Some(j)) => covariance[(i, j)] / (deviation(i) * deviation(j)),
            _ => f64::NAN,
        };
        let weakest = *order.last()?;
        // The sign of a direction means nothing: its largest component is positive.
        let sign =
            rows.row(weakest).iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).map_or(1.0, f64::signum);
        Some(Self {
            chi2,
            freedom,
            errors: place.iter().map(|i| i.map_or(f64::NAN, deviation)).collect(),
            correlations: place.iter().map(|i| place.iter().map(|j| correlation(i, j)).collect()).collect(),
            weakest: (
                place.iter().map(|i| i.map_or(0.0, |i| sign * rows[(weakest, i)])).collect(),
                variance.sqrt() / svd.singular_values[weakest].max(floor),
            ),
            singular,
        })
    }
}
