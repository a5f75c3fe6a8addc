//! What can be wrong with grains in a fluid: its case, and the fluid or the grains on the way.

use crate::column::ColumnError;
use crate::dem::GrainError;
use crate::result::{Class, MethodError, codes};

/// What helps grains that are thrown against each other by water without turbulence.
const THROWN: &str = "closures.mixing_length.below_packed = \"clipped\" if the bed is denser than closures.mixing_length.phi_max, for then the lowest water has no turbulence and runs away; else stiffer contacts (closures.contact.k_n) or slower grains";

/// Why the grains and their fluid cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CoupledError {
    /// The fluid cannot.
    #[error("the fluid cannot go on: {0}")]
    Fluid(#[source] ColumnError),
    /// Grains in one another, where water without turbulence may be behind it.
    #[error(transparent)]
    Thrown(GrainError),
}

codes!(CoupledError {
    Self::Fluid(_) => "fluid",
    Self::Thrown(_) => "overlap",
});

impl MethodError for CoupledError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::Fluid(_) => Class::Unphysical,
            Self::Thrown(error) => error.class(),
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::Fluid(_) => {
                "a shorter discrete.coupling_period, or more grains in a cell (cell.length, cell.width, discrete.slice)"
            }
            Self::Thrown(_) => THROWN,
        }
        .into()
    }
}
