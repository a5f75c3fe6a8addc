//! `bedload report`: figures and page again, from the tables alone.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::{Answers, CliError, Verb, say};
use crate::model::Registry;
use crate::output::redraw;

/// Redraw figures and page of a run from its tables.
#[derive(Clone, Debug, Args)]
pub(super) struct Report {
    /// Folder of the run
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Draw the figures as PNG, too
    #[arg(long)]
    png: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

impl Verb for Report {
    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, _: &Registry, answers: &Answers) -> Result<(), CliError> {
        let written = redraw(&self.run, self.png)?;
        let files: Vec<String> = std::iter::once(self.run.join("report.html"))
            .chain(written.figures)
            .map(|path| path.display().to_string())
            .collect();
        if self.json {
            return Ok(answers.give(&json!({ "status": "done", "files": files }))?);
        }
        Ok(say(&(files.join("\n") + "\n"))?)
    }
}
