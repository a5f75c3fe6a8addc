//! What models take for granted of a flow: the rules that several of them share, with their thresholds and where these come from.

use super::load;
use crate::closures::Range;
use crate::dem::GrainBed;
use crate::result::{Limits, Premise, Results, Rule, Validity, quantity as q};
use crate::scene::BedScene;

/// Bulk Reynolds number of the gap that the fluid has to itself, between planes.
pub const LAMINAR: Rule = Rule {
    premise: "the flow is laminar",
    number: "Re = ρ_f U h/η on the gap",
    limits: Limits::Below(1000.0, 3000.0),
    why: "the flow is turbulent: velocity and rate are those of another flow",
    source: "Patel & Head (1969), J. Fluid Mech. 38, 181-201",
};
/// The same in a pipe.
pub const LAMINAR_PIPE: Rule = Rule { limits: Limits::Below(2000.0, 4000.0), ..LAMINAR };
/// Carman-Kozeny's drag is viscous.
pub const DARCY: Rule = Rule {
    premise: "the drag between the phases is viscous",
    number: "Re_p = ρ_f |u_f - u_p| d/η",
    limits: Limits::Below(1.0, 10.0),
    why: "inertia adds to the drag: the slip between the phases is too large",
    source: "Bear (1972), Dynamics of Fluids in Porous Media",
};
/// The bed moves as a sheet.
pub const SHEET: Rule = Rule {
    premise: "the bed moves as a sheet",
    number: "θ",
    limits: Limits::Above(0.5, 0.3),
    why: "few layers move, and grains roll and jump over them: no dense continuum",
    source: "Revil-Baudard & Chauchat (2013), par. 3 and 12; 0.3 is ours",
};
/// Layers of a continuum.
pub const MANY_LAYERS: Rule = Rule {
    premise: "the moving layer is many grains thick",
    number: "δ_s/d",
    limits: Limits::Above(10.0, 5.0),
    why: "a continuum needs many grains over its thickness",
    source: "Revil-Baudard & Chauchat (2013); 5 is ours",
};
/// Roughness of the bed under the depth.
pub const SHALLOW_ROUGHNESS: Rule = Rule {
    premise: "the roughness is small against the depth",
    number: "k_s/h",
    limits: Limits::Below(0.1, 0.3),
    why: "the mixing length of a wall does not hold over elements as high as the flow",
    source: "Revil-Baudard & Chauchat (2013); 0.3 is ours",
};
/// Rough wall.
pub const ROUGH_WALL: Rule = Rule {
    premise: "the bed is a rough wall",
    number: "u_* k_s/ν",
    limits: Limits::Above(70.0, 5.0),
    why: "the viscous sublayer covers the roughness: turbulence near the bed is too strong",
    source: "Nikuradse (1933)",
};
/// Models that carry no grains in suspension.
pub const NO_SUSPENSION: Rule = Rule {
    premise: "turbulence carries no grains",
    number: "w_s/u_*",
    limits: Limits::Above(1.0, 0.8),
    why: "grains go into suspension, which this model does not carry",
    source: "Sumer et al. (1996), in Revil-Baudard & Chauchat (2013)",
};
/// Collisions that the fluid does not damp.
pub const COLLISIONS: Rule = Rule {
    premise: "the fluid does not damp collisions",
    number: "St = ρ_p d T^(1/2)/(9 η)",
    limits: Limits::Above(2000.0, 10.0),
    why: "grains do not rebound in this fluid: the restitution of dry grains is not theirs",
    source: "Gondret et al. (2002), Phys. Fluids 14, 643-652",
};
/// Shields numbers at which kinetic theory was tried.
pub const KINETIC_SHIELDS: Rule = Rule {
    premise: "kinetic theory was compared with grains at this Shields number",
    number: "θ",
    limits: Limits::Within(0.2, 1.0),
    why: "",
    source: "Chassagne et al. (2023), Table 2",
};
/// Restitution at which it was tried.
pub const KINETIC_RESTITUTION: Rule = Rule {
    premise: "kinetic theory was compared with grains of this restitution",
    number: "e",
    limits: Limits::Within(0.3, 0.9),
    why: "",
    source: "Chassagne et al. (2023), Table 2",
};
/// Friction at which it was tried.
pub const KINETIC_FRICTION: Rule = Rule {
    premise: "kinetic theory was compared with grains of this friction",
    number: "μ_p",
    limits: Limits::Within(0.0, 1.5),
    why: "",
    source: "Chassagne et al. (2023), Table 2",
};
/// Stiffness of contacts.
pub const RIGID: Rule = Rule {
    premise: "grains are rigid",
    number: "k_n/(p d)",
    limits: Limits::Above(1e4, 1e3),
    why: "contacts give way: grains overlap and the packing is too dense",
    source: "Roux & Combe (2002), C. R. Physique 3, 131-140",
};
/// Bed under the moving layer.
pub const AT_REST: Rule = Rule {
    premise: "a bed at rest lies under the moving layer",
    number: "layers at rest",
    limits: Limits::Above(5.0, 2.0),
    why: "the layer feels the bottom of the bed",
    source: "ours",
};
/// Depth over the grains.
pub const SUBMERGED: Rule = Rule {
    premise: "the flow is deep over its grains",
    number: "h/d",
    limits: Limits::Above(5.0, 2.0),
    why: "the mixing length is that of wakes, not that of a wall",
    source: "ours",
};
/// A bed that rests on the bottom of its domain.
pub const RESTS_ON_ITS_BOTTOM: Rule = Rule {
    premise: "the bed rests on its bottom",
    number: "pull of bed and water at the bottom over the friction there",
    limits: Limits::Below(0.8, 1.0),
    why: "all of the bed moves, down to its bottom: the rate is that of a bed of this thickness",
    source: "Revil-Baudard & Chauchat (2013), eq. (32); 0.8 is ours",
};
/// A slope on which a bed rests.
pub const RESTS: Rule = Rule {
    premise: "a bed rests on this slope",
    number: "pull of grains and fluid along the slope over their friction",
    limits: Limits::Below(0.8, 1.0),
    why: "no bed rests on this slope: grains and fluid slide together",
    source: "Revil-Baudard & Chauchat (2013), eq. (32)",
};

