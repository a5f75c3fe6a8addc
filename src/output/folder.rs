//! One folder per run. A new or empty folder is used; the same case, finished, is replaced by rename; anything else is refused.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::grains::{CHECKPOINT, MOTION, PROBE, is_frame, is_partial};
use super::run::read_summary;
use super::{comparison, study};
use crate::result::Status;

/// Files that a run folder may hold; anything else in it is not ours.
pub(super) const OURS: &[&str] = &[
    "summary.json",
    "case.toml",
    "profile.csv",
    "series.csv",
    "report.html",
    FIGURES,
    CHECKPOINT,
    "grains.csv",
    MOTION,
    "section.csv",
    "section.vts",
];
/// The one folder in it, of figures as PNG.
pub(super) const FIGURES: &str = "figures";

/// Why a folder cannot be used or written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// a file where the folder should be
    #[error("{} is a file, not a folder", .0.display())]
    NotAFolder(PathBuf),
    /// something in it that no run wrote
    #[error("{} was not written by bedload: it holds {entry}", folder.display())]
    Foreign {
        /// the folder
        folder: PathBuf,
        /// what is not ours
        entry: String,
    },
    /// a run where a comparison should be, and the like
    #[error("{} holds a {holds}, not a {wanted}", folder.display())]
    OtherKind {
        /// the folder
        folder: PathBuf,
        /// run, comparison or study
        holds: &'static str,
        /// run, comparison or study
        wanted: &'static str,
    },
    /// a comparison with other arguments
    #[error("{} holds another comparison: {of}", folder.display())]
    OtherComparison {
        /// the folder
        folder: PathBuf,
        /// its arguments
        of: String,
    },
    /// a study with other points
    #[error("{} holds another study: {of}", folder.display())]
    OtherStudy {
        /// the folder
        folder: PathBuf,
        /// the command that made it
        of: String,
    },
    /// the same study, not finished
    #[error("{} holds this study unfinished ({status})", folder.display())]
    UnfinishedStudy {
        /// the folder
        folder: PathBuf,
        /// its state
        status: Status,
    },
    /// a run of another case, or of this one with other values
    #[error("{} holds a run of {case} with other values", folder.display())]
    OtherCase {
        /// the folder
        folder: PathBuf,
        /// that case
        case: String,
    },
    /// the same case, not finished
    #[error("{} holds an unfinished run of this case ({status})", folder.display())]
    Unfinished {
        /// the folder
        folder: PathBuf,
        /// its state
        status: Status,
    },
    /// a folder or file that cannot be made
    #[error("cannot write {}: {error}", path.display())]
    Unwritable {
        /// folder or file
        path: PathBuf,
        /// what the system says
        error: io::Error,
    },
    /// a folder that is not a run
    #[error("{} is not a run of bedload: {reason}", folder.display())]
    NotARun {
        /// the folder
        folder: PathBuf,
        /// what is missing or wrong
        reason: String,
    },
    /// writing failed half-way: the disk is full, or worse
    #[error("writing {} failed: {error}", path.display())]
    Interrupted {
        /// the file
        path: PathBuf,
        /// what the system says
        error: io::Error,
    },
}

impl OutputError {
    /// Stable identifier, as in the answer of `--json`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotAFolder(_) => "not-a-folder",
            Self::Foreign { .. } => "foreign-folder",
            Self::OtherKind { .. } => "other-kind",
            Self::OtherComparison { .. } => "other-comparison",
            Self::OtherStudy { .. } => "other-study",
            Self::UnfinishedStudy { .. } => "unfinished-study",
            Self::OtherCase { .. } => "other-case",
            Self::Unfinished { .. } => "unfinished-run",
            Self::Unwritable { .. } => "unwritable",
            Self::NotARun { .. } => "not-a-run",
            Self::Interrupted { .. } => "write-failed",
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::NotAFolder(_) | Self::Unwritable { .. } => Some("give another folder with --out"),
            Self::Foreign { .. } => {
                Some("give another folder with --out; --force does not replace what bedload did not write")
            }
            Self::OtherKind { .. } => Some("give another folder with --out; --force replaces only its own kind"),
            Self::OtherComparison { .. } => {
                Some("give another folder with --out, or --force to replace that comparison")
            }
            Self::OtherStudy { .. } => Some("give another folder with --out, or --force to replace that study"),
            Self::UnfinishedStudy { .. } => Some("--resume to keep the points that are done, --force to start again"),
            Self::OtherCase { .. } => Some("give another folder with --out, or --force to replace that run"),
            Self::Unfinished { .. } => Some("--resume to go on, --force to start again"),
            Self::NotARun { .. } => Some("give a folder that `bedload run` wrote"),
            Self::Interrupted { .. } => {
                Some("nothing that stood there before was touched; free some space and run again")
            }
        }
    }

    /// Whether nothing was run because of it (exit code 2) or something broke on the way (exit code 1).
    #[must_use]
    pub fn is_refusal(&self) -> bool {
        !matches!(self, Self::Interrupted { .. })
    }
}

