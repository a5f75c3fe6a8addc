//! What a sweep of grains in a fluid says: the transport rate over the Shields number beside published laws, the threshold
//! that it obeys, and how far each profile of the flux lies from that of the last point.
//!
//! `Q* = A (θ* - θ_c)^n` with all three free is fitted to ln Q*, weighted by its standard error; standard errors of the fit are those of the
//! jackknife. `Q*^(2/3)` over `θ*` is a straight line if n = 3/2; its intercept is another θ_c. Deviation of profiles: Maurin et al. (2015), eq. (A2).

use serde_json::json;

use super::curves::curve;
use super::range::number_and_unit;
use super::{Assessment, Row};
use crate::closures::transport::LAWS;
use crate::compare::norms::deviation;
use crate::result::Status;
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Panel};
use crate::units::significant;

/// Places at which a law is drawn.
const PLACES: usize = 200;
/// A rate that is known worse than this is not fitted.
const POOR: f64 = 0.5;
/// A rate below which nothing moves.
const REST: f64 = 1e-6;
/// Fewest points for three free numbers.
const FEWEST: usize = 5;

/// A transport rate with its Shields number.
#[derive(Clone, Copy, Debug)]
struct Known {
    theta: f64,
    rate: f64,
    error: f64,
}

/// Q* = A (θ* - θ_c)^n.
#[derive(Clone, Copy, Debug)]
struct Law {
    factor: f64,
    threshold: f64,
    exponent: f64,
}

impl Law {
    fn numbers(self) -> [f64; 3] {
        [self.factor, self.threshold, self.exponent]
    }
}

fn error_of(row: &Row, quantity: &Quantity) -> Option<f64> {
    row.results.iter().find(|(name, _)| *name == quantity.name).and_then(|(_, reported)| reported.stderr)
}

/// Adds measures, findings and figures if `rows` are grains in a fluid; `keys` are what is varied.
pub(super) fn assess(keys: &[&str], rows: &[Row], assessment: &mut Assessment) {
    if rows.iter().all(|row| row.result(q::SHIELDS_BED.name).is_none()) {
        return;
    }
    for quantity in [&q::TRANSPORT_RATE_DIMENSIONLESS, &q::SHIELDS_BED] {
        let errors = rows.iter().map(|row| error_of(row, quantity)).collect();
        assessment.measures.push((format!("{}_stderr", quantity.name), errors));
    }
    deviations(keys, rows, assessment);
    let mut series: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| row.status == Status::Done) {
        if !series.contains(&row.point.series.as_str()) {
            series.push(&row.point.series);
        }
    }
    let mut curves: Vec<Curve> = Vec::new();
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for (i, name) in series.iter().enumerate() {
        let found = known(rows, name);
        let label = if name.is_empty() { "grains" } else { name };
        let points = found.iter().map(|k| (k.theta, Some(k.rate)));
        curves.push(Curve { line: None, colour: i + 1, ..curve(label, i, points) });
        (low, high) = found.iter().fold((low, high), |(a, b), k| (a.min(k.theta), b.max(k.theta)));
        let at = if name.is_empty() { String::new() } else { format!(" ({name})") };
        let rest = resting(rows, name);
        if let (Some(rest), Some(first)) = (rest, found.first()) {
            let text = format!("θ* = {}; θ* = {} moves", significant(rest, 3), significant(first.theta, 3));
            assessment.findings.push((format!("at rest up to{at}"), text));
        }
        if let Some((law, errors)) = fit(&found) {
            let of = |k: usize| format!("{} ± {}", significant(law.numbers()[k], 3), significant(errors[k], 2));
            let text = format!("A = {}, θ_c = {}, n = {}; {} points", of(0), of(1), of(2), found.len());
            assessment.findings.push((format!("A (θ* - θ_c)^n{at}"), text));
            let fact =
                json!({ "factor": law.factor, "threshold": law.threshold, "exponent": law.exponent, "stderr": errors });
            assessment.facts.insert(format!("fit {name}").trim().to_owned(), fact);
            let span = (law.threshold.max(rest.unwrap_or(0.0)), found.iter().map(|k| k.theta).fold(0.0, f64::max));
            let name = format!("fit {name}");
            curves.push(drawn(name.trim(), i + 1, Dash::Solid, span, |x| {
                law.factor * (x - law.threshold).powf(law.exponent)
            }));
        }
        if let Some((threshold, error)) = intercept(&found) {
            let text = format!("θ_c = {} ± {}", significant(threshold, 3), significant(error, 2));
            assessment.findings.push((format!("Q*^(2/3) reaches 0 at{at}"), text));
        }
    }
    if low < high {
        for (i, law) in LAWS.iter().enumerate() {
            let dash = [Dash::Dotted, Dash::Dashed, Dash::DashDotted][i % 3];
            curves.insert(i, drawn(law.name, 0, dash, (law.threshold, high), |x| law.rate(x)));
        }
        assessment.figures.push(Figure {
            stem: "transport".into(),
            caption: "Dimensionless transport rate over the Shields number of the largest Reynolds stress, fits A (θ* - θ_c)^n, and published laws."
                .into(),
            y: Axis::log("transport rate Q*", ""),
            panels: vec![Panel { x: Axis::log("Shields number θ*", ""), curves }],
            levels: Vec::new(),
            tint_below: None,
        });
    }
}

