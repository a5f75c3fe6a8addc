//! Re-runs what the cases claim: each `[[check]]` row of each case, as one table.

pub mod advice;
mod partial;
pub mod table;

pub use partial::Partial;

use std::fmt::Write;

use crate::case::checks::{Check, CheckKind, Limit, Tier};
use crate::case::{CaseError, shipped};
use crate::model::Registry;
use crate::result::Context;
use crate::result::{Axis, Curve, Dash, Figure, Marker, Panel};
use crate::result::{Failure, Outcome, Provenance, Watch, quantity};
use crate::study::StudyError;
use crate::study::limits::{self, Along};
use crate::study::stability::Request;
use crate::units::significant;

/// Stem of the figure beside the table.
pub const FIGURE: &str = "validation";

/// How a row ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// within the tolerance
    Green,
    /// outside it
    Red,
    /// a claim that is reported, not assessed
    Reported,
}

impl Verdict {
    /// One word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Green => "pass",
            Self::Red => "FAIL",
            Self::Reported => "shown",
        }
    }
}

/// One checked number.
#[derive(Clone, Debug)]
pub struct Row {
    /// case
    pub case: String,
    /// result, column or "limit of" a key
    pub quantity: String,
    /// what was claimed, with tolerance, kind and source
    pub check: Check,
    /// what was found; `None` with the reason
    pub found: Result<f64, String>,
    /// how it ended
    pub verdict: Verdict,
}

impl Row {
    /// Deviation relative to the expected value, absolute where that is 0.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        let found = *self.found.as_ref().ok()?;
        let scale = if self.check.expect == 0.0 { 1.0 } else { self.check.expect.abs() };
        Some((found - self.check.expect).abs() / scale)
    }
}

/// Why a case could not be validated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// the case is wrong
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// the limit of a case is wrong
    #[error(transparent)]
    Limit(#[from] StudyError),
}

/// What an unfinished validation found, and what is told after each case that was run.
pub struct Going<'a> {
    /// cases that are not run again
    pub from: Partial,
    /// takes what was found so far
    pub keep: &'a mut dyn FnMut(&Partial),
}

/// Runs the checks of `cases` (all shipped ones if there are none) up to `tier`.
///
/// # Errors
/// A case that is wrong. A case whose method fails is red rows, not an error.
pub fn validate(
    registry: &Registry,
    cases: &[String],
    tier: Tier,
    watch: &mut dyn Watch,
    mut going: Going<'_>,
) -> Result<Vec<Row>, ValidateError> {
    let names: Vec<String> =
        if cases.is_empty() { shipped::names().map(str::to_owned).collect() } else { cases.to_vec() };
    let mut rows = Vec::new();
    for name in &names {
        let (case, problem) = registry.load(name, &[]).map_err(Box::new)?;
        let due = |of: Tier| of == Tier::Quick || tier == Tier::Full;
        let wanted = |check: &&Check| due(check.tier);
        let resolved = case.resolved();
        let limit = case.limit().filter(|limit| due(limit.tier));
        if let Some(found) = going.from.found(name, &resolved) {
            let checks = case.checks().iter().filter(wanted).map(|check| (check.clone(), false));
            let all = checks.chain(limit.map(|limit| (claim(limit), true)));
            rows.extend(all.zip(found).map(|((check, of_limit), found)| {
                // A limit that is not found as it is claimed is red, whatever its kind.
                let red = of_limit && found.is_err();
                let row = assessed(&case.name, &check, found);
                if red { Row { verdict: Verdict::Red, ..row } } else { row }
            }));
            continue;
        }
        let before = rows.len();
        if case.checks().iter().filter(wanted).count() > 0 {
            let outcome = problem.run(&mut Context::new(watch));
            rows.extend(case.checks().iter().filter(wanted).map(|check| row(&case.name, check, &outcome)));
        }
        if let Some(limit) = limit {
            rows.push(limit_row(registry, name, &case.name, limit)?);
        }
        going.from.keep(name, resolved, rows[before..].iter().map(|row| row.found.clone()));
        (going.keep)(&going.from);
    }
    Ok(rows)
}

/// The limit of a case, found by bisection, against the one that it predicts.
fn limit_row(registry: &Registry, path: &str, case: &str, limit: &Limit) -> Result<Row, ValidateError> {
    let request = Request {
        case: path.into(),
        overrides: Vec::new(),
        over: vec![limit.over.clone()],
        tolerance: limit.within,
        predicted: Some(limit.expect),
    };
    let found = match limits::first(registry, &request)? {
        Along::Holds => Err(format!("every value of {} holds", limit.over)),
        Along::Fails(reason) => return Ok(red(case, limit, &format!("no value holds: {reason}"))),
        Along::Ends(found) if found.class != limit.beyond => {
            return Ok(red(case, limit, &format!("{} beyond it: {}", found.class.name(), found.reason)));
        }
        Along::Ends(found) => Ok(found.holds),
    };
    Ok(assessed(case, &claim(limit), found))
}

/// A limit that is not found as it is claimed is red, whatever its kind.
fn red(case: &str, limit: &Limit, reason: &str) -> Row {
    Row { verdict: Verdict::Red, ..assessed(case, &claim(limit), Err(reason.into())) }
}

/// What a limit claims, as a row.
fn claim(limit: &Limit) -> Check {
    let key = limit.over.split('=').next().unwrap_or_default();
    Check {
        quantity: format!("limit of {key}"),
        at: None,
        expect: limit.expect,
        tolerance: limit.tolerance,
        kind: limit.kind,
        source: format!("{}; {} beyond it", limit.source, limit.beyond.name()),
        tier: limit.tier,
    }
}

