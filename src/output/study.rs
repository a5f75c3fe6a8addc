//! The folder of a study: `study.json`, `points.csv`, `parameters.csv` where some were fitted, `report.html`, figures on
//! demand, and one run folder per point.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::Value;

use super::comparison;
use super::error::OutputError;
use super::folder::{Folder, Mode, Stands};
use super::ours::{self, Kind, POINTS, entries, holds_only};
use super::path::resolve;
use super::run::{draw_png, read_summary};
use crate::result::Figure;
use crate::result::Status;

/// Files that the folder of a study may hold.
pub(super) const FILES: &[&str] = &[RECORD, TABLE, PARAMETERS, "report.html"];
/// Everything that a study has to say; the folder is known by it.
const RECORD: &str = "study.json";
const TABLE: &str = "points.csv";
const PARAMETERS: &str = "parameters.csv";

/// What tells one study from another, and how it ended.
#[derive(Deserialize)]
struct Record {
    plan_sha256: String,
    status: Status,
    command: String,
}

fn read(folder: &Path) -> Option<Record> {
    serde_json::from_str(&fs::read_to_string(folder.join(RECORD)).ok()?).ok()
}

/// Whether a folder holds a study.
pub(super) fn stands_in(folder: &Path) -> bool {
    read(folder).is_some()
}

/// The folder of a study that is being made.
#[derive(Debug)]
pub struct StudyFolder(Folder);

impl StudyFolder {
    /// Prepares `target` for the study whose plan has the fingerprint `plan`. The same study, finished, is replaced; an
    /// unfinished one goes on where it stands with `--resume`; another one gives way to `--force` only.
    ///
    /// # Errors
    /// [`OutputError`] if the folder holds anything that must not be replaced, or cannot be written.
    pub fn prepare(target: &Path, plan: &str, mode: Mode) -> Result<Self, OutputError> {
        let folder = Folder::claim(&resolve(target)?, Kind::Study, |folder| may_replace(folder, plan, mode))?;
        clear(&folder.place(POINTS));
        Ok(Self(folder))
    }

    /// Prepares the folder of the run of the resolved case `case`, which has this fingerprint.
    ///
    /// # Errors
    /// [`OutputError`] if it holds anything that must not be replaced, or cannot be written.
    pub fn prepare_point(&self, sha256: &str, case: &str) -> Result<Folder, OutputError> {
        Folder::of_point(&self.point(sha256), case)
    }

    /// What broke on the way, with the points that stay.
    #[must_use]
    pub fn failed(&self, error: OutputError) -> OutputError {
        self.0.failed(error)
    }

    /// Where the run of the resolved case with this fingerprint is being written.
    #[must_use]
    pub fn point(&self, sha256: &str) -> PathBuf {
        self.0.place(&Self::point_name(sha256))
    }

    /// Name of that folder inside the study.
    #[must_use]
    pub fn point_name(sha256: &str) -> String {
        format!("{POINTS}/{}", sha256.get(..16).unwrap_or(sha256))
    }

    /// Marks the folder as being computed, so that it is known as ours whatever happens next.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file that cannot be written.
    pub fn begin(&self, record: &Value) -> Result<(), OutputError> {
        self.0.write(RECORD, |to| writeln!(to, "{record:#}"))?;
        let points = self.0.place(POINTS);
        fs::create_dir_all(&points).map_err(|error| OutputError::Interrupted { path: points, error })
    }

    /// Writes the parameters that were fitted.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file that cannot be written.
    pub fn write_parameters(&self, table: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputError> {
        self.0.write(PARAMETERS, table)
    }

    /// Writes table, page and figures, the record last, and puts the study in its place. Returns the figures that were drawn
    /// as PNG, and whether the folder still holds the finished study that it held before.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file that cannot be written.
    pub fn finish(
        &mut self,
        (status, record): (Status, &Value),
        table: impl FnOnce(&mut dyn Write) -> io::Result<()>,
        page: &str,
        figures: &[Figure],
        png: bool,
    ) -> Result<(Vec<PathBuf>, bool), OutputError> {
        let Self(folder) = self;
        folder.write(TABLE, table)?;
        folder.write("report.html", |to| to.write_all(page.as_bytes()))?;
        let drawn = if png { draw_png(&folder.place, folder.path(), figures)? } else { Vec::new() };
        folder.write(RECORD, |to| writeln!(to, "{record:#}"))?;
        // Ctrl-C loses nothing: what is only begun does not replace what is done.
        let kept = status == Status::Stopped && folder.over_finished();
        if kept {
            folder.give_way();
        } else {
            folder.finish()?;
        }
        Ok((drawn, kept))
    }
}

fn may_replace(folder: &Path, plan: &str, mode: Mode) -> Result<Stands, OutputError> {
    let Some(record) = read(folder) else {
        // A run or a comparison is ours as well, but no study takes its place.
        let holds = if comparison::stands_in(folder) { "comparison" } else { read_summary(folder).map(|_| "run")? };
        return Err(OutputError::OtherKind { folder: folder.into(), holds, wanted: "study" });
    };
    holds_only(folder, Kind::Study)?;
    let stands = Stands { status: record.status, same: record.plan_sha256 == plan, goes_on: false };
    match record.status {
        _ if mode.force => Ok(stands),
        _ if !stands.same => Err(OutputError::OtherStudy { folder: folder.into(), of: record.command }),
        _ if mode.resume => Ok(Stands { goes_on: true, ..stands }),
        Status::Done => Ok(stands),
        status => Err(OutputError::UnfinishedStudy { folder: folder.into(), status }),
    }
}

/// How many points of a study are done.
pub(super) fn points_done(folder: &Path) -> usize {
    let points = folder.join(POINTS);
    let done = |name: &str| read_summary(&points.join(name)).is_ok_and(|summary| summary.status == Status::Done);
    entries(&points).unwrap_or_default().iter().filter(|(name, _)| !name.starts_with('.') && done(name)).count()
}

/// Removes what a killed study left of points that had no summary yet. What cannot be removed is refused as a run folder.
fn clear(points: &Path) {
    for (name, _) in entries(points).unwrap_or_default() {
        let place = points.join(&name);
        if name.starts_with('.') || read_summary(&place).is_err() {
            ours::remove(&place, Kind::Run);
        }
    }
}
