//! `bedload stability`: where a method holds and how it fails beyond.

use clap::Args;

use super::study::StudyArgs;
use super::{CaseArgs, CliError, word};
use crate::study::stability::{self, Request};

/// Where a case holds over one key or two: each point classified, each limit bisected.
#[derive(Debug, Args)]
pub(super) struct Stability {
    #[command(flatten)]
    case: CaseArgs,
    /// table.key=a,b,c or table.key=from:to:count[:log]; the first takes numbers and is bisected; at most two
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    over: Vec<String>,
    /// Largest relative error of an answer that holds, where a closed form judges it
    #[arg(long, value_name = "SHARE", default_value_t = 0.01)]
    tolerance: f64,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

impl Stability {
    pub(super) fn execute(self) -> Result<(), CliError> {
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            let message = format!("--tolerance {} is not a share above 0", self.tolerance);
            return Err(CliError::Usage { message, hint: "0.01 is one per cent".into() });
        }
        let mut options: Vec<String> = self.over.iter().map(|over| format!("--over {}", word(over))).collect();
        options.push(format!("--tolerance {}", self.tolerance));
        let request = Request {
            case: self.case.case.clone(),
            overrides: self.case.overrides.clone(),
            over: self.over,
            tolerance: self.tolerance,
        };
        let (plan, judge) = stability::plan(&request)?;
        self.study.conduct(&self.case, &plan, judge, &options)
    }
}
