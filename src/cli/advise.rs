//! `bedload advise`: the least model that a scene needs, and what can go.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::{Answers, CaseArgs, CliError, Verb, say, word};
use crate::advise::{self, Cost, Least};
use crate::model::Registry;
use crate::units::significant;

/// The least model that serves a scene, and term by term what can go and what that costs.
#[derive(Clone, Debug, Args)]
pub(super) struct Advise {
    #[command(flatten)]
    case: CaseArgs,
    /// Largest relative change of the transport rate that a term may make and still go
    #[arg(long, value_name = "SHARE", default_value_t = 0.05)]
    tolerance: f64,
    /// Write a case of that model for this scene
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Advise {
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            let message = format!("--tolerance {} is not a share above 0", self.tolerance);
            return Err(CliError::Usage { message, hint: "0.05 is five per cent".into() });
        }
        let advice = advise::advise(registry, &self.case.case, &self.case.overrides, self.tolerance)?;
        let written = self.save(registry, &advice)?;
        if self.json {
            let numbers = advice.numbers.iter().map(|n| json!({ "name": n.name, "value": n.value, "says": n.says }));
            let terms = advice.terms.iter().map(|t| {
                json!({ "what": t.what, "keep": t.keep, "has": t.has, "error": t.error, "because": t.because, "source": t.source })
            });
            let least = &advice.least;
            return Ok(answers.give(&json!({
                "status": "done",
                "model": least.kind,
                "because": least.because,
                "cost_s": match least.cost {
                    Cost::Took(s) | Cost::Takes(s) => Some(s),
                    Cost::Unknown => None,
                },
                "cost_measured": matches!(least.cost, Cost::Took(_)),
                "error_of_model": least.off,
                "error_of_mesh": least.mesh.as_ref().map(|mesh| mesh.share),
                "mesh_against": least.mesh.as_ref().map(|mesh| &mesh.against),
                "of": advice.of,
                "numbers": numbers.collect::<Vec<_>>(),
                "terms": terms.collect::<Vec<_>>(),
                "dropped_together": advice.together,
                "written": written,
            }))?);
        }
        let mut text = format!("{}: {}\n  {}\n", self.case.case, advice.least.kind, advice.least.because);
        text += &worth(&advice.least);
        for number in &advice.numbers {
            text += &format!("  {:<36} {:>9}  {}\n", number.name, significant(number.value, 3), number.says);
        }
        text += &match advice.terms.as_slice() {
            [] => format!("\n  {} has no term that is assessed\n", advice.of),
            _ => format!("\n  terms of {}\n", advice.of),
        };
        for term in &advice.terms {
            let verdict = match (term.keep, term.has) {
                (true, true) => "keep",
                (true, false) => "add ",
                (false, true) => "drop",
                (false, false) => "none",
            };
            text += &format!("  {verdict} {:<36} {} ({})\n", term.what, term.because, term.source);
        }
        if let Some(error) = advice.together {
            text += &format!("  all that can go change the transport rate by {} together\n", advise::share(error));
        }
        text += &match written {
            Some(file) => format!("\nwrote {file}; next: bedload run {}\n", word(&file)),
            None if self.write.is_some() => "\nthe case that was given is of that model: nothing was written\n".into(),
            None => String::new(),
        };
        Ok(say(&text)?)
    }
}

/// A time for readers: milliseconds to hours.
fn time(s: f64) -> String {
    match s {
        s if s >= 7200.0 => format!("{} h", significant(s / 3600.0, 2)),
        s if s >= 120.0 => format!("{} min", significant(s / 60.0, 2)),
        s if s >= 1.0 => format!("{} s", significant(s, 2)),
        _ => format!("{} ms", significant(1e3 * s, 2)),
    }
}

/// What the advised model costs and how far it is off.
fn worth(least: &Least) -> String {
    let cost = match least.cost {
        Cost::Took(s) => format!("{} to solve", time(s)),
        Cost::Takes(s) => format!("about {} on one thread", time(s)),
        Cost::Unknown => "not known beforehand".into(),
    };
    let numbers = match &least.mesh {
        Some(mesh) => format!("{} of the transport rate against {}", advise::share(mesh.share), mesh.against),
        None if least.stochastic => "the standard error of its means, which its results state".into(),
        None => "round-off".into(),
    };
    format!("  cost              {cost}\n  error of model    {}\n  error of numbers  {numbers}\n\n", least.off)
}

impl Advise {
    /// Writes the case; `None` if none was asked for, or the one that was given serves.
    fn save(&self, registry: &Registry, advice: &advise::Advice) -> Result<Option<String>, CliError> {
        let Some(file) = &self.write else { return Ok(None) };
        let Some(text) = advice.case(registry)? else { return Ok(None) };
        let name = file.display().to_string();
        let refused = |message: String, hint: &str| CliError::Usage { message, hint: hint.into() };
        if file.exists() && !self.force {
            return Err(refused(format!("{name} is there already"), "give another name, or --force to replace it"));
        }
        fs::write(file, text)
            .map_err(|error| refused(format!("cannot write {name}: {error}"), "give another place"))?;
        Ok(Some(name))
    }
}
