//! Problems of grains and fluid as two fluids.

use super::case::{FluidStress, State, TwoFluidTable};
use super::{equations, figures, run, study};
use crate::case::Fault;
use crate::case::tables::{Moment, Oscillation};
use crate::closures::dispersion::Dispersion;
use crate::closures::drag::DallavalleGrain;
use crate::closures::kinetic::{Elastic, Granular, Moving, StaticFriction, Stresses};
use crate::closures::mixing_length::{self, BelowPacked, MixingLength};
use crate::closures::{Info, drag};
use crate::model::{
    BULK_FRICTION, Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, OwnCase, Solve, SteadyDrive,
    StudyPlan, TurbulentScene,
};
use crate::models::BedFault;
use crate::models::premises;
use crate::models::two_fluid::TwoFluidFault;
use crate::result::Context;
use crate::result::Premise;
use crate::result::Results;
use crate::result::quantity as q;
use crate::result::{Failure, Figure, Outcome};
use crate::scene::BedScene;
use crate::scene::Scene;
use crate::units::significant;

/// How a flow is followed in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeControl {
    /// simulated time \[s]
    pub duration: f64,
    /// relative error of a step
    pub tolerance: f64,
    /// number of samples
    pub samples: usize,
}

/// A two-fluid flow. All values SI.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoFluid {
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains \[m]
    pub d: f64,
    /// restitution coefficient
    pub e: f64,
    /// friction coefficient between two grains
    pub mu_p: f64,
    /// thickness of the layer of grains at rest \[m]
    pub thickness: f64,
    /// its solid fraction
    pub phi: f64,
    /// solid fraction at which the grains jam
    pub phi_max: f64,
    /// depth of the fluid over it \[m]
    pub depth: f64,
    /// angle of the slope \[rad]
    pub beta: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// steady or in time
    pub state: State,
    /// factor of the stress of the fluid
    pub fluid_stress: FluidStress,
    /// stresses of grains that move
    pub granular: Granular,
    /// pressure of enduring contacts
    pub elastic: Elastic,
    /// friction of enduring contacts
    pub static_friction: StaticFriction,
    /// drag between the phases
    pub drag: DallavalleGrain,
    /// mixing length of the turbulence
    pub mixing_length: MixingLength,
    /// grains that the turbulence carries
    pub dispersion: Dispersion,
    /// granular temperature that grains keep in the fluid [m2/s2]
    pub temperature_floor: f64,
    /// shear rate below which enduring contacts creep [1/s]
    pub rate_floor: f64,
    /// solid fraction below which grains have no weight
    pub phi_floor: f64,
    /// distance from the level of the grains at rest within which cells stay fine \[m]; all of the same height without
    pub fine: Option<f64>,
    /// a pressure gradient that oscillates: amplitude [Pa/m], period \[s]
    pub oscillation: Option<Oscillation>,
    /// a pressure gradient as it was measured; none where empty
    pub recorded: Vec<Moment>,
    /// how the flow is followed in time
    pub time: TimeControl,
}

impl TwoFluid {
    /// Stress scale (rho_p - rho_f) g d \[Pa].
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.rho_p - self.rho_f) * self.g * self.d
    }

    /// Velocity scale sqrt((rho_p/rho_f - 1) g d) [m/s].
    #[must_use]
    pub fn velocity_scale(&self) -> f64 {
        (self.stress_scale() / self.rho_f).sqrt()
    }

    /// Whether a pressure gradient goes to and fro.
    #[must_use]
    pub fn waves(&self) -> bool {
        self.oscillation.is_some() || !self.recorded.is_empty()
    }

    /// Nominal Shields number: the weight of the fluid over the grains at rest, along the slope.
    #[must_use]
    pub fn shields(&self) -> f64 {
        self.rho_f * self.g * self.depth * self.beta.sin() / self.stress_scale()
    }
}

impl Model for OnMesh<TwoFluid> {
    const INFO: ModelInfo = ModelInfo::new("two-fluid")
        .taking(&["slope", "shields", "u_star", "oscillation", "recorded"])
        .under(&["free-surface"]);
    type Scene = BedScene;
    type Table = TwoFluidTable;

