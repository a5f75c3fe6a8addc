//! What in a folder is ours: one list says what may be replaced and what may be removed.

use std::path::Path;
use std::{fs, io};

use super::error::OutputError;
use super::grains::{ANIMATION, CHECKPOINT, is_frame, is_partial};
use super::lock::is_lock;

/// What the report shows that stands in no table.
pub(super) const WORDS: &str = "page.json";
/// The folder of figures as PNG.
pub(super) const FIGURES: &str = "figures";
/// The folder of the run folders of a study.
pub(super) const POINTS: &str = "points";

/// A folder that bedload writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Run,
    Comparison,
    Study,
    Figures,
    Points,
}

/// What an entry of ours is.
enum Entry {
    File,
    /// never removed but by who holds it
    Lock,
    Folder(Kind),
}

impl Kind {
    /// Files that the folder may hold.
    fn files(self) -> &'static [&'static str] {
        match self {
            Self::Run => &[
                "summary.json",
                "case.toml",
                "profile.csv",
                "series.csv",
                "report.html",
                CHECKPOINT,
                "grains.csv",
                ANIMATION,
                "section.csv",
                "section.vts",
                WORDS,
            ],
            Self::Comparison => super::comparison::FILES,
            Self::Study => super::study::FILES,
            Self::Figures | Self::Points => &[],
        }
    }

    /// What an entry of the folder is; `None` if it is not ours.
    fn entry(self, name: &str, is_folder: bool) -> Option<Entry> {
        Some(match (self, is_folder) {
            (_, false) if is_lock(name) => Entry::Lock,
            (Self::Run | Self::Comparison | Self::Study, true) if name == FIGURES => Entry::Folder(Self::Figures),
            (Self::Study, true) if name == POINTS => Entry::Folder(Self::Points),
            (Self::Points, true) if is_point(name) => Entry::Folder(Self::Run),
            (Self::Figures, false) if name.ends_with(".png") => Entry::File,
            (Self::Run, false) if is_frame(name) => Entry::File,
            (_, false) if self.files().contains(&name) || is_partial(name) => Entry::File,
            _ => return None,
        })
    }
}

/// Whether a folder of a study is that of a point, or was on its way to be one.
fn is_point(name: &str) -> bool {
    let between_two = name.starts_with('.') && (name.contains(".new-") || name.contains(".old-"));
    between_two || name.len() == 16 && name.chars().all(|c| c.is_ascii_hexdigit())
}

/// Whether a folder, and every folder in it, holds nothing but what bedload wrote.
///
/// # Errors
/// [`OutputError::Foreign`] with the first entry that is not ours.
pub(super) fn holds_only(folder: &Path, kind: Kind) -> Result<(), OutputError> {
    match foreign(folder, kind) {
        Ok(None) => Ok(()),
        Ok(Some(entry)) => Err(OutputError::Foreign { folder: folder.into(), entry }),
        Err(error) => Err(OutputError::Unwritable { path: folder.into(), error }),
    }
}

fn foreign(folder: &Path, kind: Kind) -> io::Result<Option<String>> {
    for (name, is_folder) in entries(folder)? {
        match kind.entry(&name, is_folder) {
            None => return Ok(Some(name)),
            Some(Entry::File | Entry::Lock) => {}
            Some(Entry::Folder(kind)) => {
                if let Some(inside) = foreign(&folder.join(&name), kind)? {
                    return Ok(Some(format!("{name}/{inside}")));
                }
            }
        }
    }
    Ok(None)
}

/// Removes what is ours in a folder, name by name. Nothing can be done about a failure here.
pub(super) fn clear(folder: &Path, kind: Kind) {
    for (name, is_folder) in entries(folder).unwrap_or_default() {
        let path = folder.join(&name);
        match kind.entry(&name, is_folder) {
            Some(Entry::File) => drop(fs::remove_file(path)),
            Some(Entry::Folder(kind)) => remove(&path, kind),
            Some(Entry::Lock) | None => {}
        }
    }
}

/// The same, and the folder itself if that was all that it held.
pub(super) fn remove(folder: &Path, kind: Kind) {
    clear(folder, kind);
    let _ = fs::remove_dir(folder);
}

/// Removes the folder whose place `new` has taken. What somebody put there since it was checked moves along.
pub(super) fn retire(old: &Path, new: &Path, kind: Kind) {
    remove(old, kind);
    // What cannot be moved stays where it is.
    let _ = move_rest(old, new);
}

fn move_rest(old: &Path, new: &Path) -> io::Result<()> {
    if !old.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(old)? {
        let entry = entry?;
        let to = new.join(entry.file_name());
        if fs::symlink_metadata(&to).is_err() {
            fs::rename(entry.path(), to)?;
        } else if entry.file_type()?.is_dir() {
            move_rest(&entry.path(), &to)?;
        }
    }
    fs::remove_dir(old)
}

/// Name of each entry of a folder, and whether it is a folder; a link is none.
pub(super) fn entries(folder: &Path) -> io::Result<Vec<(String, bool)>> {
    fs::read_dir(folder)?
        .map(|entry| {
            let entry = entry?;
            Ok((entry.file_name().to_string_lossy().into_owned(), entry.file_type()?.is_dir()))
        })
        .collect()
}
