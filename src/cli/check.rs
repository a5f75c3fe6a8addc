//! `bedload check`: is this a valid case?

use clap::Args;
use serde_json::json;

use super::{CaseArgs, CliError, Verb, answer, say};
use crate::model::Registry;

/// Say whether a case is valid, without running it.
#[derive(Debug, Args)]
pub(super) struct Check {
    #[command(flatten)]
    case: CaseArgs,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Check {
    fn model(&self) -> Option<&str> {
        self.case.model.as_deref()
    }

    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        let (case, problem) = self.case.load(registry)?;
        if self.json {
            return Ok(answer(&json!({ "status": "valid", "case": case.name, "model": problem.model_name() }))?);
        }
        let checks = case.checks().len();
        let rows = if checks == 1 { "1 check".to_owned() } else { format!("{checks} checks") };
        Ok(say(&format!("{}: valid, {}, {} levels, {rows}\n", case.source, problem.model_name(), problem.cells()))?)
    }
}
