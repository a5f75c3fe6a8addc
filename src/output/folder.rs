//! One folder per run. A new or empty folder is used; the same case, finished, is replaced by rename; anything else is refused.

use std::ffi::OsString;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::error::{Finished, OutputError};
use super::grains::{CHECKPOINT, is_partial};
use super::lock::{Site, is_lock};
use super::ours::{self, Kind, entries, holds_only};
use super::path::resolve;
use super::run::read_summary;
use super::{comparison, study};
use crate::result::Status;

/// What may be done with a folder that is not empty.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Mode {
    /// replace any run that bedload wrote
    pub force: bool,
    /// go on with an unfinished run of the same case
    pub resume: bool,
}

/// What stands in a folder, and may make room.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stands {
    /// how far it is
    pub status: Status,
    /// whether it is what will be written again
    pub same: bool,
    /// whether it goes on where it stands
    pub goes_on: bool,
}

/// A folder that is being written. Dropped before [`Folder::finish`], it takes back what it wrote, but for what is finished.
#[derive(Debug)]
pub struct Folder {
    kind: Kind,
    /// where the run will be
    pub(super) target: PathBuf,
    /// where it is written: the target itself, or a folder beside it that replaces it in the end
    pub(super) place: PathBuf,
    /// whether this process made the place
    made: bool,
    /// the target, locked; `None` for a point, whose study is
    _site: Option<Site>,
    /// whether a finished run stands in the target
    over_finished: bool,
    /// whether that is the same as this one will be
    again: bool,
    /// whether the target has every checkpoint that the place has
    pub(super) carried: bool,
    /// whether all is there, but not where it should be
    whole: bool,
    finished: bool,
}

impl Folder {
    /// Prepares `target` for a run of the resolved case `case`.
    ///
    /// # Errors
    /// [`OutputError`] if the folder holds anything that must not be replaced, or cannot be written.
    pub fn prepare(target: &Path, case: &str, mode: Mode) -> Result<Self, OutputError> {
        Self::claim(&resolve(target)?, Kind::Run, |folder| may_replace(folder, case, mode))
    }

    /// Prepares the folder of one point of a study that has begun: what cannot be made now breaks the study.
    ///
    /// # Errors
    /// As [`Folder::prepare`], and [`OutputError::Interrupted`].
    pub(super) fn of_point(target: &Path, case: &str) -> Result<Self, OutputError> {
        // The folder is named by its case: whatever run stands in it is an unfinished one of this case.
        let mode = Mode { force: true, resume: true };
        Self::occupy(None, target, Kind::Run, |folder| may_replace(folder, case, mode)).map_err(|error| match error {
            OutputError::Unwritable { path, error } => OutputError::Interrupted { path, error },
            other => other,
        })
    }

    /// Prepares the resolved path `target`, whose content `may_replace` assesses where there is any.
    ///
    /// # Errors
    /// As [`Folder::prepare`].
    pub(super) fn claim(
        target: &Path,
        kind: Kind,
        may_replace: impl FnOnce(&Path) -> Result<Stands, OutputError>,
    ) -> Result<Self, OutputError> {
        let before = is_occupied(target);
        if let Err(error @ OutputError::NotAFolder(_)) = before {
            return Err(error);
        }
        match Site::take(target) {
            Ok(site) => {
                put_back(target);
                Self::occupy(Some(site), target, kind, may_replace)
            }
            // What stands there tells more than that no lock can be made.
            Err(error @ OutputError::Unwritable { .. }) if matches!(before, Ok(Some(true))) => {
                may_replace(target).and(Err(error))
            }
            Err(error) => Err(error),
        }
    }

