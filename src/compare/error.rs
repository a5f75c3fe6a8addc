//! Why flows cannot be compared.

use super::DataError;
use crate::result::quantity::{self, Quantity};
use crate::result::{Results, Status, TableError, codes};

/// Why there is nothing to compare, or not like this.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// a profile CSV that cannot be used
    #[error(transparent)]
    Data(#[from] DataError),
    /// fewer than two
    #[error("a comparison takes at least two, {given} given{}", of(models))]
    TooFew {
        /// how many were given
        given: usize,
        /// models of the case that was given, where those are several
        models: Vec<String>,
    },
    /// a run that is not done
    #[error("{subject} is {status}, not done")]
    NotDone {
        /// the run
        subject: String,
        /// its state
        status: Status,
    },
    /// a run without a profile
    #[error("{subject} has no profile{}", reason.as_ref().map_or_else(String::new, |reason| format!(": {reason}")))]
    NoProfile {
        /// the run
        subject: String,
        /// why, where it says
        reason: Option<String>,
    },
    /// a number by which the frame is defined
    #[error("{subject} does not report {}, which {needed_by} needs", quantity.name)]
    NoNumber {
        /// which one
        subject: String,
        /// the number
        quantity: &'static Quantity,
        /// the option that needs it
        needed_by: &'static str,
    },
    /// a scale that a shared column needs
    #[error("{subject} does not have {missing}, by which --scale divides {column}")]
    NoScale {
        /// which one
        subject: String,
        /// the column
        column: &'static str,
        /// the scale
        missing: &'static str,
    },
    /// a value that overflows when it is divided
    #[error("{subject}: {error}")]
    NotFinite {
        /// which one
        subject: String,
        /// column and row
        #[source]
        error: TableError,
    },
    /// flows that have nothing to do with each other
    #[error("{other} is a scene of the kind {other_kind}, {reference} one of the kind {kind}")]
    DifferentKinds {
        /// the first
        reference: String,
        /// its kind
        kind: String,
        /// the other
        other: String,
        /// its kind
        other_kind: String,
    },
    /// neither a column at common elevations nor a number
    #[error("{reference} shares no column at a common elevation and no number with any other")]
    NothingShared {
        /// the reference
        reference: String,
    },
}

codes!(CompareError {
    Self::TooFew { .. } => "too-few",
    Self::NotDone { .. } => "not-done",
    Self::NoProfile { .. } => "no-profile",
    Self::NoNumber { .. } => "no-number",
    Self::NoScale { .. } => "no-scale",
    Self::NotFinite { .. } => "not-finite",
    Self::DifferentKinds { .. } => "different-kinds",
    Self::NothingShared { .. } => "nothing-shared",
} nested {
    Self::Data(error) => error.fault.code(),
});

/// Why there is no transport rate.
pub(super) fn no_rate(results: &Results) -> Option<String> {
    results.reason(quantity::TRANSPORT_RATE.name).map(str::to_owned)
}

/// That a case has several models.
fn of(models: &[String]) -> String {
    if models.len() > 1 { format!(": a case of {}", models.join(", ")) } else { String::new() }
}

impl CompareError {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Data(error) => error.fault.hint(),
            Self::TooFew { models, .. } if models.len() > 1 => {
                let models: Vec<String> = models.iter().map(|model| format!("--model {model}")).collect();
                format!("add {}", models.join(" "))
            }
            Self::TooFew { .. } => "name two cases or run folders, or one and a profile with --data FILE.csv".into(),
            Self::NotDone { .. } => "finish it with `bedload run`, or compare its case".into(),
            Self::NoProfile { reason: Some(_), .. } => "compare flows that move a layer, or take another model".into(),
            Self::NoProfile { .. } => "run its case again".into(),
            Self::NoNumber { quantity, needed_by, .. } => {
                format!("leave {needed_by} out; data state it in a comment: # {} = ...", quantity.name)
            }
            Self::NoScale { .. } => "leave --scale out; data state mean_velocity_m_s in a comment".into(),
            Self::NotFinite { .. } => "check the scales".into(),
            Self::DifferentKinds { .. } => {
                "compare flows over a bed with each other, channels with channels, grains alone with grains alone"
                    .into()
            }
            Self::NothingShared { .. } => "compare profiles with common columns whose elevations overlap".into(),
        }
    }
}
