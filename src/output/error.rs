//! Why an output is refused, or broke on the way.

use std::io;
use std::path::PathBuf;

use crate::result::Status;

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
    /// a file where a table should be
    #[error("{} was not written by bedload", .0.display())]
    ForeignFile(PathBuf),
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
            Self::ForeignFile(_) => "foreign-file",
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
            Self::NotAFolder(_) | Self::Unwritable { .. } => Some("give another place with --out"),
            Self::Foreign { .. } => {
                Some("give another folder with --out; --force does not replace what bedload did not write")
            }
            Self::ForeignFile(_) => Some("give another file with --out, or move that one away"),
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
