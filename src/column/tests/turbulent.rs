//! Turbulent flows: logarithmic laws over rough walls, smooth walls and beds; channels with side walls.

use approx::assert_relative_eq;

use super::*;
use crate::closures::mixing_length::{BelowPacked, LiSawamoto, MixingLength, Prandtl};
use crate::closures::side_wall::SideWall;

const KAPPA: f64 = 0.41;
const RHO: f64 = 1000.0;
const U_STAR: f64 = 0.05;
const TAU: f64 = RHO * U_STAR * U_STAR;

fn li_sawamoto() -> MixingLength {
    MixingLength::LiSawamoto(LiSawamoto { kappa: KAPPA, phi_max: 0.6, below_packed: BelowPacked::Published })
}

fn turbulent(eta: f64) -> Setup {
    Setup { mixing_length: li_sawamoto(), ..Setup::laminar(RHO, eta) }
}

/// Constant stress with l_m = kappa z and a viscosity, from u(0) = 0: with x = 2 kappa z u_*/nu,
/// `u = (u_*/kappa) (asinh x - (sqrt(1 + x^2) - 1)/x)`.
fn smooth_wall(z: f64, nu: f64) -> f64 {
    let x = 2.0 * KAPPA * z * U_STAR / nu;
    U_STAR / KAPPA * (x.asinh() - x / (1.0 + (1.0 + x * x).sqrt()))
}

#[test]
fn log_law_over_a_rough_wall_is_exact_on_any_grid() {
    // Almost no viscosity: the iteration starts from a laminar flow 1e14 times too fast.
    let z_0 = 2e-4;
    let forcing = Forcing { drive: 0.0, bottom: Bottom::Rough { z_0, kappa: KAPPA }, top: Top::Stress(TAU) };
    let uneven = Grid::from_faces(vec![0.0, 0.002, 0.003, 0.01, 0.02, 0.024, 0.1]).unwrap();
    for grid in [uniform(0.1, 5), uniform(0.1, 100), graded(0.1, 60), uneven] {
        for mixing_length in [li_sawamoto(), MixingLength::Prandtl(Prandtl { kappa: KAPPA })] {
            let medium = Medium::clear(grid.cells());
            let setup = Setup { mixing_length, ..turbulent(1e-15) };
            let (column, step) = steady(grid.clone(), setup, &medium, forcing);
            assert!(error(&column, |z| U_STAR / KAPPA * (z / z_0).ln()) < 1e-11);
            assert!(step.iterations < 70, "{}", step.iterations);
        }
    }
}

#[test]
fn log_law_over_a_rough_wall_among_grains() {
    // Only the fluid between the grains carries the stress, rho eps l_m^2 u'^2 = tau: u_*/eps^(1/2) stands for u_*.
    let (z_0, phi) = (2e-4, 0.36);
    let forcing = Forcing { drive: 0.0, bottom: Bottom::Rough { z_0, kappa: KAPPA }, top: Top::Stress(TAU) };
    let grid = graded(0.1, 20);
    let grains = medium(&grid, |_| phi, |_| 0.0, |_| 0.0);
    let setup = Setup { mixing_length: MixingLength::Prandtl(Prandtl { kappa: KAPPA }), ..turbulent(1e-15) };
    let (column, step) = steady(grid, setup, &grains, forcing);
    assert!(error(&column, |z| U_STAR / (0.8 * KAPPA) * (z / z_0).ln()) < 1e-11);
    assert_relative_eq!(step.balance.bottom, TAU, max_relative = 1e-12);
}

#[test]
fn log_law_above_a_level_in_the_flow_is_exact() {
    // The upper part of the same flow: the velocity at its lowest level is given, and the mixing length that it has there.
    let (z_0, level) = (2e-4, 0.01);
    let exact = |z: f64| U_STAR / KAPPA * (z / z_0).ln();
    let bottom = Bottom::Flow { velocity: exact(level), mixing_length: KAPPA * level };
    let forcing = Forcing { drive: 0.0, bottom, top: Top::Stress(TAU) };
    let grid = Grid::from_faces(vec![level, 0.02, 0.023, 0.04, 0.1]).unwrap();
    let (column, step) = steady(grid, turbulent(1e-15), &Medium::clear(4), forcing);
    assert!(error(&column, exact) < 1e-11);
    assert_relative_eq!(step.balance.bottom, TAU, max_relative = 1e-12);
    assert_relative_eq!(column.mixing_length()[4], KAPPA * 0.1, max_relative = 1e-14);
}

