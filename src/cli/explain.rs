//! `bedload explain`: the equations with their numbers.

use clap::Args;
use serde_json::{Value, json};

use super::check::takers;
use super::{Answers, CaseArgs, CliError, Verb, say, word};
use crate::case::{Case, CaseError};
use crate::model::{Problem, Registry};
use crate::scene::Scene;
use crate::units::significant;

/// Show the equations that a case solves, with its numbers, and the laws in them.
#[derive(Clone, Debug, Args)]
pub(super) struct Explain {
    #[command(flatten)]
    case: CaseArgs,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Explain {
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
            return Ok(answers.give(&json!({
                "status": "done",
                "case": problem.name,
                "title": problem.title,
                "model": problem.model_name(),
                "equations": problem.describe().equations,
                "flow": problem.scene.as_ref().map(flow_object),
                "laws": problem.statement().laws,
                "taken": taken(&case, &problem).iter().map(Taken::object).collect::<Vec<_>>(),
            }))?);
        }
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
        let taken = taken(&case, &problem);
        text += if taken.is_empty() { "" } else { "\nNot in the file, and taken as\n" };
        text += &taken.iter().map(Taken::line).collect::<String>();
        Ok(say(&text)?)
    }
}

impl Explain {
    /// What a scene says before a model is chosen: its numbers, and who takes it.
    fn alone(&self, registry: &Registry, answers: &Answers, error: CaseError) -> Result<(), CliError> {
        let takers = takers(registry, &self.case, &error);
        let first = registry.takers(&self.case.case, &self.case.overrides).next();
        let (Some(takers), Some((_, problem))) = (takers, first) else { return Err(error.into()) };
        if self.json {
            let models = takers.iter().map(|(model, refused)| json!({ "model": model, "refused": refused }));
            return Ok(answers.give(&json!({
                "status": "done",
                "case": self.case.case,
                "title": problem.title,
                "flow": problem.scene.as_ref().map(flow_object),
                "models": models.collect::<Vec<_>>(),
            }))?);
        }
        let mut text = format!("{}\n{}\n", problem.title, self.case.case);
        text += &problem.scene.as_ref().map(flow).unwrap_or_default();
        text += "\nModels\n";
        for (model, refused) in &takers {
            text += &match refused {
                None => format!("  {model:<14} bedload explain {} --model {model}\n", word(&self.case.case)),
                Some(why) => format!("  {model:<14} does not take it: {why}\n"),
            };
        }
        Ok(say(&text)?)
    }
}

/// A value that was not in the file: a default, or what follows from the flow.
struct Taken {
    key: String,
    value: Value,
    /// what it follows from
    from: Option<&'static str>,
}

impl Taken {
    fn line(&self) -> String {
        let from = self.from.map(|from| format!("  from: {from}")).unwrap_or_default();
        // What follows has more digits than it is known to.
        let value = match self.value.as_f64().filter(|_| self.from.is_some()) {
            Some(value) => significant(value, 5),
            None => self.value.to_string().trim_matches('"').to_owned(),
        };
        format!("  {:<42} {value}{from}\n", self.key)
    }

    fn object(&self) -> Value {
        json!({ "key": self.key, "value": self.value, "from": self.from })
    }
}

/// What was not in the file and which values are taken.
fn taken(case: &Case, problem: &Problem) -> Vec<Taken> {
    let defaults = case.defaults().into_iter().map(|(key, value)| Taken { key, value, from: None });
    let derived = problem.solver().derived().into_iter().filter(|(key, ..)| !case.gives(key));
    let derived = derived.map(|(key, value, from)| Taken { key: key.into(), value: json!(value), from: Some(from) });
    defaults.chain(derived).collect()
}

/// What the flow alone fixes, as JSON.
fn flow_object(scene: &Scene) -> Value {
    let numbers = scene.numbers().into_iter();
    let numbers = numbers.map(|n| json!({ "name": n.name, "value": n.value, "definition": n.definition }));
    let derived = scene.derived().into_iter();
    let derived = derived.map(|(key, value, from)| json!({ "key": key, "value": value, "from": from }));
    json!({ "scene": scene.kind(), "numbers": numbers.collect::<Vec<_>>(), "derived": derived.collect::<Vec<_>>() })
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
