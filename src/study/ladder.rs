//! The ladder of a case: the numerical settings that answer it, from cheap and coarse to dear and fine.
//!
//! Every rung is an ordinary case, so it can be run by hand with the same `--set`. A setting that a case refuses is left
//! out: the ladder of a model is longer than any one of its cases allows.

use super::Point;
use super::focus::{Focus, Sizes};
use crate::problem::{Model, Problem};

/// What is varied, as a column of the table.
pub(super) const KEY: &str = "setting";
/// Sizes of the regularisation.
const LAMBDAS: [&str; 4] = ["1e-2", "1e-4", "1e-6", "1e-8"];

/// A rung: series, setting in words, changes of the case.
type Rung = (&'static str, String, Vec<String>);

/// What is solved much finer than all rungs: changes of the case, and what it is in words. `None` where refining has no end that can be
/// paid for: the last rung is the finest.
pub(super) fn finest(problem: &Problem) -> Option<(String, Vec<String>)> {
    let cells = problem.cells;
    let sizes = Focus::of(problem).and_then(|focus| focus.sizes);
    let exact = || sizes.map(|sizes| sizes.exactly()).unwrap_or_default();
    let fine = |cells: usize, more: Vec<String>| {
        Some((format!("exact yield, {cells} cells"), [vec![format!("grid.cells={cells}")], more].concat()))
    };
    match problem.model {
        Model::Laminar(_) | Model::Bingham(_) => fine(4 * cells.max(400), exact()),
        Model::SheetFlow(_) => fine(8 * cells.max(300), exact()),
        Model::Duct(_) | Model::Cavity(_) => fine(128, [newton(), exact(), vec!["grid.along=".into()]].concat()),
        Model::TwoFluid(_) => Some(("960 cells".into(), vec!["grid.cells=960".into()])),
        _ => None,
    }
}

/// All rungs that `problem` may have; `case` is where they come from.
pub(super) fn rungs(case: Option<&str>, problem: &Problem) -> Vec<Point> {
    let sizes = Focus::of(problem).and_then(|focus| focus.sizes);
    let rungs = match (&problem.model, &sizes) {
        (Model::Laminar(_) | Model::Bingham(_), Some(sizes)) => plane(sizes),
        (Model::SheetFlow(_), Some(sizes)) => sheet(sizes),
        (Model::Duct(duct), _) if duct.along.is_some() => whole_duct(),
        (Model::Duct(_) | Model::Cavity(_), Some(sizes)) => section(sizes),
        (Model::TwoFluid(_), _) => two_fluid(),
        (Model::Coupled(flow), _) => grains(flow.bed.discrete.duration, flow.bed.size, flow.bed.side_walls),
        _ => vec![(problem.kind, "as it stands".into(), Vec::new())],
    };
    let point = |(series, setting, overrides): Rung| Point {
        case: case.map(str::to_owned),
        series: series.into(),
        values: vec![setting],
        overrides,
    };
    rungs.into_iter().map(point).collect()
}

fn newton() -> Vec<String> {
    vec!["model.method=newton".into()]
}

fn with_cells(series: &'static str, cells: usize, more: &[String]) -> Rung {
    (series, format!("{cells} cells"), [&[format!("grid.cells={cells}")], more].concat())
}

/// Each of the first laws with each size on some meshes.
fn regularised(sizes: &Sizes, laws: usize, lambdas: &[&str], meshes: &[usize]) -> Vec<Rung> {
    let mut rungs = Vec::new();
    for law in sizes.laws.iter().take(laws) {
        for lambda in lambdas {
            for &cells in meshes {
                let (series, setting, changes) = with_cells(law.name, cells, &sizes.set(law, lambda));
                rungs.push((series, format!("λ = {}, {setting}", sizes.text(lambda)), changes));
            }
        }
    }
    rungs
}

fn plane(sizes: &Sizes) -> Vec<Rung> {
    let exact = [12, 24, 48, 96, 192, 384].map(|cells| with_cells("exact yield", cells, &sizes.exactly()));
    [exact.to_vec(), regularised(sizes, 3, &LAMBDAS, &[24, 96, 384])].concat()
}

fn sheet(sizes: &Sizes) -> Vec<Rung> {
    let exact = [40, 75, 150, 300, 600, 1200];
    let exact = exact.map(|cells| with_cells("Newton, exact yield", cells, &sizes.exactly()));
    let smoothed = |series: &'static str, method: &[String], meshes: &[usize]| -> Vec<Rung> {
        let all = regularised(sizes, 1, &LAMBDAS[..3], meshes).into_iter();
        all.map(|(_, setting, changes)| (series, setting, [method, &changes].concat())).collect()
    };
    let paper = ["model.method=iteration".to_owned()];
    let newton = smoothed("Newton, regularised", &newton(), &[75, 300]);
    [exact.to_vec(), newton, smoothed("iteration of the paper", &paper, &[75, 150])].concat()
}

