//! `bedload new`: a case to start from.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Answers, CliError, Verb, say, word};
use crate::case::{nearest, shipped};
use crate::model::Registry;

/// Write a case to start from.
#[derive(Clone, Debug, Args)]
pub(super) struct New {
    /// Shipped case to start from (`bedload list cases`)
    #[arg(value_name = "SHIPPED")]
    from: String,
    /// File to write; `-` for standard output
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
}

impl Verb for New {
    fn execute(self, _: &Registry, _: &Answers) -> Result<(), CliError> {
        let Some(shipped) = shipped::find(&self.from) else {
            let hint = nearest(&self.from, shipped::names())
                .map_or_else(|| "`bedload list cases` shows them".into(), |n| format!("did you mean \"{n}\"?"));
            let message = format!("there is no shipped case \"{}\"", self.from);
            return Err(CliError::Usage { message, hint });
        };
        // The first line points an editor at the schema beside the shipped cases.
        let content = shipped.content;
        let content = content
            .split_once('\n')
            .map_or(content, |(first, rest)| if first.starts_with("#:schema") { rest } else { content });
        if self.file.as_os_str() == "-" {
            return Ok(say(content)?);
        }
        write_new(&self.file, content, self.force)?;
        let file = self.file.display().to_string();
        let model = shipped.model.map(|model| format!(" --model {model}")).unwrap_or_default();
        Ok(say(&format!("wrote {file}; next: bedload run {}{model}\n", word(&file)))?)
    }
}

/// Writes a file that is not there yet, or replaces it with `force`.
pub(super) fn write_new(path: &Path, content: &str, force: bool) -> Result<(), CliError> {
    let file = path.display().to_string();
    let refused = |error: std::io::Error| {
        let exists = error.kind() == ErrorKind::AlreadyExists;
        CliError::Usage {
            message: if exists { format!("{file} is there already") } else { format!("cannot write {file}: {error}") },
            hint: if exists { "give another name, or --force to replace it" } else { "give another place" }.into(),
        }
    };
    let mut options = OpenOptions::new();
    if force {
        options.create(true).truncate(true)
    } else {
        options.create_new(true)
    };
    options.write(true).open(path).map_err(refused)?.write_all(content.as_bytes())?;
    Ok(())
}
