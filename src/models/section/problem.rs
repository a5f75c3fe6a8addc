//! A flow along a duct, in its cross-section.

use super::case::{CavityTable, DuctBedTable, DuctTable, Method, SectionGrid, SectionSolver};
use super::{advice, cavity_equations, equations, run, run_cavity, study};
use crate::case::tables::Shape;
use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::model::{Description, Faults, Flow, Model, ModelInfo, Offer, OnMesh, Solve, SteadyDrive, StudyPlan, Term};
use crate::models::exact::bed::{LaminarBed, laminar_bed};
use crate::models::premises;
use crate::models::section::SectionFault;
use crate::models::yielding::size;
use crate::result::Context;
use crate::result::Premise;
use crate::result::{Failure, Outcome};
use crate::result::{Results, quantity as q};
use crate::scene::Scene;
use crate::scene::{BedScene, BenchmarkScene, ChannelScene, Section};

/// Outline of a section whose height is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// a rectangle
    Rectangle {
        /// width over height
        width: f64,
    },
    /// a circle of diameter 1
    Circle,
    /// two planes, of which a strip as wide as high is taken
    Planes,
}

/// What fills a duct. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contents {
    /// a Bingham fluid; a Newtonian one without yield stress
    Bingham {
        /// density [kg/m3]
        rho: f64,
        /// plastic viscosity [Pa s]
        eta: f64,
        /// yield stress \[Pa]
        tau_0: f64,
    },
    /// a fluid over a bed of grains
    Bed(LaminarBed),
}

/// A flow along a duct. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DuctFlow {
    /// outline
    pub outline: Outline,
    /// height, or diameter \[m]
    pub h: f64,
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    pub gradient: f64,
    /// what fills the duct
    pub contents: Contents,
    /// how the yield stress is smoothed; lambda in units of [`DuctFlow::shear_scale`]
    pub regularisation: Regularisation,
    /// how it is solved
    pub solver: SectionMethod,
    /// elements along one height of the whole duct; `None`: the section alone
    pub along: Option<usize>,
}

/// A square cavity under a sliding lid. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CavityFlow {
    /// side \[m]
    pub h: f64,
    /// velocity of the lid [m/s]
    pub lid: f64,
    /// density [kg/m3]
    pub rho: f64,
    /// plastic viscosity [Pa s]
    pub eta: f64,
    /// yield stress \[Pa]
    pub tau_0: f64,
    /// how the yield stress is smoothed; lambda in units of the velocity of the lid over the side
    pub regularisation: Regularisation,
    /// how it is solved
    pub solver: SectionMethod,
}

impl CavityFlow {
    /// Bingham number tau_0 H/(eta U) on the velocity of the lid.
    #[must_use]
    pub fn bingham(&self) -> f64 {
        self.tau_0 * self.h / (self.eta * self.lid)
    }
}

/// How the minimum of a section is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionMethod {
    /// the method
    pub method: Method,
    /// whether a row of elements ends on the yield surface of a bed
    pub yield_row: bool,
    /// size of the elements at walls and bed level over the mean one
    pub finest: f64,
    /// duality gap over the work of the drive at which the first-order method ends
    pub tolerance: f64,
    /// its most iterations
    pub iterations: usize,
}

impl DuctFlow {
    /// Stress scale \[Pa]: (rho_p - rho_f) g H for a bed, -dp/dx H otherwise.
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        match &self.contents {
            Contents::Bingham { .. } => self.gradient * self.h,
            Contents::Bed(bed) => bed.stress_scale(),
        }
    }

    /// Viscosity of the fluid [Pa s].
    #[must_use]
    pub fn viscosity(&self) -> f64 {
        match &self.contents {
            Contents::Bingham { eta, .. } => *eta,
            Contents::Bed(bed) => bed.eta,
        }
    }

    /// Unit of the shear rate [1/s].
    #[must_use]
    pub fn shear_scale(&self) -> f64 {
        self.stress_scale() / self.viscosity()
    }
}

/// The whole duct has one velocity and walls on both sides.
fn whole(duct: &DuctFlow, faults: &mut Faults) {
    let slips = matches!(&duct.contents, Contents::Bed(bed) if bed.drag.is_some());
    let dual = duct.solver.method == Method::FirstOrder;
    if duct.along.is_some() && (slips || dual || duct.outline == Outline::Planes) {
        faults.push(("grid.along", SectionFault::NotWhole));
    }
}

