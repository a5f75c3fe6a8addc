//! Why a step of the grains cannot be taken: with the grain, the step and the place.

use super::grains::Point;
use crate::result::{Failure, SolveError};

/// Where and when something went wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// the grain, by its place in the order of the scene
    pub grain: u32,
    /// steps made
    pub step: u64,
    /// centre of the grain \[m]
    pub position: Point,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position;
        write!(f, "grain {} at ({x:.6e}, {y:.6e}, {z:.6e}) m, step {}", self.grain, self.step)
    }
}

/// Why the grains cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GrainError {
    /// Grains are pressed into each other, or through a wall.
    #[error("{place}: overlaps {}by {ratio:.3} of the sum of the radii, more than {limit}", partner(*.other))]
    Overlap {
        /// the grain
        place: Place,
        /// the other grain; none for a wall
        other: Option<u32>,
        /// overlap over the sum of the radii
        ratio: f64,
        /// largest accepted ratio
        limit: f64,
    },
    /// A position or velocity that is no number.
    #[error("{place}: its state is not finite")]
    NotFinite {
        /// the grain
        place: Place,
    },
    /// A grain that has left.
    #[error("{place}: it fell below z = {lowest:.6e} m, where nothing is")]
    Lost {
        /// the grain
        place: Place,
        /// lowest accepted elevation \[m]
        lowest: f64,
    },
    /// A time step that the contacts do not bear.
    #[error(
        "{place}: the time step {step_s:.3e} s is beyond its stability limit {limit_s:.3e} s, with {contacts} contacts"
    )]
    StepTooLong {
        /// the grain that sets the limit
        place: Place,
        /// the step \[s]
        step_s: f64,
        /// the limit \[s]
        limit_s: f64,
        /// its contacts
        contacts: usize,
    },
    /// A time step that the drag does not bear.
    #[error(
        "the time step {step_s:.3e} s is beyond 2 m/(df/du) = {limit_s:.3e} s, the stability limit of the drag on a grain"
    )]
    DragStep {
        /// the step \[s]
        step_s: f64,
        /// the limit \[s]
        limit_s: f64,
    },
    /// A step of the fluid that forward Euler does not bear.
    #[error(
        "the explicit step of the fluid {step_s:.3e} s is beyond its stability limit {limit_s:.3e} s at this velocity"
    )]
    FluidStep {
        /// the step \[s]
        step_s: f64,
        /// the limit \[s]
        limit_s: f64,
    },
    /// A period in which a grain could touch another one twice.
    #[error(
        "the period of {length:.6e} m along {axis} is not longer than {least:.6e} m: grains would meet their own images"
    )]
    PeriodTooShort {
        /// x or y
        axis: char,
        /// its length \[m]
        length: f64,
        /// least length \[m]
        least: f64,
    },
    /// More grains than the list can name, or none.
    #[error("{count} grains: the list holds 1 to {limit}")]
    Count {
        /// grains asked for
        count: usize,
        /// most that can be
        limit: usize,
    },
}

impl From<GrainError> for SolveError {
    fn from(error: GrainError) -> Self {
        let (code, hint) = match error {
            GrainError::Overlap { .. } => ("overlap", "stiffer contacts (closures.contact.k_n) or slower grains"),
            GrainError::NotFinite { .. } => ("not-finite", "a shorter time step, or values nearer to those of grains"),
            GrainError::Lost { .. } => {
                ("grain-lost", "a bottom without gaps: bed.bottom = \"plane\" or more layers of fixed grains")
            }
            GrainError::StepTooLong { .. } | GrainError::DragStep { .. } => {
                ("step-too-long", "a shorter discrete.time_step, or discrete.force_time_step = true")
            }
            GrainError::FluidStep { .. } => (
                "step-too-long",
                "discrete.fluid_scheme = \"implicit\", more discrete.fluid_steps or a shorter discrete.coupling_period",
            ),
            GrainError::PeriodTooShort { .. } => ("period-too-short", "a longer flow.length or flow.width"),
            GrainError::Count { .. } => ("grain-count", "another number of bed.layers, flow.length or flow.width"),
        };
        Self::Grains { code, message: error.to_string(), hint }
    }
}

impl From<GrainError> for Failure {
    fn from(error: GrainError) -> Self {
        SolveError::from(error).into()
    }
}

fn partner(other: Option<u32>) -> String {
    other.map_or_else(|| "a wall ".into(), |id| format!("grain {id} "))
}
