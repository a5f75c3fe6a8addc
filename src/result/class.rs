//! What comes of a method, in the classes of a map of stability.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What comes of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// Solved, and as accurate as wanted where a closed form says.
    Holds,
    /// Solved, and further from the closed form than the tolerance.
    Inaccurate,
    /// The iteration ends without a solution.
    NotConverged,
    /// A number leaves the range of numbers, or a grain its place.
    Diverged,
    /// The equations have no such flow, or the answer does not balance.
    Unphysical,
    /// Refused: before it is run, or by a limit that the method knows of itself.
    Refused,
}

impl Class {
    /// All of them, in the order of the figures.
    pub const ALL: [Self; 6] =
        [Self::Holds, Self::Inaccurate, Self::NotConverged, Self::Diverged, Self::Unphysical, Self::Refused];

    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Inaccurate => "holds, but inaccurate",
            Self::NotConverged => "not converged",
            Self::Diverged => "diverged",
            Self::Unphysical => "unphysical",
            Self::Refused => "refused",
        }
    }
}
