//! `bedload explain`: the equations with their numbers.

use clap::Args;

use super::{CaseArgs, CliError, Verb, say};
use crate::model::Registry;
use crate::scene::Scene;
use crate::units::significant;

/// Show the equations that a case solves, with its numbers, and the laws in them.
#[derive(Debug, Args)]
pub(super) struct Explain {
    #[command(flatten)]
    case: CaseArgs,
}

impl Verb for Explain {
    fn model(&self) -> Option<&str> {
        self.case.model.as_deref()
    }

    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        let (_, problem) = self.case.load(registry)?;
        let mut text = format!(
            "{}\n{} ({})\n\n{}",
            problem.title,
            problem.name,
            problem.model_name(),
            problem.describe().equations
        );
        if let Some(scene) = &problem.scene {
            text += &flow(scene);
        }
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

/// What the flow alone fixes.
fn flow(scene: &Scene) -> String {
    let mut text = format!("\nFlow: a scene of the kind {}\n", scene.kind());
    for number in scene.numbers() {
        text += &format!("  {:<22} {:>10}  {}\n", number.name, significant(number.value, 4), number.definition);
    }
    text
}
