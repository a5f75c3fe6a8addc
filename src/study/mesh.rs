//! Convergence over the mesh, at the exact yield: observed orders with and without a node on the yield level.

use std::borrow::Cow;

use serde_json::{Map, json};

use super::converge::{Reference, curve, error_text, line, range_text};
use super::errors::{Focus, L2, Meshes, RMS, RMS_PAPER, Truth, column};
use super::orders::{ROUND_OFF, overall, slopes};
use super::regularisation::exact_yield;
use super::{Judgement, Point, Row};
use crate::model::{OnMesh, Problem};
use crate::models::bingham::RegularisedPlane;
use crate::models::exact::bed::LaminarBed;
use crate::models::exact::bingham::BinghamPlane;
use crate::models::exact::{bingham, ouriemi};
use crate::models::laminar::RegularisedBed;
use crate::plot::{Axis, Dash, Figure, Panel};
use crate::result::quantity::{U_MIXTURE, U_PARTICLE};
use crate::result::{Profile, Quiet, Results, Status};

/// What is varied.
pub(super) const KEY: &str = "grid.cells";
/// Levels of a closed form whose profile is not used.
const LEVELS: usize = 24;
const SERIES: [&str; 2] = ["node on the yield level", "no node there"];
const REFERENCE: &str = "reference";

/// The solution of the exact yield, to round-off.
#[derive(Clone, Debug)]
pub(super) struct ClosedForm {
    velocity: Velocity,
    results: Results,
}

#[derive(Clone, Debug)]
enum Velocity {
    Bed(Box<(LaminarBed, ouriemi::Solution)>),
    Plane(bingham::Solution),
}

impl ClosedForm {
    /// The closed form of the exact yield of `problem`, if it has one and that can be evaluated.
    pub fn of(problem: &Problem) -> Option<Self> {
        let (velocity, outcome) = if let Some(OnMesh { problem: RegularisedBed { bed, .. }, .. }) = problem.get() {
            let solution = ouriemi::solve(bed, |_| {}).ok().filter(|_| bed.rise.is_none())?;
            (Velocity::Bed(Box::new((*bed, solution))), ouriemi::run(bed, LEVELS, &mut Quiet))
        } else {
            let OnMesh { problem: RegularisedPlane { plane, .. }, .. } = problem.get()?;
            (exact_plane(plane)?, bingham::run(plane, LEVELS, &mut Quiet))
        };
        let outcome = outcome.ok()?;
        Some(Self { velocity, results: outcome.results })
    }

    /// Its numbers [SI].
    pub fn results(&self) -> &Results {
        &self.results
    }

    /// The velocity at the levels of `run`.
    fn at(&self, run: &Profile) -> Option<Profile> {
        let levels = run.axis();
        let mut profile = Profile::new(levels.clone()).ok()?;
        match &self.velocity {
            Velocity::Bed(bed) => {
                let (bed, solution) = bed.as_ref();
                // The top of the grains may lie an ulp above the bed level.
                let grains = |z: f64| bed.velocity_scale() * solution.particle(z.min(bed.h_p) / bed.h);
                let defined = run.get(&U_PARTICLE)?.iter().map(Option::is_some);
                let values = levels.iter().zip(defined).map(|(&z, defined)| defined.then(|| grains(z)));
                profile.push(&U_PARTICLE, values.collect()).ok()?;
            }
            Velocity::Plane(solution) => {
                profile.push(&U_MIXTURE, levels.iter().map(|&z| Some(solution.velocity(z))).collect()).ok()?;
            }
        }
        Some(profile)
    }
}

fn exact_plane(plane: &BinghamPlane) -> Option<Velocity> {
    bingham::Solution::new(plane, |_| {}).ok().map(Velocity::Plane)
}

pub(super) fn points(reference: Reference, meshes: Meshes) -> Vec<Point> {
    let Meshes { coarsest, count, node: key } = meshes;
    let point = |series: &str, cells: usize, node: bool| {
        let grid = [format!("{KEY}={cells}"), format!("{key}={node}")];
        Point {
            case: None,
            series: series.into(),
            values: vec![cells.to_string()],
            overrides: [&grid[..], &exact_yield()].concat(),
        }
    };
    let mut points = Vec::new();
    if reference == Reference::Finest {
        points.push(point(REFERENCE, coarsest << count, true));
    }
    for (series, node) in SERIES.into_iter().zip([true, false]) {
        points.extend((0..count).map(|i| point(series, coarsest << i, node)));
    }
    points
}

fn cells(row: &Row) -> f64 {
    row.point.values.first().and_then(|v| v.parse().ok()).unwrap_or(f64::NAN)
}

