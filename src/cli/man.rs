//! `bedload man`: the manual pages.

use std::io;
use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_mangen::Man as Writer;

use super::{Answers, Cli, CliError, Verb, say};
use crate::model::Registry;
use crate::output::Manual;

/// Print the manual, or write a page for each verb.
#[derive(Clone, Debug, Args)]
pub(super) struct Man {
    /// Folder of manual pages: bedload.1 and a page for each verb, in place of earlier ones
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Verb for Man {
    fn execute(self, _: &Registry, _: &Answers) -> Result<(), CliError> {
        let Some(folder) = self.out else {
            return Ok(say(&pages()?.into_iter().map(|(_, text)| text).collect::<String>())?);
        };
        let pages = pages()?;
        Manual::prepare(&folder, &pages)?.write()?;
        Ok(say(&format!("wrote {} pages to {}\n", pages.len(), folder.display()))?)
    }
}

/// The pages, the one of the program first: name of the file, and text.
fn pages() -> io::Result<Vec<(String, String)>> {
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();
    let exits = program.get_after_help().cloned().unwrap_or_default();
    let verbs: Vec<_> = program.get_subcommands().map(|verb| verb.clone().after_help(exits.clone())).collect();
    let page = |command| {
        let writer = Writer::new(command).source(concat!("bedload ", env!("CARGO_PKG_VERSION")));
        let mut text = Vec::new();
        writer.render(&mut text)?;
        Ok((writer.get_filename(), String::from_utf8_lossy(&text).into_owned()))
    };
    std::iter::once(program).chain(verbs).map(page).collect()
}
