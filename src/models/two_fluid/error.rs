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
    /// A slope on which no bed of the grains rests, however thick.
    #[error(
        "the whole bed slides: no bed of these grains rests on a slope of {slope_deg:.2} deg, and the thicker it is, the more it would carry; with a friction of {friction:.4} at rest they rest on up to {steepest_deg:.2} deg where the bed is deep, and on up to {here_deg:.2} deg at this thickness under this depth"
    )]
    NothingAtRest {
        /// the slope \[deg]
        slope_deg: f64,
        /// the slope on which a deep bed is about to slide \[deg]
        steepest_deg: f64,
        /// that on which one of this thickness is, under this depth \[deg]
        here_deg: f64,
        /// friction of grains at rest
        friction: f64,
    },
    /// Equations that are solved but for a force that is left.
    #[error(
        "no steady flow was found at a Shields number of {shields:.4}: the velocities no longer change, but in a cell the stresses miss balance by {stress_pa:.3e} Pa, more than the {allowed_pa:.3e} Pa that round-off may leave, after {iterations} iterations"
    )]
    Unbalanced {
        /// largest stress that a cell misses \[Pa]
        stress_pa: f64,
        /// largest one that it may \[Pa]
        allowed_pa: f64,
        /// iterations made, of all ways
        iterations: usize,
        /// nominal Shields number
        shields: f64,
    },
    /// A march in pseudo-time that does not come to rest.
    #[error(
        "no steady flow was found at a Shields number of {shields:.4}: followed in pseudo-time, the flow does not settle; its last step was {step_s:.3e} s after {iterations} iterations"
    )]
    DoesNotSettle {
        /// last step of pseudo-time \[s]
        step_s: f64,
        /// iterations made, of all ways
        iterations: usize,
        /// nominal Shields number
        shields: f64,
        /// whether it is near the threshold of motion, where flows burst
        weak: bool,
    },
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
        /// whether it is near the threshold of motion, where flows burst
        weak: bool,
    },
    /// A flow in time that cannot go on.
    #[error(
        "stuck at t = {time_s:.6} s: no step is short enough; on the last one of {step_s:.3e} s {} {residual:.3e}",
        if *newton { "Newton's method did not converge, with the smallest residual" } else { "the error stayed above solver.tolerance, at" }
    )]
    StuckInTime {
        /// simulated time \[s]
        time_s: f64,
        /// last step \[s]
        step_s: f64,
        /// residual of the step, or its error
        residual: f64,
        /// whether Newton's method failed; else the error of the step is too large
        newton: bool,
    },
}

codes!(TwoFluidError {
    Self::NothingAtRest { .. } => "nothing-at-rest",
    Self::Unbalanced { .. } => "forces-left",
    Self::DoesNotSettle { .. } => "does-not-settle",
    Self::NoSteadyFlow { .. } => "no-steady-flow",
    Self::StuckInTime { .. } => "stuck-in-time",
});

impl MethodError for TwoFluidError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::NothingAtRest { .. } => Class::Unphysical,
            _ => Class::NotConverged,
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::NothingAtRest { .. } => "lower the slope, or take grains with more friction (grains.friction)",
            Self::Unbalanced { .. } => "fewer or coarser cells (grid.cells, grid.fine), or a larger regularisation.shear_rate",
            // Where flows are weak they are unstable and burst (docs/kinetic.md).
            Self::NoSteadyFlow { weak: true, .. } | Self::DoesNotSettle { weak: true, .. } => {
                "follow it in time (state = \"transient\"): near the threshold of motion the flow may have no steady state"
            }
            Self::NoSteadyFlow { .. } | Self::DoesNotSettle { .. } => {
                "other cells (grid.cells), or follow it in time (state = \"transient\")"
            }
            Self::StuckInTime { newton: true, .. } => {
                "the flow until then is kept; take other cells (grid.cells, grid.fine) or a larger regularisation.shear_rate"
            }
            Self::StuckInTime { .. } => "the flow until then is kept; take a larger solver.tolerance, or more grid.cells",
        }
        .into()
    }
}
