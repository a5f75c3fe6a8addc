//! The folder of a comparison: `compare.json`, `norms.csv`, `report.html`, figures on demand.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::OutputError;
use super::folder::{Folder, Stands};
use super::ours::{Kind, holds_only};
use super::path::resolve;
use super::run::{draw_png, read_summary};
use super::study;
use crate::compare::{Comparison, Request};
use crate::result::{Cost, Provenance, Status};

/// Files that the folder of a comparison may hold.
pub(super) const FILES: &[&str] = &[RECORD, "norms.csv", "report.html"];
/// Everything that a comparison has to say; the folder is known by it.
const RECORD: &str = "compare.json";

/// What tells one comparison from another.
#[derive(Deserialize)]
struct Record {
    request: Request,
}

fn read(folder: &Path) -> Option<Record> {
    serde_json::from_str(&fs::read_to_string(folder.join(RECORD)).ok()?).ok()
}

/// Whether a folder holds a comparison.
pub(super) fn stands_in(folder: &Path) -> bool {
    read(folder).is_some()
}

/// Prepares `target` for the comparison that `request` asks for. The folder of the same request is replaced, that of
/// another only by `force`.
///
/// # Errors
/// [`OutputError`] if the folder holds anything that must not be replaced, or cannot be written.
pub fn prepare_comparison(target: &Path, request: &Request, force: bool) -> Result<Folder, OutputError> {
    Folder::claim(&resolve(target)?, Kind::Comparison, |folder| {
        let Some(record) = read(folder) else {
            // A run or a study is ours as well, but no comparison takes its place.
            let holds = if study::stands_in(folder) { "study" } else { read_summary(folder).map(|_| "run")? };
            return Err(OutputError::OtherKind { folder: folder.into(), holds, wanted: "comparison" });
        };
        holds_only(folder, Kind::Comparison)?;
        let same = record.request == *request;
        if force || same {
            return Ok(Stands { status: Status::Done, same, goes_on: false });
        }
        let Request { subjects, data, .. } = record.request;
        Err(OutputError::OtherComparison { folder: folder.into(), of: [subjects, data].concat().join(", ") })
    })
}

/// Writes a comparison; returns the figures that were drawn as PNG.
///
/// # Errors
/// [`OutputError::Interrupted`] with the file that cannot be written.
pub fn write_comparison(
    mut folder: Folder,
    comparison: &Comparison,
    request: &Request,
    cost: &Cost,
    provenance: &Provenance,
    png: bool,
) -> Result<Vec<PathBuf>, OutputError> {
    let written = fill(&folder, comparison, request, cost, provenance, png);
    let written = written.and_then(|drawn| folder.finish().map(|()| drawn));
    written.map_err(|error| folder.failed(error))
}

fn fill(
    folder: &Folder,
    comparison: &Comparison,
    request: &Request,
    cost: &Cost,
    provenance: &Provenance,
    png: bool,
) -> Result<Vec<PathBuf>, OutputError> {
    let record = comparison.to_json(request, cost, provenance);
    // First, so that the folder is known as ours whatever happens next.
    folder.write(RECORD, |to| writeln!(to, "{record:#}"))?;
    let reference = comparison.subjects.first().map_or("", |s| s.name.as_str());
    let mut comments: Vec<String> = provenance.lines().into_iter().take(1).collect();
    comments.extend([provenance.source.clone(), format!("reference {reference}; {}", comparison.align.datum())]);
    comments.push(format!("started {}", provenance.started_utc));
    folder.write("norms.csv", |to| comparison.write_norms(to, &comments))?;
    let figures = comparison.figures();
    let page = comparison.html(&figures, cost, provenance);
    folder.write("report.html", |to: &mut dyn Write| -> io::Result<()> { to.write_all(page.as_bytes()) })?;
    if png { draw_png(&folder.place, folder.path(), &figures) } else { Ok(Vec::new()) }
}