/// The outline, in units of the height.
fn outline(section: Section, height: f64, faults: &mut Faults) -> Option<Outline> {
    /// Narrower or wider sections are lines.
    const WIDTHS: (f64, f64) = (0.05, 64.0);
    match (section.shape, section.width.map(|width| width / height)) {
        (Shape::Rectangle, None) => Some(Outline::Rectangle { width: 1.0 }),
        (Shape::Rectangle, Some(width)) if (WIDTHS.0..=WIDTHS.1).contains(&width) => Some(Outline::Rectangle { width }),
        (Shape::Rectangle, Some(width)) => {
            faults.push(("flow.section.width", SectionFault::Slender { ratio: width, low: WIDTHS.0, high: WIDTHS.1 }));
            None
        }
        (Shape::Circle, None) => Some(Outline::Circle),
        (Shape::Planes, None) => Some(Outline::Planes),
        (Shape::Circle | Shape::Planes, Some(_)) => {
            faults.push(("flow.section.width", SectionFault::NoWidth));
            None
        }
    }
}

fn solver(
    method: Method,
    law: Smoothing,
    grid: &SectionGrid,
    solver: &SectionSolver,
    faults: &mut Faults,
) -> Option<SectionMethod> {
    if method == Method::FirstOrder && law != Smoothing::None {
        faults.push(("method", SectionFault::DualIsExact));
        return None;
    }
    Some(SectionMethod {
        method,
        yield_row: grid.yield_row,
        finest: grid.finest,
        tolerance: solver.tolerance,
        iterations: solver.iterations,
    })
}

impl DuctFlow {
    /// A laminar flow in the gap, and a viscous drag where there are two phases.
    fn premises(&self, results: &Results) -> Vec<Premise> {
        let rule = if self.outline == Outline::Circle { premises::LAMINAR_PIPE } else { premises::LAMINAR };
        let slips = matches!(&self.contents, Contents::Bed(bed) if bed.drag.is_some());
        let drag = premises::DARCY.maybe(results.get(q::REYNOLDS_PARTICLE.name).filter(|_| slips));
        premises::laminar(&rule, results).into_iter().chain(drag).collect()
    }
}

/// A yield-stress fluid along a duct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duct(pub OnMesh<DuctFlow>);

/// A fluid along a duct over a bed of grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DuctBed(pub OnMesh<DuctFlow>);

impl Model for Duct {
    const INFO: ModelInfo = ModelInfo::new("duct").taking(&["pressure_gradient", "section", "yield_stress"]);
    type Scene = ChannelScene;
    type Table = DuctTable;

    fn build(scene: &ChannelScene, tables: &DuctTable, faults: &mut Faults) -> Option<Self> {
        let ChannelScene { fluid, flow } = scene;
        let section = faults.needed("flow.section", flow.section);
        let outline = outline(section?, flow.depth, faults);
        let solver = solver(tables.method, tables.regularisation.law, &tables.grid, &tables.solver, faults);
        let size = size(&tables.regularisation, faults);
        let contents = Contents::Bingham { rho: fluid.density, eta: fluid.viscosity, tau_0: fluid.yield_stress };
        let mut duct = DuctFlow {
            outline: outline?,
            h: flow.depth,
            gradient: flow.pressure_gradient?,
            contents,
            regularisation: Regularisation::EXACT,
            solver: solver?,
            along: tables.grid.along,
        };
        whole(&duct, faults);
        duct.regularisation =
            Regularisation { law: tables.regularisation.law, lambda: size?.to_scaled(duct.shear_scale()) };
        Some(Self(OnMesh { problem: duct, cells: tables.grid.cells }))
    }
}

impl Model for DuctBed {
    const INFO: ModelInfo = ModelInfo::new("duct-bed").taking(&["pressure_gradient", "section"]).under(&["plane"]);
    type Scene = BedScene;
    type Table = DuctBedTable;

