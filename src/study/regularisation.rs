//! Convergence over the size of the regularisation: what lambda costs and what it buys, against the exact yield on the same
//! mesh.

use std::borrow::Cow;

use serde_json::{Map, Value, json};

use super::converge::{Reference, curve, error_text, line, range_text};
use super::errors::{AT_BED, Focus, L2, RMS_PAPER, Truth, column};
use super::orders::{Fit, Law, between, fit, slopes};
use super::{Judgement, Point, Row};
use crate::plot::{Axis, Dash, Figure, Panel};
use crate::result::Status;
use crate::result::quantity::SHEAR_RATE;
use crate::units::significant;

/// What is varied.
pub(super) const KEY: &str = "regularisation.lambda_scaled";
/// The laws and how their errors go; the first is that of the paper whose rule is judged.
const LAWS: [(&str, Law); 3] =
    [("simple", Law::Logarithmic), ("bercovier-engelman", Law::Linear), ("papanastasiou", Law::Linear)];
const EXACT: &str = "exact yield";
/// Decades of lambda, from and to.
const DECADES: (i32, i32) = (1, 12);
/// The law of the error is asymptotic: it is fitted where lambda is at most this share of the shear rate.
const ASYMPTOTIC: f64 = 1e-2;
const SLOPE: &str = "slope_velocity_l2";

/// Sets the exact yield in any case.
pub(super) fn exact_yield() -> Vec<String> {
    ["law=none", "lambda=", "lambda_scaled="].map(|setting| format!("regularisation.{setting}")).to_vec()
}

/// Sets a law with a size in any case.
pub(super) fn smoothed(law: &str, lambda: &str) -> Vec<String> {
    let settings = [format!("law={law}"), "lambda=".into(), format!("lambda_scaled={lambda}")];
    settings.map(|setting| format!("regularisation.{setting}")).to_vec()
}

pub(super) fn points(reference: Reference, half_decades: bool) -> Vec<Point> {
    let mut points = Vec::new();
    if reference == Reference::Exact {
        points.push(Point { case: None, series: EXACT.into(), values: vec![String::new()], overrides: exact_yield() });
    }
    let (from, to) = DECADES;
    for (law, _) in LAWS {
        for decade in from..=to {
            let mut add = |lambda: String| {
                let overrides = smoothed(law, &lambda);
                points.push(Point { case: None, series: law.into(), values: vec![lambda], overrides });
            };
            add(format!("1e-{decade}"));
            if half_decades && decade < to {
                add(format!("{:.4}e-{}", 10f64.sqrt(), decade + 1));
            }
        }
    }
    points
}

/// The rule of Chauchat & Medale (2010), section 3.2: lambda = min(1e-4, 1e-4/Bn).
fn rule(bn: f64) -> f64 {
    1e-4_f64.min(1e-4 / bn)
}

/// Lambda of a row; `None` for the exact yield.
fn lambda(row: &Row) -> Option<f64> {
    row.point.values.first()?.parse().ok()
}

/// One law: the rows that have it, their lambda, and their errors of each kind.
struct Series<'a> {
    name: &'static str,
    law: Law,
    rows: Vec<usize>,
    lambda: Vec<f64>,
    measures: &'a [(String, Vec<Option<f64>>)],
}

impl Series<'_> {
    fn errors(&self, name: &str) -> Vec<Option<f64>> {
        let all = column(self.measures, name);
        self.rows.iter().map(|&i| all.get(i).copied().flatten()).collect()
    }

    fn points(&self, name: &str) -> impl Iterator<Item = (f64, Option<f64>)> {
        self.lambda.iter().copied().zip(self.errors(name)).collect::<Vec<_>>().into_iter()
    }

    fn at(&self, name: &str, lambda: f64) -> Option<f64> {
        let known: Vec<_> = self.points(name).filter_map(|(l, e)| Some((l, e?))).collect();
        between(lambda, &known)
    }
}

