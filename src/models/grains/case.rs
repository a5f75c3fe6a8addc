//! The tables of cases of single grains, as `tables` has those of the other models.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::dem::{Bottom, Discrete};
use crate::models::{GrainCell, Spring};
use crate::part;

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

fn gravity() -> f64 {
    9.81
}
fn steps() -> f64 {
    50.0
}

/// Laws of the grains; friction and restitution are those of the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainLaws {
    /// Contact of two grains, or of a grain with a wall.
    #[serde(default)]
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
        #[serde(default)]
        cell: GrainCell,
        /// Whether the side walls are without friction.
        #[serde(default)]
        smooth_walls: bool,
        /// Laws.
        #[serde(default)]
        closures: GrainLaws,
        /// How grains are moved and averaged.
        #[serde(default)]
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
