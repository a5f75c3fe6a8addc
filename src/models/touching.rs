//! What grains that are followed one by one have of the scene: friction, restitution, the amount of them. Their stiffness and the cell
//! in which they move are a matter of the model.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::needed;
use crate::case::tables::{self, only};
use crate::closures::contact::{LinearSpring, Tension};
use crate::model::Faults;
use crate::scene::{Bed, Grains};

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

/// The cell of the grains: periodic along x, and along y where there are no side walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainCell {
    /// Period along the flow.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub length: f64,
    /// Period across the flow, where flow.width gives no side walls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub width: Option<f64>,
}

impl GrainCell {
    /// Extent across the flow \[m]: the distance of the side walls, or the period.
    pub fn across(&self, walls: Option<f64>, faults: &mut Faults) -> Option<f64> {
        needed("cell.width", walls.or(self.width), faults)
    }
}

/// Layers of mobile grains: as given, or those of a packed bed of this thickness.
pub fn layers(given: Option<f64>, bed: &Bed, d: f64, faults: &mut Faults) -> Option<f64> {
    let packed = || Some(bed.solid_volume()? / (PI / 6.0 * d));
    needed("layers", given.or_else(packed), faults)
}
