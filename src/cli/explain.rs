//! `bedload explain`: the equations with their numbers.

use clap::Args;

use super::check::takers;
use super::{Answers, CaseArgs, CliError, Verb, say};
use crate::case::{Case, CaseError};
use crate::model::Registry;
use crate::scene::Scene;
use crate::units::significant;

/// Show the equations that a case solves, with its numbers, and the laws in them.
#[derive(Clone, Debug, Args)]
pub(super) struct Explain {
    #[command(flatten)]
    case: CaseArgs,
}

impl Verb for Explain {
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn execute(self, registry: &Registry, _: &Answers) -> Result<(), CliError> {
        let (case, problem) = match registry.load(&self.case.case, &self.case.overrides) {
            Ok(checked) => checked,
            Err(error) => return self.alone(registry, error),
        };
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
        text += &taken(&case);
        Ok(say(&text)?)
    }
}

impl Explain {
    /// What a scene says before a model is chosen: its numbers, and who takes it.
    fn alone(&self, registry: &Registry, error: CaseError) -> Result<(), CliError> {
        let takers = takers(registry, &self.case, &error);
        let first = registry.takers(&self.case.case, &self.case.overrides).next();
        let (Some(takers), Some((_, problem))) = (takers, first) else { return Err(error.into()) };
        let mut text = format!("{}\n{}\n", problem.title, self.case.case);
        text += &problem.scene.as_ref().map(flow).unwrap_or_default();
        text += "\nModels\n";
        for (model, refused) in &takers {
            text += &match refused {
                None => format!("  {model:<14} bedload explain {} --model {model}\n", self.case.case),
                Some(why) => format!("  {model:<14} does not take it: {why}\n"),
            };
        }
        Ok(say(&text)?)
    }
}

/// What was not in the file and which values are taken.
fn taken(case: &Case) -> String {
    let defaults = case.defaults();
    if defaults.is_empty() {
        return String::new();
    }
    let mut text = String::from("\nNot in the file, and taken as\n");
    for (key, value) in defaults {
        text += &format!("  {key:<42} {value}\n");
    }
    text
}

/// What the flow alone fixes.
fn flow(scene: &Scene) -> String {
    let mut text = format!("\nFlow: a scene of the kind {}\n", scene.kind());
    for number in scene.numbers() {
        text += &format!("  {:<22} {:>10}  {}\n", number.name, significant(number.value, 4), number.definition);
    }
    for (key, value, from) in scene.derived() {
        text += &format!("  {key:<22} {:>10}  not given: {from}\n", significant(value, 4));
    }
    text
}
