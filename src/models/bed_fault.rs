//! What can be wrong with a bed of grains and the flow over it: faults that several models find.

use crate::case::CaseFault;
use crate::result::codes;

/// Values of a bed, its grains and the flow over it that do not go together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BedFault {
    /// No fluid over the bed.
    #[error("the flow has no depth over the bed")]
    NoDepth,
    /// Grains that float.
    #[error("the grains ({grains} kg/m3) are not denser than the fluid ({fluid} kg/m3): no bed")]
    Floating {
        /// density of the grains
        grains: f64,
        /// density of the fluid
        fluid: f64,
    },
    /// A bed thinner than its grains.
    #[error("the bed is {level} m thick, less than one grain of {diameter} m")]
    ThinnerThanAGrain {
        /// bed level \[m]
        level: f64,
        /// grain diameter \[m]
        diameter: f64,
    },
    /// mu_2 below mu_s.
    #[error("mu_2 = {mu_2} is not more than mu_s = {mu_s}")]
    FrictionFalls {
        /// friction at vanishing inertial number
        mu_s: f64,
        /// friction at large inertial number
        mu_2: f64,
    },
    /// A number of grains, or a room for them, that no run could hold.
    #[error("{name} is {value:.6}, which is not from {least:.6} to {most:.6}")]
    GrainRoom {
        /// what it is
        name: &'static str,
        /// as it follows from the case
        value: f64,
        /// smallest value
        least: f64,
        /// largest value
        most: f64,
    },
}

/// Depth over the thickness of the bed below which the height of both does not hold the flow.
const SHALLOWEST: f64 = 1e-9;

impl BedFault {
    /// That the flow has no depth, if it has none beyond the round-off of its height.
    #[must_use]
    pub fn no_depth(depth: f64, thickness: f64) -> Option<Self> {
        (depth <= SHALLOWEST * thickness).then_some(Self::NoDepth)
    }
}

codes!(BedFault {
    Self::NoDepth => "no-depth",
    Self::Floating { .. } => "floating-grains",
    Self::ThinnerThanAGrain { .. } => "thinner-than-a-grain",
    Self::FrictionFalls { .. } => "friction-falls",
    Self::GrainRoom { .. } => "grain-room",
});

impl CaseFault for BedFault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        match self {
            Self::NoDepth => Some(format!("more than {SHALLOWEST:e} of the thickness of the bed")),
            Self::Floating { fluid, .. } => Some(format!("more than {fluid} kg/m3")),
            Self::ThinnerThanAGrain { diameter, .. } => Some(format!("at least {diameter} m")),
            Self::FrictionFalls { mu_s, .. } => Some(format!("more than {mu_s}")),
            Self::GrainRoom { .. } => None,
        }
    }

    fn hint(&self) -> Option<String> {
        match self {
            Self::Floating { .. } => Some("grains.density must exceed fluid.density".into()),
            _ => None,
        }
    }
}
