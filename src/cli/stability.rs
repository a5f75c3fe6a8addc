//! `bedload stability`: where a method holds and how it fails beyond.

use std::path::PathBuf;

use clap::Args;

use super::study::StudyArgs;
use super::{Answers, CaseArgs, CliError, Verb, word};
use crate::model::Registry;
use crate::study::stability::{self, Request};

/// Where a case holds over one key or two: each point classified, each limit bisected.
#[derive(Clone, Debug, Args)]
pub(super) struct Stability {
    #[command(flatten)]
    case: CaseArgs,
    /// table.key=a,b,c or table.key=from:to:count[:log]; the first takes numbers and is bisected; at most two [default: the
    /// key of the table [limit] of the case]
    #[arg(long, value_name = "KEY=VALUES")]
    over: Vec<String>,
    /// Largest relative error of an answer that is accepted, where there is a closed form [default: 0.01, or that of the case]
    #[arg(long, value_name = "SHARE")]
    tolerance: Option<f64>,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

impl Verb for Stability {
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
        if let Some(tolerance) = self.tolerance.filter(|tolerance| !(*tolerance > 0.0 && tolerance.is_finite())) {
            let message = format!("--tolerance {tolerance} is not a share above 0");
            return Err(CliError::Usage { message, hint: "0.01 is one per cent".into() });
        }
        // What is varied may be what the case lacks: then its points are what is checked.
        let own = if self.over.is_empty() { self.case.load(registry)?.0.limit().cloned() } else { None };
        if self.over.is_empty() && own.is_none() {
            let message = "nothing is varied: no --over, and the case has no table [limit]".to_owned();
            return Err(CliError::Usage { message, hint: "add --over table.key=from:to:count".into() });
        }
        let tolerance = self.tolerance.or(own.as_ref().map(|limit| limit.within)).unwrap_or(0.01);
        let over: Vec<String> = own.iter().map(|limit| limit.over.clone()).chain(self.over).collect();
        let mut options: Vec<String> = over.iter().map(|over| format!("--over {}", word(over))).collect();
        options.push(format!("--tolerance {tolerance}"));
        let request = Request {
            case: self.case.case.clone(),
            overrides: self.case.overrides.clone(),
            over,
            tolerance,
            predicted: own.filter(|_| self.case.overrides.is_empty()).map(|limit| limit.expect),
        };
        let (plan, assess) = stability::plan(registry, &request)?;
        self.study.conduct(registry, answers, &self.case, &plan, assess, &options)
    }
}
