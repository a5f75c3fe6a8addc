//! Convergence over the size of the regularisation: what lambda costs and which error it gives, against the exact yield on the same
//! mesh or the smallest lambda.

use std::borrow::Cow;

use serde_json::{Map, Value, json};

use super::curves::{curve, error_text, line, range_text};
use super::errors::Reference;
use super::errors::{CREEP, Columns, L2, RMS_PAPER, ReferenceSolution, column};
use super::orders::{Fit, between, fit, overall, slopes};
use super::{Assessment, Point, Row};
use crate::model::{Focus, Rule, Sizes, Smoothed};
use crate::result::Status;
use crate::result::quantity::SHEAR_RATE;
use crate::result::{Axis, Dash, Figure, Panel};
use crate::units::significant;

const EXACT: &str = "exact yield";
/// The law of the error is asymptotic: it is fitted where lambda is at most this share of the shear rate.
const ASYMPTOTIC: f64 = 1e-2;

pub(super) fn points(sizes: &Sizes, reference: Reference, half_decades: bool) -> Vec<Point> {
    let mut points = Vec::new();
    if reference == Reference::Exact {
        let overrides = sizes.exactly();
        points.push(Point { case: None, series: EXACT.into(), values: vec![String::new()], overrides });
    }
    let (from, to) = sizes.decades;
    for law in sizes.laws {
        for decade in from..=to {
            let mut add = |lambda: String| {
                let overrides = sizes.set(law, &lambda);
                points.push(Point { case: None, series: law.name.into(), values: vec![lambda], overrides });
            };
            add(format!("1e-{decade}"));
            if half_decades && decade < to {
                add(format!("{:.4}e-{}", 10f64.sqrt(), decade + 1));
            }
        }
    }
    points
}

impl Rule {
    fn size(bn: f64) -> f64 {
        1e-4_f64.min(1e-4 / bn)
    }
}

/// Lambda of a row; `None` for the exact yield.
fn lambda(row: &Row) -> Option<f64> {
    row.point.values.first()?.parse().ok()
}

/// One law: the rows that have it, their lambda, and their errors of each kind.
struct Series<'a> {
    law: Smoothed,
    rows: Vec<usize>,
    lambda: Vec<f64>,
    measures: &'a Columns,
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

    /// Slopes from each size to the one before it, from the size on that resolves them.
    fn slopes(&self, name: &str, sizes: &Sizes) -> Vec<f64> {
        let found = slopes(&self.lambda, &self.errors(name));
        let small = self.lambda.iter().zip(found).filter(|(l, _)| **l < 0.9 * sizes.slopes_from);
        small.filter_map(|(_, slope)| slope).collect()
    }

    /// Errors at some sizes and the slopes between.
    fn text(&self, name: &str, sizes: &Sizes) -> Vec<String> {
        let size = |lambda: f64| sizes.text(&format!("{lambda:e}"));
        let at = |lambda: &f64| self.at(name, *lambda).map(|e| format!("{} at λ = {}", error_text(e), size(*lambda)));
        let mut parts: Vec<String> = sizes.reported.iter().filter_map(at).collect();
        // A number may have no meaning where too much creeps.
        let first = self.errors(name).iter().position(Option::is_some).filter(|&i| i > 0);
        let above = first.and_then(|i| self.lambda.get(i));
        parts.extend(above.map(|lambda| format!("none above {}", size(*lambda))));
        let slope = range_text(self.slopes(name, sizes).into_iter());
        parts.extend(slope.map(|slope| format!("slope {slope} from {} down", size(sizes.slopes_from))));
        parts
    }
}

