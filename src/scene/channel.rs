//! A flow without grains, and one whose geometry is a matter of the model.

use serde::Serialize;

use super::bed::Section;
use super::{Grains, SceneNumber};
use crate::case::tables::{BinghamFluid, Fluid};

/// A fluid with or without a yield stress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Material {
    /// density [kg/m3]
    pub density: f64,
    /// viscosity, the plastic one of a yield-stress fluid [Pa s]
    pub viscosity: f64,
    /// yield stress \[Pa]; 0 is a Newtonian fluid
    pub yield_stress: f64,
}

impl From<&BinghamFluid> for Material {
    fn from(fluid: &BinghamFluid) -> Self {
        Self { density: fluid.density, viscosity: fluid.viscosity, yield_stress: fluid.yield_stress }
    }
}

impl From<&Fluid> for Material {
    fn from(fluid: &Fluid) -> Self {
        Self { density: fluid.density, viscosity: fluid.viscosity, yield_stress: 0.0 }
    }
}

/// A flow without grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChannelScene {
    /// the fluid
    pub fluid: Material,
    /// the channel and what drives the flow
    pub flow: ChannelFlow,
}

/// A channel, and the one drive of the flow in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChannelFlow {
    /// depth, distance of two planes, height of a section \[m]
    pub depth: f64,
    /// cross-section of a closed duct; `None`: plane
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_gradient: Option<f64>,
    /// mean velocity [m/s]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_velocity: Option<f64>,
    /// friction velocity [m/s]
    #[serde(skip_serializing_if = "Option::is_none")]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BenchmarkScene {
    /// the fluid, if there is one
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Material>,
    /// the grains, if there are some
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<Grains>,
}