#[test]
fn a_driven_flow_over_a_rough_wall() {
    // Orders 1.01, 1.02, 1.03 (25 to 200 cells): the wall law has one stress over its half cell, where a driven flow loses a little of it.
    // The shift is u_* h/(4 kappa H), h the height of a cell: 1.2e-3 of the largest velocity on 25 cells.
    let (z_0, h) = (1e-5, 0.1);
    let forcing = Forcing { drive: TAU / h, bottom: Bottom::Rough { z_0, kappa: KAPPA }, top: Top::FreeSurface };
    let potential = |z: f64| {
        let root = (1.0 - z / h).sqrt();
        U_STAR / KAPPA * (2.0 * root + ((1.0 - root) / (1.0 + root)).ln())
    };
    let errors = |n: usize| {
        let (column, step) = steady(uniform(h, n), turbulent(1e-12), &Medium::clear(n), forcing);
        assert_relative_eq!(step.balance.bottom, TAU, max_relative = 1e-12);
        error(&column, |z| potential(z) - potential(z_0))
    };
    for order in orders(&[25, 50, 100], errors) {
        assert!((order - 1.0).abs() < 0.1, "{order}");
    }
    assert!(errors(25) < 1.3e-3);
}

#[test]
fn smooth_wall_with_li_sawamoto() {
    // Orders 1.95, 1.98, 1.99 (100 to 800 cells, u_* H/nu = 100).
    let nu = U_STAR * 0.1 / 100.0;
    let forcing = Forcing { drive: 0.0, bottom: Bottom::NoSlip, top: Top::Stress(TAU) };
    assert_order_two(&[100, 200, 400], |n| {
        let (column, _) = steady(graded(0.1, n), turbulent(RHO * nu), &Medium::clear(n), forcing);
        error(&column, |z| smooth_wall(z, nu))
    });
}

#[test]
fn log_law_above_a_packed_bed() {
    // The bed is at the packing at which Li and Sawamoto's turbulence dies, so that the law starts from its top, where the flow
    // through the bed slips by u_s = tau l/(eps eta) tanh(h_p/l), l = sqrt(eps eta/beta).
    // Slope of u/u_* against ln(z - h_p) over 0.1 < (z - h_p)/h < 0.9: 1/kappa within 0.46 % (the rest is the
    // viscosity: 1/x of it). Orders 2.00 (200 to 1600 cells of which half are in the bed).
    let (h_p, h, eps, beta, nu) = (0.02, 0.08, 0.4, 4e5, 4e-6);
    let length = (eps * RHO * nu / beta).sqrt();
    let slip = TAU * length / (eps * RHO * nu) * (h_p / length).tanh();
    let exact = |z: f64| {
        if z < h_p {
            slip * ((z - h_p) / length).exp() * (-2.0 * z / length).exp_m1() / (-2.0 * h_p / length).exp_m1()
        } else {
            slip + smooth_wall(z - h_p, nu)
        }
    };
    let solve = |n: usize| {
        // Both halves fine at the top of the bed, with the same cell on either side.
        let fine = 1e-3 / n as f64;
        let bed = levels::graded(0.0, h_p, n / 2, fine);
        let flow = levels::graded(0.0, h, n / 2, fine);
        let above = flow.iter().rev().skip(1).map(|z| h_p + (h - z));
        let grid = Grid::from_faces(bed.iter().copied().chain(above).collect()).unwrap();
        let packed = medium(&grid, |z| if z < h_p { 0.6 } else { 0.0 }, |_| 0.0, |z| if z < h_p { beta } else { 0.0 });
        let forcing = Forcing { drive: 0.0, bottom: Bottom::NoSlip, top: Top::Stress(TAU) };
        steady(grid, turbulent(RHO * nu), &packed, forcing).0
    };
    let column = solve(400);
    let log: Vec<(f64, f64)> = (column.grid().centres().iter().zip(column.velocity()))
        .filter(|(z, _)| (0.1 * h..0.9 * h).contains(&(**z - h_p)))
        .map(|(z, u)| ((z - h_p).ln(), u / U_STAR))
        .collect();
    let n = log.len() as f64;
    let (x, y) = log.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let slope =
        log.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / log.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    println!("slope times kappa: {}", slope * KAPPA);
    assert_relative_eq!(slope, 1.0 / KAPPA, max_relative = 0.01);
    assert_order_two(&[200, 400, 800], |n| error(&solve(n), exact));
    // Below the top of the bed there is no turbulence, and above it one stress.
    let top = column.grid().faces().iter().position(|z| (z - h_p).abs() < 1e-12).unwrap();
    assert!(column.tau_reynolds()[..=top].iter().all(|&r| r == 0.0));
    let total = column.tau_viscous().iter().zip(column.tau_reynolds()).skip(top).map(|(t, r)| t + r);
    assert!(total.into_iter().all(|t| (t / TAU - 1.0).abs() < 1e-12));
}