    fn occupy(
        site: Option<Site>,
        target: &Path,
        kind: Kind,
        may_replace: impl FnOnce(&Path) -> Result<Stands, OutputError>,
    ) -> Result<Self, OutputError> {
        let occupied = is_occupied(target)?;
        let mut folder = Self {
            kind,
            target: target.into(),
            place: target.into(),
            made: false,
            _site: site,
            over_finished: false,
            again: false,
            carried: false,
            whole: false,
            finished: true,
        };
        match occupied {
            None => {
                fs::create_dir(target).map_err(unwritable(target))?;
                folder.made = true;
            }
            Some(false) => {}
            Some(true) => {
                let Stands { status, same, goes_on } = may_replace(target)?;
                if goes_on {
                    return Ok(folder);
                }
                folder.over_finished = status == Status::Done;
                folder.again = folder.over_finished && same;
                let place = free(target, "new");
                fs::create_dir(&place).map_err(unwritable(&place))?;
                (folder.place, folder.made) = (place, true);
            }
        }
        // From here on there is something to take back, and never before: what was checked above is not ours to touch.
        folder.finished = false;
        // Whether files can be made here is known before anything is computed.
        let probe = beside(&folder.place("probe"), "part");
        let made = fs::File::create(&probe).and_then(|_| fs::remove_file(&probe));
        made.map_err(unwritable(&folder.place))?;
        Ok(folder)
    }

    /// Whether a finished run stands where this one will be.
    #[must_use]
    pub fn over_finished(&self) -> bool {
        self.over_finished
    }

    /// Where the run will be: the path that was given, resolved.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.target
    }

    /// Where files of the name `name` are being written.
    #[must_use]
    pub fn place(&self, name: &str) -> PathBuf {
        self.place.join(name)
    }

    /// Writes one file, which appears whole or not at all.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file.
    pub fn write(&self, name: &str, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputError> {
        write_whole(&self.place.join(name), content)
    }

    /// Puts the run in its place.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] if the folders cannot be exchanged; the old run then stays.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        if self.place != self.target {
            self.whole = true;
            self.exchange().map_err(|error| OutputError::Interrupted { path: self.target.clone(), error })?;
        }
        self.finished = true;
        Ok(())
    }

    /// What is written gives way to the finished run that the target holds.
    pub(super) fn give_way(&mut self) {
        self.again = true;
    }

    /// What broke on the way, with what stays of this folder all the same.
    #[must_use]
    pub fn failed(&self, error: OutputError) -> OutputError {
        let Some((folder, what)) = self.stays().filter(|_| !error.is_refusal()) else { return error };
        let untouched = (folder != self.target).then(|| self.target.clone());
        OutputError::Kept { error: Box::new(error), folder: folder.into(), what, untouched }
    }

    /// Where something stays that is finished, and what it is.
    fn stays(&self) -> Option<(&Path, Finished)> {
        let finished = match self.kind {
            // What stands in the target is finished, and the same.
            _ if self.again => return None,
            _ if self.whole => Finished::Whole,
            Kind::Run if self.carried => return Some((&self.target, Finished::Checkpoint)),
            Kind::Run if self.place.join(CHECKPOINT).is_file() => Finished::Checkpoint,
            Kind::Study => match study::points_done(&self.place) {
                0 => return None,
                done => Finished::Points(done),
            },
            _ => return None,
        };
        Some((&self.place, finished))
    }

    fn exchange(&self) -> io::Result<()> {
        match fs::symlink_metadata(&self.target) {
            Ok(known) if !known.is_dir() => return Err(io::ErrorKind::NotADirectory.into()),
            Ok(_) => {}
            // Somebody took the old one away.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return fs::rename(&self.place, &self.target),
            Err(error) => return Err(error),
        }
        let old = free(&self.target, "old");
        fs::rename(&self.target, &old)?;
        if let Err(error) = fs::rename(&self.place, &self.target) {
            let _ = fs::rename(&old, &self.target);
            return Err(error);
        }
        ours::retire(&old, &self.target, self.kind);
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.finished || self.stays().is_some_and(|(folder, _)| folder == self.place) {
            return;
        }
        if self.made {
            ours::remove(&self.place, self.kind);
        } else {
            ours::clear(&self.place, self.kind);
        }
    }
}

