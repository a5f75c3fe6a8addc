//! Grains without a fluid that drives them: a film, a chute, a bed at rest.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Bed, Grains, SceneNumber};
use crate::case::Fault;
use crate::case::tables::{SlopeDefinition, standard_gravity};

/// Grains without a fluid that drives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GranularScene {
    /// The grains.
    pub grains: Grains,
    /// The layer of grains at rest.
    #[serde(default)]
    pub bed: Bed,
    /// Its tilt and its walls.
    #[serde(default)]
    pub flow: GranularFlow,
}

/// Tilt and walls of a layer of grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GranularFlow {
    /// Drive: the slope, as slope_definition says, or an angle; 0 is a bed at rest.
    #[schemars(extend("x-unit" = "1", "x-angle" = "slope_definition", "minimum" = 0.0, "maximum" = 10.0))]
    #[serde(default)]
    pub slope: f64,
    /// What the number given as slope is: papers differ. With a slope such as "2 deg" it is the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_definition: Option<SlopeDefinition>,
    /// Acceleration of gravity.
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    #[serde(default = "standard_gravity")]
    pub gravity: f64,
    /// Distance of the side walls; left out, the flow is so wide that no wall matters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub width: Option<f64>,
}

impl Default for GranularFlow {
    fn default() -> Self {
        Self { slope: 0.0, slope_definition: None, gravity: standard_gravity(), width: None }
    }
}

impl GranularFlow {
    /// Angle of the slope with the horizontal \[rad].
    ///
    /// # Errors
    /// [`Fault::TooSteep`].
    pub fn angle(&self) -> Result<f64, Fault> {
        // Without a definition it is level: a number without one is a fault of the scene.
        self.slope_definition.map_or(Ok(0.0), |definition| definition.angle(self.slope))
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
