//! Why an output is refused, or broke on the way.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use super::word::word;
use crate::result::{Status, codes};

/// The process that writes an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Holder {
    /// its number
    pub pid: u32,
    /// when it began, UTC
    pub since: String,
}

/// What is finished of an output that broke on the way, and stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Finished {
    /// the state from which a run goes on
    Checkpoint,
    /// so many points of a study
    Points(usize),
    /// all of it, but not where it should be
    Whole,
}

impl fmt::Display for Finished {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Checkpoint => to.write_str("the last checkpoint"),
            Self::Points(1) => to.write_str("1 finished point"),
            Self::Points(n) => write!(to, "{n} finished points"),
            Self::Whole => to.write_str("the complete result"),
        }
    }
}

/// Why a folder cannot be used or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// another process writes it
    #[error("{} is in use: {}", path.display(), who(holder.as_ref()))]
    InUse {
        /// folder or file
        path: PathBuf,
        /// that process, if it has said so
        holder: Option<Holder>,
    },
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
    /// a run of a case of format 1
    #[error("{} holds a run of a case of format 1, which no case of this program is", .0.display())]
    OldFormat(PathBuf),
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
        #[source]
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
    /// the same, and what was finished stays
    #[error("{error}; {} keeps {what}", folder.display())]
    Kept {
        /// what failed
        #[source]
        error: Box<Self>,
        /// where it stays
        folder: PathBuf,
        /// what stays
        what: Finished,
        /// what was to be replaced by it and still stands there
        untouched: Option<PathBuf>,
    },
    /// writing failed half-way: the disk is full, or worse
    #[error("writing {} failed: {error}", path.display())]
    Interrupted {
        /// the file
        path: PathBuf,
        /// what the system says
        #[source]
        error: io::Error,
    },
}

codes!(OutputError {
    Self::InUse { .. } => "in-use",
    Self::NotAFolder(_) => "not-a-folder",
    Self::Foreign { .. } => "foreign-folder",
    Self::ForeignFile(_) => "foreign-file",
    Self::OtherKind { .. } => "other-kind",
    Self::OtherComparison { .. } => "other-comparison",
    Self::OtherStudy { .. } => "other-study",
    Self::UnfinishedStudy { .. } => "unfinished-study",
    Self::OtherCase { .. } => "other-case",
    Self::OldFormat(_) => "old-run",
    Self::Unfinished { .. } => "unfinished-run",
    Self::Unwritable { .. } => "unwritable",
    Self::NotARun { .. } => "not-a-run",
    Self::Interrupted { .. } | Self::Kept { .. } => "write-failed",
});

impl OutputError {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Kept { folder, what, untouched, .. } => return Some(how_to_go_on(folder, *what, untouched.as_ref())),
            Self::InUse { .. } => "wait until it is done, or give another place with --out; --force does not help",
            Self::NotAFolder(_) | Self::Unwritable { .. } => "give another place with --out",
            Self::Foreign { .. } => {
                "give another folder with --out; --force does not replace what bedload did not write"
            }
            Self::ForeignFile(_) => "give another place with --out, or move that file away",
            Self::OtherKind { .. } => "give another folder with --out; --force replaces only its own kind",
            Self::OtherComparison { .. } => "give another folder with --out, or --force to replace that comparison",
            Self::OtherStudy { .. } => "give another folder with --out, or --force to replace that study",
            Self::UnfinishedStudy { .. } => "--resume to keep the points that are done, --force to start again",
            Self::OtherCase { .. } => "give another folder with --out, or --force to replace that run",
            Self::OldFormat(_) => {
                "it cannot be gone on with: give another folder with --out, or --force to replace it; report and compare read it"
            }
            Self::Unfinished { .. } => "--resume to go on, --force to start again",
            Self::NotARun { .. } => "give a folder that `bedload run` wrote",
            Self::Interrupted { .. } => "nothing that stood there before was touched; free some space and run again",
        };
        Some(hint.into())
    }

    /// Whether nothing was run because of it (exit code 2) or something broke on the way (exit code 1).
    #[must_use]
    pub fn is_refusal(&self) -> bool {
        !matches!(self, Self::Interrupted { .. } | Self::Kept { .. })
    }
}

fn who(holder: Option<&Holder>) -> String {
    match holder {
        Some(Holder { pid, since }) => format!("process {pid} has been writing it since {since}"),
        None => "another process is writing it".into(),
    }
}

fn how_to_go_on(folder: &Path, what: Finished, untouched: Option<&PathBuf>) -> String {
    let untouched = untouched.map(|target| format!("{} is as it was; ", target.display())).unwrap_or_default();
    match what {
        Finished::Whole => format!("{untouched}move that folder to where it should be"),
        _ if untouched.is_empty() => "free some space and go on with --resume".into(),
        _ => {
            format!("{untouched}free some space and go on with --out {} --resume", word(&folder.display().to_string()))
        }
    }
}