pub(super) fn judge(focus: &Focus, reference: Reference, rows: &[Row]) -> Judgement {
    let done = |row: &&Row| row.status == Status::Done && row.profile.is_some();
    let exact = rows.iter().filter(done).find(|row| row.point.series == EXACT);
    let finest = |of: &Row| {
        let same = rows.iter().filter(done).filter(|row| row.point.series == of.point.series);
        same.min_by(|a, b| lambda(a).unwrap_or(0.0).total_cmp(&lambda(b).unwrap_or(0.0)))
    };
    let truth = |row| {
        let base: &Row = if reference == Reference::Exact { exact? } else { finest(row)? };
        let itself = std::ptr::eq(base, row);
        Some(Truth { profile: Cow::Borrowed(base.profile.as_ref()?), results: &base.results }).filter(|_| !itself)
    };
    let mut measures = focus.measures(rows, truth);
    let series: Vec<Series<'_>> = LAWS.into_iter().map(|law| series(law, rows, &measures)).collect();
    let best = exact.or_else(|| finest(rows.first()?));
    let s = best.and_then(|row| row.profile.as_ref()?.range(&SHEAR_RATE)).map(|(_, high)| high / focus.shear_unit);
    let fits: Vec<Option<Fit>> = series.iter().map(|l| fit(l.law, &l.lambda, &l.errors(L2), s?, ASYMPTOTIC)).collect();
    let bn = best.and_then(|row| focus.bingham_number(&row.results));
    let mut judgement = Judgement {
        subtitle: format!(
            "Relative error of the {} against {}, over λ in units of {} 1/s.",
            focus.velocity.title,
            if reference == Reference::Exact { "the exact yield on the same mesh" } else { "the smallest λ" },
            significant(focus.shear_unit, 4)
        ),
        figures: vec![figure(focus, &series, &fits, s, bn.map(rule))],
        ..Judgement::default()
    };
    let mut slope = vec![None; rows.len()];
    let mut laws = Map::new();
    for (law, fit) in series.iter().zip(&fits) {
        let found = slopes(&law.lambda, &law.errors(L2));
        let low: Vec<f64> =
            law.lambda.iter().zip(&found).filter(|(l, _)| **l < 0.9e-4).filter_map(|(_, s)| *s).collect();
        judgement.findings.push((law.name.into(), law_text(law, range_text(low.iter().copied()), *fit)));
        laws.insert(law.name.into(), law_facts(&low, *fit));
        for (&i, s) in law.rows.iter().zip(found) {
            slope[i] = s;
        }
    }
    if let Some(s) = s {
        let text =
            format!("s = {} is the largest shear rate of the reference; fitted for λ < s/100", significant(s, 3));
        judgement.findings.push(("fits".into(), text));
        judgement.facts.insert("shear_rate_scaled".into(), json!(s));
    }
    if let (Some(bn), Some(paper)) = (bn, series.first()) {
        judgement.findings.push(("rule of the paper".into(), rule_text(focus, paper, bn)));
        judgement.facts.insert("rule".into(), rule_facts(paper, bn));
    }
    judgement.facts.insert("shear_unit_1_s".into(), json!(focus.shear_unit));
    judgement.facts.insert("velocity_unit_m_s".into(), json!(focus.velocity_unit));
    judgement.facts.insert("laws".into(), laws.into());
    measures.push((SLOPE.into(), slope));
    judgement.measures = measures;
    judgement
}

fn series<'a>(
    (name, law): (&'static str, Law),
    rows: &[Row],
    measures: &'a [(String, Vec<Option<f64>>)],
) -> Series<'a> {
    let of = rows.iter().enumerate().filter(|(_, row)| row.point.series == name);
    let (rows, lambda) = of.filter_map(|(i, row)| Some((i, lambda(row)?))).unzip();
    Series { name, law, rows, lambda, measures }
}

fn law_text(series: &Series<'_>, slope: Option<String>, fit: Option<Fit>) -> String {
    let at = |lambda: f64| series.at(L2, lambda).map(|e| format!("{} at λ = {lambda:e}", error_text(e)));
    let mut parts: Vec<String> = [1e-4, 1e-6, 1e-10].into_iter().filter_map(at).collect();
    parts.extend(slope.map(|slope| format!("slope {slope} from 1e-4 down")));
    let fitted = |f: Fit| {
        format!("fit {} {} within a factor {}", significant(f.constant, 2), f.law.formula(), significant(f.within, 2))
    };
    parts.extend(fit.map(fitted));
    if parts.is_empty() { "no errors".into() } else { parts.join(", ") }
}

