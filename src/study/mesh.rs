//! Convergence over the mesh: observed orders for each kind of mesh that a model has.

use std::borrow::Cow;

use serde_json::{Map, json};

use super::curves::{curve, error_text, line, range_text};
use super::errors::Reference;
use super::errors::{Columns, L2, RMS, RMS_PAPER, ReferenceSolution, column};
use super::orders::{ROUND_OFF, overall, slopes};
use super::{Assessment, Point, Row};
use crate::model::ClosedForm;
use crate::model::{Focus, Meshes};
use crate::result::Status;
use crate::result::{Axis, Curve, Dash, Figure, Panel};

/// What is varied.
pub(super) const KEY: &str = "grid.cells";
const REFERENCE: &str = "reference";
/// Order of all methods where the solution is smooth.
const ORDER: i32 = 2;

pub(super) fn points(meshes: &Meshes, reference: Reference) -> Vec<Point> {
    let point = |series: &str, cells: usize, kind: &[&str]| Point {
        case: None,
        series: series.into(),
        values: vec![cells.to_string()],
        overrides: meshes.set(cells, kind),
    };
    let mut points = Vec::new();
    if let (Reference::Finest, Some((_, kind))) = (reference, meshes.kinds.first()) {
        points.push(point(REFERENCE, meshes.reference, kind));
    }
    for (series, kind) in meshes.kinds {
        points.extend(meshes.cells.iter().map(|&cells| point(series, cells, kind)));
    }
    points
}

fn cells(row: &Row) -> f64 {
    row.point.values.first().and_then(|v| v.parse().ok()).unwrap_or(f64::NAN)
}

/// One kind of mesh: its rows, their cells and their errors of each kind.
struct Series<'a> {
    name: &'static str,
    rows: Vec<usize>,
    cells: Vec<f64>,
    measures: &'a Columns,
}

impl Series<'_> {
    fn errors(&self, name: &str) -> Vec<Option<f64>> {
        let all = column(self.measures, name);
        self.rows.iter().map(|&i| all.get(i).copied().flatten()).collect()
    }

    /// Orders from each mesh to the one before it.
    fn orders(&self, name: &str) -> Vec<Option<f64>> {
        slopes(&self.cells, &self.errors(name)).into_iter().map(|slope| slope.map(|slope| -slope)).collect()
    }

    /// Order from the coarsest to the finest mesh whose errors are more than round-off.
    fn order(&self, name: &str) -> Option<f64> {
        overall(&self.cells, &self.errors(name)).map(|slope| -slope)
    }

    /// Errors from the coarsest to the finest mesh and the orders between, or that there is nothing but round-off.
    fn text(&self, name: &str) -> String {
        let known: Vec<f64> = self.errors(name).into_iter().flatten().collect();
        let (Some(first), Some(last)) = (known.first(), known.last()) else { return "unknown".into() };
        let worst = known.iter().copied().fold(0.0, f64::max);
        if worst <= ROUND_OFF {
            return format!("round-off on every mesh (at most {worst:.0e})");
        }
        let whole = self.order(name).map(|order| format!(", order {order:.2}")).unwrap_or_default();
        let between = range_text(self.orders(name).into_iter().flatten());
        let between = between.map(|range| format!(" ({range} from mesh to mesh)")).unwrap_or_default();
        format!("{} to {}{whole}{between}", error_text(*first), error_text(*last))
    }
}