    fn build(scene: &BedScene, tables: &DuctBedTable, faults: &mut Faults) -> Option<Self> {
        let bed = laminar_bed(scene, (&tables.closures).into(), tables.form, Self::INFO.name, faults);
        // Without a section the planes of the scene have no side walls.
        let section = scene.flow.section.unwrap_or(Section { shape: Shape::Planes, width: None });
        let gradient = faults.needed("flow.pressure_gradient", scene.flow.pressure_gradient);
        let height = scene.bed.thickness? + scene.flow.depth?;
        let outline = outline(section, height, faults);
        let solver = solver(tables.method, tables.regularisation.law, &tables.grid, &tables.solver, faults);
        let size = size(&tables.regularisation, faults);
        let mut duct = DuctFlow {
            outline: outline?,
            h: height,
            gradient: gradient?,
            contents: Contents::Bed(bed?),
            regularisation: Regularisation::EXACT,
            solver: solver?,
            along: tables.grid.along,
        };
        whole(&duct, faults);
        duct.regularisation =
            Regularisation { law: tables.regularisation.law, lambda: size?.to_scaled(duct.shear_scale()) };
        Some(Self(OnMesh { problem: duct, cells: tables.grid.cells }))
    }

    fn offer(flow: &Flow, _: f64) -> Option<Offer> {
        advice::offer(flow)
    }
}

impl Solve for Duct {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        self.0.solve(context)
    }

    fn describe(&self) -> Description {
        self.0.describe()
    }

    fn study(&self) -> StudyPlan {
        self.0.study()
    }

    fn drive(&self) -> Option<SteadyDrive> {
        self.0.drive()
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        self.0.problem.premises(results)
    }

    fn cells(&self) -> usize {
        self.0.cells
    }
}

impl Solve for DuctBed {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        self.0.solve(context)
    }

    fn describe(&self) -> Description {
        self.0.describe()
    }

    fn study(&self) -> StudyPlan {
        self.0.study()
    }

    fn drive(&self) -> Option<SteadyDrive> {
        self.0.drive()
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        self.0.problem.premises(results)
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        Ok(advice::flow(&self.0.problem))
    }

    fn terms(&self) -> Vec<Term> {
        advice::terms(&self.0.problem)
    }

    fn cells(&self) -> usize {
        self.0.cells
    }
}

impl Solve for OnMesh<DuctFlow> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        let equations = equations(&self.problem);
        match &self.problem.contents {
            Contents::Bed(bed) => Description { form: Some(bed.form_name()), equations, laws: bed.laws() },
            Contents::Bingham { .. } => Description { equations, ..Description::default() },
        }
    }

    fn study(&self) -> StudyPlan {
        study::plan(study::duct(&self.problem), self.problem.along.is_some())
    }

    fn drive(&self) -> Option<SteadyDrive> {
        Some(SteadyDrive::of(self.problem.shear_scale() * self.problem.h, "more grid.cells"))
    }

    fn cells(&self) -> usize {
        self.cells
    }
}

impl Model for OnMesh<CavityFlow> {
    const INFO: ModelInfo = ModelInfo::new("cavity").taking(&["fluid"]);
    type Scene = BenchmarkScene;
    type Table = CavityTable;

    fn build(scene: &BenchmarkScene, tables: &CavityTable, faults: &mut Faults) -> Option<Self> {
        let (fluid, CavityTable { geometry: flow, grid, .. }) = (faults.needed("fluid", scene.fluid)?, tables);
        let grid = SectionGrid { cells: grid.cells, yield_row: false, finest: grid.finest, along: None };
        let solver = solver(tables.method, tables.regularisation.law, &grid, &tables.solver, faults);
        let lambda = size(&tables.regularisation, faults)?.to_scaled(flow.lid_velocity / flow.height);
        let problem = CavityFlow {
            h: flow.height,
            lid: flow.lid_velocity,
            rho: fluid.density,
            eta: fluid.viscosity,
            tau_0: fluid.yield_stress,
            regularisation: Regularisation { law: tables.regularisation.law, lambda },
            solver: solver?,
        };
        Some(Self { problem, cells: tables.grid.cells })
    }
}

impl Solve for OnMesh<CavityFlow> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run_cavity(&self.problem, self.cells, context.watch)
    }

    fn describe(&self) -> Description {
        Description { equations: cavity_equations(&self.problem), ..Description::default() }
    }

    fn study(&self) -> StudyPlan {
        study::plan(study::cavity(&self.problem), false)
    }

    fn premises(&self, _: &Scene, results: &Results) -> Vec<Premise> {
        premises::SLOW.maybe(results.get(q::REYNOLDS.name)).into_iter().collect()
    }

    fn cells(&self) -> usize {
        self.cells
    }
}
