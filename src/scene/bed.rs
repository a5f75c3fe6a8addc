//! A flow over a bed of grains, and the numbers that it fixes.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `theta` | Shields number of the drive, `tau/((rho_p - rho_f) g d)` | 1 |
//! | `u_*` | its friction velocity, `sqrt(tau/rho_f)` | m/s |
//! | `w_s` | settling velocity, given or of a sphere | m/s |
//! | `s` | `rho_p/rho_f` | 1 |

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Given, Grains, SceneNumber};
use crate::case::Fault;
use crate::case::tables::{Fluid, Moment, Oscillation, Shape, SlopeDefinition, standard_gravity};
use crate::closures::lid::{self, Lid};
use crate::closures::settling;

/// Von Karman's constant, in the Rouse number.
const KAPPA: f64 = 0.41;

/// A flow over a bed of grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedScene {
    /// The fluid.
    pub fluid: Fluid,
    /// The grains.
    pub grains: Grains,
    /// The bed at rest.
    #[serde(default)]
    pub bed: Bed,
    /// The flow over it, and what drives it.
    pub flow: BedFlow,
}

/// A packed bed at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bed {
    /// Thickness of the packed bed at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub thickness: Option<f64>,
    /// Solid fraction of the bed at rest; left out, it is 0.6. 0.7405 is the densest packing of equal spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi: Option<f64>,
}

impl Bed {
    /// Solid fraction: given, or that of a random packing of spheres with friction.
    #[must_use]
    pub fn phi(&self) -> Given {
        self.phi.map_or(Given::Derived(0.6), Given::Given)
    }

    /// Solid volume per area \[m].
    #[must_use]
    pub fn solid_volume(&self) -> Option<f64> {
        Some(self.thickness? * self.phi().value())
    }
}

/// The clear fluid over a bed, and what drives it: under a free surface two of depth, slope and stress (shields or u_star), under a lid or a
/// plane the depth and one drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedFlow {
    /// Depth of the clear fluid over the bed at rest; left out, it follows from the drive or from the top.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "minimum" = 0.0, "maximum" = 1e4))]
    pub depth: Option<f64>,
    /// What bounds the flow above.
    #[serde(default)]
    pub top: Top,
    /// Distance of the side walls; left out, the flow is so wide that no wall matters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub width: Option<f64>,
    /// Cross-section of a closed duct.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// Drive: the slope, as slope_definition says, or an angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "x-angle" = "slope_definition", "minimum" = 0.0, "maximum" = 10.0))]
    pub slope: Option<f64>,
    /// What the number given as slope is: papers differ. With a slope such as "2 deg" it is the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_definition: Option<SlopeDefinition>,
    /// Drive: Shields number, the stress on the bed over (rho_p - rho_f) g d.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub shields: Option<f64>,
    /// Drive: friction velocity at the bed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub u_star: Option<f64>,
    /// Drive: fall of pressure along the flow, -dp/dx.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "Pa/m", "exclusiveMinimum" = 0.0, "maximum" = 1e9))]
    pub pressure_gradient: Option<f64>,
    /// Drive: discharge of the fluid per unit width.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m2/s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub discharge: Option<f64>,
    /// Drive: mean velocity of fluid and grains over bed and flow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub mean_velocity: Option<f64>,
    /// Acceleration of gravity.
    #[schemars(extend("x-unit" = "m/s2", "exclusiveMinimum" = 0.0, "maximum" = 1000.0))]
    #[serde(default = "standard_gravity")]
    pub gravity: f64,
    /// Waves: a pressure gradient that goes to and fro, besides the steady drive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub oscillation: Option<Oscillation>,
    /// Waves as they were measured: a pressure gradient at moments, straight between them, besides the steady drive.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recorded: Vec<Moment>,
}

impl BedFlow {
    /// A flow under `top` with nothing that drives it.
    #[must_use]
    pub fn new(top: Top, gravity: f64) -> Self {
        Self {
            depth: None,
            top,
            width: None,
            section: None,
            slope: None,
            slope_definition: None,
            shields: None,
            u_star: None,
            pressure_gradient: None,
            discharge: None,
            mean_velocity: None,
            gravity,
            oscillation: None,
            recorded: Vec::new(),
        }
    }

    /// Whether a pressure gradient goes to and fro.
    #[must_use]
    pub fn waves(&self) -> bool {
        self.oscillation.is_some() || !self.recorded.is_empty()
    }

    /// Angle with the horizontal \[rad] of the slope, if there is one.
    ///
    /// # Errors
    /// [`Fault::TooSteep`].
    pub fn angle(&self) -> Result<Option<f64>, Fault> {
        self.slope.zip(self.slope_definition).map(|(slope, definition)| definition.angle(slope)).transpose()
    }

    /// Sine of the slope, if there is one: the number itself where it was given as such.
    ///
    /// # Errors
    /// [`Fault::TooSteep`].
    pub fn sine(&self) -> Result<Option<f64>, Fault> {
        let angle = self.angle()?;
        Ok(match (self.slope, self.slope_definition) {
            (Some(slope), Some(SlopeDefinition::Sine)) => Some(slope),
            _ => angle.map(f64::sin),
        })
    }
}

/// What bounds a flow above: a word, or a law with what it needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Top {
    /// A free surface.
    #[default]
    FreeSurface,
    /// A plane on which the fluid does not slip.
    Plane,
    /// The lid of a duct that takes a given stress from the flow.
    Stress(lid::Stress),
    /// The lid of a duct, its stress solved for: the slope and the stress on the bed are given.
    Solved,
    /// The lid of a duct with the friction of Colebrook and White.
    ColebrookWhite(lid::ColebrookWhite),
    /// A free surface over the fixed grains under a bed that is let fall: the depth is known after the deposit.
    OverFixedGrains {
        /// Height of the surface over the mean centre of the fixed grains.
        #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e2))]
        height: f64,
    },
}

