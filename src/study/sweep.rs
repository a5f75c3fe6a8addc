//! `sweep`: one case over a grid of values.

use serde_json::json;

use super::Assess;
use super::curves::curve;
use super::range::{MAX_POINTS, Varied, number_and_unit, parse};
use super::{Assessment, Plan, Point, Row, StudyError};
use crate::result::Status;
use crate::result::quantity::{self, Quantity};
use crate::result::{Axis, Curve, Figure, Panel, Scale};
use crate::units::{CommonUnits, parse_quantity, readable_unit, significant};

/// What a sweep shows: the first of these that any point reports.
const QUANTITIES: &[&Quantity] = &[
    &quantity::TRANSPORT_RATE,
    &quantity::DISCHARGE,
    &quantity::SURFACE_VELOCITY,
    &quantity::MEAN_VELOCITY,
    &quantity::U_MAX,
    &quantity::ROUGHNESS_LENGTH,
];
/// From this ratio of largest to smallest on, an axis is logarithmic.
const WIDE: f64 = 100.0;
/// Two numbers that agree to this share are the same.
const SAME: f64 = 1e-9;

/// The plan of a sweep of `case` over the grid of all `--over` arguments, the last one varying fastest, and how to assess it.
///
/// # Errors
/// [`StudyError::BadOver`] with the argument that cannot be read.
pub fn plan(case: &str, overrides: &[String], over: &[String]) -> Result<(Plan, Assess), StudyError> {
    let varied: Vec<Varied> = over.iter().map(|argument| parse(argument)).collect::<Result<_, _>>()?;
    let bad = |reason: String| StudyError::BadOver { argument: over.join(" --over "), reason };
    let count = varied.iter().try_fold(1_usize, |n, v| n.checked_mul(v.values.len())).filter(|n| *n <= MAX_POINTS);
    let count = count.ok_or_else(|| bad(format!("the grid has more than {MAX_POINTS} points")))?;
    if let Some((i, v)) = varied.iter().enumerate().find(|(i, v)| varied[..*i].iter().any(|w| w.key == v.key)) {
        return Err(bad(format!("argument {} varies {} again", i + 1, v.key)));
    }
    let axis = varied.iter().position(|v| v.values.len() > 1 && v.values.iter().all(|v| number_and_unit(v).is_some()));
    let points = (0..count).map(|index| point(&varied, axis, index)).collect();
    let plan = Plan {
        verb: "sweep",
        case: case.into(),
        overrides: overrides.to_vec(),
        options: over.iter().map(|argument| ("over".into(), argument.clone())).collect(),
        varied: varied.iter().map(|v| v.key.clone()).collect(),
        points,
        repeats: 1,
    };
    Ok((plan, Box::new(move |rows: &[Row]| assess(&varied, axis, rows))))
}

/// Point `index` of the grid. Its series is named by what is not on the horizontal axis.
fn point(varied: &[Varied], axis: Option<usize>, mut index: usize) -> Point {
    let mut values = vec![String::new(); varied.len()];
    for (value, v) in values.iter_mut().zip(varied).rev() {
        value.clone_from(&v.values[index % v.values.len()]);
        index /= v.values.len();
    }
    let pairs = || varied.iter().zip(&values).map(|(v, value)| (v.key.as_str(), value.as_str()));
    let others = pairs().enumerate().filter(|(i, _)| Some(*i) != axis);
    let series = others.map(|(_, (key, value))| format!("{} = {value}", key.rsplit('.').next().unwrap_or(key)));
    Point {
        case: None,
        series: series.collect::<Vec<_>>().join(", "),
        overrides: pairs().map(|(key, value)| format!("{key}={value}")).collect(),
        values: values.clone(),
    }
}

