//! Problems of single grains.

use super::case::{GrainsTable, ImpactTable, Target, VerificationCase as Which, VerificationTable};
use super::{bed, impact, verification};
use crate::closures::contact::{LinearSpring, linear_spring};
use crate::dem::GrainBed;
use crate::dem::drive::accepts;
use crate::model::{Description, Faults, Model, ModelInfo, Solve};
use crate::models::BedFault;
use crate::models::premises;
use crate::models::{derived, layers, load};
use crate::result::Context;
use crate::result::{CheckpointError, Failure, Outcome, Premise, Results};
use crate::scene::{BenchmarkScene, GranularScene, Scene};

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
    const INFO: ModelInfo = ModelInfo::new("dem").taking(&["width"]).stochastic();
    type Scene = GranularScene;
    type Table = GrainsTable;

    fn build(scene: &GranularScene, table: &GrainsTable, faults: &mut Faults) -> Option<Self> {
        let GrainsTable { cell, closures, discrete, .. } = table;
        let (d, walls) = (scene.grains.diameter, scene.flow.width.is_some());
        let layers = layers(table.layers, &scene.bed, d, faults);
        let weight = scene.grains.density * scene.flow.gravity;
        let contact = closures.contact.of(&scene.grains, load(layers, weight, d), faults);
        let [length, width] = cell.size(scene.flow.width, d, faults);
        let beta = scene.flow.angle().map_err(|fault| faults.push(("flow.slope", fault))).ok();
        let layers = layers?;
        let count = layers * (length / d) * (width / d);
        let wide = |name: &'static str, length: f64, least: f64, faults: &mut Faults| {
            if length < least * d {
                faults.push((name, BedFault::GrainRoom { name, value: length, least: least * d, most: 1e3 }));
            }
        };
        wide("cell.length", length, 4.0, faults);
        wide(if walls { "flow.width" } else { "cell.width" }, width, if walls { 1.0 } else { 4.0 }, faults);
        let possible = (1.0..=MAX_GRAINS).contains(&count);
        if !possible {
            let name = "the number of mobile grains";
            faults.push(("layers", BedFault::GrainRoom { name, value: count, least: 1.0, most: MAX_GRAINS }));
        }
        Some(Self {
            d,
            rho_p: scene.grains.density,
            mobile: if possible { count.round() as usize } else { 1 },
            bottom: table.bottom,
            size: [length, width],
            side_walls: scene.flow.width.is_some(),
            smooth_walls: table.smooth_walls,
            beta: beta?,
            g: scene.flow.gravity,
            contact: contact?,
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

    fn derived(&self) -> Vec<(&'static str, f64, &'static str)> {
        derived(self)
    }

    fn cells(&self) -> usize {
        self.mobile
    }

    fn premises(&self, _: &Scene, _: &Results) -> Vec<Premise> {
        premises::rigid(self, self.rho_p * self.g).into_iter().collect()
    }

    fn accepts(&self, checkpoint: &[u8]) -> Option<Result<(), CheckpointError>> {
        Some(accepts(self, checkpoint))
    }
}

impl Model for Impact {
    const INFO: ModelInfo = ModelInfo::new("impact").taking(&["grains"]).stochastic();
    type Scene = BenchmarkScene;
    type Table = ImpactTable;

    fn build(scene: &BenchmarkScene, table: &ImpactTable, faults: &mut Faults) -> Option<Self> {
        let grains = faults.needed("grains", scene.grains)?;
        let contact = table.closures.contact.of(&grains, None, faults)?;
        Some(Self {
            d: grains.diameter,
            rho_p: grains.density,
            velocity: table.motion.velocity,
            angle: table.motion.angle,
            spin: table.motion.spin,
            target: table.motion.target,
            contact,
            steps_per_contact: table.discrete.steps_per_contact,
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
    const INFO: ModelInfo = ModelInfo::new("verification").taking(&["grains"]).stochastic();
    type Scene = BenchmarkScene;
    type Table = VerificationTable;

    fn build(scene: &BenchmarkScene, table: &VerificationTable, faults: &mut Faults) -> Option<Self> {
        let grains = faults.needed("grains", scene.grains)?;
        let contact = table.closures.contact.of(&grains, None, faults)?;
        Some(Self {
            case: table.which,
            d: grains.diameter,
            rho_p: grains.density,
            velocity: table.motion.velocity,
            g: table.motion.gravity,
            contact,
            steps_per_contact: table.discrete.steps_per_contact,
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
