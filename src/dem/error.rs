//! Why a step of the grains cannot be taken: with the grain, the step and the place.

use std::io;

use super::grains::Point;
use crate::closures::contact::restitution::RestitutionError;
use crate::result::{CheckpointError, Class, MethodError, codes};

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

codes!(GrainError {
    Self::Overlap { .. } => "overlap",
    Self::NotFinite { .. } => "not-finite",
    Self::Lost { .. } => "grain-lost",
    Self::StepTooLong { .. } | Self::DragStep { .. } | Self::FluidStep { .. } => "step-too-long",
    Self::PeriodTooShort { .. } => "period-too-short",
    Self::Count { .. } => "grain-count",
});

impl MethodError for GrainError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::Overlap { .. } | Self::NotFinite { .. } | Self::Lost { .. } => Class::Diverged,
            Self::StepTooLong { .. }
            | Self::DragStep { .. }
            | Self::FluidStep { .. }
            | Self::PeriodTooShort { .. }
            | Self::Count { .. } => Class::Refused,
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::Overlap { .. } => "stiffer contacts (closures.contact.k_n) or slower grains",
            Self::NotFinite { .. } => "a shorter time step, or values nearer to those of grains",
            Self::Lost { .. } => "a bottom without gaps: bottom = \"plane\" or more layers of fixed grains",
            Self::StepTooLong { .. } | Self::DragStep { .. } => {
                "a shorter discrete.time_step, or discrete.force_time_step = true"
            }
            Self::FluidStep { .. } => {
                "discrete.fluid_scheme = \"implicit\", more discrete.fluid_steps or a shorter discrete.coupling_period"
            }
            Self::PeriodTooShort { .. } => "a longer cell.length or cell.width",
            Self::Count { .. } => "another number of layers, cell.length or cell.width",
        }
        .into()
    }
}

/// Why a run of grains cannot begin, or cannot keep its states.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// No damping of the contact gives its restitution coefficient.
    #[error(transparent)]
    Restitution(RestitutionError),
    /// A checkpoint that cannot be used.
    #[error("the checkpoint cannot be used: {0}")]
    Checkpoint(#[source] CheckpointError),
    /// A checkpoint or a frame that cannot be written.
    #[error("a file of the grains cannot be written: {0}")]
    File(#[source] io::Error),
}

codes!(RunError {
    Self::Restitution(_) => "restitution",
    Self::Checkpoint(_) => "checkpoint",
    Self::File(_) => "file",
});

impl MethodError for RunError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        Class::Unphysical
    }

    fn hint(&self) -> String {
        match self {
            Self::Restitution(_) => "a restitution coefficient (grains.restitution) in (0, 1]",
            Self::Checkpoint(_) => "--force starts again",
            Self::File(_) => "free some space, or give another folder with --out",
        }
        .into()
    }
}

fn partner(other: Option<u32>) -> String {
    other.map_or_else(|| "a wall ".into(), |id| format!("grain {id} "))
}
