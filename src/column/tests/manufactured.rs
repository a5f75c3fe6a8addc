//! A manufactured solution in which everything varies: the force that makes it a solution is derived by hand below.

use std::f64::consts::PI;

use super::*;
use crate::closures::mixing_length::{BelowPacked, LiSawamoto, MixingLength};
use crate::closures::mixture_viscosity::{Boyer, MixtureViscosity};
use crate::closures::side_wall::SideWall;

const RHO: f64 = 1.3;
const ETA: f64 = 0.02;
const DRIVE: f64 = 0.7;
const KAPPA: f64 = 0.41;
const PHI_MAX: f64 = 0.62;
const JAMMED: f64 = 0.66;
const WIDTH: f64 = 0.7;
const WALL: SideWall = SideWall::GrafAltinakar;

/// A function with its first two derivatives.
type Jet = [f64; 3];

fn product(a: Jet, b: Jet) -> Jet {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

/// phi = (1 + cos(pi z))/4: from 0.5 to 0.
fn phi(z: f64) -> Jet {
    [0.25 * (1.0 + (PI * z).cos()), -0.25 * PI * (PI * z).sin(), -0.25 * PI * PI * (PI * z).cos()]
}

/// l_m = kappa int (1 - phi/phi_max) dz.
fn length(z: f64) -> [f64; 2] {
    [KAPPA * (z - 0.25 * (z + (PI * z).sin() / PI) / PHI_MAX), KAPPA * (1.0 - phi(z)[0] / PHI_MAX)]
}

/// eta_e = eta (1 + 5/2 phi/(1 - phi/phi_j)).
fn viscosity(z: f64) -> [f64; 2] {
    let gap = 1.0 - phi(z)[0] / JAMMED;
    [ETA * (1.0 + 2.5 * phi(z)[0] / gap), ETA * 2.5 / (gap * gap) * phi(z)[1]]
}

fn fluid(z: f64) -> Jet {
    [1.5 * z - 0.4 * z * z + 0.1 * (3.0 * z).sin(), 1.5 - 0.8 * z + 0.3 * (3.0 * z).cos(), -0.8 - 0.9 * (3.0 * z).sin()]
}

fn grains(z: f64) -> Jet {
    [0.6 * z + 0.2 * z * z, 0.6 + 0.4 * z, 0.4]
}

fn drag(z: f64) -> f64 {
    3.0 + 2.0 * (2.0 * z).sin()
}

/// Stress T at the top, and the force F(z) that the equation lacks.
fn exact(form: ViscousForm, z: f64) -> (f64, f64) {
    let (u, u_p, p, [l, dl], [eta, deta]) = (fluid(z), grains(z), phi(z), length(z), viscosity(z));
    let eps = [1.0 - p[0], -p[1], -p[2]];
    let mixture = form == ViscousForm::Mixture;
    let sheared = if mixture {
        let (a, b) = (product(eps, u), product(p, u_p));
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    } else {
        u
    };
    let [_, s, ds] = sheared;
    assert!(s > 0.0, "|s| is smooth only where s does not vanish");
    // tau = eta_e s, or eps eta_e s, with their derivatives
    let (tau, dtau) = (eta * s, deta * s + eta * ds);
    let (tau, viscous) = if mixture { (tau, eps[0] * dtau) } else { (eps[0] * tau, eps[1] * tau + eps[0] * dtau) };
    // R = rho eps l^2 s^2
    let reynolds = RHO * eps[0] * l * l * s * s;
    let dreynolds = RHO * (eps[1] * l * l * s * s + 2.0 * eps[0] * l * dl * s * s + 2.0 * eps[0] * l * l * s * ds);
    let f = WALL.friction_factor(u[0] * WIDTH * RHO / ETA);
    let wall = eps[0] * RHO * 2.0 / WIDTH * f / 8.0 * u[0] * u[0];
    (tau + reynolds, -(viscous + dreynolds + eps[0] * DRIVE + drag(z) * (u_p[0] - u[0]) - wall))
}

fn solve(form: ViscousForm, grid: Grid) -> FluidColumn {
    let setup = Setup {
        viscosity: MixtureViscosity::Boyer(Boyer { phi_max: JAMMED }),
        form,
        mixing_length: MixingLength::LiSawamoto(LiSawamoto {
            kappa: KAPPA,
            phi_max: PHI_MAX,
            below_packed: BelowPacked::Published,
        }),
        side_wall: WALL,
        width: WIDTH,
        ..Setup::laminar(RHO, ETA)
    };
    let mut grains = medium(&grid, |z| phi(z)[0], |z| grains(z)[0], drag);
    grains.force = grid.centres().iter().map(|&z| exact(form, z).1).collect();
    let forcing = Forcing { drive: DRIVE, bottom: Bottom::NoSlip, top: Top::Stress(exact(form, 1.0).0) };
    steady(grid, setup, &grains, forcing).0
}

#[test]
fn each_viscous_form() {
    // Orders 2.00 on equal cells in each form; on graded ones 1.96 to 2.00 in the mixture form, 1.92, 1.95, 1.97, 1.99 in the
    // others (40 to 640 cells).
    for form in [ViscousForm::Mixture, ViscousForm::Fluid, ViscousForm::Effective] {
        for grid in [uniform, graded] {
            assert_order_two(&[40, 80, 160, 320], |n| error(&solve(form, grid(1.0, n)), |z| fluid(z)[0]));
        }
    }
}

#[test]
fn fluid_and_effective_are_one_equation() {
    let (a, b) = (solve(ViscousForm::Fluid, graded(1.0, 40)), solve(ViscousForm::Effective, graded(1.0, 40)));
    assert_eq!(a.velocity(), b.velocity());
    // The mixture form is another one: with the force of the fluid form it gives another flow.
    let force = |form| exact(form, 0.3).1;
    assert!((force(ViscousForm::Mixture) - force(ViscousForm::Fluid)).abs() > 1e-2);
}

#[test]
fn stresses_at_the_faces() {
    // Orders 2.00 of the total stress at the faces above the lowest tenth (80 to 320 cells): at the wall the half cell makes
    // it 1.
    for form in [ViscousForm::Mixture, ViscousForm::Fluid] {
        assert_order_two(&[80, 160], |n| {
            let column = solve(form, uniform(1.0, n));
            let stresses = column.tau_viscous().iter().zip(column.tau_reynolds()).zip(column.grid().faces());
            let off = |((tau, reynolds), z): ((&f64, &f64), &f64)| (tau + reynolds - exact(form, *z).0).abs();
            stresses.skip(n / 10).map(off).fold(0.0, f64::max)
        });
    }
}
