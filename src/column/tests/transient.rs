//! Time: backward Euler, and the steady state as its limit.

use std::f64::consts::PI;

use approx::assert_relative_eq;

use super::*;
use crate::closures::mixing_length::{MixingLength, Prandtl};
use crate::closures::side_wall::SideWall;

/// Decay of a sine between plates at rest, nu = 2.5, by `steps` steps up to the time 0.1. Returns the amplitude.
fn decay(cells: usize, steps: usize) -> f64 {
    let mut column = FluidColumn::new(uniform(1.0, cells), Setup::laminar(2.0, 5.0)).unwrap();
    let sine = |z: f64| (PI * z).sin();
    let start: Vec<f64> = column.grid().centres().iter().map(|&z| sine(z)).collect();
    column.set_velocity(&start).unwrap();
    let forcing = Forcing { drive: 0.0, bottom: Bottom::NoSlip, top: Top::NoSlip };
    let medium = Medium::clear(cells);
    for _ in 0..steps {
        let step = column.step(&medium, &forcing, 0.1 / steps as f64).unwrap();
        assert!(step.balance.relative().abs() < 1e-12, "{step:?}");
    }
    let i = cells / 2;
    column.velocity()[i] / sine(column.grid().centres()[i])
}

#[test]
fn a_sine_decays_as_backward_euler_says() {
    // The sine is an eigenvector of the discrete equations too, with the eigenvalue (2/h sin(pi h/2))^2.
    for (cells, steps) in [(10, 1), (25, 7), (40, 30)] {
        let h = 1.0 / cells as f64;
        let rate = 2.5 * (2.0 / h * (PI * h / 2.0).sin()).powi(2);
        let expect = (1.0 + rate * 0.1 / steps as f64).powi(-(steps as i32));
        assert_relative_eq!(decay(cells, steps), expect, max_relative = 1e-11);
    }
}

#[test]
fn order_one_in_time() {
    // Orders 0.998, 0.999, 0.999 against exp(-nu pi^2 t) (50 to 400 steps, 2000 cells).
    let exact = (-0.25 * PI * PI).exp();
    for order in orders(&[50, 100, 200], |steps| (decay(2000, steps) / exact - 1.0).abs()) {
        assert!((order - 1.0).abs() < 0.05, "{order}");
    }
}

#[test]
fn the_steady_state_does_not_know_the_time_step() {
    let grid = graded(0.1, 60);
    let grains = medium(&grid, |z| 0.5 - 4.0 * z.min(0.12), |z| 0.5 * z, |z| 2e3 * (0.1 - z));
    let forcing = Forcing { drive: 30.0, bottom: Bottom::NoSlip, top: Top::FreeSurface };
    for form in [ViscousForm::Mixture, ViscousForm::Fluid] {
        let mixing_length = MixingLength::Prandtl(Prandtl { kappa: 0.41 });
        let setup =
            Setup { form, mixing_length, side_wall: SideWall::Blasius, width: 0.05, ..Setup::laminar(1000.0, 1e-3) };
        let (rest, _) = steady(grid.clone(), setup, &grains, forcing);
        for dt in [1.0, 50.0] {
            let mut column = FluidColumn::new(grid.clone(), setup).unwrap();
            for _ in 0..2000 {
                let step = column.step(&grains, &forcing, dt).unwrap();
                assert!(step.balance.relative().abs() < 1e-12, "{step:?}");
            }
            for (a, b) in column.velocity().iter().zip(rest.velocity()) {
                assert_relative_eq!(*a, *b, max_relative = 1e-10);
            }
        }
    }
}

#[test]
fn momentum_gained_by_the_fluid_alone() {
    // Nothing but the drive: u = G t/rho whatever the solid fraction, for the fluid is driven and accelerated alike.
    let grid = uniform(1.0, 5);
    let grains = medium(&grid, |z| 0.6 * z, |_| 0.0, |_| 0.0);
    let forcing = Forcing { drive: 3.0, bottom: Bottom::Stress(0.0), top: Top::FreeSurface };
    let mut column = FluidColumn::new(grid, Setup::laminar(2.0, 1.0)).unwrap();
    for n in 1..=4 {
        let balance = column.step(&grains, &forcing, 0.5).unwrap().balance;
        assert!(error(&column, |_| 0.75 * f64::from(n)) < 1e-13);
        assert_relative_eq!(balance.inertia, 3.0 * 0.7, max_relative = 1e-13);
        assert!(balance.relative().abs() < 1e-13);
    }
}

#[test]
fn a_velocity_put_back_continues_to_the_bit() {
    let grid = graded(0.1, 30);
    let grains = medium(&grid, |z| 0.5 - 4.0 * z, |z| z, |_| 1e3);
    let forcing = Forcing { drive: 30.0, bottom: Bottom::NoSlip, top: Top::FreeSurface };
    let setup = Setup { mixing_length: MixingLength::Prandtl(Prandtl { kappa: 0.41 }), ..Setup::laminar(1000.0, 1e-3) };
    let mut whole = FluidColumn::new(grid.clone(), setup).unwrap();
    let run = |column: &mut FluidColumn| {
        for _ in 0..5 {
            column.step(&grains, &forcing, 0.01).unwrap();
        }
    };
    run(&mut whole);
    let mut restarted = FluidColumn::new(grid, setup).unwrap();
    restarted.set_velocity(whole.velocity()).unwrap();
    for column in [&mut whole, &mut restarted] {
        run(column);
    }
    assert_eq!(whole.velocity(), restarted.velocity());
    assert_eq!(whole.tau_reynolds(), restarted.tau_reynolds());
}