fn law_facts(slopes: &[f64], fit: Option<Fit>) -> Value {
    let least = slopes.iter().copied().reduce(f64::min);
    let most = slopes.iter().copied().reduce(f64::max);
    let fit = fit.map(
        |f| json!({ "law": f.law.formula(), "constant": f.constant, "within_factor": f.within, "points": f.points }),
    );
    json!({ "slope_least": least, "slope_most": most, "fit": fit })
}

/// The columns that say what the rule buys, with their names for readers.
fn bought(focus: &Focus) -> Vec<(String, String)> {
    let mut columns = vec![(L2.to_owned(), "velocity (L2)".to_owned())];
    columns.push((focus.number_error(), focus.number.0.title.into()));
    if focus.bed {
        columns.push((AT_BED.into(), "velocity at the bed level".into()));
    }
    columns
}

fn rule_text(focus: &Focus, paper: &Series<'_>, bn: f64) -> String {
    let size = rule(bn);
    let errors = bought(focus).into_iter();
    let errors = errors.filter_map(|(name, title)| Some(format!("{title} {}", error_text(paper.at(&name, size)?))));
    let errors = errors.collect::<Vec<_>>().join(", ");
    let rms = paper.at(RMS_PAPER, size).map(|e| format!(" (its own RMS: {e:.1e})")).unwrap_or_default();
    let buys = if errors.is_empty() { "lies outside the points".into() } else { format!("buys {errors}{rms}") };
    format!(
        "λ = min(1e-4, 1e-4/Bn) = {} with Bn = {} = {} {buys}",
        significant(size, 2),
        focus.bingham,
        significant(bn, 3)
    )
}

fn rule_facts(paper: &Series<'_>, bn: f64) -> Value {
    let size = rule(bn);
    let errors = paper.measures.iter().map(|(name, _)| (name.clone(), json!(paper.at(name, size))));
    json!({ "bingham_number": bn, "lambda_scaled": size, "errors": errors.collect::<Map<_, _>>() })
}

fn figure(focus: &Focus, series: &[Series<'_>], fits: &[Option<Fit>], s: Option<f64>, rule: Option<f64>) -> Figure {
    let mut laws: Vec<_> = series.iter().enumerate().map(|(i, law)| curve(law.name, i, law.points(L2))).collect();
    let (first, fitted) = (series.first(), fits.first().copied().flatten());
    if let (Some(s), Some(f), Some(paper)) = (s, fitted, first) {
        let inside = paper.lambda.iter().copied().filter(|l| *l <= 0.1 * s);
        let points = inside.map(|l| (l, f.constant * f.law.at(l, s))).collect();
        laws.push(line(format!("{} {}", significant(f.constant, 2), f.law.formula()), 3, Dash::Dotted, points));
    }
    let mut kinds = Vec::new();
    if let Some(paper) = first {
        let names = bought(focus).into_iter().chain([(RMS_PAPER.to_owned(), "RMS as in the paper".to_owned())]);
        kinds.extend(names.enumerate().map(|(i, (name, title))| curve(&title, i, paper.points(&name))));
    }
    let drawn = laws.iter().chain(&kinds).flat_map(|c| c.points.iter().flatten()).map(|p| p.1).filter(|e| *e > 0.0);
    let (low, high) = drawn.fold((f64::INFINITY, 0.0_f64), |(a, b), e| (a.min(e), b.max(e)));
    if let (Some(size), true) = (rule, low < high) {
        for (panel, name) in [(&mut laws, "rule of the paper"), (&mut kinds, "")] {
            panel.push(line(name.into(), 0, Dash::Dotted, vec![(size, low), (size, high)]));
        }
    }
    let panel = |curves| Panel { x: Axis::log(focus.lambda, "1"), curves };
    Figure {
        stem: "convergence".into(),
        caption: format!(
            "Relative error over the size λ of the regularisation, in units of {} 1/s{}: (a) L² norm of the {} for three laws; \
             (b) what the first of them does to other measures. The RMS of the paper is (1/N) sqrt(Σe²), in units of {} m/s.",
            significant(focus.shear_unit, 4),
            if focus.bed { " (Δρ = ρ_p - ρ_f)" } else { "" },
            focus.velocity.title,
            significant(focus.velocity_unit, 4)
        ),
        y: Axis::log("error", "1"),
        panels: vec![panel(laws), panel(kinds)],
        levels: Vec::new(),
        tint_below: None,
    }
}
