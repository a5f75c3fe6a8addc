//! Why an impact has no answer.

use crate::result::{Class, MethodError, codes};

/// Why an impact has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImpactError {
    /// Contacts too soft for any impact of this velocity.
    #[error("the grain would sink {radii:.2} radii deep: such an impact is none")]
    TooDeep {
        /// depth over the radius of the grain
        radii: f64,
    },
    /// Grains that stay together.
    #[error("the grain has not left its target after {steps} steps")]
    NoParting {
        /// steps made
        steps: u64,
    },
}

codes!(ImpactError {
    Self::TooDeep { .. } => "overlap",
    Self::NoParting { .. } => "no-parting",
});

impl MethodError for ImpactError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        match self {
            Self::TooDeep { .. } => Class::Diverged,
            Self::NoParting { .. } => Class::Unphysical,
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::TooDeep { .. } => "stiffer contacts (closures.contact.k_n) or a slower impact (flow.velocity)",
            Self::NoParting { .. } => {
                "a larger restitution coefficient (grains.restitution) or fewer discrete.steps_per_contact"
            }
        }
        .into()
    }
}
