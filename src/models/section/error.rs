//! What can be wrong with a flow through a section: its case, and its solution.

use crate::case::CaseFault;
use crate::result::{Class, MethodError, codes};

/// Outlines and methods of a section that do not go together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SectionFault {
    /// A width where the outline has none.
    #[error("only a rectangle has a width")]
    NoWidth,
    /// A section that is much wider than high, or the reverse.
    #[error("the width is {ratio} times the height: a section takes {low} to {high}")]
    Slender {
        /// width over height
        ratio: f64,
        /// smallest
        low: f64,
        /// largest
        high: f64,
    },
    /// The first-order method with a regularisation.
    #[error("the first-order method has the exact yield only")]
    DualIsExact,
    /// The whole duct for a model that has only its section.
    #[error("the whole duct has one velocity, walls on all sides and Newton's method only")]
    NotWhole,
}

codes!(SectionFault {
    Self::NoWidth => "no-width",
    Self::Slender { .. } => "slender",
    Self::DualIsExact => "dual-is-exact",
    Self::NotWhole => "not-whole",
});

impl CaseFault for SectionFault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        match self {
            Self::Slender { low, high, .. } => Some(format!("{low} to {high} heights")),
            Self::DualIsExact => Some("newton; first-order with regularisation.law = \"none\"".into()),
            Self::NoWidth | Self::NotWhole => None,
        }
    }

    fn hint(&self) -> Option<String> {
        match self {
            Self::NoWidth => Some("remove it, or set flow.section.shape = \"rectangle\"".into()),
            Self::Slender { .. } => Some("shape = \"planes\" is the limit of a wide section".into()),
            Self::DualIsExact => None,
            Self::NotWhole => {
                Some("remove it: `--set grid.along=`; form = \"mixed\" and method = \"newton\" have it".into())
            }
        }
    }
}

/// Why a flow through a section was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// A convex minimum that the method does not find.
    #[error(
        "the {method} method ends {change:.3e} (relative) from its goal after {iterations} iterations, at lambda = {lambda_1_s:.3e} 1/s"
    )]
    NotConverged {
        /// the method
        method: &'static str,
        /// last relative change of the velocity, or duality gap
        change: f64,
        /// iterations made
        iterations: usize,
        /// smoothing of the yield stress [1/s]
        lambda_1_s: f64,
    },
}

codes!(SectionError {
    Self::NotConverged { .. } => "unsettled",
});

impl MethodError for SectionError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        Class::NotConverged
    }

    fn hint(&self) -> String {
        "take method = \"newton\", raise solver.iterations or solver.tolerance, or change grid.cells".into()
    }
}
