//! The tables of cases of single grains, as `tables` has those of the other models.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::tables::Grains;
use crate::case::tables::SlopeDefinition;
use crate::closures::contact::LinearSpring;
use crate::closures::role::Only;
use crate::dem::{Bottom, Discrete};
use crate::models::{GrainCell, Spring};
use crate::{part, tables};

/// A bed of grains that is let fall into place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainBed {
    /// Layers of mobile grains: their number is layers times length times width over the square of the diameter.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub layers: f64,
    /// What the bed rests on.
    #[serde(default)]
    pub bottom: Bottom,
}

/// The channel of the grains: periodic along x, and its tilt.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainFlow {
    /// Period along the flow.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub length: f64,
    /// Period across the flow, or the distance of the side walls.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub width: f64,
    /// Whether there are side walls instead of a period; with the friction of the grains, unless smooth_walls.
    #[serde(default)]
    pub side_walls: bool,
    /// Whether the side walls are without friction.
    #[serde(default)]
    pub smooth_walls: bool,
    /// Drive: the slope, as slope_definition says, or an angle; 0 is a bed at rest.
    #[serde(default)]
    #[schemars(extend("x-unit" = "1", "x-angle" = "slope_definition", "minimum" = 0.0, "maximum" = 10.0))]
    pub slope: f64,
    /// What the number given as slope is: papers differ. With a slope such as "2 deg" it is the angle.
    #[serde(default = "tangent")]
    pub slope_definition: SlopeDefinition,
    /// Acceleration of gravity.
    #[serde(default = "gravity")]
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub gravity: f64,
}

/// The model: grains one by one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainsModel {
    /// What kind of model: every grain is followed.
    pub kind: GrainsKind,
}

/// Every grain is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GrainsKind {
    /// Every grain is followed.
    Grains,
}

/// The model: the impact of one grain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ImpactModel {
    /// What kind of model: one impact, next to its closed form.
    pub kind: ImpactKind,
}

/// One impact, next to its closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactKind {
    /// One impact, next to its closed form.
    Impact,
}

/// The model: grains compared with an exact solution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerificationModel {
    /// What kind of model: a few grains, compared with a closed form or a conservation law.
    pub kind: VerificationKind,
    /// Which one.
    pub trial: VerificationCase,
}

/// A few grains, compared with a closed form or a conservation law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum VerificationKind {
    /// A few grains, compared with a closed form or a conservation law.
    Trial,
}

/// What the grains are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum VerificationCase {
    /// Head-on impacts for restitution coefficients from 0.1 to 1, both conventions, on wall, fixed and mobile grain.
    HeadOn,
    /// Oblique impacts at every degree: the gross-slip law with the contact of the case; energy with many others, too.
    Oblique,
    /// A grain that slides on a plane until it rolls.
    Rolling,
    /// A grain that bounces on a plane.
    Bouncing,
    /// Three grains, one on the other.
    Stack,
    /// Two hundred grains that collide: momentum and angular momentum.
    Cluster,
    /// Eight grains that collide for a million steps: the energy balance.
    Ledger,
    /// Energy of springs and grains together in one impact, against the time step.
    Springs,
}

/// How the grains of a verification case move.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerificationFlow {
    /// Velocity at the beginning.
    #[serde(default = "slow")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub velocity: f64,
    /// Acceleration of gravity.
    #[serde(default = "gravity")]
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub gravity: f64,
}

impl Default for VerificationFlow {
    fn default() -> Self {
        Self { velocity: slow(), gravity: gravity() }
    }
}

fn slow() -> f64 {
    0.1
}

/// How a grain hits what is there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ImpactFlow {
    /// Velocity of the grain before the impact, relative to what it hits.
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub velocity: f64,
    /// Angle of that velocity with the normal: 0 is head-on.
    #[serde(default)]
    #[schemars(extend("x-unit" = "rad", "minimum" = 0.0, "maximum" = 1.57))]
    pub angle: f64,
    /// Angular velocity before the impact; positive rolls with the motion.
    #[serde(default)]
    #[schemars(extend("x-unit" = "rad/s", "minimum" = -1e6, "maximum" = 1e6))]
    pub spin: f64,
    /// What it hits.
    #[serde(default)]
    pub target: Target,
}

/// What a grain hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Target {
    /// A plane wall.
    #[default]
    Wall,
    /// A fixed grain of the same size.
    Fixed,
    /// A mobile grain of the same size, at rest.
    Mobile,
}

/// How long and how finely an impact is followed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ImpactSteps {
    /// Time steps within the duration of the contact.
    #[serde(default = "steps")]
    #[schemars(extend("x-unit" = "1", "minimum" = 5.0, "maximum" = 100000.0))]
    pub steps_per_contact: f64,
}

impl Default for ImpactSteps {
    fn default() -> Self {
        Self { steps_per_contact: steps() }
    }
}

fn tangent() -> SlopeDefinition {
    SlopeDefinition::Tangent
}
fn gravity() -> f64 {
    9.81
}
fn steps() -> f64 {
    50.0
}

/// Laws of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainClosures {
    /// Contact of two grains, or of a grain with a wall.
    pub contact: Only<LinearSpring>,
}

tables! {
    /// A bed of spheres with friction, grain by grain, at rest or down a slope.
    pub struct GrainsBedTables {
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: GrainBed,
        /// The channel and its tilt.
        flow: GrainFlow,
        /// The model.
        model: GrainsModel,
        /// Laws.
        closures: GrainClosures,
        /// How grains are moved and averaged.
        discrete: Discrete,
    }
}

tables! {
    /// The impact of one sphere on a wall or another sphere, next to its closed form.
    pub struct ImpactTables {
        /// The grains.
        grains: Grains,
        /// The impact.
        flow: ImpactFlow,
        /// The model.
        model: ImpactModel,
        /// Laws.
        closures: GrainClosures,
        /// How finely it is followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
}

tables! {
    /// A few grains, compared with a closed form or a conservation law.
    pub struct VerificationTables {
        /// The grains.
        grains: Grains,
        /// How they move.
        #[serde(default)]
        flow: VerificationFlow,
        /// The model.
        model: VerificationModel,
        /// Laws.
        closures: GrainClosures,
        /// How finely contacts are followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
}

/// Laws of the grains; friction and restitution are those of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainLaws {
    /// Contact of two grains, or of a grain with a wall.
    pub contact: Spring,
}

part! {
    /// A bed of spheres with friction, grain by grain, at rest or down a slope.
    pub struct GrainsTable {
        /// Layers of mobile grains: their number is layers times length times width over the square of the diameter; left out, those
        /// of the bed of the scene, thickness phi/(pi d/6).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
        layers: Option<f64>,
        /// What the bed rests on.
        #[serde(default)]
        bottom: Bottom,
        /// The cell.
        cell: GrainCell,
        /// Whether the side walls are without friction.
        #[serde(default)]
        smooth_walls: bool,
        /// Laws.
        closures: GrainLaws,
        /// How grains are moved and averaged.
        discrete: Discrete,
    }
}

part! {
    /// The impact of one sphere on a wall or another sphere, next to its closed form.
    pub struct ImpactTable {
        /// The impact.
        motion: ImpactFlow,
        /// Laws.
        closures: GrainLaws,
        /// How finely it is followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
}

part! {
    /// A few grains, compared with a closed form or a conservation law.
    pub struct VerificationTable {
        /// Which one.
        which: VerificationCase,
        /// How they move.
        #[serde(default)]
        motion: VerificationFlow,
        /// Laws.
        closures: GrainLaws,
        /// How finely contacts are followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
}
