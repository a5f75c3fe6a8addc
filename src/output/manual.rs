//! The manual pages, in a folder that holds those of other programs, too.

use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::folder::write_whole;
use super::lock::Site;
use super::path::{Made, resolve};
use super::table::replaces;

/// Manual pages that will be written.
#[derive(Debug)]
pub struct Manual<'a> {
    folder: PathBuf,
    pages: &'a [(String, String)],
    _above: Made,
    _site: Site,
}

impl<'a> Manual<'a> {
    /// Prepares `pages`, name of the file and text each, in `folder`, which is made if it is missing. Earlier ones, known by
    /// the name of the page in their title, are replaced.
    ///
    /// # Errors
    /// [`OutputError`] if something else stands there, or the folder cannot be written.
    pub fn prepare(folder: &Path, pages: &'a [(String, String)]) -> Result<Self, OutputError> {
        let folder = resolve(folder)?;
        if folder.exists() && !folder.is_dir() {
            return Err(OutputError::NotAFolder(folder));
        }
        let site = Site::take(&folder)?;
        for (name, _) in pages {
            let title = format!("\n.TH {} 1 ", name.trim_end_matches(".1"));
            replaces(&folder.join(name), |known| known.contains(&title))?;
        }
        let above = Made::above(&folder.join("bedload.1"));
        let above = above.map_err(|error| OutputError::Unwritable { path: folder.clone(), error })?;
        Ok(Self { folder, pages, _above: above, _site: site })
    }

    /// Writes the pages.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the page that cannot be written; the one that stood there before stays.
    pub fn write(self) -> Result<(), OutputError> {
        let mut pages = self.pages.iter();
        pages.try_for_each(|(name, text)| write_whole(&self.folder.join(name), |to| to.write_all(text.as_bytes())))
    }
}
