//! The ladder of a case: the numerical settings that answer it, from cheap and coarse to dear and fine.
//!
//! Every rung is an ordinary case, so it can be run by hand with the same `--set`. A setting that a case refuses is left
//! out: the ladder of a model is longer than any one of its cases allows.

use super::Point;
use crate::case::for_model;
use crate::model::{Problem, Registry, Rung};

/// What is varied, as a column of the table.
pub(super) const KEY: &str = "setting";

/// All rungs that `problem` may have; `case` is where they come from.
pub(super) fn rungs(case: Option<&str>, problem: &Problem) -> Vec<Point> {
    let mut rungs = problem.solver().study().rungs;
    if rungs.is_empty() {
        rungs.push(Rung { series: problem.kind, setting: "as it stands".into(), changes: Vec::new() });
    }
    let point = |Rung { series, setting, changes }| Point {
        case: case.map(str::to_owned),
        series: series.to_owned(),
        values: vec![setting],
        overrides: changes,
    };
    rungs.into_iter().map(point).collect()
}

/// The points that their case accepts.
pub(super) fn accepted(registry: &Registry, points: Vec<Point>, case: &str, overrides: &[String]) -> Vec<Point> {
    let fits = |point: &Point| registry.load(case, &[overrides, &point.overrides].concat()).is_ok();
    points.into_iter().filter(fits).collect()
}

/// The `--set` arguments of one of `cases`: `overrides` are for the first and for other models of its file.
pub(super) fn overrides_of(cases: &[String], overrides: &[String], case: &str) -> Vec<String> {
    let Some(first) = cases.first() else { return Vec::new() };
    let (Some((file, model)), Some((same, _))) = (case.rsplit_once(':'), first.rsplit_once(':')) else {
        return if case == first { overrides.to_vec() } else { Vec::new() };
    };
    if file != same {
        return Vec::new();
    }
    let models: Vec<String> =
        cases.iter().filter_map(|case| case.rsplit_once(':')).map(|(_, model)| model.to_owned()).collect();
    for_model(model, &models, overrides)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rungs of a shipped case that the case accepts, by series.
    fn series(case: &str) -> Vec<(String, usize)> {
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
        if let Some((_, finest)) = problem.solver().study().finest {
            registry.load(case, &finest).unwrap();
        }
        series
    }

    #[test]
    fn the_rungs_are_cases_that_are_series() {
        let counts = |case| series(case).iter().map(|(_, n)| *n).collect::<Vec<_>>();
        assert_eq!(counts("bed_ouriemi-laminar"), [6, 12, 12, 12]);
        assert_eq!(counts("bingham_1d_plane"), [6, 12, 12, 12]);
        assert_eq!(counts("sheet_1d_sumer91"), [6, 6, 6]);
        assert_eq!(counts("section_2d_square_bed"), [5, 3, 12, 12]);
        // A quarter of that cell is less than a case may have.
        assert_eq!(counts("flow_theta06_quick-coupled").iter().sum::<usize>(), 11);
        assert_eq!(counts("section_3d_square_bed"), [4]);
        assert_eq!(counts("flow_theta06-two-fluid"), [4, 4]);
        assert_eq!(counts("bed_ouriemi-laminar-exact"), [1]);
    }
}
