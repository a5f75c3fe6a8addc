//! Figures of a sweep of sheet flows over the Shields number: transport rate beside published laws, thickness, roughness.

use super::Row;
use super::curves::curve;
use crate::closures::transport::LAWS;
use crate::result::Status;
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Panel};
use crate::units::readable_unit;

/// Places at which a law is drawn.
const PLACES: usize = 60;
/// Palette of what is computed; what it is compared with is in the ink of the text.
const COMPUTED: [usize; 2] = [1, 2];

/// The figures; none unless three points or more have a moving layer.
pub(super) fn figures(rows: &[Row]) -> Vec<Figure> {
    let done: Vec<&Row> = rows.iter().filter(|row| row.status == Status::Done).collect();
    let get = |row: &Row, of: &Quantity| row.result(of.name);
    let mut layers: Vec<&Row> = done
        .into_iter()
        .filter(|row| [&q::SHIELDS, &q::SHEET_THICKNESS, &q::TRANSPORT_SHARE_BED].iter().all(|x| get(row, x).is_some()))
        .collect();
    if layers.len() < 3 {
        return Vec::new();
    }
    let theta = |row: &Row| get(row, &q::SHIELDS).unwrap_or(f64::NAN);
    layers.sort_by(|a, b| theta(a).total_cmp(&theta(b)));
    let line = |name: &str, (colour, dash): (usize, Dash), value: &dyn Fn(&Row) -> Option<f64>| Curve {
        name: name.into(),
        points: layers.iter().map(|row| Some((theta(row), value(row)?))).collect(),
        colour,
        line: Some(dash),
        ..Curve::default()
    };
    let marked = |name: &str, i: usize, value: &dyn Fn(&Row) -> Option<f64>| {
        let points = layers.iter().map(|row| (theta(row), value(row)));
        Curve { line: None, colour: COMPUTED[i], ..curve(name, i, points) }
    };
    let figure = |stem: &str, caption: &str, y: Axis, curves: Vec<Curve>| Figure {
        stem: stem.into(),
        caption: caption.into(),
        y,
        panels: vec![Panel { x: Axis::linear("Shields number θ", ""), curves }],
        levels: Vec::new(),
        tint_below: None,
    };
    let (low, high) = (theta(layers[0]), theta(layers[layers.len() - 1]));
    let law = |i: usize| {
        let law = &LAWS[i];
        let points = (0..=PLACES).map(|k| {
            let x = low + (high - low) * k as f64 / PLACES as f64;
            Some((x, law.rate(x)))
        });
        let dash = [Dash::Solid, Dash::Dashed, Dash::DashDotted][i % 3];
        Curve { name: law.name.into(), points: points.collect(), colour: 0, line: Some(dash), ..Curve::default() }
    };
    let rate = |row: &Row| get(row, &q::TRANSPORT_RATE_DIMENSIONLESS);
    let below = |row: &Row| Some(rate(row)? * get(row, &q::TRANSPORT_SHARE_BED)?);
    let mut transport: Vec<Curve> = (0..LAWS.len()).map(law).collect();
    transport.push(marked("in all", 0, &rate));
    transport.push(marked("in the sheet", 1, &below));
    let largest = layers.iter().filter_map(|row| get(row, &q::SHEET_THICKNESS)).fold(0.0, f64::max);
    let (factor, unit) = readable_unit(largest, "m");
    let metres = |of: &'static Quantity| move |row: &Row| Some(get(row, of)? * factor);
    let thickness = vec![
        line("with the weight along the slope (32)", (0, Dash::Solid), &metres(&q::SHEET_THICKNESS_FULL)),
        line("without (33)", (0, Dash::Dashed), &metres(&q::SHEET_THICKNESS_FLAT)),
        marked("computed", 0, &metres(&q::SHEET_THICKNESS)),
    ];
    let share = |row: &Row| Some(get(row, &q::ROUGHNESS)? / get(row, &q::SHEET_THICKNESS)?);
    vec![
        figure(
            "transport",
            "Dimensionless transport rate over the Shields number, in all and in the sheet, with published laws.",
            Axis::log("transport rate Q*", ""),
            transport,
        ),
        figure(
            "thickness",
            "Thickness of the sheet over the Shields number, computed and by the balance of its grains with the solid \
             fraction computed, eq. (32) and (33) of Revil-Baudard & Chauchat (2013).",
            Axis::linear("thickness δₛ", unit),
            thickness,
        ),
        figure(
            "roughness",
            "Mixing length at the bed level over the thickness of the sheet.",
            Axis { ends: Some((0.0, 0.2)), ..Axis::linear("mixing length over thickness kₛ/δₛ", "") },
            vec![marked("", 0, &share)],
        ),
    ]
}
