//! Problems of single grains.

use super::case::{GrainFlow, GrainsBedTables, ImpactTables, Target, VerificationCase as Which, VerificationTables};
use super::{bed, impact, verification};
use crate::closures::contact::{LinearSpring, linear_spring};
use crate::dem::GrainBed;
use crate::dem::drive::accepts;
use crate::model::{Description, Faults, Model, ModelInfo, Solve};
use crate::models::BedFault;
use crate::models::{of_scene, touching};
use crate::result::Context;
use crate::result::{CheckpointError, Failure, Outcome};
use crate::scene::{Bed, BenchmarkScene, GranularFlow, GranularScene};

/// The impact of one sphere. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// diameter \[m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// velocity before [m/s]
    pub velocity: f64,
    /// angle with the normal \[rad]
    pub angle: f64,
    /// angular velocity before [1/s]
    pub spin: f64,
    /// what it hits
    pub target: Target,
    /// contact
    pub contact: LinearSpring,
    /// steps within the duration of the contact
    pub steps_per_contact: f64,
}

/// A few grains, compared with an exact solution. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verification {
    /// the verification case
    pub case: Which,
    /// diameter \[m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// velocity at the beginning [m/s]
    pub velocity: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// contact
    pub contact: LinearSpring,
    /// steps within the duration of a contact
    pub steps_per_contact: f64,
}

/// Most grains of a case: what a machine of today holds.
const MAX_GRAINS: f64 = 2e7;

impl Model for GrainBed {
    const INFO: ModelInfo = ModelInfo { name: "grains", stochastic: true };
    type Scene = GranularScene;
    type Tables = GrainsBedTables;

    fn scene(tables: &GrainsBedTables) -> GranularScene {
        let GrainsBedTables { grains, flow, closures, .. } = tables;
        let GrainFlow { slope, slope_definition, gravity, .. } = *flow;
        let width = flow.side_walls.then_some(flow.width);
        GranularScene {
            grains: touching(grains, &closures.contact.0),
            bed: Bed::default(),
            flow: GranularFlow { slope, slope_definition, gravity, width },
        }
    }

    fn build(scene: &GranularScene, tables: &GrainsBedTables, faults: &mut Faults) -> Option<Self> {
        let GrainsBedTables { bed, flow, closures, discrete, .. } = tables;
        let beta = scene.flow.angle().map_err(|fault| faults.push(("flow.slope", fault))).ok();
        let d = scene.grains.diameter;
        let count = bed.layers * (flow.length / d) * (flow.width / d);
        let wide = |name: &'static str, length: f64, least: f64, faults: &mut Faults| {
            if length < least * d {
                faults.push((name, BedFault::GrainRoom { name, value: length, least: least * d, most: 1e3 }));
            }
        };
        wide("flow.length", flow.length, 4.0, faults);
        wide("flow.width", flow.width, if flow.side_walls { 1.0 } else { 4.0 }, faults);
        let possible = (1.0..=MAX_GRAINS).contains(&count);
        if !possible {
            let name = "the number of mobile grains";
            faults.push(("bed.layers", BedFault::GrainRoom { name, value: count, least: 1.0, most: MAX_GRAINS }));
        }
        let contact = of_scene(closures.contact.0, &scene.grains)?;
        Some(Self {
            d,
            rho_p: scene.grains.density,
            mobile: if possible { count.round() as usize } else { 1 },
            bottom: bed.bottom,
            size: [flow.length, flow.width],
            side_walls: scene.flow.width.is_some(),
            smooth_walls: flow.smooth_walls,
            beta: beta?,
            g: scene.flow.gravity,
            contact,
            discrete: *discrete,
        })
    }
}

impl Solve for GrainBed {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        bed::run(self, context)
    }

    fn describe(&self) -> Description {
        let (equations, laws) = (bed::equations(self), vec![&linear_spring::INFO]);
        Description { form: None, equations, laws }
    }

    fn cells(&self) -> usize {
        self.mobile
    }

    fn accepts(&self, checkpoint: &[u8]) -> Option<Result<(), CheckpointError>> {
        Some(accepts(self, checkpoint))
    }
}

impl Model for Impact {
    const INFO: ModelInfo = ModelInfo { name: "impact", stochastic: true };
    type Scene = BenchmarkScene;
    type Tables = ImpactTables;

    fn scene(tables: &ImpactTables) -> BenchmarkScene {
        let grains = touching(&tables.grains, &tables.closures.contact.0);
        BenchmarkScene { fluid: None, grains: Some(grains) }
    }

    fn build(scene: &BenchmarkScene, tables: &ImpactTables, _: &mut Faults) -> Option<Self> {
        let grains = scene.grains?;
        let contact = of_scene(tables.closures.contact.0, &grains)?;
        Some(Self {
            d: grains.diameter,
            rho_p: grains.density,
            velocity: tables.flow.velocity,
            angle: tables.flow.angle,
            spin: tables.flow.spin,
            target: tables.flow.target,
            contact,
            steps_per_contact: tables.discrete.steps_per_contact,
        })
    }
}

impl Solve for Impact {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        impact::run(self, context.watch)
    }

    fn describe(&self) -> Description {
        let (equations, laws) = (impact::equations(self), vec![&linear_spring::INFO]);
        Description { form: None, equations, laws }
    }

    fn cells(&self) -> usize {
        1
    }
}

impl Model for Verification {
    const INFO: ModelInfo = ModelInfo { name: "trial", stochastic: true };
    type Scene = BenchmarkScene;
    type Tables = VerificationTables;

    fn scene(tables: &VerificationTables) -> BenchmarkScene {
        let grains = touching(&tables.grains, &tables.closures.contact.0);
        BenchmarkScene { fluid: None, grains: Some(grains) }
    }

    fn build(scene: &BenchmarkScene, tables: &VerificationTables, _: &mut Faults) -> Option<Self> {
        let grains = scene.grains?;
        let contact = of_scene(tables.closures.contact.0, &grains)?;
        Some(Self {
            case: tables.model.trial,
            d: grains.diameter,
            rho_p: grains.density,
            velocity: tables.flow.velocity,
            g: tables.flow.gravity,
            contact,
            steps_per_contact: tables.discrete.steps_per_contact,
        })
    }
}

impl Solve for Verification {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        verification::run(self, context.watch)
    }

    fn describe(&self) -> Description {
        let (equations, laws) = (verification::equations(self), vec![&linear_spring::INFO]);
        Description { form: None, equations, laws }
    }

    fn cells(&self) -> usize {
        1
    }
}