pub(super) fn assess(focus: &Focus, meshes: &Meshes, closed: Option<&dyn ClosedForm>, rows: &[Row]) -> Assessment {
    let finest = rows.iter().find(|row| row.point.series == REFERENCE && row.status == Status::Done);
    let solution = |row: &Row| {
        let (profile, results) = match closed {
            Some(form) => (Cow::Owned(form.at(row.profile.as_ref()?)?), form.results()),
            None => {
                let finest = finest.filter(|finest| !std::ptr::eq(*finest, row))?;
                (Cow::Borrowed(finest.profile.as_ref()?), &finest.results)
            }
        };
        Some(ReferenceSolution { profile, results, exact_yield: false })
    };
    let mut measures = focus.measures(rows, solution);
    let mut more: Columns = Vec::new();
    let kinds: Vec<Series<'_>> = meshes.kinds.iter().map(|(name, _)| series(name, rows, &measures)).collect();
    let mut assessment = Assessment {
        subtitle: format!(
            "Relative error of the {} against {}.",
            focus.velocity.title,
            if closed.is_some() {
                "the closed form, at the nodes".into()
            } else {
                format!("{} cells", meshes.reference)
            }
        ),
        figures: vec![figure(focus, &kinds)],
        ..Assessment::default()
    };
    let wanted: Vec<(String, &str)> = std::iter::once((L2.to_owned(), "velocity (L2)"))
        .chain(focus.numbers.iter().map(|number| (number.column(), number.quantity.title)))
        .collect();
    let mut facts = Map::new();
    for kind in &kinds {
        if let [only] = &kinds[..] {
            let text = |(name, title): &(String, &str)| ((*title).to_owned(), only.text(name));
            assessment.findings.extend(wanted.iter().map(text));
        } else {
            let text = wanted.iter().map(|(name, title)| format!("{title} {}", kind.text(name)));
            assessment.findings.push((kind.name.into(), text.collect::<Vec<_>>().join("; ")));
        }
        if let (true, Some(paper), Some(own)) = (focus.paper_rms, kind.order(RMS_PAPER), kind.order(RMS))
            && kind.order(L2).is_some()
        {
            let text =
                format!("order {paper:.2} where the root mean square has {own:.2}: it divides by N outside the root");
            assessment.findings.push(("  RMS of the paper".into(), text));
        }
        let number = focus.numbers.first().and_then(|number| kind.order(&number.column()));
        let mut orders = Map::new();
        orders.insert("order_velocity".into(), json!(kind.order(L2)));
        orders.insert("order_number".into(), json!(number));
        for number in focus.numbers {
            orders.insert(format!("order_{}", number.short), json!(kind.order(&number.column())));
        }
        facts.insert(kind.name.into(), orders.into());
    }
    for (name, _) in &wanted {
        let mut orders = vec![None; rows.len()];
        for kind in &kinds {
            for (&i, order) in kind.rows.iter().zip(kind.orders(name)) {
                orders[i] = order;
            }
        }
        more.push((name.replacen("error", "order", 1), orders));
    }
    assessment.findings.extend(meshes.remarks.iter().map(|&(label, text)| (label.to_owned(), text.to_owned())));
    // Where there is a closed form, the corner at the yield level is all there is of an error.
    if closed.is_some() {
        let moves = "without a node there, the error goes with the square of the distance from the yield level to the nearest node";
        assessment.findings.push(("orders".into(), moves.into()));
    }
    assessment.facts.insert("orders_from_coarsest_to_finest".into(), facts.into());
    drop(kinds);
    measures.extend(more);
    assessment.measures = measures;
    assessment
}

fn series<'a>(name: &'static str, rows: &[Row], measures: &'a Columns) -> Series<'a> {
    let of: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].point.series == name).collect();
    let cells = of.iter().map(|&i| cells(&rows[i])).collect();
    Series { name, rows: of, cells, measures }
}

/// A panel for the velocity and one for the first number where there are several kinds of mesh; else one for all measures.
fn figure(focus: &Focus, kinds: &[Series<'_>]) -> Figure {
    let all = kinds.iter().flat_map(|kind| kind.cells.iter().copied());
    let (fewest, most) = all.fold((f64::INFINITY, 0.0_f64), |(a, b), n| (a.min(n), b.max(n)));
    let drawn = |label: &str, i: usize, kind: &Series<'_>, name: &str| {
        let errors = kind.errors(name).into_iter().map(|e| e.filter(|e| *e > 0.0));
        curve(label, i, kind.cells.iter().copied().zip(errors))
    };
    let panel = |mut curves: Vec<Curve>, named: bool| {
        let largest = curves.iter().flat_map(|c| c.points.iter().flatten()).map(|p| p.1).fold(0.0, f64::max);
        if largest > ROUND_OFF {
            let guide = vec![(fewest, 2.0 * largest), (most, 2.0 * largest * (fewest / most).powi(ORDER))];
            let name = if named { format!("order {ORDER}") } else { String::new() };
            curves.push(line(name, curves.len().max(3), Dash::Dotted, guide));
        }
        // Ends between two decades: no number stands where the next panel begins.
        Panel { x: Axis { ends: Some((0.75 * fewest, 1.4 * most)), ..Axis::log("cells", "1") }, curves }
    };
    let (velocity, first) = (focus.velocity.title, focus.numbers.first());
    let (caption, y, panels) = match (kinds, first) {
        ([_, _, ..], Some(number)) => {
            let of = |name: &str, named: bool| {
                let label = |kind: &Series<'_>| if named { kind.name } else { "" };
                panel(kinds.iter().enumerate().map(|(i, kind)| drawn(label(kind), i, kind, name)).collect(), named)
            };
            let number_title = number.quantity.title;
            (
                format!("(a) L² norm of the {velocity}, (b) {number_title}"),
                format!("relative error of (a) velocity, (b) {number_title}"),
                vec![of(L2, true), of(&number.column(), false)],
            )
        }
        _ => {
            let titles = focus.numbers.iter().map(|number| (number.column(), number.quantity.title));
            let titles: Vec<(String, &str)> = std::iter::once((L2.to_owned(), "velocity (L2)")).chain(titles).collect();
            let curves = kinds
                .iter()
                .flat_map(|kind| titles.iter().enumerate().map(move |(i, (name, title))| drawn(title, i, kind, name)));
            let caption = format!("L² norm of the {velocity}, and numbers");
            (caption, "relative error".into(), vec![panel(curves.collect(), true)])
        }
    };
    Figure {
        stem: "convergence".into(),
        caption: format!(
            "Relative error over the number of cells: {caption}. Errors below {ROUND_OFF:.0e} are round-off."
        ),
        y: Axis::log(&y, "1"),
        panels,
        levels: Vec::new(),
        tint_below: None,
    }
}