fn drawn(name: &str, colour: usize, dash: Dash, (from, to): (f64, f64), law: impl Fn(f64) -> f64) -> Curve {
    let place = |k: usize| from + (to - from) * (k as f64 / PLACES as f64).powi(3);
    let points = (1..=PLACES).map(|k| Some((place(k), law(place(k))))).map(|p| p.filter(|p| p.1 > 1e-5));
    Curve { name: name.into(), points: points.collect(), colour, line: Some(dash), ..Curve::default() }
}

/// The largest Shields number of a series whose grains rest.
fn resting(rows: &[Row], series: &str) -> Option<f64> {
    let of = rows.iter().filter(|row| row.status == Status::Done && row.point.series == series);
    let rests = |row: &&Row| row.result(q::TRANSPORT_RATE_DIMENSIONLESS.name).is_some_and(|rate| rate < REST);
    of.filter(rests).filter_map(|row| row.result(q::SHIELDS_BED.name)).reduce(f64::max)
}

/// The rates of a series that are known, from the smallest Shields number on.
fn known(rows: &[Row], series: &str) -> Vec<Known> {
    let one = |row: &Row| {
        let rate = row.result(q::TRANSPORT_RATE_DIMENSIONLESS.name)?;
        let theta = row.result(q::SHIELDS_BED.name)?;
        let error = error_of(row, &q::TRANSPORT_RATE_DIMENSIONLESS)?;
        (rate > 0.0 && theta > 0.0 && error > 0.0 && error < POOR * rate).then_some(Known { theta, rate, error })
    };
    let of = rows.iter().filter(|row| row.status == Status::Done && row.point.series == series);
    let mut found: Vec<Known> = of.filter_map(one).collect();
    found.sort_by(|a, b| a.theta.total_cmp(&b.theta));
    found
}

/// A weighted straight line: value at 0, slope, weighted sum of squares.
fn straight(points: impl Iterator<Item = (f64, f64, f64)> + Clone) -> Option<[f64; 3]> {
    let weigh = |f: &dyn Fn((f64, f64, f64)) -> f64| points.clone().map(|p| p.2 * f(p)).sum::<f64>();
    let total = weigh(&|_| 1.0);
    let (x, y) = (weigh(&|p| p.0) / total, weigh(&|p| p.1) / total);
    let spread = weigh(&|p| (p.0 - x).powi(2));
    let slope = weigh(&|p| (p.0 - x) * (p.1 - y)) / spread;
    let rest = weigh(&|p| (p.1 - y - slope * (p.0 - x)).powi(2));
    let line = [y - slope * x, slope, rest];
    line.iter().all(|x| x.is_finite()).then_some(line)
}

/// The law whose squares are least: for each threshold a straight line in logarithms, the threshold by bracketing.
fn best(points: &[Known]) -> Option<Law> {
    let smallest = points.iter().map(|k| k.theta).fold(f64::INFINITY, f64::min);
    let line = |threshold: f64| {
        straight(points.iter().map(|k| ((k.theta - threshold).ln(), k.rate.ln(), (k.rate / k.error).powi(2))))
    };
    let (mut from, mut to) = (0.0, smallest * (1.0 - 1e-9));
    let mut found = None;
    for _ in 0..6 {
        let place = |k: usize| from + (to - from) * k as f64 / 100.0;
        let rest = |k: usize| line(place(k)).map_or(f64::INFINITY, |l| l[2]);
        let k = (0..=100).min_by(|&a, &b| rest(a).total_cmp(&rest(b)))?;
        found = Some(place(k));
        (from, to) = (place(k.saturating_sub(1)), place((k + 1).min(100)));
    }
    let threshold = found?;
    let [constant, exponent, _] = line(threshold)?;
    Some(Law { factor: constant.exp(), threshold, exponent })
}

/// The best law, and the standard errors of its numbers by the jackknife.
fn fit(points: &[Known]) -> Option<(Law, [f64; 3])> {
    let n = points.len();
    if n < FEWEST {
        return None;
    }
    let law = best(points)?;
    let without = |i: usize| best(&[&points[..i], &points[i + 1..]].concat()).map(Law::numbers);
    let others: Vec<[f64; 3]> = (0..n).map(without).collect::<Option<_>>()?;
    let spread = |k: usize| {
        let mean = others.iter().map(|l| l[k]).sum::<f64>() / n as f64;
        let square: f64 = others.iter().map(|l| (l[k] - mean).powi(2)).sum();
        (square * (n - 1) as f64 / n as f64).sqrt()
    };
    Some((law, [0, 1, 2].map(spread)))
}

