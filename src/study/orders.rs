//! How fast an error falls: slopes between neighbouring points, and the constant of a known law.

use crate::model::Law;

/// Relative errors below this are round-off, of sums over thousands of cells: no order is read from them.
pub const ROUND_OFF: f64 = 1e-11;

/// Slope d ln(e)/d ln(x) from each point to the one before it; `None` at the first point, beside a missing value, and where
/// either error is round-off.
#[must_use]
pub fn slopes(x: &[f64], errors: &[Option<f64>]) -> Vec<Option<f64>> {
    let seen = |e: Option<f64>| e.filter(|e| *e > ROUND_OFF);
    let at = |i: usize| Some((*x.get(i)?, seen(errors.get(i).copied().flatten())?));
    let slope = |i: usize| {
        let ((x0, e0), (x1, e1)) = (at(i.checked_sub(1)?)?, at(i)?);
        Some((e1 / e0).ln() / (x1 / x0).ln()).filter(|slope| slope.is_finite())
    };
    (0..x.len()).map(slope).collect()
}

/// Slope between the first and the last point that are more than round-off.
#[must_use]
pub fn overall(x: &[f64], errors: &[Option<f64>]) -> Option<f64> {
    let mut seen = x.iter().zip(errors).filter_map(|(x, e)| Some((*x, e.filter(|e| *e > ROUND_OFF)?)));
    let ((x0, e0), (x1, e1)) = (seen.next()?, seen.next_back()?);
    Some((e1 / e0).ln() / (x1 / x0).ln()).filter(|slope| slope.is_finite())
}

/// A law with its constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// the law
    pub law: Law,
    /// C
    pub constant: f64,
    /// largest ratio between a point and the law, either way
    pub within: f64,
    /// points that were fitted
    pub points: usize,
}

/// Fits C to the points with lambda at most `most` of `s`, each counting alike in its logarithm.
#[must_use]
pub fn fit(law: Law, lambda: &[f64], errors: &[Option<f64>], s: f64, most: f64) -> Option<Fit> {
    let seen = lambda.iter().zip(errors).filter(|(l, _)| **l > 0.0 && **l <= most * s);
    let seen = seen.filter_map(|(l, e)| e.filter(|e| *e > ROUND_OFF).map(|e| (e / law.at(*l, s)).ln()));
    let logs: Vec<f64> = seen.filter(|x| x.is_finite()).collect();
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    let within = logs.iter().fold(0.0_f64, |m, x| m.max((x - mean).abs())).exp();
    mean.is_finite().then(|| Fit { law, constant: mean.exp(), within, points: logs.len() })
}

/// Error at `x` on the straight line between its neighbours in logarithms; `None` outside the points.
#[must_use]
pub fn between(x: f64, points: &[(f64, f64)]) -> Option<f64> {
    let mut sorted: Vec<(f64, f64)> = points.iter().copied().filter(|p| p.0 > 0.0 && p.1 > 0.0).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let above = sorted.partition_point(|p| p.0 < x);
    let b = sorted.get(above)?;
    if b.0 <= x * (1.0 + 1e-12) {
        return Some(b.1);
    }
    let a = sorted.get(above.checked_sub(1)?)?;
    Some((a.1.ln() + (b.1 / a.1).ln() * (x / a.0).ln() / (b.0 / a.0).ln()).exp())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_order_of_a_power_is_its_exponent_and_round_off_has_none() {
        let x = [10.0, 20.0, 40.0, 80.0, 160.0];
        let errors = [Some(1e-2), Some(2.5e-3), None, Some(1e-9), Some(1e-13)];
        let found = slopes(&x, &errors);
        assert_eq!(found[0], None);
        assert_relative_eq!(found[1].unwrap(), -2.0, max_relative = 1e-12);
        assert_eq!(found[2..], [None, None, None]);
        let whole = (1e-9_f64 / 1e-2).ln() / 8.0_f64.ln();
        assert_relative_eq!(overall(&x, &errors).unwrap(), whole, max_relative = 1e-12);
        assert_eq!(overall(&x[..1], &errors[..1]), None);
    }

    #[test]
    fn the_constant_of_the_law_is_found_and_its_misfit_reported() {
        let s = 1e-2;
        let lambda = [1e-1, 1e-3, 1e-5, 1e-7];
        let errors: Vec<Option<f64>> = lambda.iter().map(|&l| Some(3.0 * Law::Logarithmic.at(l, s).abs())).collect();
        let found = fit(Law::Logarithmic, &lambda, &errors, s, 0.1).unwrap();
        assert_eq!(found.points, 3);
        assert_relative_eq!(found.constant, 3.0, max_relative = 1e-12);
        assert_relative_eq!(found.within, 1.0, max_relative = 1e-12);
        let wrong = fit(Law::Linear, &lambda, &errors, s, 0.1).unwrap();
        assert!(wrong.within > 2.0, "{wrong:?}");
        assert_eq!(fit(Law::Linear, &lambda, &[None; 4], s, 0.1), None);
    }

    #[test]
    fn between_two_points_a_power_law_is_exact() {
        let points = [(1e-2, 1e-4), (1e-4, 1e-8)];
        assert_relative_eq!(between(1e-3, &points).unwrap(), 1e-6, max_relative = 1e-12);
        assert_relative_eq!(between(1e-2, &points).unwrap(), 1e-4);
        assert_eq!((between(1.0, &points), between(1e-5, &points)), (None, None));
    }
}
