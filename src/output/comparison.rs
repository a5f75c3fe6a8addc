//! The folder of a comparison: `compare.json`, `norms.csv`, `report.html`, figures on demand.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::Value;

use super::error::OutputError;
use super::folder::{Folder, Stands};
use super::ours::{Kind, holds_only};
use super::path::resolve;
use super::run::{draw_png, read_summary};
use super::study;
use crate::result::{Figure, Status};

/// Files that the folder of a comparison may hold.
pub(super) const FILES: &[&str] = &[RECORD, "norms.csv", "report.html"];
/// Everything that a comparison has to say; the folder is known by it.
const RECORD: &str = "compare.json";

/// What tells one comparison from another.
#[derive(Deserialize)]
struct Record {
    request: Value,
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
pub fn prepare_comparison(target: &Path, request: &Value, force: bool) -> Result<Folder, OutputError> {
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
        let named = |list: &str| record.request.get(list).and_then(Value::as_array).cloned().unwrap_or_default();
        let of: Vec<Value> = [named("subjects"), named("data")].concat();
        let of: Vec<&str> = of.iter().filter_map(Value::as_str).collect();
        Err(OutputError::OtherComparison { folder: folder.into(), of: of.join(", ") })
    })
}

/// What a comparison has to say.
pub struct Compared<'a> {
    /// its record, with the request
    pub record: &'a Value,
    /// writes the table of norms
    pub norms: &'a dyn Fn(&mut dyn Write) -> io::Result<()>,
    /// its page
    pub page: &'a str,
    /// its figures
    pub figures: &'a [Figure],
}

/// Writes a comparison; returns the figures that were drawn as PNG.
///
/// # Errors
/// [`OutputError::Interrupted`] with the file that cannot be written.
pub fn write_comparison(mut folder: Folder, compared: &Compared<'_>, png: bool) -> Result<Vec<PathBuf>, OutputError> {
    let written = fill(&folder, compared, png);
    let written = written.and_then(|drawn| folder.finish().map(|()| drawn));
    written.map_err(|error| folder.failed(error))
}

fn fill(folder: &Folder, compared: &Compared<'_>, png: bool) -> Result<Vec<PathBuf>, OutputError> {
    // First, so that the folder is known as ours whatever happens next.
    folder.write(RECORD, |to| writeln!(to, "{:#}", compared.record))?;
    folder.write("norms.csv", |to| (compared.norms)(to))?;
    folder.write("report.html", |to: &mut dyn Write| to.write_all(compared.page.as_bytes()))?;
    if png { draw_png(&folder.place, folder.path(), compared.figures) } else { Ok(Vec::new()) }
}
