//! Problems of grains in a fluid.

use super::case::{CoupledDiscrete, CoupledTable, FluidScheme};
use super::{advice, equations, figures, run, study};
use crate::case::Fault;
use crate::closures::contact::linear_spring;
use crate::closures::drag::{DallavalleGrain, dallavalle_grain};
use crate::closures::fluctuation::Fluctuation;
use crate::closures::mixing_length::MixingLength;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::role::Only;
use crate::closures::side_wall::{self, SideWall};
use crate::dem::drive::accepts;
use crate::dem::keep::law;
use crate::dem::{Bottom, GrainBed, stability};
use crate::model::{Description, Faults, Flow, Model, ModelInfo, Offer, Solve, StudyPlan, Term};
use crate::models::BedFault;
use crate::result::Premise;
use crate::result::Results;
use crate::scene::Scene;

use crate::models::{derived, layers, load};
use crate::result::Context;
use crate::result::{CheckpointError, Failure, Figure, Outcome};
use crate::scene::{BedScene, Top};

/// Grains in a fluid that flows over them. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled {
    /// the grains, their bed and channel
    pub bed: GrainBed,
    /// elevations of the fixed grains
    pub relief: Relief,
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// the free surface
    pub surface: Surface,
    /// drag on single grains
    pub drag: DallavalleGrain,
    /// mixing length of the turbulence
    pub mixing_length: MixingLength,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// friction of the fluid on the side walls
    pub side_wall: SideWall,
    /// eddies that a grain meets
    pub fluctuation: Fluctuation,
    /// time between two solutions of the fluid \[s]
    pub coupling_period: f64,
    /// steps of the fluid in that time
    pub fluid_steps: u32,
    /// how it is stepped
    pub fluid_scheme: FluidScheme,
    /// how the deep bed is frozen, if it is
    pub freeze: Option<Freeze>,
    /// time between two samples \[s]
    pub sample_period: f64,
    /// standard error of the transport rate, relative to it, with which the run ends
    pub known_to: Option<f64>,
}

/// When layers of the deep bed are frozen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Freeze {
    /// mean displacement of a layer at rest in a period, in grain diameters
    pub creep: f64,
    /// time between two checks of the layers \[s]
    pub period: f64,
    /// time of the first check \[s]
    pub after: f64,
}

/// Elevations of the fixed grains around their mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// largest elevation \[m]
    pub largest: f64,
    /// step between elevations \[m]
    pub step: f64,
}

/// Where the free surface is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// over the mean centre of the fixed grains \[m]
    Height(f64),
    /// over the level of the bed at rest \[m]
    Depth(f64),
}

impl Coupled {
    /// Kinematic viscosity of the fluid [m2/s].
    #[must_use]
    pub fn nu(&self) -> f64 {
        self.eta / self.rho_f
    }

    /// Stress scale (rho_p - rho_f) g d \[Pa].
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.bed.rho_p - self.rho_f) * self.bed.g * self.bed.d
    }
}

/// Most grains of a case.
const MAX_GRAINS: f64 = 2e7;

impl Model for Coupled {
    const INFO: ModelInfo = ModelInfo::new("coupled")
        .taking(&["slope", "shields", "u_star", "width"])
        .under(&["free-surface", "over-fixed-grains"])
        .stochastic();
    type Scene = BedScene;
    type Table = CoupledTable;