pub(super) fn judge(focus: &Focus, closed: Option<&ClosedForm>, rows: &[Row]) -> Judgement {
    let finest = rows.iter().find(|row| row.point.series == REFERENCE && row.status == Status::Done);
    let truth = |row: &Row| match closed {
        Some(form) => Some(Truth { profile: Cow::Owned(form.at(row.profile.as_ref()?)?), results: &form.results }),
        None => {
            let finest = finest.filter(|finest| !std::ptr::eq(*finest, row))?;
            Some(Truth { profile: Cow::Borrowed(finest.profile.as_ref()?), results: &finest.results })
        }
    };
    let mut measures = focus.measures(rows, truth);
    let mut judgement = Judgement {
        subtitle: format!(
            "Relative error of the {} against {}.",
            focus.velocity.title,
            if closed.is_some() { "the closed form, at the nodes" } else { "the finest mesh" }
        ),
        figures: vec![figure(focus, rows, &measures)],
        ..Judgement::default()
    };
    let mut facts = Map::new();
    let wanted = [(L2.to_owned(), "velocity (L2)"), (focus.number_error(), focus.number.0.title)];
    let (mut by_velocity, mut by_number) = (vec![None; rows.len()], vec![None; rows.len()]);
    for series in SERIES {
        let of: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].point.series == series).collect();
        let x: Vec<f64> = of.iter().map(|&i| cells(&rows[i])).collect();
        let errors = |name: &str| -> Vec<Option<f64>> {
            let all = column(&measures, name);
            of.iter().map(|&i| all.get(i).copied().flatten()).collect()
        };
        let orders = |name: &str| -> Vec<Option<f64>> {
            slopes(&x, &errors(name)).into_iter().map(|order| order.map(|order| -order)).collect()
        };
        let text = wanted.iter().map(|(name, title)| format!("{title} {}", text(&errors(name), &x, &orders(name))));
        judgement.findings.push((series.into(), text.collect::<Vec<_>>().join("; ")));
        let order = |name: &str| overall(&x, &errors(name)).map(|slope| -slope);
        facts.insert(series.into(), json!({ "order_velocity": order(L2), "order_number": order(&wanted[1].0) }));
        if let (Some(paper), Some(own), Some(_)) = (order(RMS_PAPER), order(RMS), order(L2)) {
            let text =
                format!("order {paper:.2} where the root mean square has {own:.2}: it divides by N outside the root");
            judgement.findings.push(("  RMS of the paper".into(), text));
        }
        for (column, name) in [(&mut by_velocity, L2), (&mut by_number, wanted[1].0.as_str())] {
            for (&i, order) in of.iter().zip(orders(name)) {
                column[i] = order;
            }
        }
    }
    judgement.findings.push(("yield".into(), "exact".into()));
    // With Coulomb friction the corner is all there is of an error.
    if closed.is_some() {
        let moves = "without a node there, the error goes with the square of the distance from the yield level to the nearest node";
        judgement.findings.push(("orders".into(), moves.into()));
    }
    judgement.facts.insert("orders_from_coarsest_to_finest".into(), facts.into());
    measures.push(("order_velocity_l2".into(), by_velocity));
    measures.push((format!("order_{}", focus.number.1), by_number));
    judgement.measures = measures;
    judgement
}

/// Errors from the coarsest to the finest mesh and the orders between, or that there is nothing but round-off.
fn text(errors: &[Option<f64>], cells: &[f64], orders: &[Option<f64>]) -> String {
    let known: Vec<f64> = errors.iter().copied().flatten().collect();
    let (Some(first), Some(last)) = (known.first(), known.last()) else { return "unknown".into() };
    let worst = known.iter().copied().fold(0.0, f64::max);
    if worst <= ROUND_OFF {
        return format!("round-off on every mesh (at most {worst:.0e})");
    }
    let whole = overall(cells, errors).map(|slope| format!(", order {:.2}", -slope)).unwrap_or_default();
    let between = range_text(orders.iter().copied().flatten()).map(|range| format!(" ({range} from mesh to mesh)"));
    format!("{} to {}{whole}{}", error_text(*first), error_text(*last), between.unwrap_or_default())
}

fn figure(focus: &Focus, rows: &[Row], measures: &[(String, Vec<Option<f64>>)]) -> Figure {
    let all = rows.iter().filter(|row| row.point.series != REFERENCE).map(cells);
    let (fewest, most) = all.fold((f64::INFINITY, 0.0_f64), |(a, b), n| (a.min(n), b.max(n)));
    let panel = |name: &str, named: bool| {
        let errors = column(measures, name);
        let at = |i: usize| errors.get(i).copied().flatten().filter(|e| *e > 0.0);
        let mut curves = Vec::new();
        for (k, series) in SERIES.iter().enumerate() {
            let of = (0..rows.len()).filter(|&i| rows[i].point.series == *series);
            curves.push(curve(if named { series } else { "" }, k, of.map(|i| (cells(&rows[i]), at(i)))));
        }
        let largest = (0..rows.len()).filter_map(at).fold(0.0, f64::max);
        if largest > ROUND_OFF {
            let (a, b) = (fewest, most);
            let guide = vec![(a, 2.0 * largest), (b, 2.0 * largest * (a / b).powi(2))];
            curves.push(line(if named { "order 2".into() } else { String::new() }, 3, Dash::Dotted, guide));
        }
        // Ends between two decades: no number stands where the next panel begins.
        Panel { x: Axis { ends: Some((0.75 * fewest, 1.4 * most)), ..Axis::log("cells", "1") }, curves }
    };
    Figure {
        stem: "convergence".into(),
        caption: format!(
            "Relative error over the number of cells: (a) L² norm of the {}, (b) {}. Errors below {ROUND_OFF:.0e} are round-off.",
            focus.velocity.title, focus.number.0.title
        ),
        y: Axis::log("relative error of (a) velocity, (b) transport rate", "1"),
        panels: vec![panel(L2, true), panel(&focus.number_error(), false)],
        levels: Vec::new(),
        tint_below: None,
    }
}
