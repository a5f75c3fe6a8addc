//! Why a method failed, with the numbers that say so, and the last good state.

use std::error::Error;
use std::fmt;
use std::sync::Arc;

use super::{Class, Outcome, TableError, codes};

/// Why a method failed. A model has its own errors; those that any method can have are in [`NumericalError`].
pub trait MethodError: Error + Send + Sync + 'static {
    /// Stable identifier of the kind of failure, as in `summary.json`.
    fn code(&self) -> &'static str;

    /// What it says of the method: not converged, diverged, unphysical or refused.
    fn class(&self) -> Class;

    /// What a user can change.
    fn hint(&self) -> String;
}

/// An error of any method: its message, code, class and hint, and by [`SolveError::downcast_ref`] its type and numbers.
#[derive(Clone, Debug)]
pub struct SolveError(Arc<dyn MethodError>);

impl SolveError {
    /// An iteration that ended with a relative residual, which is no number where its scale left the range of them.
    #[must_use]
    pub fn not_converged(residual: f64, iterations: usize) -> Self {
        if residual.is_finite() {
            NumericalError::NotConverged { residual, iterations }.into()
        } else {
            NumericalError::NotRepresentable { name: "the residual".into() }.into()
        }
    }

    /// Stable identifier of the kind of failure, as in `summary.json`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        self.0.code()
    }

    /// What it says of the method.
    #[must_use]
    pub fn class(&self) -> Class {
        self.0.class()
    }

    /// What a user can change.
    #[must_use]
    pub fn hint(&self) -> String {
        self.0.hint()
    }

    /// The error as it was made, if it is a `T`.
    #[must_use]
    pub fn downcast_ref<T: MethodError>(&self) -> Option<&T> {
        let error: &(dyn Error + 'static) = self.0.as_ref();
        error.downcast_ref()
    }
}

impl fmt::Display for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Error for SolveError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.source()
    }
}

impl<T: MethodError> From<T> for SolveError {
    fn from(error: T) -> Self {
        Self(Arc::new(error))
    }
}

/// What can happen to any method: to its iteration, to its numbers, and to the balances of its result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NumericalError {
    /// A scalar equation whose root was not found.
    #[error(
        "the root of {equation} was not found after {iterations} iterations: residual {residual:.3e} between {low:.6e} and {high:.6e}"
    )]
    NoRoot {
        /// the equation
        equation: &'static str,
        /// evaluations made
        iterations: usize,
        /// last relative residual
        residual: f64,
        /// lower end of the bracket
        low: f64,
        /// upper end of the bracket
        high: f64,
    },
    /// An iteration that does not reach round-off.
    #[error("not converged: the relative residual is {residual:.3e} after {iterations} iterations")]
    NotConverged {
        /// relative residual
        residual: f64,
        /// iterations made
        iterations: usize,
    },
    /// A result that is not a finite number.
    #[error("{column} is not finite in row {row}")]
    NotFinite {
        /// column name
        column: &'static str,
        /// row, from 0
        row: usize,
    },
    /// A number or a balance that leaves the range of floating-point numbers.
    #[error("{name} cannot be computed: a number on the way is larger or smaller than any that the machine has")]
    NotRepresentable {
        /// result, balance or variable
        name: String,
    },
    /// A global balance that does not close.
    #[error(
        "the balance {balance} is off by {relative:.3e} of its scale, more than {limit:.0e}: the numbers cannot be trusted"
    )]
    Unbalanced {
        /// what is balanced
        balance: String,
        /// relative residual
        relative: f64,
        /// largest accepted magnitude
        limit: f64,
    },
    /// A steady drive, and a fluid that flows against it.
    #[error("the fluid flows uphill: its mean velocity is {velocity_m_s:.4} m/s, against the drive{}", when(*.over_s))]
    FlowsUphill {
        /// mean velocity of the fluid, negative [m/s]
        velocity_m_s: f64,
        /// time over which it is the mean \[s]; `None` for a steady flow
        over_s: Option<[f64; 2]>,
        /// what a user can change
        hint: &'static str,
    },
    /// Columns of unequal length: a defect of the program.
    #[error("{column} has the wrong number of rows")]
    Inconsistent {
        /// column name
        column: &'static str,
    },
}

codes!(NumericalError {
    Self::NoRoot { .. } => "no-root",
    Self::NotConverged { .. } => "not-converged",
    Self::NotFinite { .. } => "not-finite",
    Self::NotRepresentable { .. } => "not-representable",
    Self::Unbalanced { .. } => "unbalanced",
    Self::FlowsUphill { .. } => "flows-uphill",
    Self::Inconsistent { .. } => "inconsistent",
});

impl MethodError for NumericalError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::NoRoot { .. } | Self::NotConverged { .. } => Class::NotConverged,
            Self::NotFinite { .. } => Class::Diverged,
            Self::NotRepresentable { .. }
            | Self::Unbalanced { .. }
            | Self::FlowsUphill { .. }
            | Self::Inconsistent { .. } => Class::Unphysical,
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::NotFinite { .. } | Self::NotRepresentable { .. } | Self::Unbalanced { .. } => {
                "a value of the case is far from those of any flow: case.toml has all of them in SI"
            }
            Self::FlowsUphill { hint, .. } => hint,
            Self::NoRoot { .. } | Self::NotConverged { .. } | Self::Inconsistent { .. } => {
                "the solver gave up on a case that was checked: please report it with case.toml"
            }
        }
        .into()
    }
}

fn when(over: Option<[f64; 2]>) -> String {
    let Some([from, to]) = over else { return String::new() };
    if from < to { format!(", from t = {from:.4} s to {to:.4} s") } else { format!(", at t = {to:.4} s") }
}

impl From<TableError> for SolveError {
    fn from(error: TableError) -> Self {
        match error {
            TableError::NotFinite { column, row } => NumericalError::NotFinite { column, row },
            TableError::Length { column, .. } => NumericalError::Inconsistent { column },
            _ => NumericalError::Inconsistent { column: "table" },
        }
        .into()
    }
}

/// A failed run: the reason, and the last good state if there is one.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{error}")]
pub struct Failure {
    /// where, when and with what values
    pub error: SolveError,
    /// what was computed before
    pub last: Option<Box<Outcome>>,
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        Self { error, last: None }
    }
}

impl<T: MethodError> From<T> for Failure {
    fn from(error: T) -> Self {
        SolveError::from(error).into()
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        SolveError::from(error).into()
    }
}