    fn build(scene: &BedScene, table: &TwoFluidTable, faults: &mut Faults) -> Option<Self> {
        let BedScene { fluid, grains, flow, bed } = scene;
        let TwoFluidTable { closures, regularisation, solver, phi_max, .. } = table;
        let thickness = faults.needed("bed.thickness", bed.thickness);
        let (thickness, phi, phi_max) = (thickness?, bed.phi().value(), *phi_max);
        if grains.density <= fluid.density {
            faults.push(("grains.density", BedFault::Floating { grains: grains.density, fluid: fluid.density }));
        }
        if thickness < grains.diameter {
            let fault = BedFault::ThinnerThanAGrain { level: thickness, diameter: grains.diameter };
            faults.push(("bed.thickness", fault));
        }
        if phi >= phi_max {
            faults.push(("bed.phi", below("phi", phi, phi_max)));
        }
        if let Elastic::JohnsonJackson(law) = closures.elastic
            && law.phi_rlp >= phi_max
        {
            faults.push(("closures.elastic.phi_rlp", below("phi_rlp", law.phi_rlp, phi_max)));
        }
        if let Granular::Inertial(law) = closures.granular
            && law.mu_2 <= law.mu_s
        {
            faults.push(("closures.granular.mu_2", BedFault::FrictionFalls { mu_s: law.mu_s, mu_2: law.mu_2 }));
        }
        if let MixingLength::LiSawamoto(law) = closures.mixing_length
            && law.below_packed == BelowPacked::Zero
        {
            let fault = Fault::LawMismatch {
                family: "mixing_length".into(),
                law: "li-sawamoto with below_packed = \"zero\"".into(),
                model: Self::INFO.name.into(),
                allowed: vec![mixing_length::li_sawamoto::INFO.law.into()],
            };
            faults.push(("closures.mixing_length.below_packed", fault));
        }
        // Neither is there where the drives of the scene are wrong, which it says itself.
        let (depth, beta) = (scene.depth(), scene.slope());
        if flow.waves() && table.state == State::Steady {
            let key = if flow.oscillation.is_some() { "flow.oscillation" } else { "flow.recorded" };
            faults.push((key, TwoFluidFault::NeedsTime));
        }
        if let Some(last) = flow.recorded.last()
            && table.state != State::Steady
            && last.time < solver.duration
        {
            let fault = TwoFluidFault::RecordEnds { record_s: last.time, duration_s: solver.duration };
            faults.push(("solver.duration", fault));
        }
        let problem = TwoFluid {
            rho_f: fluid.density,
            eta: fluid.viscosity,
            rho_p: grains.density,
            d: grains.diameter,
            e: grains.restitution().value(),
            mu_p: grains.friction().value(),
            thickness,
            phi,
            phi_max,
            depth: depth?,
            beta: beta?,
            g: flow.gravity,
            state: table.state,
            fluid_stress: table.fluid_stress,
            granular: closures.granular,
            elastic: closures.elastic,
            static_friction: closures.static_friction,
            drag: closures.drag.0,
            mixing_length: closures.mixing_length,
            dispersion: closures.dispersion,
            temperature_floor: regularisation.granular_temperature,
            rate_floor: regularisation.shear_rate,
            phi_floor: regularisation.phi,
            fine: table.grid.fine,
            oscillation: flow.oscillation,
            recorded: flow.recorded.clone(),
            time: TimeControl { duration: solver.duration, tolerance: solver.tolerance, samples: solver.samples },
        };
        Some(Self { problem, cells: table.grid.cells })
    }

    fn offer(flow: &Flow, tolerance: f64) -> Option<Offer> {
        /// Largest deviation from the grains, -4 to +14 % from this Shields number on, to 1 (docs/kinetic.md). Below, at 0.2,
        /// more than half of the transport is missed.
        const MEASURED: (f64, f64) = (0.4, 0.15);
        let Flow::Turbulent(scene) = flow else { return None };
        let known = !scene.walls && scene.is_measured() && scene.at_least(MEASURED.0);
        if !known || scene.suspends() || tolerance < MEASURED.1 {
            return None;
        }
        let [wanted, off] = [tolerance, MEASURED.1].map(|share| format!("{} %", significant(100.0 * share, 2)));
        let theta = significant(scene.theta, 3);
        Some(Offer {
            effort: Effort::Seconds,
            because: format!("θ = {theta}, and {wanted} is enough: it is within {off} of the grains"),
            off: "4 % less to 14 % more than the grains (docs/kinetic.md)",
            case: OwnCase::Scene(Vec::new()),
        })
    }
}

