//! A flow along a duct, in its cross-section.

use super::bed::{laminar_bed, size};
use super::{Faults, LaminarBed};
use crate::case::Fault;
use crate::case::scene::{Cavity, Duct, DuctBed};
pub use crate::case::section::Method;
use crate::case::section::{SectionGrid, SectionSolver, Shape};
use crate::case::tables::LaminarFlow;
use crate::closures::friction;
use crate::closures::regularisation::{Regularisation, Smoothing};

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
        /// yield stress [Pa]
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
    /// height, or diameter [m]
    pub h: f64,
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    pub gradient: f64,
    /// what fills the duct
    pub contents: Contents,
    /// how the yield stress is smoothed; lambda in units of [`DuctFlow::shear_scale`]
    pub regularisation: Regularisation,
    /// how it is solved
    pub solver: SectionMethod,
}

/// A square cavity under a sliding lid. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CavityFlow {
    /// side [m]
    pub h: f64,
    /// velocity of the lid [m/s]
    pub lid: f64,
    /// density [kg/m3]
    pub rho: f64,
    /// plastic viscosity [Pa s]
    pub eta: f64,
    /// yield stress [Pa]
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
    /// Stress scale [Pa]: (rho_p - rho_f) g H for a bed, -dp/dx H otherwise.
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

pub(super) fn duct(scene: &Duct, faults: &mut Faults) -> Option<DuctFlow> {
    let Duct { fluid, flow, .. } = scene;
    let outline = outline(flow.shape, flow.width.map(|width| width / flow.height), faults);
    let solver = solver(scene.model.method, scene.regularisation.law, &scene.grid, &scene.solver, faults);
    let size = size(&scene.regularisation, faults);
    let contents = Contents::Bingham { rho: fluid.density, eta: fluid.viscosity, tau_0: fluid.yield_stress };
    let mut duct = DuctFlow {
        outline: outline?,
        h: flow.height,
        gradient: flow.pressure_gradient,
        contents,
        regularisation: Regularisation::EXACT,
        solver: solver?,
    };
    duct.regularisation = Regularisation { law: scene.regularisation.law, lambda: size?.to_scaled(duct.shear_scale()) };
    Some(duct)
}

pub(super) fn bed(scene: &DuctBed, model: &str, faults: &mut Faults) -> Option<DuctFlow> {
    let DuctBed { fluid, grains, bed, flow, closures, .. } = scene;
    let drive = LaminarFlow {
        height: flow.height,
        pressure_gradient: Some(flow.pressure_gradient),
        shields: None,
        gravity: flow.gravity,
    };
    let tables = (fluid, grains, bed, &drive, closures);
    let bed = laminar_bed(tables, scene.model.form, model, &[friction::coulomb::INFO.law], faults);
    let outline = outline(flow.shape, flow.width.map(|width| width / flow.height), faults);
    let solver = solver(scene.model.method, scene.regularisation.law, &scene.grid, &scene.solver, faults);
    let size = size(&scene.regularisation, faults);
    let mut duct = DuctFlow {
        outline: outline?,
        h: flow.height,
        gradient: flow.pressure_gradient,
        contents: Contents::Bed(bed?),
        regularisation: Regularisation::EXACT,
        solver: solver?,
    };
    duct.regularisation = Regularisation { law: scene.regularisation.law, lambda: size?.to_scaled(duct.shear_scale()) };
    Some(duct)
}

pub(super) fn cavity(scene: &Cavity, faults: &mut Faults) -> Option<CavityFlow> {
    let Cavity { fluid, flow, grid, .. } = scene;
    let grid = SectionGrid { cells: grid.cells, yield_row: false, finest: grid.finest };
    let solver = solver(scene.model.method, scene.regularisation.law, &grid, &scene.solver, faults);
    let lambda = size(&scene.regularisation, faults)?.to_scaled(flow.lid_velocity / flow.height);
    Some(CavityFlow {
        h: flow.height,
        lid: flow.lid_velocity,
        rho: fluid.density,
        eta: fluid.viscosity,
        tau_0: fluid.yield_stress,
        regularisation: Regularisation { law: scene.regularisation.law, lambda },
        solver: solver?,
    })
}

/// The outline, in units of the height.
fn outline(shape: Shape, width: Option<f64>, faults: &mut Faults) -> Option<Outline> {
    /// Narrower or wider sections are lines.
    const WIDTHS: (f64, f64) = (0.05, 64.0);
    match (shape, width) {
        (Shape::Rectangle, None) => Some(Outline::Rectangle { width: 1.0 }),
        (Shape::Rectangle, Some(width)) if (WIDTHS.0..=WIDTHS.1).contains(&width) => Some(Outline::Rectangle { width }),
        (Shape::Rectangle, Some(width)) => {
            faults.push(("flow.width", Fault::Slender { ratio: width, low: WIDTHS.0, high: WIDTHS.1 }));
            None
        }
        (Shape::Circle, None) => Some(Outline::Circle),
        (Shape::Planes, None) => Some(Outline::Planes),
        (Shape::Circle | Shape::Planes, Some(_)) => {
            faults.push(("flow.width", Fault::NoWidth));
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
        faults.push(("model.method", Fault::DualIsExact));
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
