//! `bedload sweep`: one case over a grid of values.

use clap::Args;

use super::study::StudyArgs;
use super::{CaseArgs, CliError, Verb, word};
use crate::model::Registry;
use crate::study::sweep;

/// Run a case over values of one key or a grid of several: a table of all results, and a figure.
#[derive(Debug, Args)]
pub(super) struct Sweep {
    #[command(flatten)]
    case: CaseArgs,
    /// table.key=a,b,c or table.key=from:to:count[:log], with a unit at the end; repeated, a grid
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    over: Vec<String>,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

impl Verb for Sweep {
    fn model(&self) -> Option<&str> {
        self.case.model.as_deref()
    }

    fn json(&self) -> bool {
        self.study.json
    }

    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        let (plan, assess) = sweep::plan(&self.case.case, &self.case.overrides, &self.over)?;
        let options: Vec<String> = self.over.iter().map(|over| format!("--over {}", word(over))).collect();
        self.study.conduct(registry, &self.case, &plan, assess, &options)
    }
}
