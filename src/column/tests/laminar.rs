//! Laminar flows: between plates, down a slope, through a bed.

use approx::assert_relative_eq;

use super::*;
use crate::closures::mixture_viscosity::MixtureViscosity;

const ETA: f64 = 0.3;

#[test]
fn poiseuille() {
    // Orders 2.000 on equal cells, 1.94 to 1.99 on graded ones (40 to 320 cells).
    let forcing = Forcing { drive: 2.0, bottom: Bottom::NoSlip, top: Top::NoSlip };
    let exact = |z: f64| forcing.drive / (2.0 * ETA) * z * (0.5 - z);
    for grid in [uniform, graded] {
        assert_order_two(&[40, 80, 160], |n| {
            let (column, step) = steady(grid(0.5, n), Setup::laminar(1e3, ETA), &Medium::clear(n), forcing);
            assert_eq!(step.iterations, 1, "a linear problem");
            error(&column, exact)
        });
    }
    // The walls share the force on equal cells.
    let (_, step) = steady(uniform(0.5, 8), Setup::laminar(1e3, ETA), &Medium::clear(8), forcing);
    assert_relative_eq!(step.balance.bottom, 0.5, max_relative = 1e-13);
    assert_relative_eq!(step.balance.top, -0.5, max_relative = 1e-13);
}

#[test]
fn couette_is_exact_on_any_grid() {
    let forcing =
        Forcing { drive: 0.0, bottom: Bottom::Flow { velocity: -0.2, mixing_length: 0.0 }, top: Top::Lid(1.0) };
    for grid in [uniform(0.5, 7), graded(0.5, 33)] {
        let medium = Medium::clear(grid.cells());
        let (column, step) = steady(grid, Setup::laminar(1e3, ETA), &medium, forcing);
        assert!(error(&column, |z| 2.4 * z - 0.2) < 1e-14);
        assert_relative_eq!(step.balance.bottom, 2.4 * ETA, max_relative = 1e-13);
    }
}

#[test]
fn couette_in_layers_is_exact() {
    // Under one stress, a layer of grains at rest that do not resist but thicken the fluid, below clear fluid. The faces meet
    // between cells of different widths. Fluid form: the grains also take their share of the area.
    let grid = Grid::from_faces(vec![0.0, 0.1, 0.25, 0.4, 0.45, 0.7, 1.0]).unwrap();
    let (phi, tau) = (0.4, 0.6);
    let grains = medium(&grid, |z| if z < 0.4 { phi } else { 0.0 }, |_| 0.0, |_| 0.0);
    for (form, layer) in [(ViscousForm::Mixture, 2.0 * ETA), (ViscousForm::Fluid, 0.6 * 2.0 * ETA)] {
        let setup = Setup { viscosity: MixtureViscosity::Einstein, form, ..Setup::laminar(1e3, ETA) };
        let forcing = Forcing { drive: 0.0, bottom: Bottom::NoSlip, top: Top::Stress(tau) };
        let (column, _) = steady(grid.clone(), setup, &grains, forcing);
        // In the layer the mixture form shears U = eps u.
        let weight = if form == ViscousForm::Mixture { 1.0 - phi } else { 1.0 };
        let exact = |z: f64| if z < 0.4 { tau * z / (layer * weight) } else { tau * (0.4 / layer + (z - 0.4) / ETA) };
        assert!(error(&column, exact) < 1e-14, "{form:?}");
        assert!(column.tau_viscous()[..6].iter().all(|t| (t - tau).abs() < 1e-14));
    }
}

#[test]
fn film() {
    // Orders 2.000 on equal cells, 1.94 to 1.99 on graded ones (40 to 320 cells).
    let h = 0.02;
    let forcing = Forcing { drive: 9.81, bottom: Bottom::NoSlip, top: Top::FreeSurface };
    for grid in [uniform, graded] {
        assert_order_two(&[40, 80, 160], |n| {
            let (column, step) = steady(grid(h, n), Setup::laminar(1e3, ETA), &Medium::clear(n), forcing);
            assert_relative_eq!(step.balance.bottom, 9.81 * h, max_relative = 1e-12);
            error(&column, |z| 9.81 / ETA * (h * z - 0.5 * z * z))
        });
    }
}

#[test]
fn brinkman() {
    // Orders 1.91, 1.96, 1.98 in the mixture form, 1.92, 1.97, 1.98 in the others (40 to 320 cells, layers of 0.06 and 0.08 of
    // the bed at both ends).
    let (phi, beta, drive, lid) = (0.4, 4e1, 10.0, 0.5);
    let eps = 1.0 - phi;
    let forcing = Forcing { drive, bottom: Bottom::NoSlip, top: Top::Lid(lid) };
    for form in [ViscousForm::Mixture, ViscousForm::Fluid, ViscousForm::Effective] {
        // u'' l^2 = u - seepage. In the mixture form U = eps u is sheared, and the fluid takes eps of the stress.
        let share = if form == ViscousForm::Mixture { eps } else { 1.0 };
        let length = (eps * share * 2.0 * ETA / beta).sqrt();
        let (seepage, top) = (eps * drive / beta, lid / share);
        let sinh = |x: f64| (x / length).sinh() / (1.0 / length).sinh();
        let exact = |z: f64| seepage + (top - seepage) * sinh(z) - seepage * sinh(1.0 - z);
        assert_order_two(&[40, 80, 160], |n| {
            let grid = uniform(1.0, n);
            let bed = medium(&grid, |_| phi, |_| 0.0, |_| beta);
            let setup = Setup { viscosity: MixtureViscosity::Einstein, form, ..Setup::laminar(1e3, ETA) };
            let (column, step) = steady(grid, setup, &bed, forcing);
            // What the grains receive is what the fluid loses to them.
            let mut force = vec![0.0; n];
            column.force_on_grains(&bed, &mut force).unwrap();
            let received: f64 = force.iter().zip(column.grid().widths()).map(|(f, h)| f * h).sum();
            assert_relative_eq!(received, step.balance.grains_share - step.balance.drag, max_relative = 1e-12);
            error(&column, exact)
        });
    }
}

#[test]
fn grains_drag_the_fluid_along() {
    // Nothing but drag and drive: the fluid moves with the grains, faster by eps G/beta.
    let grid = uniform(1.0, 9);
    let grains = medium(&grid, |_| 0.3, |z| 1.0 - 3.0 * z * z, |_| 50.0);
    let forcing = Forcing { drive: 5.0, bottom: Bottom::Stress(0.0), top: Top::FreeSurface };
    let (column, _) = steady(grid, Setup::laminar(1e3, 1e-12), &grains, forcing);
    assert!(error(&column, |z| 1.07 - 3.0 * z * z) < 1e-12);
    // What drives the fluid ends in the grains.
    let mut force = [0.0; 9];
    column.force_on_grains(&grains, &mut force).unwrap();
    force.into_iter().for_each(|f| assert_relative_eq!(f, 0.7 * 5.0, max_relative = 1e-10));
}
