//! Figures that only colliding grains have: how friction and solid fraction go with the inertial number, beside the dense
//! rheology.

use crate::closures::kinetic::{Inertial, PHI_C};
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Outcome, Panel, Profile};

/// Inertial numbers that are drawn.
const DRAWN: std::ops::Range<f64> = 1e-4..1e2;
/// Solid fraction above which grains are drawn.
const ENOUGH: f64 = 1e-3;

/// The profiles at the phases of waves, if there are some.
fn phases(name: &str, profile: &Profile) -> Option<Figure> {
    profile.get(&q::PHI_270)?;
    const NAMES: [&str; 4] = ["0°", "90°", "180°", "270°"];
    const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::DashDotted, Dash::Dotted];
    let curve = |phase: usize, quantity: &Quantity| {
        let values = profile.get(quantity)?;
        let points = profile.axis().into_iter().zip(values).map(|(z, value)| Some(((*value)?, z))).collect();
        // One legend, in the first panel.
        let name = if quantity.unit == "1" { NAMES[phase].into() } else { String::new() };
        let line = Some(DASHES[phase]);
        Some(Curve { name, points, colour: phase + 1, line, ..Curve::default() })
    };
    let panel =
        |k: usize, axis: Axis| Panel { x: axis, curves: (0..4).filter_map(|i| curve(i, q::PHASES[i][k])).collect() };
    Some(Figure {
        stem: "phases".into(),
        caption: format!("{name}: profiles at four phases of the waves; the clear fluid is fastest at 90° and 270°."),
        y: Axis::elevation("m"),
        panels: vec![
            panel(0, Axis::linear("solid fraction φ", "")),
            panel(1, Axis::linear("fluid velocity", "m/s")),
            panel(2, Axis::linear("grain velocity", "m/s")),
        ],
        levels: Vec::new(),
        tint_below: None,
    })
}

/// The figures of the run `name`: the phases of waves, and what needs kinetic theory.
pub(super) fn figures(name: &str, outcome: &Outcome) -> Vec<Figure> {
    let phases = outcome.profile.as_ref().and_then(|profile| phases(name, profile));
    phases.into_iter().chain(inertial(name, outcome)).collect()
}

/// Those over the inertial number; none without kinetic theory or where hardly a grain moves.
fn inertial(name: &str, outcome: &Outcome) -> Vec<Figure> {
    let Some(profile) = outcome.profile.as_ref().filter(|profile| profile.get(&q::PRODUCTION).is_some()) else {
        return Vec::new();
    };
    let at = |quantity: &Quantity, row: usize| profile.get(quantity)?.get(row).copied().flatten();
    let inertial = |row: usize| at(&q::INERTIAL_NUMBER, row).filter(|i| DRAWN.contains(i));
    let drawn = |row: &usize| at(&q::PHI, *row).is_some_and(|phi| phi > ENOUGH) && inertial(*row).is_some();
    let rows: Vec<usize> = (0..profile.rows()).filter(drawn).collect();
    if rows.len() < 2 {
        return Vec::new();
    }
    let curve = |name: &str, (colour, dash): (usize, Dash), value: &dyn Fn(usize, f64) -> Option<f64>| {
        let point = |&row: &usize| inertial(row).and_then(|i| Some((i, value(row, i)?)));
        Curve {
            name: name.into(),
            points: rows.iter().map(point).collect(),
            colour,
            line: Some(dash),
            ..Curve::default()
        }
    };
    let figure =
        |stem: &str, title: &str, own: &dyn Fn(usize, f64) -> Option<f64>, law: &str, of: &dyn Fn(f64) -> f64| {
            let curves =
                vec![curve("here", (2, Dash::Solid), own), curve(law, (0, Dash::DashDotted), &|_, i| Some(of(i)))];
            Figure {
                stem: stem.into(),
                caption: format!("{name}: {title} over the inertial number."),
                y: Axis::linear(title, ""),
                panels: vec![Panel { x: Axis::log("inertial number I", ""), curves }],
                levels: Vec::new(),
                tint_below: None,
            }
        };
    let friction = |row: usize, _: f64| Some(at(&q::TAU_PARTICLE, row)? / at(&q::P_PARTICLE, row)?);
    let dense = Inertial::default();
    vec![
        figure("friction_inertial", "friction τₚ/Pₚ", &friction, "μ(I)", &|i| dense.mu(i)),
        figure("fraction_inertial", "solid fraction φ", &|row, _| at(&q::PHI, row), "φ(I)", &|i| {
            PHI_C / (1.0 + dense.b * i)
        }),
    ]
}
