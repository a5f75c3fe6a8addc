//! What grains that touch have of the scene: friction and restitution; their stiffness is a matter of the model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::needed;
use crate::case::tables::{self, only};
use crate::closures::contact::{LinearSpring, Tension};
use crate::model::Faults;
use crate::scene::Grains;

only!(
    /// Linear spring and dashpot along the normal, linear spring with a Coulomb slider across it.
    SpringLaw,
    LinearSpring
);

/// Stiffness of a contact; friction and restitution are those of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Spring {
    /// The law of contact.
    pub law: SpringLaw,
    /// Normal stiffness of the contact.
    #[schemars(extend("x-unit" = "N/m", "exclusiveMinimum" = 0.0, "maximum" = 1e12))]
    pub k_n: f64,
    /// Tangential stiffness of the contact; 0 is without friction.
    #[schemars(extend("x-unit" = "N/m", "minimum" = 0.0, "maximum" = 1e12))]
    pub k_s: f64,
    /// Whether the dashpot may pull while grains part.
    #[serde(default)]
    pub tension: Tension,
}

/// Grains and stiffness of a case of format 1, which has friction and restitution in the law of contact.
pub fn touching(grains: &tables::Grains, contact: &LinearSpring) -> (Grains, Spring) {
    let LinearSpring { k_n, k_s, mu, e_n, tension } = *contact;
    let (restitution, friction) = (Some(e_n), Some(mu));
    let grains = Grains { restitution, friction, ..Grains::new(grains.diameter, grains.density) };
    (grains, Spring { law: SpringLaw::LinearSpring, k_n, k_s, tension })
}

impl Spring {
    /// The law of contact of these grains.
    pub fn of(self, grains: &Grains, faults: &mut Faults) -> Option<LinearSpring> {
        let Self { k_n, k_s, tension, .. } = self;
        let e_n = needed("grains.restitution", grains.restitution, faults);
        let mu = needed("grains.friction", grains.friction, faults);
        Some(LinearSpring { k_n, k_s, mu: mu?, e_n: e_n?, tension })
    }
}
