//! `bedload migrate`: a case of format 1 as one of format 2.

use std::path::PathBuf;

use clap::Args;

use super::new::write_new;
use super::{CliError, Verb, say};
use crate::model::Registry;

/// Write a case in format 2: the flow, and the table of its model. Quantities in SI, every default filled in.
#[derive(Debug, Args)]
pub(super) struct Migrate {
    /// A file of format 1, or the name of a shipped case
    #[arg(value_name = "OLD")]
    old: String,
    /// File to write; `-` for standard output
    #[arg(value_name = "NEW")]
    new: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
}

impl Verb for Migrate {
    fn execute(self, registry: &Registry) -> Result<(), CliError> {
        let (case, _) = registry.load(&self.old, &[])?;
        let Some(text) = registry.converted(&case) else {
            let hint = "write the case by hand: docs/scenes.md".into();
            return Err(CliError::Usage { message: format!("{} has no form of format 2", self.old), hint });
        };
        if self.new.as_os_str() == "-" {
            return Ok(say(&text)?);
        }
        write_new(&self.new, &text, self.force)?;
        let file = self.new.display();
        Ok(say(&format!("wrote {file}; next: bedload check {file}\n"))?)
    }
}
