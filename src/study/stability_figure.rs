//! The figure of a map of stability: what came of each point, and the limits between them.

use super::Row;
use super::chart::time_text;
use super::curves::line;
use super::limits::{Found, Limit};
use super::range::{Varied, number_and_unit};
use crate::result::{Axis, Class, Curve, Dash, Figure, Marker, Panel, Scale};

fn marker(class: Class) -> Marker {
    match class {
        Class::Holds => Marker::Circle,
        Class::Inaccurate => Marker::Triangle,
        Class::Refused => Marker::Square,
        Class::NotConverged | Class::Diverged | Class::Unphysical => Marker::Cross,
    }
}

/// What the points stand over: the second key, the error of what has one, or the class.
#[derive(Clone, Copy, PartialEq)]
enum Height {
    /// numbers of a second key
    Numbers,
    /// words of a second key
    Words,
    /// errors; what has none at the top
    Error { low: f64, top: f64 },
    /// the class alone
    Class,
}

/// The classes over one key (and the error of what has one) or over two, the limits between them dashed, the predicted one dotted.
pub(super) fn figure(
    varied: &[Varied],
    rows: &[Row],
    found: &[Found],
    limits: &[Limit],
    predicted: Option<f64>,
) -> Figure {
    let number = |row: &Row, i: usize| row.point.values.get(i).and_then(|v| number_and_unit(v)).map(|p| p.0);
    let unit = |i: usize| {
        let value = varied.get(i).and_then(|v| v.values.first()).and_then(|v| number_and_unit(v));
        value.map_or("", |p| p.1).to_owned()
    };
    let axis = |i: usize| {
        let key = varied.get(i).map_or("", |v| v.key.as_str());
        let values = || rows.iter().filter_map(move |row| number(row, i));
        let (low, high) = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let scale = if low > 0.0 && high >= 20.0 * low { Scale::Log } else { Scale::Linear };
        Axis { scale, ..Axis::linear(key, &unit(i)) }
    };
    let errors = || found.iter().filter_map(|what| what.error);
    let kind = match varied.len() {
        0 | 1 if errors().next().is_none() => Height::Class,
        0 | 1 => {
            let (low, high) = errors().fold((f64::INFINITY, 0.1), |(a, b), x| (f64::min(a, x), f64::max(b, x)));
            Height::Error { low, top: 10.0 * high }
        }
        _ if rows.iter().all(|row| number(row, 1).is_some()) => Height::Numbers,
        _ => Height::Words,
    };
    let place = |of: usize| of as f64;
    let second = |row: &Row| match kind {
        Height::Numbers => number(row, 1),
        _ => varied.get(1)?.values.iter().position(|v| row.point.values.get(1) == Some(v)).map(place),
    };
    let height = |row: &Row, what: &Found| match kind {
        Height::Numbers | Height::Words => second(row),
        Height::Error { top, .. } => Some(what.error.unwrap_or(top)),
        Height::Class => Class::ALL.iter().position(|c| *c == what.class).map(place),
    };
    let curve = |(i, class): (usize, &Class)| {
        let of = rows.iter().zip(found).filter(|(_, what)| what.class == *class);
        let of: Vec<_> = of.filter_map(|(row, what)| Some((number(row, 0)?, height(row, what)?, row, what))).collect();
        let note = |row: &Row, what: &Found| {
            let why = if what.reason.is_empty() { String::new() } else { format!(": {}", what.reason) };
            let names: Vec<String> = varied.iter().map(|v| v.key.clone()).collect();
            format!("{}: {}{why} ({})", row.point.name(&names), class.name(), time_text(row.cost.solve_s))
        };
        Curve {
            name: class.name().into(),
            points: of.iter().map(|p| Some((p.0, p.1))).collect(),
            notes: of.iter().map(|p| note(p.2, p.3)).collect(),
            colour: [3, 5, 2, 4, 1, 0][i],
            marker: Some(marker(*class)),
            ..Curve::default()
        }
    };
    let mut curves: Vec<Curve> = Class::ALL.iter().enumerate().map(curve).filter(|c| !c.points.is_empty()).collect();
    curves.extend(borders(kind, rows, limits, &second));
    let heights = || curves.iter().flat_map(|c| &c.points).flatten().map(|p| p.1);
    let (low, high) = heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(y), b.max(y)));
    if let Some(x) = predicted.filter(|_| low < high) {
        curves.push(line("predicted limit".into(), 0, Dash::Dotted, vec![(x, low), (x, high)]));
    }
    let names = || Class::ALL.map(|class| class.name().to_owned()).to_vec();
    let limited = if limits.is_empty() { "" } else { "; dashed: the limit, bisected" };
    let expected = if predicted.is_some() { "; dotted: the limit that was predicted" } else { "" };
    let keys: Vec<&str> = varied.iter().map(|v| v.key.as_str()).collect();
    Figure {
        stem: "stability".into(),
        caption: format!("Where the method holds, over {}{limited}{expected}.", keys.join(" and ")),
        y: match kind {
            Height::Numbers => axis(1),
            Height::Words => varied.get(1).map_or_else(|| axis(1), |v| Axis::named(&v.key, v.values.clone())),
            Height::Error { .. } => Axis::log("error; what fails at the top", "1"),
            Height::Class => Axis::named("class", names()),
        },
        panels: vec![Panel { x: axis(0), curves }],
        levels: Vec::new(),
        tint_below: None,
    }
}

/// The limits as lines: across the whole panel over one key, along the rows of a second one, numbers joined from row to row.
fn borders(kind: Height, rows: &[Row], limits: &[Limit], second: &dyn Fn(&Row) -> Option<f64>) -> Vec<Curve> {
    let at = |limit: &Limit| 0.5 * (limit.holds + limit.fails);
    let across = |limit: &Limit, low: f64, high: f64| vec![Some((at(limit), low)), Some((at(limit), high)), None];
    let row_of = |limit: &Limit| rows.iter().find(|row| row.point.series == limit.series).and_then(second);
    let mut lines: Vec<Vec<Option<(f64, f64)>>> = match kind {
        Height::Class => limits.iter().map(|l| across(l, -0.5, Class::ALL.len() as f64 - 0.5)).collect(),
        Height::Error { low, top } => limits.iter().map(|l| across(l, low, top)).collect(),
        Height::Words => limits.iter().filter_map(|l| row_of(l).map(|y| across(l, y - 0.5, y + 0.5))).collect(),
        Height::Numbers => Vec::new(),
    };
    if kind == Height::Numbers {
        let mut heights: Vec<(f64, &str)> = Vec::new();
        for row in rows {
            let name = row.point.series.as_str();
            if let Some(y) = second(row).filter(|_| heights.iter().all(|(_, known)| *known != name)) {
                heights.push((y, name));
            }
        }
        heights.sort_by(|a, b| a.0.total_cmp(&b.0));
        for upper in [true, false] {
            let of = |name: &str, k: usize| {
                limits.iter().filter(|l| l.series == name && (l.holds < l.fails) == upper).nth(k).map(at)
            };
            let joined = |k: usize| heights.iter().map(|(y, name)| Some((of(name, k)?, *y))).collect::<Vec<_>>();
            lines.extend((0..limits.len()).map(joined).take_while(|points| points.iter().any(Option::is_some)));
        }
    }
    let curve = |(i, points): (usize, Vec<_>)| Curve {
        name: if i == 0 { "limit".into() } else { String::new() },
        points,
        line: Some(Dash::Dashed),
        ..Curve::default()
    };
    lines.into_iter().enumerate().map(curve).collect()
}