/// Where the straight line through Q*^(2/3) reaches zero, and its standard error by the jackknife.
fn intercept(points: &[Known]) -> Option<(f64, f64)> {
    let n = points.len();
    if n < FEWEST {
        return None;
    }
    let zero = |points: &[Known]| {
        let line = straight(points.iter().map(|k| {
            let sigma = 2.0 / 3.0 * k.error / k.rate.cbrt();
            (k.theta, k.rate.cbrt().powi(2), sigma.powi(-2))
        }));
        line.map(|[at_zero, slope, _]| -at_zero / slope)
    };
    let others: Vec<f64> = (0..n).map(|i| zero(&[&points[..i], &points[i + 1..]].concat())).collect::<Option<_>>()?;
    let mean = others.iter().sum::<f64>() / n as f64;
    let square: f64 = others.iter().map(|x| (x - mean).powi(2)).sum();
    Some((zero(points)?, (square * (n - 1) as f64 / n as f64).sqrt()))
}

/// RMS of the difference of the flux from that of the last point, over the mean flux of that.
fn deviations(keys: &[&str], rows: &[Row], assessment: &mut Assessment) {
    let Some(last) = rows.iter().rposition(|row| row.status == Status::Done && row.profile.is_some()) else { return };
    let Some(reference) = rows[last].profile.as_ref() else { return };
    let Some(flux) = reference.get(&q::FLUX) else { return };
    let mean = flux.iter().flatten().sum::<f64>() / flux.len() as f64;
    let of = |(i, row): (usize, &Row)| {
        let run = row.profile.as_ref().filter(|_| i != last && mean > 0.0)?;
        Some(deviation(reference, run, &q::FLUX)?.rms / mean)
    };
    let values: Vec<Option<f64>> = rows.iter().enumerate().map(of).collect();
    let known: Vec<f64> = values.iter().copied().flatten().collect();
    if let (Some(low), Some(high)) = (known.iter().copied().reduce(f64::min), known.iter().copied().reduce(f64::max)) {
        let mut text = format!("{} to {} of the mean flux", significant(low, 2), significant(high, 2));
        if let &[key] = keys {
            let place = |row: &Row| row.point.values.first().and_then(|v| number_and_unit(v)).map(|(x, _)| x);
            let pairs = rows.iter().map(place).zip(&values);
            let logarithms: Vec<_> = pairs.filter_map(|(x, e)| Some((x?.ln(), e.as_ref()?.ln(), 1.0))).collect();
            if let Some([_, slope, _]) = straight(logarithms.iter().copied()).filter(|_| logarithms.len() > 2) {
                text += &format!("; goes like {key} to the power {slope:.2}");
            }
        }
        assessment.findings.push(("flux profile against that of the last point, eq. (A2)".into(), text));
    }
    assessment.measures.push(("flux_deviation".into(), values));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(points: &[f64], noise: f64) -> Vec<Known> {
        let one = |(i, &theta): (usize, &f64)| {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let rate = 9.0 * (theta - 0.04_f64).powf(1.5) * (1.0 + sign * noise);
            Known { theta, rate, error: 0.03 * rate }
        };
        points.iter().enumerate().map(one).collect()
    }

    const THETA: [f64; 7] = [0.05, 0.06, 0.08, 0.12, 0.2, 0.35, 0.6];

    #[test]
    fn a_power_law_is_found_again() {
        let (found, errors) = fit(&law(&THETA, 0.0)).unwrap();
        for (a, b) in found.numbers().into_iter().zip([9.0, 0.04, 1.5]) {
            assert!((a / b - 1.0).abs() < 1e-4, "{found:?}");
        }
        assert!(errors.iter().all(|e| *e < 1e-3), "{errors:?}");
        let (threshold, error) = intercept(&law(&THETA, 0.0)).unwrap();
        assert!((threshold - 0.04).abs() < 1e-12 && error < 1e-12);
    }

    #[test]
    fn with_noise_the_errors_cover_the_exact_value() {
        let (found, errors) = fit(&law(&THETA, 0.03)).unwrap();
        for ((a, b), e) in found.numbers().into_iter().zip([9.0, 0.04, 1.5]).zip(errors) {
            assert!((a - b).abs() < 3.0 * e && e > 1e-4, "{found:?} ± {errors:?}");
        }
        assert!(fit(&law(&THETA[..4], 0.0)).is_none());
    }

    #[test]
    fn a_wrong_exponent_moves_the_intercept() {
        let points: Vec<Known> =
            THETA.iter().map(|&theta| Known { theta, rate: 5.0 * (theta - 0.04).powi(2), error: 0.01 }).collect();
        assert!(intercept(&points).unwrap().0 > 0.045);
    }
}
