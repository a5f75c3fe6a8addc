//! `bedload check`: is this a valid case?

use clap::Args;
use serde_json::json;

use super::{Answers, CaseArgs, CliError, Verb, say};
use crate::case::CaseError;
use crate::model::Registry;

/// Say whether a case is valid, without running it.
#[derive(Clone, Debug, Args)]
pub(super) struct Check {
    #[command(flatten)]
    case: CaseArgs,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Check {
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let (case, problem) = match registry.load(&self.case.case, &self.case.overrides) {
            Ok(checked) => checked,
            Err(error) => return self.alone(registry, answers, error),
        };
        if self.json {
            return Ok(answers.give(&json!({ "status": "valid", "case": case.name, "model": problem.model_name() }))?);
        }
        let checks = case.checks().len();
        let rows = if checks == 1 { "1 check".to_owned() } else { format!("{checks} checks") };
        // An impact follows one grain at one place.
        let size = match (problem.stochastic, problem.cells()) {
            (_, 1) => String::new(),
            (true, grains) => format!("{grains} grains, "),
            (false, levels) => format!("{levels} levels, "),
        };
        Ok(say(&format!("{}: valid, {}, {size}{rows}\n", case.name, problem.model_name()))?)
    }
}

impl Check {
    /// What a case says that does not choose its model: valid if a model takes it.
    fn alone(&self, registry: &Registry, answers: &Answers, error: CaseError) -> Result<(), CliError> {
        let Some(takers) =
            takers(registry, &self.case, &error).filter(|t| t.iter().any(|(_, refused)| refused.is_none()))
        else {
            return Err(error.into());
        };
        // Of a file that has the tables of several models, each is to be right; a scene alone is not every model's.
        let wrong = takers.iter().find(|(_, refused)| refused.is_some());
        if let (Some((model, _)), Some(false)) = (wrong, error.choices().map(|choices| choices.alone)) {
            let models: Vec<String> = takers.iter().map(|(model, _)| model.clone()).collect();
            registry.of(model, &models, &self.case.case, &self.case.overrides)?;
        }
        if self.json {
            let models = takers.iter().map(|(model, refused)| json!({ "model": model, "refused": refused }));
            let models: Vec<_> = models.collect();
            return Ok(answers.give(&json!({ "status": "valid", "case": self.case.case, "models": models }))?);
        }
        let mut text = format!("{}: valid for\n", self.case.case);
        for (model, refused) in &takers {
            text += &match refused {
                None => format!("  {model:<14} --model {model}\n"),
                Some(why) => format!("  {model:<14} not: {why}\n"),
            };
        }
        Ok(say(&text)?)
    }
}

/// The models to choose from for a case, and why those do not take it that do not; `None` where something else is wrong.
pub(super) fn takers(registry: &Registry, case: &CaseArgs, error: &CaseError) -> Option<Vec<(String, Option<String>)>> {
    let choices = error.choices()?;
    let taken = |model: &String| {
        let loaded = registry.of(model, choices.models, &case.case, &case.overrides);
        let why = loaded.err().and_then(|error| Some(error.reports().first()?.message.clone()));
        (model.clone(), why)
    };
    Some(choices.models.iter().map(taken).collect())
}
