//! `bedload completions`: a script for a shell.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::{Answers, Cli, CliError, Verb, say};
use crate::model::Registry;

/// Print a completion script for a shell.
#[derive(Clone, Debug, Args)]
pub(super) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Verb for Completions {
    fn execute(self, _: &Registry, _: &Answers) -> Result<(), CliError> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "bedload", &mut script);
        Ok(say(&String::from_utf8_lossy(&script))?)
    }
}
