//! The tables that only a sheet flow has.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::dilatancy::PhiI;
use crate::closures::drag::Dallavalle;
use crate::closures::friction::{FrictionLaw, MuI};

use crate::closures::mixing_length::LiSawamoto;
use crate::closures::mixture_viscosity::{Boyer, MixtureViscosity};
use crate::closures::rearrangement::Rearrangement;
use crate::closures::role::Only;
use crate::closures::suspension::{Rouse, Suspension};
use crate::part;

/// How the discrete equations are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SheetMethod {
    /// Newton's method on the whole column.
    #[default]
    Newton,
    /// The pseudo-time iteration of Revil-Baudard & Chauchat (2013), Appendix B; it needs a regularisation.
    Iteration,
}

/// Small numbers of the sheet flow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SheetRegularisation {
    /// Law of the smoothing of the yield.
    #[serde(default)]
    pub law: SheetSmoothing,
    /// Size: shear rate below which the grains creep instead of standing still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1/s", "exclusiveMinimum" = 0.0, "maximum" = 1e3))]
    pub lambda: Option<f64>,
    /// Solid volume per area under the interface, in grain diameters, in which the buoyancy of the viscous stress is left out
    /// of the momentum of the grains.
    #[serde(default = "interface_cut")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 100.0))]
    pub interface_cut: f64,
    /// Whether more is left out where the equations change type deeper; if not, the case fails there.
    #[serde(default = "deepen")]
    pub deepen_cut: bool,
}

fn deepen() -> bool {
    true
}

fn interface_cut() -> f64 {
    0.3
}

impl Default for SheetRegularisation {
    fn default() -> Self {
        Self { law: SheetSmoothing::None, lambda: None, interface_cut: interface_cut(), deepen_cut: deepen() }
    }
}

/// How the yield is smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SheetSmoothing {
    /// The exact yield: rigid below it.
    #[default]
    None,
    /// gamma/(|gamma| + lambda): eq. (22) of Revil-Baudard & Chauchat (2013).
    Simple,
}

/// Cells of the column.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SheetGrid {
    /// Number of cells, three quarters of them in the bed.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 40, "maximum" = 100_000))]
    pub cells: usize,
}

fn cells() -> usize {
    300
}

impl Default for SheetGrid {
    fn default() -> Self {
        Self { cells: cells() }
    }
}

/// Settings of the pseudo-time iteration; Newton's method takes none of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SheetSolver {
    /// Step of pseudo-time, the same for both velocities.
    #[serde(default = "time_step")]
    #[schemars(extend("x-unit" = "s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub time_step: f64,
    /// Relative residual at which the iteration has converged.
    #[serde(default = "tolerance")]
    #[schemars(extend("x-unit" = "1", "minimum" = 1e-12, "maximum" = 1e-3))]
    pub tolerance: f64,
    /// Iterations after which the method gives up.
    #[serde(default = "max_iterations")]
    #[schemars(extend("minimum" = 1, "maximum" = 100_000_000))]
    pub max_iterations: usize,
}

fn time_step() -> f64 {
    0.05
}

fn tolerance() -> f64 {
    1e-9
}

fn max_iterations() -> usize {
    200_000
}

impl Default for SheetSolver {
    fn default() -> Self {
        Self { time_step: time_step(), tolerance: tolerance(), max_iterations: max_iterations() }
    }
}

/// What the top of the bed is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BedLevel {
    /// It is that of the bed at rest: its grains, bed.phi times the thickness, are those of every model of the scene. They are
    /// conserved between bed and suspension, and the interface in the flow follows.
    #[default]
    AtRest,
    /// The thickness of the bed is that of the bed in the flow, up to the interface; the amount of grains follows.
    InFlow,
}

/// Laws of the sheet flow; the top and the settling velocity are those of the flow and of the grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(bound = "")]
#[schemars(bound = "")]
pub struct SheetLaws<F: FrictionLaw = MuI> {
    /// Friction of the grains.
    #[serde(default)]
    pub friction: Only<F>,
    /// Dilatancy of the grains.
    #[serde(default)]
    pub dilatancy: Only<PhiI>,
    /// Rearrangement time of the grains.
    #[serde(default)]
    pub rearrangement: Rearrangement,
    /// Effective viscosity of the mixture.
    #[serde(default = "boyer")]
    pub mixture_viscosity: MixtureViscosity,
    /// Drag between the phases.
    #[serde(default)]
    pub drag: Only<Dallavalle>,
    /// Mixing length of the turbulence.
    #[serde(default)]
    pub mixing_length: Only<LiSawamoto>,
    /// Grains in suspension.
    #[serde(default = "rouse")]
    pub suspension: Suspension,
}

/// Viscosity of a bed of spheres that jams where they do.
fn boyer() -> MixtureViscosity {
    MixtureViscosity::Boyer(Boyer { phi_max: PhiI::default().phi_max })
}

fn rouse() -> Suspension {
    Suspension::Rouse(Rouse { settling_velocity: None })
}

impl<F: FrictionLaw> Default for SheetLaws<F> {
    fn default() -> Self {
        Self {
            friction: Only::default(),
            dilatancy: Only::default(),
            rearrangement: Rearrangement::default(),
            mixture_viscosity: boyer(),
            drag: Only::default(),
            mixing_length: Only::default(),
            suspension: rouse(),
        }
    }
}

part! {
    /// Turbulent flow over a bed of grains that shear as dense granular flow, with a suspension above.
    #[schemars(rename = "SheetTable")]
    pub struct SheetTable<F: FrictionLaw = MuI> {
        /// What the top of the bed is.
        #[serde(default)]
        bed_level: BedLevel,
        /// How the discrete equations are solved.
        #[serde(default)]
        method: SheetMethod,
        /// Laws.
        #[serde(default)]
        closures: SheetLaws<F>,
        /// Small numbers.
        #[serde(default)]
        regularisation: SheetRegularisation,
        /// Cells of the column.
        #[serde(default)]
        grid: SheetGrid,
        /// The iteration.
        #[serde(default)]
        solver: SheetSolver,
    }
}