impl From<Lid> for Top {
    fn from(lid: Lid) -> Self {
        match lid {
            Lid::FreeSurface => Self::FreeSurface,
            Lid::Stress(law) => Self::Stress(law),
            Lid::Solved => Self::Solved,
            Lid::ColebrookWhite(law) => Self::ColebrookWhite(law),
        }
    }
}

impl Top {
    /// Its word in a case.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::FreeSurface => "free-surface",
            Self::Plane => "plane",
            Self::Stress(_) => "stress",
            Self::Solved => "solved",
            Self::ColebrookWhite(_) => "colebrook-white",
            Self::OverFixedGrains { .. } => "over-fixed-grains",
        }
    }

    /// The law of the stress on the top of a turbulent flow; `None` for a top that is none of them.
    #[must_use]
    pub fn lid(&self) -> Option<Lid> {
        match *self {
            Self::FreeSurface => Some(Lid::FreeSurface),
            Self::Stress(law) => Some(Lid::Stress(law)),
            Self::Solved => Some(Lid::Solved),
            Self::ColebrookWhite(law) => Some(Lid::ColebrookWhite(law)),
            Self::Plane | Self::OverFixedGrains { .. } => None,
        }
    }
}

/// Cross-section of a closed duct; its height is that of bed and flow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Section {
    /// Outline.
    pub shape: Shape,
    /// Width of a rectangle; left out, it is a square.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub width: Option<f64>,
}

impl BedScene {
    /// Stress scale (rho_p - rho_f) g d \[Pa].
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.grains.density - self.fluid.density) * self.flow.gravity * self.grains.diameter
    }

    /// Kinematic viscosity of the fluid [m2/s].
    #[must_use]
    pub fn nu(&self) -> f64 {
        self.fluid.viscosity / self.fluid.density
    }

    /// Shields number of the drive, in closed form: as wanted, or the weight of the fluid along the slope. `None` where the
    /// stress on the bed is an outcome.
    #[must_use]
    pub fn shields_drive(&self) -> Option<f64> {
        let flow = &self.flow;
        let weight = || {
            let (depth, sine) = (self.depth()?, flow.sine().ok()?.or(self.slope().map(f64::sin))?);
            (flow.top == Top::FreeSurface)
                .then(|| self.fluid.density * flow.gravity * depth * sine / self.stress_scale())
        };
        let of_u_star = || Some(self.fluid.density * flow.u_star?.powi(2) / self.stress_scale());
        flow.shields.or_else(of_u_star).or_else(weight)
    }

    /// Friction velocity of the drive [m/s].
    #[must_use]
    pub fn u_star_drive(&self) -> Option<f64> {
        Some(self.u_star(self.shields_drive()?))
    }

    /// Friction velocity [m/s] of the Shields number `theta`.
    #[must_use]
    pub fn u_star(&self, theta: f64) -> f64 {
        (theta.max(0.0) * self.stress_scale() / self.fluid.density).sqrt()
    }

    /// Settling velocity [m/s]: given, or that of a sphere alone ([`settling`]).
    #[must_use]
    pub fn settling_velocity(&self) -> Given {
        let Grains { diameter, density, settling_velocity, .. } = self.grains;
        let buoyant = (density / self.fluid.density - 1.0) * self.flow.gravity;
        let sphere = || settling::sphere(buoyant, self.nu(), diameter);
        settling_velocity.map_or_else(|| Given::Derived(sphere()), Given::Given)
    }

    pub(super) fn numbers(&self) -> Vec<SceneNumber> {
        let (d, nu, eta) = (self.grains.diameter, self.nu(), self.fluid.viscosity);
        let s = self.grains.density / self.fluid.density;
        let w_s = self.settling_velocity().value();
        let mut numbers = vec![
            SceneNumber::new("density_ratio", s, "ρ_p/ρ_f"),
            SceneNumber::new(
                "galileo",
                ((s - 1.0) * self.flow.gravity * d * d * d).sqrt() / nu,
                "((ρ_p/ρ_f - 1) g d³)^(1/2)/ν",
            ),
            SceneNumber::new("settling_velocity_m_s", w_s, "w_s: given, or of a sphere alone, Cheng (2009)"),
        ];
        numbers.extend(self.depth().map(|depth| SceneNumber::new("submergence", depth / d, "depth over d")));
        let Some((theta, u_star)) = self.shields_drive().zip(self.u_star_drive()) else { return numbers };
        numbers.extend([
            SceneNumber::new("shields_drive", theta, "τ/((ρ_p - ρ_f) g d) of the drive alone, no side walls"),
            SceneNumber::new("u_star_drive_m_s", u_star, "u_* = (τ/ρ_f)^(1/2) of the drive alone"),
            SceneNumber::new("reynolds_grain", u_star * d / nu, "u_* d/ν"),
            SceneNumber::new("suspension", w_s / u_star, "w_s/u_*: the turbulence carries grains below 1"),
            SceneNumber::new("rouse", w_s / (KAPPA * u_star), "w_s/(0.41 u_*)"),
            SceneNumber::new(
                "stokes",
                self.grains.density * u_star * d / (9.0 * eta),
                "ρ_p u_* d/(9 η): collisions at u_*",
            ),
            SceneNumber::new("bagnold", self.grains.density * u_star * d / eta, "ρ_p d² (u_*/d)/η"),
        ]);
        numbers
    }
}
