//! `bedload explain`: the equations with their numbers.

use clap::Args;

use super::{CaseArgs, CliError, Verb, say};
use crate::model::Registry;

/// Show the equations that a case solves, with its numbers, and the laws in them.
#[derive(Debug, Args)]
pub(super) struct Explain {
    #[command(flatten)]
    case: CaseArgs,
}

impl Verb for Explain {
    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        let (_, problem) = self.case.load(registry)?;
        let mut text = format!(
            "{}\n{} ({})\n\n{}",
            problem.title,
            problem.name,
            problem.model_name(),
            problem.describe().equations
        );
        let laws = problem.describe().laws;
        if !laws.is_empty() {
            text += "\nLaws\n";
        }
        for law in laws {
            text += &format!("  closures.{}, {}: {}\n    {}\n", law.family, law.law, law.equation, law.source);
            for range in law.ranges {
                text += &format!("    given for {range}\n");
            }
        }
        Ok(say(&text)?)
    }
}