/// A bed of grains that lie on each other.
pub const PACKED_BED: Rule = Rule {
    premise: "grains of the bed lie on each other",
    number: "φ",
    limits: Limits::Above(0.55, 0.5),
    why: "so loose a bed does not stand: the grains settle, and the bed is lower than the scene says",
    source: "Onoda & Liniger (1990), Phys. Rev. Lett. 64, 2727-2730; 0.5 is ours",
};
/// The packing of the bed is that of the law.
pub const PACKED_AS_THE_LAW: Rule = Rule {
    premise: "the bed is packed as closures.dilatancy says",
    number: "|φ_max - φ|",
    limits: Limits::Below(0.01, 0.05),
    why: "the bed of this model has the packing of its law, not that of the scene",
    source: "ours",
};
/// Inertia that a cavity is solved without.
pub const SLOW: Rule = Rule {
    premise: "inertia is small",
    number: "Re = ρ U H/η",
    limits: Limits::Below(10.0, 100.0),
    why: "inertia carries the vortex downstream, which this model leaves out",
    source: "Ghia, Ghia & Shin (1982), J. Comput. Phys. 48, 387-411: by 0.12 H at 100; 10 is ours",
};
/// A cell of grains that is periodic along and across the flow.
pub const WIDE_CELL: Rule = Rule {
    premise: "the cell is so large that a larger one carries the same",
    number: "least extent of the cell over d",
    limits: Limits::Above(10.0, 5.0),
    why: "grains meet their own images: the rate is that of this cell",
    source: "ours (docs/coupled.md)",
};
/// The same between side walls, along the flow.
pub const LONG_CELL: Rule =
    Rule { number: "length of the cell over d", limits: Limits::Above(50.0, 25.0), ..WIDE_CELL };
/// A bed that neither rises nor sinks while means are taken.
pub const SETTLED: Rule = Rule {
    premise: "the bed has settled",
    number: "change of its level from the first half of the averaged time to the second, over twice its error",
    limits: Limits::Within(0.0, 1.0),
    why: "",
    source: "ours",
};
/// Side walls without friction.
pub const SMOOTH_WALLS: Rule = Rule {
    premise: "side walls without friction are far apart",
    number: "h/W",
    limits: Limits::Below(0.1, 0.5),
    why: "the friction of the walls (closures.side_wall) decides the rate of a narrow flume",
    source: "ours",
};

/// Reynolds number of the gap, as the model reports it.
pub fn laminar(rule: &Rule, results: &Results) -> Option<Premise> {
    rule.maybe(results.get(q::REYNOLDS_GAP.name).or(results.get(q::REYNOLDS.name)))
}

/// Stiffness of the contacts under the weight of the grains, of which a volume weighs `weight` [N/m3].
pub fn rigid(bed: &GrainBed, weight: f64) -> Option<Premise> {
    let layers = bed.mobile as f64 * bed.d * bed.d / (bed.size[0] * bed.size[1].max(bed.d));
    RIGID.maybe(load(Some(layers), weight, bed.d).map(|p| bed.contact.k_n / (p * bed.d)))
}

/// Pull over friction of a bed of this friction on the slope of a scene, of a packing `phi`.
pub fn rests(scene: &BedScene, mu_s: f64, phi: f64) -> Option<Premise> {
    let excess = scene.grains.density / scene.fluid.density - 1.0;
    let pull = |angle: f64| (1.0 / excess + phi) * angle.tan() / (mu_s * phi);
    RESTS.maybe(scene.slope().map(pull))
}

/// Settling against the friction velocity of the drive.
pub fn no_suspension(scene: &BedScene) -> Option<Premise> {
    NO_SUSPENSION.maybe(scene.u_star_drive().map(|u_star| scene.settling_velocity().value() / u_star))
}

/// Flags `value` if it is outside `range`.
#[must_use]
pub fn outside(closure: String, range: &Range, value: f64) -> Option<Validity> {
    (!range.contains(value)).then(|| Validity {
        closure,
        variable: range.variable.into(),
        value,
        range: range.to_string(),
        z_m: None,
    })
}
