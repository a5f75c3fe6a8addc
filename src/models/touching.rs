//! What grains that are followed one by one have of the scene: friction, restitution, the amount of them. Their stiffness and the cell
//! in which they move are a matter of the model.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::Fault;
use crate::case::tables::only;
use crate::closures::contact::{LinearSpring, Tension};
use crate::dem::GrainBed;
use crate::model::Faults;
use crate::scene::{Bed, Grains};

only!(
    /// Linear spring and dashpot along the normal, linear spring with a Coulomb slider across it.
    SpringLaw,
    LinearSpring
);

/// Stiffness of a contact: given, or what keeps the overlap under the weight of the bed small. Friction and restitution are those of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Spring {
    /// The law of contact.
    #[serde(default = "spring")]
    pub law: SpringLaw,
    /// Normal stiffness of the contact; left out, it is rigidity p d with p the weight of the grains under water on the bottom.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "N/m", "exclusiveMinimum" = 0.0, "maximum" = 1e12))]
    pub k_n: Option<f64>,
    /// Tangential stiffness of the contact, 0 is without friction; left out, it is k_s_over_k_n times k_n.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "N/m", "minimum" = 0.0, "maximum" = 1e12))]
    pub k_s: Option<f64>,
    /// k_n/(p d) where k_n is left out: grains are rigid from 1e4 on (Chassagne et al. 2023).
    #[serde(default = "rigid")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub rigidity: f64,
    /// k_s/k_n where k_s is left out.
    #[serde(default = "one")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 10.0))]
    pub k_s_over_k_n: f64,
    /// Whether the dashpot may pull while grains part.
    #[serde(default)]
    pub tension: Tension,
}

fn spring() -> SpringLaw {
    SpringLaw::LinearSpring
}

fn rigid() -> f64 {
    1e4
}

fn one() -> f64 {
    1.0
}

impl Default for Spring {
    fn default() -> Self {
        Self {
            law: spring(),
            k_n: None,
            k_s: None,
            rigidity: rigid(),
            k_s_over_k_n: one(),
            tension: Tension::default(),
        }
    }
}

impl Spring {
    /// The law of contact of these grains under the pressure `p` \[Pa], if there is one.
    pub fn of(self, grains: &Grains, p: Option<f64>, faults: &mut Faults) -> Option<LinearSpring> {
        let Self { tension, rigidity, k_s_over_k_n, .. } = self;
        let derived = || p.map(|p| rigidity * p * grains.diameter);
        let k_n = faults.needed("closures.contact.k_n", self.k_n.or_else(derived))?;
        let k_s = self.k_s.unwrap_or(k_s_over_k_n * k_n);
        Some(LinearSpring { k_n, k_s, mu: grains.friction().value(), e_n: grains.restitution().value(), tension })
    }
}

/// Pressure on the bottom \[Pa] of so many layers of grains, of which a volume weighs `weight` [N/m3].
pub fn load(layers: Option<f64>, weight: f64, d: f64) -> Option<f64> {
    layers.map(|layers| weight * layers * PI / 6.0 * d)
}

/// The cell of the grains: periodic along x, and along y where there are no side walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainCell {
    /// Period along the flow; left out, it is 10 d, or 100 d between side walls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub length: Option<f64>,
    /// Period across the flow, where flow.width gives no side walls; left out, it is 10 d.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub width: Option<f64>,
}

/// Diameters along and across the flow from which on means are those of a larger cell (docs/coupled.md), and along it between side walls.
const CELL: [f64; 2] = [10.0, 100.0];

impl GrainCell {
    /// Extent along and across the flow \[m]: as given, the distance of the side walls, or so many diameters that larger cells change nothing.
    pub fn size(&self, walls: Option<f64>, d: f64, faults: &mut Faults) -> [f64; 2] {
        if walls.is_some() && self.width.is_some() {
            let allowed = vec!["length".to_owned()];
            let users = vec!["a cell without side walls".to_owned()];
            let model = "a cell between side walls, whose distance is flow.width".to_owned();
            faults.push(("cell.width", Fault::NotUsed { what: "key", name: "width".into(), model, users, allowed }));
        }
        let along = if walls.is_some() { CELL[1] } else { CELL[0] };
        [self.length.unwrap_or(along * d), walls.or(self.width).unwrap_or(CELL[0] * d)]
    }
}

/// What the table of a bed of grains leaves to the scene, as it is taken: key, value in SI, and from what.
pub fn derived(bed: &GrainBed) -> Vec<(&'static str, f64, &'static str)> {
    let [length, width] = bed.size;
    // Between walls a row of grains is whole.
    let across = if bed.side_walls { (width / bed.d).floor().max(1.0) } else { width / bed.d };
    let along = if bed.side_walls { "100 d between side walls" } else { "10 d" };
    let mut all = vec![
        ("layers", bed.mobile as f64 / (length / bed.d * across), "the bed: thickness φ/(π d/6), in whole grains"),
        ("cell.length", length, along),
        ("closures.contact.k_n", bed.contact.k_n, "rigidity p d, p the weight of the grains on the bottom"),
        ("closures.contact.k_s", bed.contact.k_s, "k_s_over_k_n times k_n"),
    ];
    if !bed.side_walls {
        all.insert(2, ("cell.width", width, "10 d"));
    }
    all
}

/// Layers of mobile grains: as given, or those of a packed bed of this thickness.
pub fn layers(given: Option<f64>, bed: &Bed, d: f64, faults: &mut Faults) -> Option<f64> {
    let packed = || Some(bed.solid_volume()? / (PI / 6.0 * d));
    faults.needed("layers", given.or_else(packed))
}
