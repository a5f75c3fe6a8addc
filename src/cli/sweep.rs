//! `bedload sweep`: one case over a grid of values.

use std::path::PathBuf;

use clap::Args;

use super::study::StudyArgs;
use super::{Answers, CaseArgs, CliError, Verb, word};
use crate::model::Registry;
use crate::study::sweep;

/// Run a case over values of one key or a grid of several: a table of all results, and a figure.
#[derive(Clone, Debug, Args)]
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
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn out(&mut self) -> Option<&mut PathBuf> {
        self.study.out.as_mut()
    }

    fn json(&self) -> bool {
        self.study.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let (plan, assess) = sweep::plan(&self.case.case, &self.case.overrides, &self.over)?;
        let options: Vec<String> = self.over.iter().map(|over| format!("--over {}", word(over))).collect();
        self.study.conduct(registry, answers, &self.case, &plan, assess, &options)
    }
}