pub(super) fn assess(focus: &Focus, sizes: &Sizes, reference: Reference, rows: &[Row]) -> Assessment {
    let done = |row: &&Row| row.status == Status::Done && row.profile.is_some();
    let exact = rows.iter().filter(done).find(|row| row.point.series == EXACT);
    let finest = |of: &Row| {
        let same = rows.iter().filter(done).filter(|row| row.point.series == of.point.series);
        same.min_by(|a, b| lambda(a).unwrap_or(0.0).total_cmp(&lambda(b).unwrap_or(0.0)))
    };
    let solution = |row| {
        let exact_yield = reference == Reference::Exact;
        let base: &Row = if exact_yield { exact? } else { finest(row)? };
        let profile = Cow::Borrowed(base.profile.as_ref()?);
        (!std::ptr::eq(base, row)).then_some(ReferenceSolution { profile, results: &base.results, exact_yield })
    };
    let mut measures = focus.measures(rows, solution);
    if let Some(at_rest) = exact.and_then(|row| row.profile.as_ref()).filter(|_| sizes.creep) {
        let creep = rows.iter().map(|row| focus.creep(row, at_rest).filter(|_| lambda(row).is_some()));
        measures.push((CREEP.into(), creep.collect()));
    }
    let reported = reported(focus, &measures);
    let series: Vec<Series<'_>> = sizes.laws.iter().map(|law| series(*law, rows, &measures)).collect();
    let best = exact.or_else(|| finest(rows.first()?));
    let s = best.and_then(|row| row.profile.as_ref()?.range(&SHEAR_RATE)).map(|(_, high)| high / sizes.shear_unit);
    let fits: Vec<Option<Fit>> =
        series.iter().map(|one| fit(one.law.falls?, &one.lambda, &one.errors(L2), s?, ASYMPTOTIC)).collect();
    let bn = sizes.rule.zip(best).and_then(|(rule, row)| Some((rule, rule.bingham_number(&row.results)?)));
    let mut assessment = Assessment {
        subtitle: format!(
            "Relative error of the {} against {}, over λ in {}.",
            focus.velocity.title,
            if reference == Reference::Exact { "the exact yield on the same mesh" } else { "the smallest λ" },
            unit_text(sizes)
        ),
        figures: vec![figure(focus, sizes, (&series, &reported), &fits, s, bn.map(|(_, bn)| Rule::size(bn)))],
        ..Assessment::default()
    };
    let mut laws = Map::new();
    for (one, fit) in series.iter().zip(&fits) {
        assessment.findings.extend(findings(sizes, one, &reported, *fit, series.len() == 1));
        laws.insert(one.law.name.into(), law_facts(sizes, one, &reported, *fit));
    }
    if let Some(s) = s.filter(|_| fits.iter().any(Option::is_some)) {
        let largest = sizes.text(&significant(s, 3));
        let text = format!("s = {largest} is the largest shear rate of the reference; fitted for λ < s/100");
        assessment.findings.push(("fits".into(), text));
        assessment.facts.insert("shear_rate_scaled".into(), json!(s));
    }
    if let (Some((rule, bn)), Some(paper)) = (bn, series.first()) {
        assessment.findings.push(("rule of the paper".into(), rule_text(&rule, paper, &reported, bn)));
        assessment.facts.insert("rule".into(), rule_facts(paper, bn));
    }
    // On the mesh of the smallest size there is no other.
    // They are about that reference: the smallest size is solved like the others.
    let remarks = sizes.remarks.iter().filter(|_| reference == Reference::Exact);
    assessment.findings.extend(remarks.map(|&(label, text)| (label.to_owned(), text.to_owned())));
    assessment.facts.insert("shear_unit_1_s".into(), json!(sizes.shear_unit));
    assessment.facts.insert("velocity_unit_m_s".into(), json!(focus.velocity_unit));
    assessment.facts.insert("laws".into(), laws.into());
    let mut more: Columns = Vec::new();
    for (name, _) in &reported {
        let mut column = vec![None; rows.len()];
        for one in &series {
            for (&i, slope) in one.rows.iter().zip(slopes(&one.lambda, &one.errors(name))) {
                column[i] = slope;
            }
        }
        let name = name.trim_start_matches("error_").trim_end_matches("_scaled");
        more.push((format!("slope_{name}"), column));
    }
    drop(series);
    measures.extend(more);
    assessment.measures = measures;
    assessment
}

/// The errors that are reported, and the creep where it is measured.
fn reported(focus: &Focus, measures: &Columns) -> Vec<(String, String)> {
    let creep = measures.iter().any(|(name, _)| name == CREEP);
    let creep = creep.then(|| (CREEP.to_owned(), "creep of what is at rest".to_owned()));
    focus.reported().into_iter().chain(creep).collect()
}

fn unit_text(sizes: &Sizes) -> String {
    if sizes.unit == "1" {
        format!("units of {} 1/s{}", significant(sizes.shear_unit, 4), sizes.symbols)
    } else {
        sizes.unit.into()
    }
}

fn series<'a>(law: Smoothed, rows: &[Row], measures: &'a Columns) -> Series<'a> {
    let of = rows.iter().enumerate().filter(|(_, row)| row.point.series == law.name);
    let (rows, lambda) = of.filter_map(|(i, row)| Some((i, lambda(row)?))).unzip();
    Series { law, rows, lambda, measures }
}

/// What is reported of a law: of the velocity alone where it is one of several, of each measure where it is the only one.
fn findings(
    sizes: &Sizes,
    one: &Series<'_>,
    reported: &[(String, String)],
    fit: Option<Fit>,
    alone: bool,
) -> Vec<(String, String)> {
    let fitted = |f: Fit| {
        format!("fit {} {} within a factor {}", significant(f.constant, 2), f.law.formula(), significant(f.within, 2))
    };
    let text = |name: &str| {
        let mut parts = one.text(name, sizes);
        parts.extend(fit.filter(|_| name == L2).map(fitted));
        if parts.is_empty() { "no errors".into() } else { parts.join(", ") }
    };
    if alone {
        reported.iter().map(|(name, title)| (title.clone(), text(name))).collect()
    } else {
        vec![(one.law.name.into(), text(L2))]
    }
}