fn assess(varied: &[Varied], axis: Option<usize>, rows: &[Row]) -> Assessment {
    let reported = QUANTITIES.iter().copied().find(|q| rows.iter().any(|row| row.result(q.name).is_some()));
    let keys: Vec<&str> = varied.iter().map(|v| v.key.as_str()).collect();
    let mut assessment = Assessment { subtitle: format!("Over {}.", keys.join(" and ")), ..Assessment::default() };
    let Some(reported) = reported else { return assessment };
    let known = rows.iter().filter(|row| row.status == Status::Done);
    let known: Vec<(f64, &Row)> = known.filter_map(|row| Some((row.result(reported.name)?, row))).collect();
    let units = CommonUnits::of(known.iter().map(|(value, _)| (*value, reported.unit)));
    let ends = [known.iter().min_by(|a, b| a.0.total_cmp(&b.0)), known.iter().max_by(|a, b| a.0.total_cmp(&b.0))];
    for (label, end) in ["smallest", "largest"].into_iter().zip(ends) {
        let Some((value, row)) = end else { continue };
        let at: Vec<String> = keys.iter().zip(&row.point.values).map(|(key, v)| format!("{key} = {v}")).collect();
        let shields = row.result(quantity::SHIELDS.name).map(|x| format!(" (θ = {})", significant(x, 3)));
        let text = format!(
            "{} {} at {}{}",
            reported.title,
            units.readable(*value, reported.unit),
            at.join(", "),
            shields.unwrap_or_default()
        );
        assessment.findings.push((label.into(), text));
        assessment
            .facts
            .insert(label.into(), json!({ "quantity": reported.name, "value": value, "values": row.point.values }));
    }
    assessment.figures.extend(figure(varied, axis, rows, reported));
    assessment.figures.extend(super::sheet::figures(rows));
    super::coupled::assess(&keys, rows, &mut assessment);
    assessment
}

/// A value on the horizontal axis: as typed where all have one unit, else in SI.
fn positions(values: &[String]) -> Option<(Vec<f64>, String)> {
    let pairs: Vec<(f64, &str)> = values.iter().map(|v| number_and_unit(v)).collect::<Option<_>>()?;
    let unit = pairs.first()?.1;
    if pairs.iter().all(|(_, u)| *u == unit) {
        return Some((pairs.iter().map(|p| p.0).collect(), unit.to_owned()));
    }
    let si = values.iter().zip(&pairs).map(|(value, (_, unit))| parse_quantity(value, unit).ok());
    Some((si.collect::<Option<_>>()?, "SI".into()))
}

fn figure(varied: &[Varied], axis: Option<usize>, rows: &[Row], reported: &'static Quantity) -> Option<Figure> {
    let axis = axis?;
    let key = varied.get(axis)?;
    let (x, unit) = positions(&key.values)?;
    let place = |row: &Row| x.get(key.values.iter().position(|v| row.point.values.get(axis) == Some(v))?).copied();
    let value = |row: &Row, name: &str| row.result(name).filter(|_| row.status == Status::Done);
    let of = |name: &str| rows.iter().filter_map(|row| value(row, name)).collect::<Vec<f64>>();
    let (factor, y_unit) =
        readable_unit(of(reported.name).into_iter().fold(0.0, |m, x| f64::max(m, x.abs())), reported.unit);
    let mut series: Vec<&str> = Vec::new();
    for row in rows {
        if !series.contains(&row.point.series.as_str()) {
            series.push(&row.point.series);
        }
    }
    let curves = |x: &dyn Fn(&Row) -> Option<f64>, named: bool| -> Vec<Curve> {
        let one = |(i, name): (usize, &&str)| {
            let of = rows.iter().filter(|row| row.point.series == **name);
            let points = of.map(|row| (x(row).unwrap_or(f64::NAN), value(row, reported.name).map(|y| y * factor)));
            curve(if named { name } else { "" }, i, points)
        };
        series.iter().enumerate().map(one).collect()
    };
    let mut panels = vec![Panel { x: scaled(&key.key, &unit, &x, key.log), curves: curves(&place, true) }];
    let shields = of(quantity::SHIELDS.name);
    let theta = |row: &Row| value(row, quantity::SHIELDS.name);
    // A sweep over the Shields number itself has it on its axis already.
    let agree = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let again = rows.iter().all(|row| place(row).zip(theta(row)).is_none_or(|(x, theta)| agree(x, theta)));
    if !shields.is_empty() && !again {
        let x = scaled(quantity::SHIELDS.title, "1", &shields, false);
        panels.push(Panel { x, curves: curves(&theta, false) });
    }
    let against = if panels.len() > 1 {
        format!("(a) {}, (b) the {}", key.key, quantity::SHIELDS.title)
    } else {
        key.key.clone()
    };
    Some(Figure {
        stem: "sweep".into(),
        caption: format!("{} over {against}.", capitalised(reported.title)),
        y: scaled(reported.title, y_unit, &of(reported.name), false),
        panels,
        levels: Vec::new(),
        tint_below: None,
    })
}

/// An axis for these values: logarithmic where that is wanted, or where they are positive and lie far apart.
fn scaled(title: &str, unit: &str, values: &[f64], log: bool) -> Axis {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
    let log = low > 0.0 && (log || high > WIDE * low);
    Axis { scale: if log { Scale::Log } else { Scale::Linear }, ..Axis::linear(title, unit) }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
