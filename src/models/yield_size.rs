//! The one size of a regularisation of the yield, as the models with a yield stress take it.

use crate::case::Fault;
use crate::case::tables::RegularisationTable;
use crate::closures::regularisation::Smoothing;
use crate::model::Faults;

/// The size of a regularisation, as it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Size {
    /// [1/s]
    Rate(f64),
    /// in the unit of the model
    Scaled(f64),
}

impl Size {
    /// In units of the shear rate `unit` [1/s].
    pub(super) fn to_scaled(self, unit: f64) -> f64 {
        match self {
            Self::Rate(lambda) => lambda / unit,
            Self::Scaled(lambda) => lambda,
        }
    }
}

/// The one size that a law needs; 0 for the exact yield.
pub(super) fn size(table: &RegularisationTable, faults: &mut Faults) -> Option<Size> {
    match (table.law, table.lambda, table.lambda_scaled) {
        (Smoothing::None, None, None) => Some(Size::Scaled(0.0)),
        (Smoothing::Simple | Smoothing::BercovierEngelman | Smoothing::Papanastasiou, Some(lambda), None) => {
            Some(Size::Rate(lambda))
        }
        (Smoothing::Simple | Smoothing::BercovierEngelman | Smoothing::Papanastasiou, None, Some(lambda)) => {
            Some(Size::Scaled(lambda))
        }
        (law, a, b) => {
            let given = usize::from(a.is_some()) + usize::from(b.is_some());
            faults.push(("regularisation", Fault::RegularisationSize { given, exact: law == Smoothing::None }));
            None
        }
    }
}