impl Solve for OnMesh<TwoFluid> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn figures(&self, name: &str, outcome: &Outcome) -> Vec<Figure> {
        figures::figures(name, outcome)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: laws(&self.problem) }
    }

    fn study(&self) -> StudyPlan {
        study::plan(&self.problem)
    }

    fn drive(&self) -> Option<SteadyDrive> {
        let flow = &self.problem;
        let (at_s, hint) = match flow.state {
            State::Steady => (None, "state = \"transient\", which follows the flow from rest"),
            State::Transient => (Some(flow.time.duration), "a smaller solver.tolerance, or more grid.cells"),
        };
        let steady = flow.beta > 0.0 && !flow.waves();
        steady.then(|| SteadyDrive { velocity_scale: flow.velocity_scale(), at_s, hint })
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn premises(&self, scene: &Scene, results: &Results) -> Vec<Premise> {
        let (Scene::Bed(scene), flow) = (scene, &self.problem) else { return Vec::new() };
        let of = |quantity: &q::Quantity| results.get(quantity.name);
        let stokes = |heat: f64| flow.rho_p * flow.d * heat.sqrt() / (9.0 * flow.eta);
        let kinetic = !matches!(flow.granular, Granular::Inertial(_));
        let driven = flow.beta > 0.0;
        // In a thin bed the water over it pulls at the bottom, too.
        let on_the_bottom = flow.thickness_at_rest().map(|_| flow.pull_on_the_bottom());
        let found = [
            premises::COLLISIONS.maybe(of(&q::TEMPERATURE_MAX).map(stokes).filter(|_| kinetic)),
            premises::KINETIC_SHIELDS.maybe(scene.shields_drive().filter(|_| kinetic && driven)),
            premises::KINETIC_RESTITUTION.maybe(Some(flow.e).filter(|_| kinetic)),
            premises::KINETIC_FRICTION.maybe(Some(flow.mu_p).filter(|_| kinetic)),
            premises::AT_REST.maybe(of(&q::LAYER_BOTTOM).map(|bottom| bottom / flow.d)),
            premises::SUBMERGED.maybe(Some(flow.depth / flow.d).filter(|_| driven)),
            premises::no_suspension(scene).filter(|_| flow.dispersion == Dispersion::None && driven),
            premises::PACKED_BED.maybe(Some(flow.phi)),
            premises::rests(scene, flow.friction_at_rest(), flow.phi).filter(|_| driven),
            premises::RESTS_ON_ITS_BOTTOM.maybe(on_the_bottom.filter(|_| driven)),
        ];
        found.into_iter().flatten().collect()
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        let flow = &self.problem;
        // Waves, settling and dry grains have no other model.
        let steady = flow.state == State::Steady && !flow.waves();
        let in_water = flow.shields() > 0.0 && flow.rho_p < 20.0 * flow.rho_f;
        Ok((steady && in_water).then(|| {
            Flow::Turbulent(TurbulentScene {
                kind: Self::INFO.name,
                rho_f: flow.rho_f,
                rho_p: flow.rho_p,
                nu: flow.eta / flow.rho_f,
                d: flow.d,
                g: flow.g,
                depth: flow.depth,
                sine: flow.beta.sin(),
                theta: flow.shields(),
                mu_s: BULK_FRICTION,
                contacts: Some((flow.mu_p, flow.e)),
                settling: None,
                walls: false,
                grains: None,
            })
        }))
    }
}

/// A solid fraction that is not below that of jammed grains.
fn below(name: &str, value: f64, phi_max: f64) -> Fault {
    Fault::OutOfRange { name: name.into(), value, allowed: format!("less than two-fluid.phi_max = {phi_max}") }
}

fn laws(flow: &TwoFluid) -> Vec<&'static Info> {
    let mut laws = vec![flow.granular.info()];
    laws.extend(flow.granular.parts());
    laws.push(flow.elastic.info());
    if let Moving::Kinetic(_) = flow.granular.moving(flow.e, flow.mu_p) {
        // Under mu(I) the grains in contact carry no friction of their own.
        laws.push(flow.static_friction.info());
    }
    laws.extend([&drag::dallavalle_grain::INFO, flow.mixing_length.info(), flow.dispersion.info()]);
    laws
}
