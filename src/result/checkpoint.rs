//! The state of an unfinished run, from which it goes on.

/// Why a checkpoint cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// not one at all
    #[error("it is not a checkpoint of bedload")]
    Foreign,
    /// another layout
    #[error("it has version {found}, this program reads version {reads}")]
    Version {
        /// its version
        found: u32,
        /// the version that this program reads
        reads: u32,
    },
    /// another case
    #[error("it belongs to another case")]
    OtherCase,
    /// shorter than it says
    #[error("it is truncated: {found} bytes of {expected}")]
    Truncated {
        /// bytes there are
        found: usize,
        /// bytes there should be
        expected: usize,
    },
    /// damaged
    #[error("it is corrupt: {what}")]
    Corrupt {
        /// what does not fit
        what: &'static str,
    },
}
