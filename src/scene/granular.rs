//! Grains without a fluid that drives them: a film, a chute, a bed at rest.

use serde::Serialize;

use super::{Bed, Grains, SceneNumber};
use crate::case::Fault;
use crate::case::tables::SlopeDefinition;

/// Grains without a fluid that drives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GranularScene {
    /// the grains
    pub grains: Grains,
    /// the layer at rest
    pub bed: Bed,
    /// its tilt and its walls
    pub flow: GranularFlow,
}

/// Tilt and walls of a layer of grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GranularFlow {
    /// slope, as its definition says; 0 is a bed at rest
    pub slope: f64,
    /// what the number given as slope is
    pub slope_definition: SlopeDefinition,
    /// gravity [m/s2]
    pub gravity: f64,
    /// distance of side walls \[m]; `None`: as wide as no wall matters
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
}

impl GranularFlow {
    /// Angle of the slope with the horizontal \[rad].
    ///
    /// # Errors
    /// [`Fault::TooSteep`].
    pub fn angle(&self) -> Result<f64, Fault> {
        self.slope_definition.angle(self.slope)
    }
}

impl GranularScene {
    pub(super) fn numbers(&self) -> Vec<SceneNumber> {
        let mut numbers = Vec::new();
        if let Ok(angle) = self.flow.angle() {
            numbers.push(SceneNumber::new("slope_tangent", angle.tan(), "shear stress over pressure of a steady flow"));
        }
        let layers = self.bed.thickness.map(|thickness| thickness / self.grains.diameter);
        numbers.extend(layers.map(|layers| SceneNumber::new("layers", layers, "thickness over d")));
        numbers
    }
}
