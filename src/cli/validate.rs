//! `bedload validate`: re-run what the cases claim.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};

use super::progress::Progress;
use super::{Answers, CliError, Verb, say};
use crate::case::checks::Tier;
use crate::model::Registry;
use crate::output::TableFile;
use crate::units::significant;
use crate::validate::advice::{self, Assessed};
use crate::validate::table::ADVICE_TESTS;
use crate::validate::{FIGURE, Going, HEAD, Partial, Row, ValidateError, Verdict, figure, markdown, validate};

/// Re-run what the cases claim and write the table.
#[derive(Clone, Debug, Args)]
pub(super) struct Validate {
    /// Cases to validate; all shipped ones if left out
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// A model of the cases; repeat it for several [default: all that a case has]
    #[arg(long, value_name = "MODEL", requires = "cases")]
    model: Vec<String>,
    /// The rows that take little time alone: the default
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Include the rows that take long
    #[arg(long)]
    full: bool,
    /// Assess advice on scenes whose answer is known, too; so does --full without cases
    #[arg(long)]
    advice: bool,
    /// File for the table [default: docs/validation.md with --full, where there is a folder docs]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Take the rows that an unfinished validation by this very program into the same file found
    #[arg(long, requires = "full")]
    resume: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Validate {
    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let tier = if self.full && !self.quick { Tier::Full } else { Tier::Quick };
        let default = (self.full && self.cases.is_empty())
            .then(|| PathBuf::from("docs/validation.md"))
            .filter(|_| Path::new("docs").is_dir());
        let table = self.out.or(default).map(|file| TableFile::prepare(&file, HEAD, FIGURE)).transpose()?;
        let (mut cases, mut waiting) = (Vec::new(), Vec::new());
        for case in &self.cases {
            let of_it = registry.cases_of(case, &[], &self.model).map_err(ValidateError::from)?;
            let claims = of_it.iter().map(|name| Claims::of(registry, name, tier)).collect::<Result<Vec<_>, _>>()?;
            if claims.iter().all(|claims| claims.all == 0) {
                return Err(no_checks(case, &claims));
            }
            waiting.extend(claims.into_iter().filter(|claims| claims.waiting > 0));
            cases.extend(of_it);
        }
        let from = table.as_ref().filter(|_| self.resume).and_then(TableFile::kept);
        let from = from.map(|text| Partial::read(&text)).unwrap_or_default();
        // Hours of work are not lost: the quick rows are made again in a minute.
        let kept = table.as_ref().filter(|_| tier == Tier::Full);
        let mut keep = |found: &Partial| kept.into_iter().for_each(|table| table.keep(&found.text()));
        let going = Going { from, keep: &mut keep };
        let rows = validate(registry, &cases, tier, &mut Progress::new(self.json), going)?;
        let assessed = if self.advice || self.full && self.cases.is_empty() {
            advice::assess(registry, ADVICE_TESTS)
        } else {
            Vec::new()
        };
        if let Some(table) = table {
            let advice = if assessed.is_empty() { String::new() } else { advice::markdown(&assessed) };
            table.write(&(markdown(&rows) + &advice), &figure(&rows))?;
        }
        let verdicts = || rows.iter().map(|r| r.verdict).chain(assessed.iter().map(|j| j.verdict));
        let red = verdicts().filter(|v| *v == Verdict::Red).count();
        if self.json {
            answers.give(
                &json!({ "status": if red == 0 { "done" } else { "failed" }, "red": red, "rows": rows.iter().map(object).collect::<Vec<_>>(), "advice": assessed.iter().map(advice).collect::<Vec<_>>() }),
            )?;
            return if red == 0 { Ok(()) } else { Err(CliError::Quiet(3)) };
        }
        let mut text = String::new();
        for row in &rows {
            let found = row.found.as_ref().map_or_else(Clone::clone, |x| significant(*x, 7));
            let expected = significant(row.check.expect, 7);
            let name = format!("{} {}", row.case, row.quantity);
            text += &format!(
                "{:5} {name:<48} {found} (expected {expected} ± {:.0e})\n",
                row.verdict.word(),
                row.check.tolerance
            );
        }
        for row in &assessed {
            let found = row.advised.found.as_ref().map_or_else(Clone::clone, |(error, _)| significant(*error, 2));
            let tolerance = row.test.tolerance;
            text += &format!(
                "{:5} advice: {:<40} {}, error {found} (± {tolerance:.0e})\n",
                row.verdict.word(),
                row.test.name,
                row.advised.name
            );
        }
        for Claims { case, waiting, .. } in waiting {
            let checks = if waiting == 1 { "1 check".to_owned() } else { format!("{waiting} checks") };
            text += &format!("{case}: {checks} of the tier full: --full runs them\n");
        }
        let green = verdicts().filter(|v| *v == Verdict::Green).count();
        say(&(text + &format!("{green} pass, {red} fail, {} shown\n", verdicts().count() - green - red)))?;
        if red == 0 { Ok(()) } else { Err(CliError::Red(red)) }
    }
}

/// What a case claims: its checks and its limit.
struct Claims {
    case: String,
    model: &'static str,
    all: usize,
    /// those that wait for the tier full
    waiting: usize,
}

impl Claims {
    fn of(registry: &Registry, name: &str, tier: Tier) -> Result<Self, CliError> {
        let (case, _) = registry.load(name, &[])?;
        let tiers = case.checks().iter().map(|check| check.tier).chain(case.limit().map(|limit| limit.tier));
        let waits = |of: &Tier| *of == Tier::Full && tier == Tier::Quick;
        let (all, waiting) = (tiers.clone().count(), tiers.filter(waits).count());
        Ok(Self { case: case.name, model: case.model, all, waiting })
    }
}

/// That there is nothing to validate, and how to add something.
fn no_checks(case: &str, claims: &[Claims]) -> CliError {
    let model = claims.first().map_or("MODEL", |claims| claims.model);
    CliError::Usage {
        message: format!("{case} has no checks: there is nothing to validate"),
        hint: format!(
            "add rows [[{model}.check]] with quantity, expect, tolerance, kind and source (docs/cases.md, Checks)"
        ),
    }
}

fn advice(row: &Assessed) -> Value {
    let found = |answer: &advice::Answer| match &answer.found {
        Ok((error, time)) => json!({ "model": answer.name, "error": error, "time_s": time }),
        Err(reason) => json!({ "model": answer.name, "reason": reason }),
    };
    json!({
        "scene": row.test.name,
        "tolerance": row.test.tolerance,
        "advised": found(&row.advised),
        "others": row.candidates.iter().map(found).collect::<Vec<_>>(),
        "without": row.without.as_ref().map(found),
        "verdict": row.verdict.word(),
    })
}

fn object(row: &Row) -> Value {
    json!({
        "case": row.case,
        "quantity": row.quantity,
        "at": row.check.at,
        "expect": row.check.expect,
        "found": row.found.as_ref().ok(),
        "reason": row.found.as_ref().err(),
        "tolerance": row.check.tolerance,
        "kind": row.check.kind,
        "verdict": row.verdict.word(),
        "source": row.check.source,
    })
}
