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
        let known = fs::symlink_metadata(&file);
        let new = known.is_err();
        match known {
            Ok(known) if known.is_dir() => return Err(unwritable(io::ErrorKind::IsADirectory.into())),
            Ok(_) if fs::read_to_string(&file).is_ok_and(|text| text.is_empty() || text.starts_with(head)) => {}
            Ok(_) => return Err(OutputError::ForeignFile(file)),
            // A figure without its table is somebody's.
            Err(_) if fs::symlink_metadata(&drawing).is_ok() => return Err(OutputError::ForeignFile(drawing)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(unwritable(error)),
        }
        Ok(Self { _above: Made::above(&drawing).map_err(unwritable)?, _site: site, file, new })
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
        })
    }
}
