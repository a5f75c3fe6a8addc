//! `bedload schema`: the shape of case files.

use clap::Args;

use super::{Answers, CliError, Verb, say};
use crate::case::{reference, schema};
use crate::model::Registry;

/// Print the JSON Schema of case files, for editors.
#[derive(Clone, Debug, Args)]
pub(super) struct Schema {
    /// The case reference for people, as Markdown
    #[arg(long)]
    reference: bool,
}

impl Verb for Schema {
    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        if self.reference {
            Ok(say(&reference(registry.kinds()))?)
        } else {
            Ok(answers.give(&schema::published(registry.kinds()))?)
        }
    }
}
