//! The ladder of a case: the numerical settings that answer it, from cheap and coarse to dear and fine.
//!
//! Every rung is an ordinary case, so it can be run by hand with the same `--set`. A setting that a case refuses is left
//! out: the ladder of a model is longer than any one of its cases allows.

use super::Point;
use super::regularisation::{exact_yield, smoothed};
use crate::model::{OnMesh, Problem};
use crate::models::bingham::RegularisedPlane;
use crate::models::coupled::Coupled;
use crate::models::laminar::RegularisedBed;
use crate::models::section::{CavityFlow, Duct, DuctBed};
use crate::models::sheet_flow::SheetFlow;
use crate::models::two_fluid::TwoFluid;

/// What is varied, as a column of the table.
pub(super) const KEY: &str = "setting";
/// Sizes of the regularisation.
const LAMBDAS: [&str; 4] = ["1e-2", "1e-4", "1e-6", "1e-8"];
/// Laws of the regularisation, with what the figure calls them.
const LAWS: [&str; 3] = ["simple", "bercovier-engelman", "papanastasiou"];

/// A rung: series, setting in words, changes of the case.
type Rung = (&'static str, String, Vec<String>);

/// What is solved much finer than all rungs: changes of the case, and what it is in words. `None` where refining has no end that can be
/// paid for: the last rung is the finest.
pub(super) fn finest(problem: &Problem) -> Option<(String, Vec<String>)> {
    let cells = problem.cells();
    let fine = |cells: usize, more: Vec<String>| {
        Some((format!("exact yield, {cells} cells"), [vec![format!("grid.cells={cells}")], more].concat()))
    };
    match family(problem) {
        Family::Plane => fine(4 * cells.max(400), exact_yield()),
        Family::Sheet => fine(8 * cells.max(300), newton()),
        Family::Section | Family::WholeDuct => fine(128, [newton(), vec!["grid.along=".into()]].concat()),
        Family::TwoFluid => Some(("960 cells".into(), vec!["grid.cells=960".into()])),
        Family::Grains | Family::One => None,
    }
}

/// What kind of ladder a problem has.
enum Family {
    Plane,
    Sheet,
    Section,
    WholeDuct,
    TwoFluid,
    Grains,
    One,
}

fn family(problem: &Problem) -> Family {
    let duct = problem.get().map(|Duct(flow)| flow).or(problem.get().map(|DuctBed(flow)| flow));
    match () {
        () if problem.get::<OnMesh<RegularisedBed>>().is_some() => Family::Plane,
        () if problem.get::<OnMesh<RegularisedPlane>>().is_some() => Family::Plane,
        () if problem.get::<OnMesh<SheetFlow>>().is_some() => Family::Sheet,
        () if duct.is_some_and(|duct| duct.problem.along.is_some()) => Family::WholeDuct,
        () if duct.is_some() || problem.get::<OnMesh<CavityFlow>>().is_some() => Family::Section,
        () if problem.get::<OnMesh<TwoFluid>>().is_some() => Family::TwoFluid,
        () if problem.get::<Coupled>().is_some() => Family::Grains,
        () => Family::One,
    }
}

/// All rungs that `problem` may have; `case` is where they come from.
pub(super) fn rungs(case: Option<&str>, problem: &Problem) -> Vec<Point> {
    let rungs = match (family(problem), problem.get::<Coupled>()) {
        (Family::Plane, _) => plane(),
        (Family::Sheet, _) => sheet(),
        (Family::WholeDuct, _) => whole_duct(),
        (Family::Section, _) => section(),
        (Family::TwoFluid, _) => two_fluid(),
        (Family::Grains, Some(flow)) => grains(flow.bed.discrete.duration, flow.bed.size, flow.bed.side_walls),
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
    [vec!["model.method=newton".into()], exact_yield()].concat()
}

fn with_cells(series: &'static str, cells: usize, more: &[String]) -> Rung {
    (series, format!("{cells} cells"), [&[format!("grid.cells={cells}")], more].concat())
}

/// Each law with each size on some meshes.
fn regularised(method: &[String], laws: &[&'static str], meshes: &[usize]) -> Vec<Rung> {
    let mut rungs = Vec::new();
    for &law in laws {
        for lambda in LAMBDAS {
            for &cells in meshes {
                let (_, setting, changes) = with_cells(law, cells, &[method, &smoothed(law, lambda)].concat());
                rungs.push((law, format!("λ = {lambda}, {setting}"), changes));
            }
        }
    }
    rungs
}

fn plane() -> Vec<Rung> {
    let exact = [12, 24, 48, 96, 192, 384].map(|cells| with_cells("exact yield", cells, &exact_yield()));
    [exact.to_vec(), regularised(&[], &LAWS, &[24, 96, 384])].concat()
}

fn sheet() -> Vec<Rung> {
    let exact = [40, 75, 150, 300, 600, 1200].map(|cells| with_cells("Newton, exact yield", cells, &newton()));
    let method = |name: &str| vec![format!("model.method={name}")];
    // Sheet flow has its λ in 1/s only.
    let sized = |series: &'static str, name: &str, lambdas: &[&str], meshes: &[usize]| -> Vec<Rung> {
        let one = |lambda: &str, cells: usize| {
            let law = ["regularisation.law=simple".to_owned(), format!("regularisation.lambda={lambda}")];
            let (_, setting, changes) = with_cells(series, cells, &[&method(name)[..], &law].concat());
            (series, format!("λ = {lambda} 1/s, {setting}"), changes)
        };
        lambdas.iter().flat_map(|lambda| meshes.iter().map(|&cells| one(lambda, cells)).collect::<Vec<_>>()).collect()
    };
    let newton = sized("Newton, regularised", "newton", &["1e-2", "1e-4", "1e-6"], &[75, 300]);
    let paper = sized("iteration of the paper", "iteration", &["1e-2", "1e-4", "1e-6"], &[75, 150]);
    [exact.to_vec(), newton, paper].concat()
}

fn section() -> Vec<Rung> {
    let exact = [8, 12, 24, 48, 96].map(|cells| with_cells("Newton, exact yield", cells, &newton()));
    let first = ["model.method=first-order".to_owned()];
    let dual = [12, 24, 48].map(|cells| with_cells("first-order", cells, &[&first[..], &exact_yield()].concat()));
    let method = ["model.method=newton".to_owned()];
    [exact.to_vec(), dual.to_vec(), regularised(&method, &LAWS[..2], &[12, 24, 48])].concat()
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
        let registry = crate::models::builtin();
        let (_, problem) = registry.load(case, &[]).unwrap();
        let mut series: Vec<(String, usize)> = Vec::new();
        for point in rungs(None, &problem) {
            if registry.load(case, &point.overrides).is_err() {
                continue;
            }
            match series.last_mut().filter(|(name, _)| *name == point.series) {
                Some((_, count)) => *count += 1,
                None => series.push((point.series, 1)),
            }
        }
        if let Some((_, finest)) = finest(&problem) {
            registry.load(case, &finest).unwrap();
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
