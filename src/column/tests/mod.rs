//! The column against exact solutions. The orders stated are those measured, on the cells stated.

mod failures;
mod laminar;
mod manufactured;
mod transient;
mod turbulent;

use super::*;
use crate::numerics::levels;

const STEADY: f64 = f64::INFINITY;

/// Cells of a smooth map, four times finer at the bottom than their mean.
fn graded(height: f64, cells: usize) -> Grid {
    let mirrored = levels::graded(0.0, height, cells, 0.25 * height / cells as f64);
    Grid::from_faces(mirrored.into_iter().rev().map(|z| height - z).collect()).unwrap()
}

fn uniform(height: f64, cells: usize) -> Grid {
    Grid::uniform(0.0, height, cells).unwrap()
}

/// A medium given by functions of z at the centres.
fn medium(grid: &Grid, phi: impl Fn(f64) -> f64, velocity: impl Fn(f64) -> f64, beta: impl Fn(f64) -> f64) -> Medium {
    let at = |f: &dyn Fn(f64) -> f64| grid.centres().iter().map(|&z| f(z)).collect();
    Medium { phi: at(&phi), velocity: at(&velocity), beta: at(&beta), force: vec![0.0; grid.cells()] }
}

/// The steady state from rest. The momentum must balance, whatever is solved.
fn steady(grid: Grid, setup: Setup, medium: &Medium, forcing: Forcing) -> (FluidColumn, Step) {
    let mut column = FluidColumn::new(grid, setup).unwrap();
    let step = column.step(medium, &forcing, STEADY).unwrap();
    assert!(step.balance.relative().abs() < 1e-12, "{step:?}");
    (column, step)
}

/// Largest error of the velocity, relative to the largest velocity.
fn error(column: &FluidColumn, exact: impl Fn(f64) -> f64) -> f64 {
    let pairs = column.grid().centres().iter().map(|&z| exact(z)).zip(column.velocity());
    let (worst, largest) =
        pairs.fold((0.0, 0.0), |(worst, largest): (f64, f64), (e, u)| (worst.max((e - u).abs()), largest.max(e.abs())));
    worst / largest
}

/// The order between each of the numbers of cells and its double.
fn orders(cells: &[usize], error: impl Fn(usize) -> f64) -> Vec<f64> {
    let orders = cells.iter().map(|&n| (error(n) / error(2 * n)).log2()).collect();
    println!("orders on {cells:?} cells: {orders:.3?}, last error {:.2e}", error(2 * cells[cells.len() - 1]));
    orders
}

fn assert_order_two(cells: &[usize], error: impl Fn(usize) -> f64) {
    for order in orders(cells, error) {
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }
}
