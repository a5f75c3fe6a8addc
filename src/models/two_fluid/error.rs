//! What can be wrong with a flow of two fluids: its case, and its solution.

use crate::case::CaseFault;
use crate::result::{Class, MethodError, codes};

/// A drive of a flow of two fluids that it cannot follow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TwoFluidFault {
    /// Waves in a steady flow.
    #[error("a steady flow has no waves")]
    NeedsTime,
    /// A flow that goes on after its recorded waves.
    #[error("the waves are recorded for {record_s} s, and the flow lasts {duration_s} s")]
    RecordEnds {
        /// last moment of the record \[s]
        record_s: f64,
        /// time to follow \[s]
        duration_s: f64,
    },
}

codes!(TwoFluidFault {
    Self::NeedsTime => "needs-time",
    Self::RecordEnds { .. } => "record-ends",
});

impl CaseFault for TwoFluidFault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn hint(&self) -> Option<String> {
        match self {
            Self::NeedsTime => Some("remove the waves, or set state = \"transient\"".into()),
            Self::RecordEnds { record_s, .. } => Some(format!("set solver.duration to {record_s} s, or less")),
        }
    }
}

/// Why a flow of two fluids was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TwoFluidError {
    /// A two-fluid flow that no way of the method leads to.
    #[error(
        "no steady flow was found at a Shields number of {shields:.4}: the smallest residual is {residual:.3e} after {iterations} iterations"
    )]
    NoSteadyFlow {
        /// smallest residual of the steady equations
        residual: f64,
        /// iterations made, of all ways
        iterations: usize,
        /// nominal Shields number
        shields: f64,
    },
    /// A flow in time that cannot go on.
    #[error(
        "stuck at t = {time_s:.6} s: no step is short enough, the last one was {step_s:.3e} s with the residual {residual:.3e}"
    )]
    StuckInTime {
        /// simulated time \[s]
        time_s: f64,
        /// last step \[s]
        step_s: f64,
        /// residual of the step, or its error
        residual: f64,
    },
}

codes!(TwoFluidError {
    Self::NoSteadyFlow { .. } => "no-steady-flow",
    Self::StuckInTime { .. } => "stuck-in-time",
});

impl MethodError for TwoFluidError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        Class::NotConverged
    }

    fn hint(&self) -> String {
        match self {
            Self::NoSteadyFlow { .. } => {
                "follow it in time (state = \"transient\"): near the threshold of motion the flow may have no steady state"
            }
            Self::StuckInTime { .. } => {
                "the flow until then is kept; take more cells (grid.cells) or a larger solver.tolerance"
            }
        }
        .into()
    }
}
