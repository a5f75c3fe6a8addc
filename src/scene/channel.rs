//! A flow without grains, and one whose geometry is a matter of the model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bed::Section;
use super::{Grains, SceneNumber};
use crate::case::tables::Fluid;

/// A fluid with or without a yield stress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Material {
    /// Density of the fluid.
    #[schemars(extend("x-unit" = "kg/m3", "exclusiveMinimum" = 0.0, "maximum" = 20000.0))]
    pub density: f64,
    /// Dynamic viscosity of the fluid, the plastic one of a yield-stress fluid.
    #[schemars(extend("x-unit" = "Pa s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub viscosity: f64,
    /// Yield stress of the fluid; 0 is a Newtonian fluid.
    #[serde(default)]
    #[schemars(extend("x-unit" = "Pa", "minimum" = 0.0, "maximum" = 1e9))]
    pub yield_stress: f64,
}

impl From<&Fluid> for Material {
    fn from(fluid: &Fluid) -> Self {
        Self { density: fluid.density, viscosity: fluid.viscosity, yield_stress: 0.0 }
    }
}

/// A flow without grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChannelScene {
    /// The fluid.
    pub fluid: Material,
    /// The channel, and what drives the flow in it.
    pub flow: ChannelFlow,
}

/// A channel, and the one drive of the flow in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChannelFlow {
    /// Depth: of the flow, the distance of two planes, the height of a section.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub depth: f64,
    /// Cross-section of a closed duct; a plane flow has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// Drive: fall of pressure along the flow, -dp/dx.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub pressure_gradient: Option<f64>,
    /// Drive: mean velocity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub mean_velocity: Option<f64>,
    /// Drive: friction velocity at the wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub u_star: Option<f64>,
}

impl ChannelFlow {
    /// A plane flow of this depth with nothing that drives it.
    #[must_use]
    pub fn new(depth: f64) -> Self {
        Self { depth, section: None, pressure_gradient: None, mean_velocity: None, u_star: None }
    }
}

impl ChannelScene {
    pub(super) fn numbers(&self) -> Vec<SceneNumber> {
        let Material { density, viscosity, yield_stress } = self.fluid;
        let h = self.flow.depth;
        let mut numbers = Vec::new();
        if let Some(mean) = self.flow.mean_velocity {
            numbers.push(SceneNumber::new("reynolds", density * mean * h / viscosity, "ρ U H/η"));
            numbers.push(SceneNumber::new("bingham", yield_stress * h / (viscosity * mean), "τ_0 H/(η U)"));
        }
        if let Some(gradient) = self.flow.pressure_gradient {
            numbers.push(SceneNumber::new("yield_over_drive", yield_stress / (gradient * h), "τ_0/(-dp/dx H)"));
        }
        if let Some(u_star) = self.flow.u_star {
            numbers.push(SceneNumber::new("reynolds_friction", density * u_star * h / viscosity, "u_* H/ν"));
        }
        numbers
    }
}

/// A flow whose geometry is a matter of the model: its matter alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BenchmarkScene {
    /// The fluid, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Material>,
    /// The grains, if there are some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<Grains>,
}
