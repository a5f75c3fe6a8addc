//! The convex minimum of a section as a second-order cone program, solved by an interior-point method that shares nothing
//! with ours: on small meshes both find the same velocity.

use std::ops::ControlFlow;

use crate::closures::regularisation::Regularisation;
use crate::models::section::Outline;
use crate::models::section::cavity::Cavity;
use crate::models::section::duct::{Duct, Filling};
use crate::models::section::newton;
use crate::models::section::program::{FIXED, Program};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// Default tolerances leave 2e-5 in small fluxes.
const TOLERANCE: f64 = 1e-10;

/// The unknowns of the minimum in units of `scale`: minimise `x K x/2 - b x + sum t s` with `|B x + c| <= s`.
fn by_cones<const D: usize, const N: usize>(program: &Program<D, N>, scale: f64) -> Vec<f64> {
    let (n, points) = (program.size(), program.points.len());
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for ((i, j), value) in program.pattern.places().zip(&program.base) {
        rows.push(j);
        columns.push(i);
        values.push(*value);
    }
    let cost = CscMatrix::new_from_triplets(n + points, n + points, rows, columns, values);
    let linear: Vec<f64> = program
        .load
        .iter()
        .map(|b| -b / scale)
        .chain(program.points.iter().map(|point| point.carried / scale))
        .collect();
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let mut right = Vec::new();
    let mut at = 0;
    for (block, points) in program.each() {
        for point in points {
            let row = (D + 1) * at;
            rows.push(row);
            columns.push(n + at);
            values.push(-1.0);
            right.push(0.0);
            for d in 0..D {
                for (unknown, strain) in block.unknowns.iter().zip(&point.strain[d]) {
                    if *unknown != FIXED && *strain != 0.0 {
                        rows.push(row + 1 + d);
                        columns.push(*unknown as usize);
                        values.push(-strain);
                    }
                }
                right.push(point.offset[d] / scale);
            }
            at += 1;
        }
    }
    let constraints = CscMatrix::new_from_triplets((D + 1) * points, n + points, rows, columns, values);
    let cones = vec![SupportedConeT::SecondOrderConeT(D + 1); points];
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(TOLERANCE)
        .tol_gap_rel(TOLERANCE)
        .tol_feas(TOLERANCE)
        .build()
        .unwrap();
    let mut solver = DefaultSolver::new(&cost, &linear, &constraints, &right, &cones, settings).unwrap();
    solver.solve();
    // An answer that is almost solved is none.
    assert_eq!(solver.solution.status, SolverStatus::Solved);
    solver.solution.x[..n].iter().map(|x| x * scale).collect()
}

fn compare<const D: usize, const N: usize>(name: &str, program: &Program<D, N>, digits: f64) {
    let solved = newton::solve(program, &Regularisation::EXACT, &mut |_| ControlFlow::Continue(())).unwrap();
    let largest = solved.x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let cones = by_cones(program, largest);
    let worst = solved.x.iter().zip(&cones).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / largest;
    println!("{name}: {worst:.1e} of the largest value, {} iterations", solved.history.len());
    assert!(worst < digits, "{name}: {worst}");
    // The gap at which the cone program ends bounds the distance from the minimum in the norm of K.
    let mut g = vec![[0.0; D]; program.points.len()];
    program.strains(&cones, &mut g);
    let (value, least) = (program.value(&cones, &g), program.value(&solved.x, &solved.g));
    let apart: Vec<f64> = solved.x.iter().zip(&cones).map(|(a, b)| a - b).collect();
    let mut forces = vec![0.0; apart.len()];
    program.pattern.multiply(&program.base, &apart, &mut forces);
    let distance = 0.5 * apart.iter().zip(&forces).map(|(a, f)| a * f).sum::<f64>();
    let gap = TOLERANCE * least.abs().max(largest * largest);
    println!(
        "{name}: minimum {least:.3e}, above it {:.1e}, half the distance squared {distance:.1e}, gap {gap:.1e}",
        value - least
    );
    assert!(distance < 2.0 * gap, "{name}: {distance} {gap}");
    // Ours is above the minimum by no more than its own gap.
    let own = program.gap(&solved.g, &solved.q);
    assert!(value - least < 2.0 * gap && least - value < own + 2.0 * gap, "{name}: {value} {least}, gaps {gap} {own}");
}

#[test]
fn ducts_have_the_velocity_of_the_cone_program() {
    let square = Outline::Rectangle { width: 1.0 };
    let k = 0.45_f64.powi(3) / (900.0 * 180.0 * 0.55 * 0.55);
    let bed = |k| Filling::Bed { level: 0.5, e: 2.375, resistance: 0.43 * 0.55, k };
    for (name, shape, filling, f) in [
        ("Bingham, square", square, Filling::Bingham(0.1), 1.0),
        ("Bingham, circle", Outline::Circle, Filling::Bingham(0.1), 1.0),
        ("mixed bed", square, bed(None), 0.1),
        ("two-fluid bed", Outline::Circle, bed(Some(k)), 0.1),
    ] {
        let divided = Duct { shape, filling, f }.divide(6, 12, 1.0, None);
        compare(name, &divided.program, 1e-7);
    }
}

#[test]
fn a_cavity_has_the_stream_function_of_the_cone_program() {
    // The minimum is flat in the stream function: the gap leaves 1.5e-6 and 1.7e-7 of it. At a tolerance of 1e-12 the
    // interior-point method only almost solves the program, and its answer stays the same.
    for bn in [2.0, 20.0] {
        compare("cavity", &Cavity::new(bn, 12, 0.5).program, 2e-6);
    }
}