fn law_facts(sizes: &Sizes, one: &Series<'_>, reported: &[(String, String)], fit: Option<Fit>) -> Value {
    let ends = |name: &str| {
        let found = one.slopes(name, sizes);
        (found.iter().copied().reduce(f64::min), found.iter().copied().reduce(f64::max))
    };
    let (least, most) = ends(L2);
    let slopes = reported.iter().map(|(name, _)| {
        let (least, most) = ends(name);
        let whole = overall(&one.lambda, &one.errors(name));
        (name.clone(), json!({ "least": least, "most": most, "overall": whole }))
    });
    let slopes: Map<String, Value> = slopes.collect();
    let fit = fit.map(
        |f| json!({ "law": f.law.formula(), "constant": f.constant, "within_factor": f.within, "points": f.points }),
    );
    json!({ "slope_least": least, "slope_most": most, "slopes": slopes, "fit": fit })
}

fn rule_text(rule: &Rule, paper: &Series<'_>, reported: &[(String, String)], bn: f64) -> String {
    let size = Rule::size(bn);
    let errors = reported.iter();
    let errors = errors.filter_map(|(name, title)| Some(format!("{title} {}", error_text(paper.at(name, size)?))));
    let errors = errors.collect::<Vec<_>>().join(", ");
    let rms = paper.at(RMS_PAPER, size).map(|e| format!(" (its own RMS: {e:.1e})")).unwrap_or_default();
    let gives =
        if errors.is_empty() { "lies outside the points".into() } else { format!("gives these errors: {errors}{rms}") };
    format!(
        "λ = min(1e-4, 1e-4/Bn) = {} with Bn = {} = {} {gives}",
        significant(size, 2),
        rule.bingham,
        significant(bn, 3)
    )
}

fn rule_facts(paper: &Series<'_>, bn: f64) -> Value {
    let size = Rule::size(bn);
    let errors = paper.measures.iter().map(|(name, _)| (name.clone(), json!(paper.at(name, size))));
    json!({ "bingham_number": bn, "lambda_scaled": size, "errors": errors.collect::<Map<_, _>>() })
}

/// A panel for the velocity under several laws and one for all measures under the first; the second alone where that is the
/// only one.
fn figure(
    focus: &Focus,
    sizes: &Sizes,
    (series, reported): (&[Series<'_>], &[(String, String)]),
    fits: &[Option<Fit>],
    s: Option<f64>,
    rule: Option<f64>,
) -> Figure {
    let mut laws: Vec<_> = series.iter().enumerate().map(|(i, one)| curve(one.law.name, i, one.points(L2))).collect();
    let mut kinds = Vec::new();
    if let Some(first) = series.first() {
        let paper = focus.paper_rms.then(|| (RMS_PAPER.to_owned(), "RMS as in the paper".to_owned()));
        let all = reported.iter().cloned().chain(paper);
        kinds.extend(all.enumerate().map(|(i, (name, title))| curve(&title, i, first.points(&name))));
    }
    let several = series.len() > 1;
    if let (Some(s), Some(f), Some(first)) = (s, fits.first().copied().flatten(), series.first()) {
        let inside = first.lambda.iter().copied().filter(|l| *l <= 0.1 * s);
        let points = inside.map(|l| (l, f.constant * f.law.at(l, s))).collect();
        let panel = if several { &mut laws } else { &mut kinds };
        panel.push(line(format!("{} {}", significant(f.constant, 2), f.law.formula()), 3, Dash::Dotted, points));
    }
    let drawn = laws.iter().chain(&kinds).flat_map(|c| c.points.iter().flatten()).map(|p| p.1).filter(|e| *e > 0.0);
    let (low, high) = drawn.fold((f64::INFINITY, 0.0_f64), |(a, b), e| (a.min(e), b.max(e)));
    if let (Some(size), true) = (rule, low < high) {
        for (panel, name) in [(&mut laws, "rule of the paper"), (&mut kinds, "")] {
            panel.push(line(name.into(), 0, Dash::Dotted, vec![(size, low), (size, high)]));
        }
    }
    let panel = |curves| Panel { x: Axis::log(sizes.formula, sizes.unit), curves };
    let velocity = focus.velocity.title;
    let what = if several {
        format!(
            "(a) L² norm of the {velocity} for {} laws; (b) what the first of them does to other measures",
            series.len()
        )
    } else {
        format!("L² norm of the {velocity}, and other measures")
    };
    let mut caption = format!("Relative error over the size λ of the regularisation, in {}: {what}.", unit_text(sizes));
    let unit = significant(focus.velocity_unit, 4);
    if focus.paper_rms {
        caption += &format!(" The RMS of the paper is (1/N) sqrt(Σe²), in units of {unit} m/s.");
    }
    if reported.iter().any(|(name, _)| name == CREEP) {
        caption += &format!(
            " The creep is the velocity half-way up what is at rest under the exact yield, in units of {unit} m/s."
        );
    }
    Figure {
        stem: "convergence".into(),
        caption,
        y: Axis::log("error", "1"),
        panels: if several { vec![panel(laws), panel(kinds)] } else { vec![panel(kinds)] },
        levels: Vec::new(),
        tint_below: None,
    }
}
