//! The tables of a case file that several models have, as typed values in SI. Doc lines, units and ranges here are the schema, the diagnostics
//! and the case reference: nothing says them a second time.
//!
//! `x-unit` is the SI unit of a quantity; a string with any unit of that dimension is accepted in its place.

use std::f64::consts::FRAC_PI_2;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::Fault;

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

/// A pressure gradient that goes to and fro, of the fluid and the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Oscillation {
    /// Amplitude G of the fall of pressure along the flow: -dp/dx = G cos(2 pi t/period).
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub amplitude: f64,
    /// Period.
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub period: f64,
}

/// A moment of a recorded series.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Moment {
    /// When.
    #[schemars(extend("x-unit" = "s", "minimum" = 0.0, "maximum" = 1e9))]
    pub time: f64,
    /// Fall of pressure along the flow then, -dp/dx.
    #[schemars(extend("x-unit" = "Pa/m", "minimum" = -1e9, "maximum" = 1e9))]
    pub pressure_gradient: f64,
}

/// Outline of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// A rectangle, or a square.
    Rectangle,
    /// A circle.
    Circle,
    /// Two planes without side walls: the same elements give the plane flow.
    Planes,
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

pub(crate) fn standard_gravity() -> f64 {
    9.81
}

pub(crate) fn cells() -> usize {
    200
}

/// An enum with one word: the tag by which a case names its model.
macro_rules! only {
    ($(#[$doc:meta])* $name:ident, $variant:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize, ::schemars::JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum $name {
            $(#[$doc])*
            $variant,
        }
    };
}
pub(crate) use only;
