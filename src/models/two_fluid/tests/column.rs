//! The fluid is that of the shared column.

use super::reference;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::column::{Bottom, FluidColumn, Forcing, Grid, Medium, Newton, Setup, Top, ViscousForm};
use crate::models::two_fluid::levels::Levels;
use crate::models::two_fluid::state::{Cell, FLUID};
use crate::models::two_fluid::steady;
use crate::models::two_fluid::system::Memory;

#[test]
fn one_medium_gives_the_same_stresses_to_both() {
    let (flow, column) = reference(&["grid.fine="], 120);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let (laws, state) = (&column.laws, &solved.state);
    let levels = Levels::new(&column, state, &solved.mobilised);
    let cells: Vec<Cell<f64>> = state.iter().map(|x| Cell::new(laws, x)).collect();
    let medium = Medium {
        phi: cells.iter().map(|cell| cell.phi).collect(),
        velocity: cells.iter().map(|cell| cell.v).collect(),
        beta: levels.cells.iter().map(|level| level.drag / (level.u - level.v)).collect(),
        force: vec![0.0; cells.len()],
    };
    let setup = Setup {
        rho: 1.0,
        eta: laws.nu,
        viscosity: MixtureViscosity::Clear,
        form: ViscousForm::Effective,
        mixing_length: laws.mixing_length,
        newton: Newton { tolerance: 1e-14, ..Newton::default() },
        ..Setup::laminar(1.0, laws.nu)
    };
    let height: f64 = column.widths.iter().sum();
    let mut fluid = FluidColumn::new(Grid::uniform(0.0, height, 120).unwrap(), setup).unwrap();
    let velocity: Vec<f64> = state.iter().map(|x| x[FLUID]).collect();
    fluid.set_velocity(&velocity).unwrap();
    let forcing = Forcing { drive: laws.drive[0], bottom: Bottom::NoSlip, top: Top::FreeSurface };
    fluid.step(&medium, &forcing, f64::INFINITY).unwrap();
    let (faces, _) = column.evaluate(state, &Memory::steady(120), &solved.mobilised);
    let scale = faces.iter().map(|face| face.turbulent).fold(0.0, f64::max);
    for (f, face) in faces.iter().enumerate() {
        let (viscous, turbulent) = (fluid.tau_viscous()[f], fluid.tau_reynolds()[f]);
        assert!((face.viscous - viscous).abs() < 1e-12 * scale, "face {f}: {} {viscous}", face.viscous);
        assert!((face.turbulent - turbulent).abs() < 1e-12 * scale, "face {f}: {} {turbulent}", face.turbulent);
    }
    for (u, v) in fluid.velocity().iter().zip(&velocity) {
        assert!((u - v).abs() < 1e-9 * velocity[119]);
    }
}