/// Puts back what a process that was killed between two renames had taken out of the place of `target`, which is locked.
fn put_back(target: &Path) {
    let (Some(above), Some(name)) = (target.parent(), target.file_name()) else { return };
    if fs::symlink_metadata(target).is_ok() {
        return;
    }
    let above = if above.as_os_str().is_empty() { Path::new(".") } else { above };
    let prefix = format!(".{}.old-", name.to_string_lossy());
    let old = entries(above)
        .unwrap_or_default()
        .into_iter()
        .find(|(name, is_folder)| *is_folder && name.starts_with(&prefix));
    if let Some((old, _)) = old {
        // If it cannot be moved, it stays, and the place is free.
        let _ = fs::rename(above.join(old), target);
    }
}

fn unwritable(path: &Path) -> impl FnOnce(io::Error) -> OutputError {
    |error| OutputError::Unwritable { path: path.into(), error }
}

/// Whether there is anything in a folder; `None` if there is no folder.
fn is_occupied(target: &Path) -> Result<Option<bool>, OutputError> {
    match fs::symlink_metadata(target) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(unwritable(target)(error)),
        Ok(known) if !known.is_dir() => Err(OutputError::NotAFolder(target.into())),
        Ok(_) => {
            let entries = entries(target).map_err(unwritable(target))?;
            Ok(Some(entries.iter().any(|(name, _)| !is_partial(name) && !is_lock(name))))
        }
    }
}

/// Writes a file beside `path` and renames it.
///
/// # Errors
/// [`OutputError::Interrupted`]; the file that stood there before stays.
pub(super) fn write_whole(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    let partial = beside(path, "part");
    let written = fs::File::create(&partial).and_then(|file| {
        let mut writer = BufWriter::with_capacity(1 << 16, &file);
        content(&mut writer)?;
        writer.flush()?;
        drop(writer);
        // A disk may take a file and say only afterwards that it is full: the last checkpoint stays until the next is safe.
        if path.file_name().is_some_and(|name| name == CHECKPOINT) {
            file.sync_data()?;
        }
        fs::rename(&partial, path)
    });
    written.map_err(|error| {
        let _ = fs::remove_file(&partial);
        OutputError::Interrupted { path: path.into(), error }
    })
}

/// A hidden name beside `path` that no other process uses.
fn beside(path: &Path, what: &str) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{what}-{}", std::process::id()));
    path.with_file_name(name)
}

/// The same, and not taken: a process of the same number may have been killed before.
fn free(path: &Path, what: &str) -> PathBuf {
    let first = beside(path, what);
    let further = (2..).map(|n| {
        let mut name = first.clone().into_os_string();
        name.push(format!("-{n}"));
        PathBuf::from(name)
    });
    let mut names = std::iter::once(first.clone()).chain(further);
    names.find(|name| fs::symlink_metadata(name).is_err()).unwrap_or(first)
}

/// Whether a folder that is not empty may be replaced by a run of the resolved case `case`.
fn may_replace(folder: &Path, case: &str, mode: Mode) -> Result<Stands, OutputError> {
    if comparison::stands_in(folder) {
        return Err(OutputError::OtherKind { folder: folder.into(), holds: "comparison", wanted: "run" });
    }
    if study::stands_in(folder) {
        return Err(OutputError::OtherKind { folder: folder.into(), holds: "study", wanted: "run" });
    }
    let summary = read_summary(folder)?;
    holds_only(folder, Kind::Run)?;
    let held = fs::read_to_string(folder.join("case.toml"));
    let same = held.as_ref().is_ok_and(|text| text == case);
    let old = held.is_ok_and(|text| text.lines().any(|line| line.trim() == "format = 1"));
    let stands = Stands { status: summary.status, same, goes_on: false };
    match (same, summary.status) {
        _ if mode.force => Ok(stands),
        (true, Status::Done) => Ok(stands),
        (true, _) if mode.resume => Ok(stands),
        (true, status) => Err(OutputError::Unfinished { folder: folder.into(), status }),
        _ if old => Err(OutputError::OldFormat(folder.into())),
        (false, _) => Err(OutputError::OtherCase { folder: folder.into(), case: summary.case }),
    }
}
