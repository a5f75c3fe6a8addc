//! The case that an argument names, and each of several models of it.

use clap::Args;

use super::{CliError, Verb, word};
use crate::case::for_model;
use crate::model::{Checked, Registry};

/// A case and what to change in it.
#[derive(Clone, Debug, Args)]
pub(super) struct CaseArgs {
    /// A file, or the name of a shipped case
    #[arg(value_name = "CASE")]
    pub case: String,
    /// A model that solves it, where the case is a scene or has the tables of several; repeat it for several models
    #[arg(long, value_name = "MODEL")]
    pub model: Vec<String>,
    /// Change a value: table.key=value; an empty value removes the key
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

impl CaseArgs {
    /// The arguments that name this case again.
    pub fn as_typed(&self) -> String {
        let model = self.model.iter().map(|model| format!(" --model {}", word(model)));
        let overrides = self.overrides.iter().map(|o| format!(" --set {}", word(o)));
        std::iter::once(word(&self.case)).chain(model).chain(overrides).collect()
    }

    /// The same of one of several models: what is set in the table of another is not for it.
    pub fn of(&self, model: &str, models: &[String]) -> Self {
        Self {
            case: self.case.clone(),
            model: vec![model.into()],
            overrides: for_model(model, models, &self.overrides),
        }
    }

    pub fn load(&self, registry: &Registry) -> Result<Checked, CliError> {
        Ok(registry.load(&self.case, &self.overrides)?)
    }
}

/// Nothing is written unless every model takes the case, and the folder is none of a run.
pub(super) fn all_are_right(registry: &Registry, verb: &mut impl Verb, models: &[String]) -> Result<(), CliError> {
    if let Some(out) = verb.out().filter(|out| out.join("summary.json").exists()) {
        return Err(CliError::Usage {
            message: format!(
                "{} is the folder of a run, and those of several models are folders in one",
                out.display()
            ),
            hint: "another --out, or one model".into(),
        });
    }
    let Some(case) = verb.case() else { return Ok(()) };
    models.iter().try_for_each(|model| case.of(model, models).load(&registry.clone().choosing(model)).map(drop))
}
