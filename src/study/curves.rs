//! How studies draw their curves and word their errors.

use crate::result::{Curve, Dash, Marker};

/// A curve of errors with a marker at each point; series `i` has one colour and one marker in all panels.
pub(super) fn curve(name: &str, i: usize, points: impl Iterator<Item = (f64, Option<f64>)>) -> Curve {
    Curve {
        name: name.into(),
        points: points.map(|(x, e)| e.map(|e| (x, e))).collect(),
        colour: i,
        line: Some([Dash::Solid, Dash::Dashed, Dash::DashDotted, Dash::Dotted][i % 4]),
        marker: Some([Marker::Circle, Marker::Square, Marker::Triangle][i % 3]),
        ..Curve::default()
    }
}

/// A line without markers.
pub(super) fn line(name: String, colour: usize, dash: Dash, points: Vec<(f64, f64)>) -> Curve {
    Curve { name, points: points.into_iter().map(Some).collect(), colour, line: Some(dash), ..Curve::default() }
}

/// An error for readers: `4.71 %` where a per cent says something, `9.2e-7` below.
pub(super) fn error_text(e: f64) -> String {
    if e >= 1e-4 { crate::compare::percent(e) } else { format!("{e:.1e}") }
}

/// Smallest and largest of some slopes: `0.85 to 0.99`.
pub(super) fn range_text(slopes: impl Iterator<Item = f64>) -> Option<String> {
    let (low, high) = slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    // Adding 0 makes -0 a 0.
    let [a, b] = [low, high].map(|x| format!("{:.2}", (100.0 * x).round() / 100.0 + 0.0));
    (low <= high).then(|| if a == b { a } else { format!("{a} to {b}") })
}