    fn build(scene: &BedScene, table: &CoupledTable, faults: &mut Faults) -> Option<Self> {
        let (fluid, grains, side_walls) = (&scene.fluid, &scene.grains, scene.flow.width.is_some());
        let CoupledTable { cell, closures, discrete, .. } = table;
        let layers = layers(table.layers, &scene.bed, grains.diameter, faults);
        let weight = (grains.density - fluid.density) * scene.flow.gravity;
        let contact = closures.contact.of(grains, load(layers, weight, grains.diameter), faults);
        let [length, width] = cell.size(scene.flow.width, grains.diameter, faults);
        let d = grains.diameter;
        if grains.density <= fluid.density {
            faults.push(("grains.density", BedFault::Floating { grains: grains.density, fluid: fluid.density }));
        }
        // Neither a slope nor a surface is there where the drives of the scene are wrong, which it says itself.
        let beta = scene.slope();
        let surface = match scene.flow.top {
            Top::OverFixedGrains { height } => Some(Surface::Height(height)),
            _ => scene.depth().map(Surface::Depth),
        };
        let layers = layers?;
        let across = if side_walls { (width / d).floor() } else { width / d };
        let count = layers * (length / d) * across.max(1.0);
        let mut within = |path, name: &'static str, value: f64, least: f64, most: f64| {
            if !(least..=most).contains(&value) {
                faults.push((path, BedFault::GrainRoom { name, value, least, most }));
            }
        };
        within("cell.length", "cell.length", length, 4.0 * d, 1e3);
        let across_key = if side_walls { "flow.width" } else { "cell.width" };
        within(across_key, across_key, width, if side_walls { d } else { 4.0 * d }, 1e3);
        within("layers", "the number of mobile grains", count, 1.0, MAX_GRAINS);
        let relief = Relief {
            largest: table.relief.unwrap_or(d / 3.0),
            step: table.relief_step.or(table.relief).unwrap_or(d / 3.0),
        };
        if table.bottom == Bottom::Steps {
            within("relief", "relief", relief.largest, 0.0, d);
        }
        let CoupledDiscrete { coupling_period, sample_period, duration, .. } = *discrete;
        within("discrete.sample_period", "discrete.sample_period", sample_period, coupling_period, duration);
        let usual = if side_walls { SideWall::Blasius } else { SideWall::default() };
        let side_wall = closures.side_wall.unwrap_or(usual);
        if side_wall != SideWall::default() && !side_walls {
            let fault = Fault::LawMismatch {
                family: "side_wall".into(),
                law: side_wall.info().law.into(),
                model: format!("{} without side walls", Self::INFO.name),
                allowed: vec![side_wall::none::INFO.law.into()],
            };
            faults.push(("closures.side_wall.law", fault));
        }
        let Only(drag) = closures.drag;
        let mobile = if (1.0..=MAX_GRAINS).contains(&count) { count.round() as usize } else { 1 };
        Some(Self {
            bed: GrainBed {
                d,
                rho_p: grains.density,
                mobile,
                bottom: table.bottom,
                size: [length, width],
                side_walls,
                smooth_walls: false,
                beta: beta?,
                g: scene.flow.gravity,
                contact: contact?,
                discrete: discrete.grains(),
            },
            relief,
            rho_f: fluid.density,
            eta: fluid.viscosity,
            surface: surface?,
            drag,
            mixing_length: closures.mixing_length,
            viscosity: closures.mixture_viscosity,
            side_wall,
            fluctuation: closures.fluctuation,
            coupling_period,
            fluid_steps: discrete.fluid_steps,
            fluid_scheme: discrete.fluid_scheme,
            freeze: discrete.freeze_below.map(|creep| Freeze {
                creep,
                period: discrete.freeze_period,
                after: discrete.freeze_after,
            }),
            sample_period,
            known_to: discrete.known_to,
        })
    }
    fn offer(flow: &Flow, tolerance: f64) -> Option<Offer> {
        match flow {
            Flow::Turbulent(scene) => Some(advice::offer(scene, tolerance)),
            Flow::Laminar(_) => None,
        }
    }
}

impl Solve for Coupled {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(self, context)
    }

    fn describe(&self) -> Description {
        let laws = vec![
            &linear_spring::INFO,
            &dallavalle_grain::INFO,
            self.mixing_length.info(),
            self.viscosity.info(),
            self.side_wall.info(),
            self.fluctuation.info(),
        ];
        Description { form: None, equations: equations(self), laws }
    }

    fn takes_s(&self) -> Option<f64> {
        /// Steps of a grain in a second, with its fluid: 15 to 20 million with 1000 grains on the machine of docs/grains.md.
        const RATE: f64 = 1.5e7;
        /// Longest step of a bed, whose grains touch several others, over that of a pair: 0.47 to 0.52 in the quick flows.
        const IN_A_BED: f64 = 0.5;
        let discrete = &self.bed.discrete;
        let longest = || {
            Some(IN_A_BED * discrete.safety * stability::of_pair(&law(&self.bed.contact).ok()?, 0.5 * self.bed.mass()))
        };
        let step = discrete.time_step.or_else(longest)?;
        Some(self.bed.mobile as f64 * discrete.duration / step / RATE)
    }

    fn derived(&self) -> Vec<(&'static str, f64, &'static str)> {
        let mut all = derived(&self.bed);
        if self.bed.bottom == Bottom::Steps {
            all.push(("relief", self.relief.largest, "d/3"));
            all.push(("relief_step", self.relief.step, "the relief"));
        }
        all
    }

    fn study(&self) -> StudyPlan {
        study::plan(self)
    }

    fn figures(&self, name: &str, outcome: &Outcome) -> Vec<Figure> {
        outcome.profile.as_ref().map(|profile| figures::figures(name, profile)).unwrap_or_default()
    }

    fn cells(&self) -> usize {
        self.bed.mobile
    }

    fn premises(&self, scene: &Scene, results: &Results) -> Vec<Premise> {
        let Scene::Bed(scene) = scene else { return Vec::new() };
        advice::premises(self, scene, results)
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        Ok(Some(Flow::Turbulent(advice::scene(self))))
    }

    fn terms(&self) -> Vec<Term> {
        advice::terms(self)
    }

    fn accepts(&self, checkpoint: &[u8]) -> Option<Result<(), CheckpointError>> {
        Some(accepts(self, checkpoint))
    }
}
