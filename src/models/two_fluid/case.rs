//! The tables that only a two-fluid flow has.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::dispersion::Dispersion;
use crate::closures::drag::DallavalleGrain;
use crate::closures::kinetic::radial::PHI_MAX;
use crate::closures::kinetic::{Elastic, FrictionalCollisional, Granular, StaticFriction};
use crate::closures::mixing_length::{LiSawamoto, MixingLength};
use crate::closures::role::Only;

use crate::part;

fn phi_max() -> f64 {
    PHI_MAX
}

/// Whether the steady flow is solved for, or the flow in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// The steady flow, by Newton's method.
    #[default]
    Steady,
    /// The flow in time, from the grains at rest under still fluid.
    Transient,
}

/// What the stress of the fluid is per area of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FluidStress {
    /// rho_f (1 - phi)(nu + nu_t) du_f/dz, as printed: eq. (2.7).
    #[default]
    Share,
    /// rho_f (nu + nu_t) du_f/dz, as in a public code.
    Whole,
}

/// Laws of the two fluids.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TwoFluidClosures {
    /// Stresses of grains that move.
    #[serde(default = "frictional_collisional")]
    pub granular: Granular,
    /// Pressure of enduring contacts.
    #[serde(default)]
    pub elastic: Elastic,
    /// Friction of enduring contacts; mu(I) has its own.
    #[serde(default)]
    pub static_friction: StaticFriction,
    /// Drag between the phases.
    #[serde(default)]
    pub drag: Only<DallavalleGrain>,
    /// Mixing length of the turbulence.
    #[serde(default = "li_sawamoto")]
    pub mixing_length: MixingLength,
    /// Grains that the turbulence carries.
    #[serde(default)]
    pub dispersion: Dispersion,
}

fn frictional_collisional() -> Granular {
    Granular::FrictionalCollisional(FrictionalCollisional::default())
}

fn li_sawamoto() -> MixingLength {
    MixingLength::LiSawamoto(LiSawamoto::default())
}

impl Default for TwoFluidClosures {
    fn default() -> Self {
        Self {
            granular: frictional_collisional(),
            elastic: Elastic::default(),
            static_friction: StaticFriction::default(),
            drag: Only::default(),
            mixing_length: li_sawamoto(),
            dispersion: Dispersion::default(),
        }
    }
}

/// Small numbers of the two fluids.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TwoFluidRegularisation {
    /// Granular temperature that grains keep in the fluid: it picks the branch with motion, since none is a solution always.
    #[serde(default = "temperature")]
    #[schemars(extend("x-unit" = "m2/s2", "exclusiveMinimum" = 0.0, "maximum" = 1e-2))]
    pub granular_temperature: f64,
    /// Shear rate below which enduring contacts creep instead of standing still.
    #[serde(default = "shear_rate")]
    #[schemars(extend("x-unit" = "1/s", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub shear_rate: f64,
    /// Solid fraction below which grains have no weight: what is left of them in clear fluid.
    #[serde(default = "residual")]
    #[schemars(extend("x-unit" = "1", "minimum" = 1e-20, "maximum" = 1e-3))]
    pub phi: f64,
}

fn temperature() -> f64 {
    1e-8
}

fn shear_rate() -> f64 {
    1e-6
}

fn residual() -> f64 {
    1e-12
}

impl Default for TwoFluidRegularisation {
    fn default() -> Self {
        Self { granular_temperature: temperature(), shear_rate: shear_rate(), phi: residual() }
    }
}

/// The flow in time; the steady one takes none of these.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TwoFluidSolver {
    /// Simulated time.
    #[serde(default = "duration")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub duration: f64,
    /// Largest error of a step, relative: in solid fraction, momenta and fluctuation energy.
    #[serde(default = "tolerance")]
    #[schemars(extend("x-unit" = "1", "minimum" = 1e-9, "maximum" = 0.1))]
    pub tolerance: f64,
    /// Samples of the series, evenly spaced.
    #[serde(default = "samples")]
    #[schemars(extend("minimum" = 2, "maximum" = 100_000))]
    pub samples: usize,
}

fn duration() -> f64 {
    20.0
}

fn tolerance() -> f64 {
    1e-3
}

fn samples() -> usize {
    200
}

impl Default for TwoFluidSolver {
    fn default() -> Self {
        Self { duration: duration(), tolerance: tolerance(), samples: samples() }
    }
}

/// Cells of the column.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TwoFluidGrid {
    /// Number of cells.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 20, "maximum" = 100_000))]
    pub cells: usize,
    /// Distance from the level of the grains at rest within which cells stay fine: their heights grow with the distance z
    /// from it like (1 + (z/fine)^2)^(1/2). Without, all have the same height.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub fine: Option<f64>,
}

fn cells() -> usize {
    240
}

impl Default for TwoFluidGrid {
    fn default() -> Self {
        Self { cells: cells(), fine: None }
    }
}

part! {
    /// Grains that collide and the turbulent fluid that drives them, as two fluids of one dimension.
    pub struct TwoFluidTable {
        /// Solid fraction at which the grains jam: in the radial distribution function and in the elastic pressure.
        #[serde(default = "phi_max")]
        #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
        phi_max: f64,
        /// Whether the steady flow is solved for, or the flow in time.
        #[serde(default)]
        state: State,
        /// Whether the stress of the fluid carries the factor 1 - phi.
        #[serde(default)]
        fluid_stress: FluidStress,
        /// Laws.
        #[serde(default)]
        closures: TwoFluidClosures,
        /// Small numbers.
        #[serde(default)]
        regularisation: TwoFluidRegularisation,
        /// Cells of the column.
        #[serde(default)]
        grid: TwoFluidGrid,
        /// The flow in time.
        #[serde(default)]
        solver: TwoFluidSolver,
    }
}
