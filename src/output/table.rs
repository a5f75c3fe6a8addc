//! A table in a file of its own, with a figure beside it: what `validate` writes.

use std::path::{Path, PathBuf};
use std::{fs, io};

use super::error::OutputError;
use super::folder::write_whole;
use super::lock::Site;
use super::ours::FIGURES;
use super::path::{Made, resolve};
use super::run::draw_one;
use crate::plot::{self};
use crate::result::Figure;

/// A table that will be written, and its figure in the folder of figures beside it.
#[derive(Debug)]
pub struct TableFile {
    file: PathBuf,
    /// whether none stands there
    new: bool,
    /// folders that were made for the figure
    _above: Made,
    _site: Site,
}

impl TableFile {
    /// Prepares `file`; an earlier table, known by the text `head` that it begins with, is replaced.
    ///
    /// # Errors
    /// [`OutputError`] if something else stands there, or the file cannot be written.
    pub fn prepare(file: &Path, head: &str, figure: &str) -> Result<Self, OutputError> {
        let file = resolve(file)?;
        let site = Site::take(&file)?;
        let unwritable = |error| OutputError::Unwritable { path: file.clone(), error };
        let drawing = file.with_file_name(FIGURES).join(format!("{figure}.png"));
        let new = !replaces(&file, |text| text.starts_with(head))?;
        // A figure without its table is somebody's.
        if new && fs::symlink_metadata(&drawing).is_ok() {
            return Err(OutputError::ForeignFile(drawing));
        }
        Ok(Self { _above: Made::above(&drawing).map_err(unwritable)?, _site: site, file, new })
    }

    /// The file of what an unfinished table holds: `validation.md.partial`.
    fn partial(&self) -> PathBuf {
        let mut name = self.file.file_name().unwrap_or_default().to_owned();
        name.push(".partial");
        self.file.with_file_name(name)
    }

    /// What an unfinished table held.
    #[must_use]
    pub fn kept(&self) -> Option<String> {
        fs::read_to_string(self.partial()).ok()
    }

    /// Keeps what the table holds so far. That it cannot be kept is no reason to stop: the table is written in the end.
    pub fn keep(&self, text: &str) {
        let _ = write_whole(&self.partial(), |to| to.write_all(text.as_bytes()));
    }

    /// Writes the figure, then the table.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file that cannot be written; the one that stood there before stays.
    pub fn write(self, text: &str, figure: &Figure) -> Result<(), OutputError> {
        let folder = self.file.with_file_name("");
        let drawing = draw_one(&folder, &folder, &figure.stem, |path| plot::png(figure, path))?;
        write_whole(&self.file, |to| to.write_all(text.as_bytes())).inspect_err(|_| {
            if self.new {
                let _ = fs::remove_file(drawing);
            }
        })?;
        let _ = fs::remove_file(self.partial());
        Ok(())
    }
}

/// Whether `file` stands there to be replaced: it is empty, or its text is `ours`.
///
/// # Errors
/// [`OutputError`] if something else stands there.
pub(super) fn replaces(file: &Path, ours: impl FnOnce(&str) -> bool) -> Result<bool, OutputError> {
    let unwritable = |error| OutputError::Unwritable { path: file.into(), error };
    match fs::symlink_metadata(file) {
        Ok(known) if known.is_dir() => Err(unwritable(io::ErrorKind::IsADirectory.into())),
        Ok(_) if fs::read_to_string(file).is_ok_and(|text| text.is_empty() || ours(&text)) => Ok(true),
        Ok(_) => Err(OutputError::ForeignFile(file.into())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(unwritable(error)),
    }
}
