//! Why no steady flow leaves a part of its bed at rest: what several models find.

use super::exact::bed::LaminarBed;
use crate::result::{Class, MethodError, SolveError, codes};

/// Why there is no steady flow over a bed at rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BedError {
    /// The grains yield down to the bottom, which the model cannot hold.
    #[error(
        "the whole bed moves: the mobile layer would be {mobile_depth_m:.6} m deep where the bed is {bed_m:.6} m (z = 0 is reached)"
    )]
    WholeBedMoves {
        /// depth to which the grains would move \[m]
        mobile_depth_m: f64,
        /// thickness of the bed \[m]
        bed_m: f64,
        /// largest drive with a static layer [Pa/m]
        limit_pa_m: f64,
    },
    /// The drive exceeds the friction at every depth.
    #[error(
        "no part of the bed can stay at rest: the drive is {drive:.6} of the submerged weight, friction holds less than {limit:.6}"
    )]
    NoStaticBed {
        /// dimensionless drive f = -dp/dx/((rho_p - rho_f) g)
        drive: f64,
        /// mu_s phi
        limit: f64,
    },
    /// A wanted value that no drive gives.
    #[error("no drive gives {quantity} = {wanted:.6}: with a static bed it stays below {largest:.6}")]
    OutOfReach {
        /// what was asked for
        quantity: &'static str,
        /// the wanted value
        wanted: f64,
        /// largest value that the model reaches
        largest: f64,
    },
}

codes!(BedError {
    Self::WholeBedMoves { .. } => "whole-bed-moves",
    Self::NoStaticBed { .. } => "no-static-bed",
    Self::OutOfReach { .. } => "out-of-reach",
});

impl MethodError for BedError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        Class::Unphysical
    }

    fn hint(&self) -> String {
        match self {
            Self::WholeBedMoves { limit_pa_m, .. } => {
                format!("drive it with less than {limit_pa_m:.4} Pa/m, or make the bed deeper (bed.thickness)")
            }
            Self::NoStaticBed { .. } => "lower the drive, or raise mu_s or phi".into(),
            Self::OutOfReach { .. } => "ask for less, raise mu_s, or leave more room above the bed".into(),
        }
    }
}

/// An error of a laminar bed that was solved in units of its height and of the weight of its grains, in SI.
pub(super) fn in_si(error: SolveError, bed: &LaminarBed) -> SolveError {
    match error.downcast_ref() {
        Some(BedError::WholeBedMoves { mobile_depth_m, bed_m, limit_pa_m }) => BedError::WholeBedMoves {
            mobile_depth_m: mobile_depth_m * bed.h,
            bed_m: bed_m * bed.h,
            limit_pa_m: limit_pa_m * (bed.rho_p - bed.rho_f) * bed.g,
        }
        .into(),
        _ => error,
    }
}