fn row(case: &str, check: &Check, outcome: &Result<Outcome, Failure>) -> Row {
    let found = match outcome {
        Err(failure) => Err(failure.to_string()),
        Ok(outcome) => find(check, outcome).ok_or_else(|| "not reported".to_owned()),
    };
    assessed(case, check, found)
}

fn assessed(case: &str, check: &Check, found: Result<f64, String>) -> Row {
    let mut row = Row {
        case: case.into(),
        quantity: check.quantity.clone(),
        check: check.clone(),
        found,
        verdict: Verdict::Reported,
    };
    if check.kind != CheckKind::Finding {
        let inside = row.deviation().is_some_and(|deviation| deviation <= check.tolerance);
        row.verdict = if inside { Verdict::Green } else { Verdict::Red };
    }
    row
}

/// The number that a check asks for.
fn find(check: &Check, outcome: &Outcome) -> Option<f64> {
    match (check.quantity.strip_prefix("profile."), check.at) {
        (Some(column), Some(z)) => outcome.profile.as_ref()?.at(quantity::find(quantity::COLUMNS, column)?, z),
        _ => outcome.results.get(&check.quantity),
    }
}

/// Deviations below this are round-off and drawn there.
const ROUND_OFF: f64 = 1e-17;

/// Deviation against tolerance of every row that has both.
#[must_use]
pub fn figure(rows: &[Row]) -> Figure {
    let of = |kind: CheckKind, name: &str, colour: usize, marker: Marker| {
        let points = rows.iter().filter(|row| row.check.kind == kind && row.check.tolerance > 0.0);
        let points = points.filter_map(|row| Some((row.check.tolerance, row.deviation()?.max(ROUND_OFF), row)));
        let points: Vec<_> = points.collect();
        Curve {
            name: name.into(),
            points: points.iter().map(|(x, y, _)| Some((*x, *y))).collect(),
            notes: points.iter().map(|(_, _, row)| format!("{} {}", row.case, row.quantity)).collect(),
            colour,
            marker: Some(marker),
            ..Curve::default()
        }
    };
    let limit = Curve {
        name: "deviation = tolerance".into(),
        points: vec![Some((1e-13, 1e-13)), Some((1.0, 1.0))],
        line: Some(Dash::Dashed),
        ..Curve::default()
    };
    let curves = vec![
        limit,
        of(CheckKind::Verification, "verification", 1, Marker::Circle),
        of(CheckKind::Validation, "validation", 2, Marker::Square),
        of(CheckKind::Regression, "regression", 3, Marker::Triangle),
        of(CheckKind::Finding, "finding: reported, not assessed", 4, Marker::Cross),
    ];
    Figure {
        stem: FIGURE.into(),
        caption: "Deviation of every checked number against its tolerance: what is assessed lies below the line."
            .into(),
        y: Axis::log("deviation from the expected value", "1"),
        panels: vec![Panel { x: Axis::log("tolerance", "1"), curves }],
        levels: Vec::new(),
        tint_below: None,
    }
}

/// What the table begins with; it is known as ours by that.
pub const HEAD: &str = "# Validation\n\nMade by bedload ";

/// The table as Markdown: `docs/validation.md`.
#[must_use]
pub fn markdown(rows: &[Row]) -> String {
    let made = Provenance::of_this_program();
    let mut text = format!(
        "{HEAD}{} ({}), {}, {}.\n\n![Deviation against tolerance](figures/{FIGURE}.png)\n\n",
        made.bedload, made.commit, made.rustc, made.target
    );
    text += "Written by `bedload validate --full`; do not edit. Each row is a `[[check]]` of a shipped case (run the case \
         to see it in its place) or its `[limit]`, where its method ends (`bedload stability CASE`).\n\n\
         - verification: against an exact or independently computed solution of the same equations\n\
         - validation: against measurements or published results\n\
         - finding: a claim that is not reproduced; both numbers are shown and it is never red\n\n\
         | case | quantity | kind | expected | found | deviation | tolerance | verdict | source |\n\
         |---|---|---|---|---|---|---|---|---|\n";
    for row in rows {
        let at = row.check.at.map_or_else(String::new, |z| format!(" at {} m", significant(z, 4)));
        let found = row.found.as_ref().map_or_else(Clone::clone, |x| significant(*x, 7));
        // Below a tenth of the tolerance the digits are round-off, which may differ from machine to machine.
        let deviation = row.deviation().map_or_else(
            || "-".into(),
            |d| {
                if d <= 0.1 * row.check.tolerance {
                    format!("< {:.0e}", 0.1 * row.check.tolerance)
                } else {
                    significant(d, 2)
                }
            },
        );
        let kind = match row.check.kind {
            CheckKind::Verification => "verification",
            CheckKind::Validation => "validation",
            CheckKind::Regression => "regression",
            CheckKind::Finding => "finding",
        };
        let tier = if row.check.tier == Tier::Full { " (full)" } else { "" };
        let _ = writeln!(
            text,
            "| {} | {}{at} | {kind}{tier} | {} | {found} | {deviation} | {:.0e} | {} | {} |",
            row.case,
            row.quantity,
            significant(row.check.expect, 7),
            row.check.tolerance,
            row.verdict.word(),
            row.check.source.replace('|', "\\|"),
        );
    }
    text
}
