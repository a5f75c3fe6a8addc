//! The tables of a case file as typed values in SI. Doc lines, units and ranges here are the schema, the diagnostics
//! and the case reference: nothing says them a second time.
//!
//! `x-unit` is the SI unit of a quantity; a string with any unit of that dimension is accepted in its place.

use std::f64::consts::FRAC_PI_2;

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use super::fault::Fault;
use crate::closures::dilatancy::Dilatancy;
use crate::closures::drag::Drag;
use crate::closures::friction::Friction;
use crate::closures::mixing_length::MixingLength;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::regularisation::Smoothing;
use crate::closures::wall::Wall;

/// What the case is about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct About {
    /// The question that the case answers, in one line.
    pub title: String,
}

/// The fluid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Fluid {
    /// Density of the fluid.
    #[schemars(extend("x-unit" = "kg/m3", "exclusiveMinimum" = 0.0, "maximum" = 20000.0))]
    pub density: f64,
    /// Dynamic viscosity of the fluid; a kinematic viscosity times the density.
    #[schemars(extend("x-unit" = "Pa s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub viscosity: f64,
}

/// A fluid with a yield stress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BinghamFluid {
    /// Density of the material.
    #[schemars(extend("x-unit" = "kg/m3", "exclusiveMinimum" = 0.0, "maximum" = 20000.0))]
    pub density: f64,
    /// Plastic viscosity of the material.
    #[schemars(extend("x-unit" = "Pa s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub viscosity: f64,
    /// Yield stress of the material; 0 is a Newtonian fluid.
    #[schemars(extend("x-unit" = "Pa", "minimum" = 0.0, "maximum" = 1e9))]
    pub yield_stress: f64,
}

/// The grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grains {
    /// Diameter of the grains.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub diameter: f64,
    /// Density of the grains.
    #[schemars(extend("x-unit" = "kg/m3", "exclusiveMinimum" = 0.0, "maximum" = 30000.0))]
    pub density: f64,
}

/// A bed of grains at the bottom of the flow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bed {
    /// Bed level h_p: height of the top of the grains over the lower wall; below the flow height.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub level: f64,
    /// Solid fraction of the bed, the same at every depth; 0.7405 is the densest packing of equal spheres.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi: f64,
}

/// A film of grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Film {
    /// Solid fraction of the film, the same at every depth.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi: f64,
}

/// A flow between two planes over a bed. Exactly one drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(transform = laminar_drives)]
pub struct LaminarFlow {
    /// Flow height H: distance between the lower and the upper wall, bed included.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: fall of pressure along the flow, -dp/dx.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub pressure_gradient: Option<f64>,
    /// Drive: wanted Shields number; the pressure gradient that gives it is solved for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub shields: Option<f64>,
    /// Acceleration of gravity.
    #[serde(default = "standard_gravity")]
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub gravity: f64,
}

/// A flow between two planes. Exactly one drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(transform = plane_drives)]
pub struct PlaneFlow {
    /// Flow height H: distance between the two planes.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: fall of pressure along the flow, -dp/dx.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub pressure_gradient: Option<f64>,
    /// Drive: wanted mean velocity; the pressure gradient that gives it is solved for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub mean_velocity: Option<f64>,
}

/// A film that flows down a slope under its own weight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmFlow {
    /// Thickness H of the film, normal to the slope.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: the slope, as slope_definition says, or an angle.
    #[schemars(extend("x-unit" = "1", "x-angle" = "slope_definition", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub slope: f64,
    /// What the number given as slope is: papers differ. With a slope such as "2 deg" it is the angle.
    pub slope_definition: SlopeDefinition,
    /// Acceleration of gravity.
    #[serde(default = "standard_gravity")]
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    pub gravity: f64,
}

/// What the number given as slope is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SlopeDefinition {
    /// Tangent of the angle with the horizontal.
    Tangent,
    /// Sine of the angle with the horizontal.
    Sine,
    /// The angle with the horizontal itself, in radians, or as "24 deg".
    Angle,
}

impl SlopeDefinition {
    /// Angle with the horizontal \[rad\] of a slope given as `slope`.
    ///
    /// # Errors
    /// [`Fault::TooSteep`] for the vertical and beyond.
    pub fn angle(self, slope: f64) -> Result<f64, Fault> {
        let (definition, beta) = match self {
            Self::Tangent => ("tangent", slope.atan()),
            Self::Sine => ("sine", slope.asin()),
            Self::Angle => ("angle", slope),
        };
        // The arc sine of more than 1 is not a number, which is not less than pi/2 either.
        if beta < FRAC_PI_2 { Ok(beta) } else { Err(Fault::TooSteep { definition, value: slope }) }
    }
}

/// A turbulent flow over a wall, driven by the stress at the wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallFlow {
    /// Flow height H: elevation up to which the profile is given.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: friction velocity sqrt(tau/rho_f).
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub u_star: f64,
}

