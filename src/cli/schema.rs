//! `bedload schema`: the shape of case files.

use clap::Args;

use super::{CliError, Verb, answer, say};
use crate::case::{reference, schema};
use crate::model::Registry;

/// Print the JSON Schema of case files, for editors.
#[derive(Debug, Args)]
pub(super) struct Schema {
    /// The case reference for people, as Markdown
    #[arg(long)]
    reference: bool,
}

impl Verb for Schema {
    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        if self.reference {
            Ok(say(&reference(registry.kinds()))?)
        } else {
            Ok(answer(&schema::published(registry.kinds()))?)
        }
    }
}