#[test]
fn side_walls_against_the_drive() {
    // Only side walls hold the fluid: eps G = eps rho (2/W) (f/8) u^2 at every level.
    let (width, nu) = (6.5e-3, 1e-6);
    for side_wall in [SideWall::GrafAltinakarPublished, SideWall::GrafAltinakar, SideWall::Blasius] {
        for u in [1e-4, 0.01, 0.5] {
            let f = side_wall.friction_factor(u * width / nu);
            let drive = RHO * 2.0 / width * f / 8.0 * u * u;
            let grid = graded(0.1, 20);
            let grains = medium(&grid, |z| 4.0 * z, |_| 0.0, |_| 0.0);
            let forcing = Forcing { drive, bottom: Bottom::Stress(0.0), top: Top::FreeSurface };
            let setup = Setup { side_wall, width, ..turbulent(RHO * nu) };
            let (column, step) = steady(grid, setup, &grains, forcing);
            assert!(error(&column, |_| u) < 1e-11, "{side_wall:?} {u}");
            assert_relative_eq!(step.balance.side_walls, step.balance.drive, max_relative = 1e-12);
            // phi is 0.2 on average: the walls hold the fluid only.
            assert_relative_eq!(step.balance.side_walls, 0.8 * 0.1 * drive, max_relative = 1e-3);
        }
    }
}

#[test]
fn any_start_leads_to_the_same_flow() {
    // Start velocities that reverse, oscillate and overshoot. Iterations from rest: 14 and 16.
    let grid = graded(0.1, 80);
    let grains = medium(&grid, |z| if z < 0.03 { 0.5 } else { 0.0 }, |_| 0.1, |z| if z < 0.03 { 1e4 } else { 0.0 });
    let forcing = Forcing { drive: TAU / 0.07, bottom: Bottom::NoSlip, top: Top::FreeSurface };
    let setup = Setup { side_wall: SideWall::GrafAltinakar, width: 0.01, ..turbulent(1e-3) };
    for (form, iterations) in [(ViscousForm::Mixture, 14), (ViscousForm::Fluid, 16)] {
        let (rest, step) = steady(grid.clone(), Setup { form, ..setup }, &grains, forcing);
        assert_eq!(step.iterations, iterations, "{form:?}");
        for (i, start) in [-1.0, 5.0, 100.0, -1e4].into_iter().enumerate() {
            let mut column = FluidColumn::new(grid.clone(), Setup { form, ..setup }).unwrap();
            let velocity: Vec<f64> = grid.centres().iter().map(|z| start * (z * 10f64.powi(i as i32)).sin()).collect();
            column.set_velocity(&velocity).unwrap();
            let step = column.step(&grains, &forcing, STEADY).unwrap();
            assert!(step.iterations < 60, "{} from {start}", step.iterations);
            for (a, b) in column.velocity().iter().zip(rest.velocity()) {
                assert_relative_eq!(*a, *b, max_relative = 1e-9);
            }
        }
    }
}