/// The model: Ouriemi's bed in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OuriemiModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Newtonian fluid over a Coulomb bed between two planes.
    pub solution: OuriemiSolution,
    /// One velocity for fluid and grains, or two.
    pub form: Form,
}

/// The model: Bingham plane Poiseuille flow in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BinghamModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Bingham fluid between two planes.
    pub solution: BinghamSolution,
}

/// The model: Bagnold's granular film in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BagnoldModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Dry grains down a slope.
    pub solution: BagnoldSolution,
}

/// The model: the logarithmic law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LogLawModel {
    /// What kind of model: this one is a closed form.
    pub kind: ExactKind,
    /// Turbulent layer of constant stress over a rough wall.
    pub solution: LogLawSolution,
}

/// The model: a laminar bed, solved numerically.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LaminarModel {
    /// What kind of model: a laminar flow over a bed.
    pub kind: LaminarKind,
    /// One velocity for fluid and grains, or two.
    pub form: Form,
}

/// The model: a Bingham fluid between two planes, solved numerically.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BinghamKindModel {
    /// What kind of model: plane flow of a Bingham fluid.
    pub kind: BinghamKind,
}

/// How the yield stress is smoothed, and by how much: a size for every law but `none`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RegularisationTable {
    /// Law of the smoothing.
    #[serde(default)]
    pub law: Smoothing,
    /// Size: shear rate below which the material creeps instead of standing still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1/s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub lambda: Option<f64>,
    /// Size in the model's unit of shear rate: (rho_p - rho_f) g H/eta for a bed; for a Bingham fluid U_m/H, or G H/eta where the gradient G is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub lambda_scaled: Option<f64>,
}

/// Cells of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct YieldGrid {
    /// Number of cells.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 8, "maximum" = 1_000_000))]
    pub cells: usize,
    /// Whether a node is placed on the yield level, where the solution has a corner.
    #[serde(default = "yes")]
    pub yield_node: bool,
}

impl Default for YieldGrid {
    fn default() -> Self {
        Self { cells: cells(), yield_node: true }
    }
}

fn yes() -> bool {
    true
}

macro_rules! only {
    ($(#[$doc:meta])* $name:ident, $variant:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum $name {
            $(#[$doc])*
            $variant,
        }
    };
}

only!(
    /// Closed forms.
    ExactKind,
    Exact
);
only!(
    /// A laminar flow over a bed, solved numerically.
    LaminarKind,
    Laminar
);
only!(
    /// Plane flow of a Bingham fluid, solved numerically.
    BinghamKind,
    Bingham
);
only!(
    /// Newtonian fluid over a Coulomb bed between two planes.
    OuriemiSolution,
    Ouriemi
);
only!(
    /// Bingham fluid between two planes.
    BinghamSolution,
    BinghamPlane
);
only!(
    /// Dry grains down a slope.
    BagnoldSolution,
    BagnoldFilm
);
only!(
    /// Turbulent layer of constant stress over a rough wall.
    LogLawSolution,
    LogLaw
);

/// One velocity for fluid and grains, or two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// Fluid and grains share one velocity.
    Mixed,
    /// Two velocities, coupled by the drag: a flow through the static bed, a slip in the mobile one, a threshold of motion.
    TwoFluid,
}

/// Laws of the laminar bed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedClosures {
    /// Friction of the grains.
    pub friction: Friction,
    /// Effective viscosity of the mixture.
    pub mixture_viscosity: MixtureViscosity,
    /// Drag between the phases; only the two-fluid form has it.
    #[serde(default)]
    pub drag: Drag,
    /// Solid fraction of sheared grains; only with friction by mu(I_v).
    #[serde(default)]
    pub dilatancy: Dilatancy,
}

/// Laws of the granular film.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmClosures {
    /// Friction of the grains.
    pub friction: Friction,
}

/// Laws of the turbulent layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallClosures {
    /// Mixing length.
    pub mixing_length: MixingLength,
    /// Roughness of the wall.
    pub wall: Wall,
}

/// The levels at which the profile is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grid {
    /// Number of cells: the profile is given at their centres and at the walls; their faces lie on the yield and bed levels.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 10, "maximum" = 1_000_000))]
    pub cells: usize,
}

impl Default for Grid {
    fn default() -> Self {
        Self { cells: cells() }
    }
}

fn standard_gravity() -> f64 {
    9.81
}

fn cells() -> usize {
    200
}

/// Exactly one of `drives` must be given: a JSON Schema `oneOf` of `required`.
pub(crate) fn one_of(schema: &mut Schema, drives: &[&str]) {
    let choices: Vec<_> = drives.iter().map(|drive| serde_json::json!({ "required": [drive] })).collect();
    schema.insert("oneOf".into(), choices.into());
}

fn laminar_drives(schema: &mut Schema) {
    one_of(schema, &["pressure_gradient", "shields"]);
}

fn plane_drives(schema: &mut Schema) {
    one_of(schema, &["pressure_gradient", "mean_velocity"]);
}
