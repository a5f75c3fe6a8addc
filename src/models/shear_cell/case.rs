//! The tables that only grains between two moving walls have.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::tables::Grid;
use crate::closures::kinetic;
use crate::closures::kinetic::radial::PHI_MAX;
use crate::closures::role::choice;

use crate::part;

/// The gap between the walls and the grains in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ShearCell {
    /// Distance of the walls.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Solid fraction, mean over the gap. Below phi_max.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi: f64,
    /// Solid fraction at which the grains jam.
    #[serde(default = "phi_max")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_max: f64,
    /// Velocity of the grains at the lower wall; they slip, so it is not that of the wall.
    #[schemars(extend("x-unit" = "m/s", "minimum" = -1e3, "maximum" = 1e3))]
    pub velocity_lower: f64,
    /// Velocity of the grains at the upper wall.
    #[schemars(extend("x-unit" = "m/s", "minimum" = -1e3, "maximum" = 1e3))]
    pub velocity_upper: f64,
    /// Granular temperature at the lower wall.
    #[schemars(extend("x-unit" = "m2/s2", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub temperature_lower: f64,
    /// Granular temperature at the upper wall.
    #[schemars(extend("x-unit" = "m2/s2", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub temperature_upper: f64,
}

fn phi_max() -> f64 {
    PHI_MAX
}

/// Laws of the grains between the walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ShearCellClosures {
    /// Stresses of grains that collide: a kinetic theory. Without fluid neither saltation nor drag counts.
    pub granular: Colliding,
}

choice! {
    /// Stresses of grains that collide.
    pub enum Colliding from kinetic {
        garzo_dufty::GarzoDufty(..),
        frictional_collisional::FrictionalCollisional(..),
    }
}

part! {
    /// Grains that collide between two walls, without fluid or gravity.
    pub struct ShearCellTable {
        /// The gap between the walls, and what they do to the grains.
        geometry: ShearCell,
        /// Laws.
        closures: ShearCellClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}