fn section(sizes: &Sizes) -> Vec<Rung> {
    let newton = [newton(), sizes.exactly()].concat();
    let exact = [8, 12, 24, 48, 96].map(|cells| with_cells("Newton, exact yield", cells, &newton));
    let first = [vec!["model.method=first-order".to_owned()], sizes.exactly()].concat();
    let dual = [12, 24, 48].map(|cells| with_cells("first-order", cells, &first));
    [exact.to_vec(), dual.to_vec(), regularised(sizes, 2, &LAMBDAS, &[12, 24, 48])].concat()
}

/// The whole duct costs so much that its rungs are few.
fn whole_duct() -> Vec<Rung> {
    [8, 12, 16, 20].map(|cells| with_cells("whole duct", cells, &[])).to_vec()
}

/// The closures of both columns of Chassagne et al. (2023) on some meshes.
fn two_fluid() -> Vec<Rung> {
    let law = |law: &'static str| {
        let set = [format!("closures.granular.law={law}")];
        [60, 120, 240, 480].map(|cells| with_cells(law, cells, &set)).to_vec()
    };
    [law("frictional-collisional"), law("garzo-dufty")].concat()
}

/// Shorter runs, smaller cells, softer and harder grains, older fluids, a deep bed that is held: from the case itself, one at a time.
fn grains(duration: f64, [length, width]: [f64; 2], narrow: bool) -> Vec<Rung> {
    let lasting = |share: f64| format!("discrete.duration={}", share * duration);
    let mut rungs: Vec<Rung> = [0.125, 0.25, 0.5, 1.0]
        .iter()
        .map(|&share| ("duration", format!("{} s", share * duration), vec![lasting(share)]))
        .collect();
    for share in [0.25, 0.5] {
        let mut changes = vec![format!("flow.length={}", share * length)];
        let mut words = format!("{} mm long", 1e3 * share * length);
        if !narrow {
            changes.push(format!("flow.width={}", share * width));
            words += &format!(", {} mm wide", 1e3 * share * width);
        }
        rungs.push(("smaller cell", words, changes));
    }
    for stiffness in ["2.5e3", "1e4"] {
        let set = ["k_n", "k_s"].map(|k| format!("closures.contact.{k}={stiffness}"));
        rungs.push(("other stiffness", format!("k_n = k_s = {stiffness} N/m"), set.to_vec()));
    }
    for period in ["0.03 s", "0.1 s"] {
        rungs.push(("coupling period", period.into(), vec![format!("discrete.coupling_period={period}")]));
    }
    for creep in ["0.003", "0.01"] {
        let words = format!("layers held below {creep} d in 0.2 s");
        rungs.push(("deep bed held", words, vec![format!("discrete.hold_creep={creep}")]));
    }
    rungs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rungs of a shipped case that the case accepts, by series.
    fn accepted(case: &str) -> Vec<(String, usize)> {
        let (_, problem) = Problem::load(case, &[]).unwrap();
        let mut series: Vec<(String, usize)> = Vec::new();
        for point in rungs(None, &problem) {
            if Problem::load(case, &point.overrides).is_err() {
                continue;
            }
            match series.last_mut().filter(|(name, _)| *name == point.series) {
                Some((_, count)) => *count += 1,
                None => series.push((point.series, 1)),
            }
        }
        if let Some((_, finest)) = finest(&problem) {
            Problem::load(case, &finest).unwrap();
        }
        series
    }

    #[test]
    fn the_rungs_are_cases_that_are_accepted() {
        let counts = |case| accepted(case).iter().map(|(_, n)| *n).collect::<Vec<_>>();
        assert_eq!(counts("laminar_1d_ouriemi"), [6, 12, 12, 12]);
        assert_eq!(counts("bingham_1d_plane"), [6, 12, 12, 12]);
        assert_eq!(counts("sheet_1d_sumer91"), [6, 6, 6]);
        assert_eq!(counts("section_2d_square_bed"), [5, 3, 12, 12]);
        // A quarter of that cell is less than a case may have.
        assert_eq!(counts("coupled_3d_chassagne_quick").iter().sum::<usize>(), 11);
        assert_eq!(counts("section_3d_square_bed"), [4]);
        assert_eq!(counts("kinetic_1d_theta06"), [4, 4]);
        assert_eq!(counts("exact_1d_ouriemi"), [1]);
    }
}