/// What may be done with a folder that is not empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mode {
    /// replace any run that bedload wrote
    pub force: bool,
    /// go on with an unfinished run of the same case
    pub resume: bool,
}

/// A folder that is being written. Dropped before [`Folder::finish`], it takes back what it wrote.
#[derive(Debug)]
pub struct Folder {
    /// where the run will be
    pub(super) target: PathBuf,
    /// where it is written: the target itself, or a folder beside it that replaces it in the end
    pub(super) place: PathBuf,
    /// what was made for it: the place, or the first of the folders above it that were not there
    made: Option<PathBuf>,
    /// whether a finished run stands in the target
    over_finished: bool,
    finished: bool,
}

impl Folder {
    /// Prepares `target` for a run of the resolved case `case`.
    ///
    /// # Errors
    /// [`OutputError`] if the folder holds anything that must not be replaced, or cannot be written.
    pub fn prepare(target: &Path, case: &str, mode: Mode) -> Result<Self, OutputError> {
        Self::claim(target, |folder| may_replace(folder, case, mode))
    }

    /// Prepares `target`, whose content `may_replace` judges where there is any; it says in what state that is.
    ///
    /// # Errors
    /// As [`Folder::prepare`].
    pub(super) fn claim(
        target: &Path,
        may_replace: impl FnOnce(&Path) -> Result<Status, OutputError>,
    ) -> Result<Self, OutputError> {
        let unwritable = |path: &Path| {
            let path = path.to_owned();
            move |error| OutputError::Unwritable { path, error }
        };
        let occupied = match fs::symlink_metadata(target) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(unwritable(target)(error)),
            Ok(_) if !target.is_dir() => return Err(OutputError::NotAFolder(target.into())),
            Ok(_) => Some(entries(target).map_err(unwritable(target))?.iter().any(|(name, _)| !is_partial(name))),
        };
        let folder = match occupied {
            None => {
                let made = target.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists()).last();
                let made = made.map(Path::to_owned);
                let folder = Self::new(target.into(), target.into(), made, false);
                fs::create_dir_all(target).map_err(unwritable(target))?;
                folder
            }
            Some(false) => Self::new(target.into(), target.into(), None, false),
            Some(true) => {
                let status = may_replace(target)?;
                let target = fs::canonicalize(target).map_err(unwritable(target))?;
                let place = beside(&target, "new");
                fs::create_dir(&place).map_err(unwritable(&place))?;
                Self::new(target, place.clone(), Some(place), status == Status::Done)
            }
        };
        // Whether files can be made here is known before anything is computed.
        let probe = folder.place.join(PROBE);
        fs::write(&probe, b"").and_then(|()| fs::remove_file(&probe)).map_err(unwritable(&folder.place))?;
        Ok(folder)
    }

    /// A folder that goes on being written where it stands: nothing is taken back.
    pub(super) fn go_on(target: &Path) -> Self {
        let mut folder = Self::new(target.into(), target.into(), None, false);
        folder.finished = true;
        folder
    }

    fn new(target: PathBuf, place: PathBuf, made: Option<PathBuf>, over_finished: bool) -> Self {
        Self { target, place, made, over_finished, finished: false }
    }

    /// Whether a finished run stands where this one will be.
    #[must_use]
    pub fn over_finished(&self) -> bool {
        self.over_finished
    }

    /// Where the run will be.
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
    pub fn finish(mut self) -> Result<(), OutputError> {
        if self.place != self.target {
            let failed = |path: &Path| {
                let path = path.to_owned();
                move |error| OutputError::Interrupted { path, error }
            };
            let old = beside(&self.target, "old");
            fs::rename(&self.target, &old).map_err(failed(&self.target))?;
            if let Err(error) = fs::rename(&self.place, &self.target) {
                let _ = fs::rename(&old, &self.target);
                return Err(failed(&self.target)(error));
            }
            // The new run is in place; what is left of the old one is only litter.
            let _ = fs::remove_dir_all(&old);
        }
        self.finished = true;
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.finished {
            return;
        }
        // Nothing can be done about a failure here, and nothing but our own files is touched.
        let Some(made) = &self.made else {
            for name in OURS.iter().chain(comparison::OURS).chain(study::OURS) {
                let path = self.place.join(name);
                let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
            }
            return;
        };
        let _ = fs::remove_dir_all(&self.place);
        for parent in self.place.ancestors().skip(1).take_while(|p| p.starts_with(made)) {
            // Only folders that are empty go.
            let _ = fs::remove_dir(parent);
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
        let mut writer = BufWriter::with_capacity(1 << 16, file);
        content(&mut writer)?;
        writer.flush()?;
        fs::rename(&partial, path)
    });
    written.map_err(|error| {
        let _ = fs::remove_file(&partial);
        OutputError::Interrupted { path: path.into(), error }
    })
}

