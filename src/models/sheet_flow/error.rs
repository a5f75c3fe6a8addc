//! What can be wrong with a sheet flow: its case, and its solution.

use crate::case::CaseFault;
use crate::result::{Class, MethodError, codes};

/// Laws and methods of a sheet flow that do not go together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SheetFlowFault {
    /// A law whose packing is looser than that of the bed.
    #[error("phi_max = {phi_max} of {law} must reach {bed}, that of the bed at rest (closures.dilatancy)")]
    PackedBeyond {
        /// the law
        law: &'static str,
        /// its phi_max
        phi_max: f64,
        /// that of the bed
        bed: f64,
    },
    /// The pseudo-time iteration with the exact yield.
    #[error("the iteration needs a regularisation: the viscosity of grains at rest is infinite")]
    IterationNeedsCreep,
    /// A lid that takes more than the weight of the fluid along the slope.
    #[error(
        "the lid takes {stress} Pa, and the fluid over the bed exerts {drive:.6} Pa along the slope: nothing is left to drive the bed"
    )]
    LidTakesAll {
        /// stress of the lid \[Pa]
        stress: f64,
        /// weight of the fluid along the slope, per area \[Pa]
        drive: f64,
    },
}

codes!(SheetFlowFault {
    Self::LidTakesAll { .. } => "lid-takes-all",
    Self::PackedBeyond { .. } => "packed-beyond",
    Self::IterationNeedsCreep => "iteration-needs-creep",
});

impl CaseFault for SheetFlowFault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        match self {
            Self::PackedBeyond { bed, .. } => Some(format!("at least {bed}; no below_packed = \"zero\"")),
            Self::IterationNeedsCreep => None,
            Self::LidTakesAll { drive, .. } => Some(format!("less than {drive:.6} Pa")),
        }
    }

    fn hint(&self) -> Option<String> {
        match self {
            Self::PackedBeyond { .. } => None,
            Self::LidTakesAll { .. } => Some("a smaller stress, a steeper slope or a deeper flow".into()),
            Self::IterationNeedsCreep => Some("give [regularisation] a law and a lambda, or take newton".into()),
        }
    }
}

/// Why there is no steady sheet flow over a bed at rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SheetFlowError {
    /// A bed that the flow sets in motion down to its bottom.
    #[error(
        "the whole bed moves: at a Shields number of {shields:.4} the grains yield down to the bottom of the bed, {bed_m:.6} m below its top{}",
        edge(most)
    )]
    NothingAtRest {
        /// thickness of the bed in the flow \[m]
        bed_m: f64,
        /// Shields number
        shields: f64,
        /// share of the drive at which the last grains come to rest, where that is known
        most: Option<f64>,
    },
    /// A solution of the discrete equations that is none of the flow.
    #[error(
        "only a solution with jammed grains was found: where they come to rest they carry {carried:.4} of the stress, and the viscosity of packed grains the rest"
    )]
    Jammed {
        /// share of the stress
        carried: f64,
    },
    /// A suspension that takes the bed away.
    #[error(
        "the suspension takes the bed away: it would hold {suspended_m:.6} m of solid volume, the bed has {bed_m:.6} m"
    )]
    BedSuspended {
        /// solid volume in suspension, per area \[m]
        suspended_m: f64,
        /// solid volume of the bed at rest, per area \[m]
        bed_m: f64,
    },
    /// A bed whose loosening feeds itself.
    #[error(
        "no level of the bed holds its grains: from {rest_m:.6} m at rest it was raised to {reached_m:.6} m, where nothing stays at rest; a looser bed leaves a thinner, steeper flow, which loosens it more"
    )]
    BedRunsAway {
        /// bed level at rest \[m]
        rest_m: f64,
        /// level up to which it was raised \[m]
        reached_m: f64,
    },
    /// A lid that would have to drive the flow.
    #[error("the lid would have to push: its stress comes out as {stress_pa:.6} Pa against the flow, less than none")]
    LidPushes {
        /// stress that the lid takes from the fluid \[Pa]
        stress_pa: f64,
    },
    /// Equations that are not those of a boundary value problem right under the interface.
    #[error(
        "the equations change type down to {depth_m:.3e} m of grains under the interface; the buoyancy of the viscous stress is left out in {cut_m:.3e} m alone"
    )]
    ChangeOfType {
        /// solid volume per area under the interface down to which they do \[m]
        depth_m: f64,
        /// that in which the term is left out \[m]
        cut_m: f64,
    },
}

/// Up to where a bed rests.
fn edge(most: &Option<f64>) -> String {
    most.map_or_else(String::new, |most| {
        format!("; its lowest grains rest up to {most:.4} times this drive (slope or stress)")
    })
}

codes!(SheetFlowError {
    Self::NothingAtRest { .. } => "nothing-at-rest",
    Self::Jammed { .. } => "locked",
    Self::BedSuspended { .. } => "bed-suspended",
    Self::BedRunsAway { .. } => "bed-runs-away",
    Self::LidPushes { .. } => "lid-pushes",
    Self::ChangeOfType { .. } => "change-of-type",
});

impl MethodError for SheetFlowError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::Jammed { .. } => Class::NotConverged,
            Self::ChangeOfType { .. } => Class::Refused,
            Self::NothingAtRest { .. }
            | Self::BedSuspended { .. }
            | Self::BedRunsAway { .. }
            | Self::LidPushes { .. } => Class::Unphysical,
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::NothingAtRest { .. } => "lower the drive or the slope, or make the bed deeper (bed.thickness)",
            Self::Jammed { .. } => {
                "raise the Shields number: hardly a grain moves; or lower it, if the bed is about to move as a whole"
            }
            Self::BedSuspended { .. } => {
                "lower the drive, make the bed deeper (bed.thickness), or take grains that settle faster"
            }
            Self::BedRunsAway { .. } => "lower the drive, or leave more room above the bed (flow.height)",
            Self::LidPushes { .. } => "raise the slope, or ask for a lower Shields number",
            Self::ChangeOfType { .. } => "regularisation.deepen_cut = true, or a larger regularisation.interface_cut",
        }
        .into()
    }
}
