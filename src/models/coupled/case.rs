//! The tables that only a coupled flow of grains and fluid has.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::drag::DallavalleGrain;
use crate::closures::fluctuation::Fluctuation;
use crate::closures::mixing_length::{LiSawamoto, MixingLength};
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::role::Only;
use crate::closures::side_wall::SideWall;
use crate::dem::{Bottom, Discrete};
use crate::models::{GrainCell, Spring};
use crate::part;

fn clear() -> MixtureViscosity {
    MixtureViscosity::Clear
}

/// How the fluid is stepped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FluidScheme {
    /// Backward Euler with the drag: stable with any step.
    #[default]
    Implicit,
    /// Forward Euler: stable for steps below h^2/(2 nu) and 2 (1 - phi) rho_f/beta alone.
    Explicit,
}

/// How grains are moved, how often the fluid is solved, and what is averaged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CoupledDiscrete {
    /// Simulated time after the bed has come to rest, transient included.
    #[serde(default = "duration")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub duration: f64,
    /// The run ends when the standard error of the transport rate is below this share of it; where it is left out it runs for
    /// its whole duration.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub known_to: Option<f64>,
    /// Time between two solutions of the fluid.
    #[serde(default = "period")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub coupling_period: f64,
    /// Steps of the fluid in that time.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 1, "maximum" = 10_000))]
    pub fluid_steps: u32,
    /// How the fluid is stepped: explicit steps are there to show where they fail.
    #[serde(default)]
    pub fluid_scheme: FluidScheme,
    /// Time between two samples of the means; at least the coupling period.
    #[serde(default = "sample")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub sample_period: f64,
    /// Longest time that the grains are given to fall and come to rest.
    #[serde(default = "settle")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub settle: f64,
    /// Time step of the grains; derived from the stability limit where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub time_step: Option<f64>,
    /// Whether a time step beyond the limits of contacts and drag is taken nevertheless.
    #[serde(default)]
    pub force_time_step: bool,
    /// The deep bed is frozen where a layer of one diameter moves less than this share of a diameter in freeze_period, the mean of its
    /// grains, and released when the layer above moves more. Without it all grains are moved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub freeze_below: Option<f64>,
    /// Time between two checks of what may be frozen.
    #[serde(default = "freeze_period")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub freeze_period: f64,
    /// Time from which on layers are frozen.
    #[serde(default)]
    #[schemars(extend("x-unit" = "s", "minimum" = 0.0, "maximum" = 1e5))]
    pub freeze_after: f64,
    /// Derived time step over the stability limit of a grain in a packing.
    #[serde(default = "safety")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub safety: f64,
    /// Listed neighbours are nearer than a diameter and this share of it.
    #[serde(default = "skin")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.01, "maximum" = 1.0))]
    pub skin: f64,
    /// Height of the cells of the fluid and of the averages over the diameter.
    #[serde(default = "slice")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.005, "maximum" = 2.0))]
    pub slice: f64,
    /// Number from which everything random is drawn.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1_000_000))]
    pub seed: u32,
    /// Frames of the grains for ParaView, evenly spaced over the duration.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10_000))]
    pub frames: u32,
}

impl Default for CoupledDiscrete {
    fn default() -> Self {
        Self {
            duration: duration(),
            known_to: None,
            coupling_period: period(),
            fluid_steps: one(),
            fluid_scheme: FluidScheme::default(),
            sample_period: sample(),
            settle: settle(),
            time_step: None,
            force_time_step: false,
            freeze_below: None,
            freeze_period: freeze_period(),
            freeze_after: 0.0,
            safety: safety(),
            skin: skin(),
            slice: slice(),
            seed: 0,
            frames: 0,
        }
    }
}

fn duration() -> f64 {
    20.0
}

impl CoupledDiscrete {
    /// The part that moves and averages grains.
    #[must_use]
    pub fn grains(&self) -> Discrete {
        Discrete {
            duration: self.duration,
            averaged: 1.0,
            settle: self.settle,
            time_step: self.time_step,
            safety: self.safety,
            force_time_step: self.force_time_step,
            skin: self.skin,
            slice: self.slice,
            seed: self.seed,
            frames: self.frames,
        }
    }
}

fn period() -> f64 {
    1e-2
}
fn one() -> u32 {
    1
}
fn sample() -> f64 {
    0.1
}
fn settle() -> f64 {
    2.0
}
fn freeze_period() -> f64 {
    0.2
}

fn safety() -> f64 {
    0.7
}
fn skin() -> f64 {
    0.3
}
fn slice() -> f64 {
    1.0 / 30.0
}

/// Laws of the coupled flow; friction and restitution are those of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CoupledLaws {
    /// Contact of two grains, or of a grain with a wall.
    #[serde(default)]
    pub contact: Spring,
    /// Drag on single grains.
    #[serde(default)]
    pub drag: Only<DallavalleGrain>,
    /// Mixing length of the turbulence.
    #[serde(default = "li_sawamoto")]
    pub mixing_length: MixingLength,
    /// Effective viscosity of the mixture.
    #[serde(default = "clear")]
    pub mixture_viscosity: MixtureViscosity,
    /// Friction of the fluid on the side walls; left out, that of smooth walls (blasius) between side walls and none without.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side_wall: Option<SideWall>,
    /// Eddies that a grain meets.
    #[serde(default)]
    pub fluctuation: Fluctuation,
}

fn li_sawamoto() -> MixingLength {
    MixingLength::LiSawamoto(LiSawamoto::default())
}

impl Default for CoupledLaws {
    fn default() -> Self {
        Self {
            contact: Spring::default(),
            drag: Only::default(),
            mixing_length: li_sawamoto(),
            mixture_viscosity: clear(),
            side_wall: None,
            fluctuation: Fluctuation::default(),
        }
    }
}

part! {
    /// Grains with friction, grain by grain, in a turbulent fluid of one dimension that drives them.
    pub struct CoupledTable {
        /// Layers of mobile grains N_l: their number is layers times the diameters along the flow, times those across it that the
        /// width has room for; left out, those of the bed of the scene, thickness phi/(pi d/6).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
        layers: Option<f64>,
        /// What the bed rests on.
        #[serde(default)]
        bottom: Bottom,
        /// Largest elevation of the fixed grains over their mean, on bottom = "steps"; a third of the diameter where it is left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("x-unit" = "m", "minimum" = 0.0, "maximum" = 1.0))]
        relief: Option<f64>,
        /// Step between the elevations of the fixed grains; the relief itself where it is left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
        relief_step: Option<f64>,
        /// The cell.
        #[serde(default)]
        cell: GrainCell,
        /// Laws.
        #[serde(default)]
        closures: CoupledLaws,
        /// How grains and fluid are stepped.
        #[serde(default)]
        discrete: CoupledDiscrete,
    }
}