/// A hidden name beside `path` that no other process uses.
fn beside(path: &Path, what: &str) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.{what}-{}", std::process::id()))
}

/// Whether a folder that is not empty may be replaced by a run of the resolved case `case`; the state of the run in it.
fn may_replace(folder: &Path, case: &str, mode: Mode) -> Result<Status, OutputError> {
    if comparison::stands_in(folder) {
        return Err(OutputError::OtherKind { folder: folder.into(), holds: "comparison", wanted: "run" });
    }
    if study::stands_in(folder) {
        return Err(OutputError::OtherKind { folder: folder.into(), holds: "study", wanted: "run" });
    }
    let summary = read_summary(folder)?;
    holds_only(folder, OURS)?;
    let same = fs::read_to_string(folder.join("case.toml")).is_ok_and(|text| text == case);
    if mode.force {
        return Ok(summary.status);
    }
    match (same, summary.status) {
        (true, Status::Done) => Ok(Status::Done),
        (true, status) if mode.resume => Ok(status),
        (true, status) => Err(OutputError::Unfinished { folder: folder.into(), status }),
        (false, _) => Err(OutputError::OtherCase { folder: folder.into(), case: summary.case }),
    }
}

/// Whether every entry of a folder is one of `ours`, a figure, or a file that was being written.
pub(super) fn holds_only(folder: &Path, ours: &[&str]) -> Result<(), OutputError> {
    let unwritable = |error| OutputError::Unwritable { path: folder.into(), error };
    let foreign = |entry: String| Err(OutputError::Foreign { folder: folder.into(), entry });
    for (name, is_folder) in entries(folder).map_err(unwritable)? {
        if is_folder != [FIGURES, study::POINTS].contains(&name.as_str())
            || !(ours.contains(&name.as_str()) || is_partial(&name) || is_frame(&name))
        {
            return foreign(name);
        }
    }
    for (name, is_folder) in entries(&folder.join(FIGURES)).unwrap_or_default() {
        if is_folder || !(name.ends_with(".png") || is_partial(&name)) {
            return foreign(format!("{FIGURES}/{name}"));
        }
    }
    Ok(())
}

/// Name of each entry of a folder, and whether it is a folder.
pub(super) fn entries(folder: &Path) -> io::Result<Vec<(String, bool)>> {
    fs::read_dir(folder)?
        .map(|entry| {
            let entry = entry?;
            Ok((entry.file_name().to_string_lossy().into_owned(), entry.file_type()?.is_dir()))
        })
        .collect()
}
