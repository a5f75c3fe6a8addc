//! The cavity: accepted values of Stokes flow, conservation, and two methods that agree.

use std::ops::ControlFlow;

use crate::closures::regularisation::Regularisation;
use crate::models::section::cavity::Cavity;
use crate::models::section::{dual, newton};
use crate::result::Outcome;

use super::run;

fn get(outcome: &Outcome, name: &str) -> f64 {
    outcome.results.get(name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn stokes_flow_has_the_accepted_vortex_with_order_two() {
    let at = |cells: usize| {
        let outcome = run("section_2d_cavity_bn0", &[&format!("grid.cells={cells}"), "grid.finest=1"]);
        ["stream_function_max", "vortex_y_m", "vortex_z_m"].map(|name| get(&outcome, name))
    };
    let (coarse, fine) = (at(16), at(64));
    println!("{coarse:?} {fine:?}");
    assert!((fine[0] - 0.10008).abs() < 8e-5, "{fine:?}");
    assert!((fine[1] - 0.5).abs() < 1e-9 && (fine[2] - 0.765).abs() < 1.5e-3, "{fine:?}");
    let order = ((coarse[0] - 0.100_076).abs() / (fine[0] - 0.100_076).abs()).log2() / 2.0;
    assert!((1.5..2.8).contains(&order), "{order}");
}

#[test]
fn a_yield_stress_weakens_the_vortex_raises_it_and_leaves_material_at_rest() {
    let at = |bn: f64| {
        let outcome = run("section_2d_cavity_bn2", &[&format!("fluid.yield_stress={bn}"), "grid.cells=24"]);
        ["stream_function_max", "vortex_z_m", "unyielded_share"].map(|name| get(&outcome, name))
    };
    let numbers = [0.5, 2.0, 5.0, 20.0].map(at);
    println!("{numbers:?}");
    for pair in numbers.windows(2) {
        assert!(pair[1][0] < pair[0][0] && pair[1][1] > pair[0][1] && pair[1][2] > pair[0][2], "{pair:?}");
    }
    assert!((numbers[1][0] - 0.0781).abs() < 8e-4, "{numbers:?}");
    assert!((numbers[1][2] - 0.27).abs() < 0.02, "{numbers:?}");
}

#[test]
fn two_methods_agree() {
    for bn in [2.0, 20.0] {
        let cavity = Cavity::new(bn, 16, 0.5);
        let go_on = &mut |_| ControlFlow::Continue(());
        let newton = newton::solve(&cavity.program, &Regularisation::EXACT, go_on).unwrap();
        let dual = dual::solve(&cavity.program, 1e-7, 20_000, go_on).unwrap();
        let largest = newton.x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let worst = newton.x.iter().zip(&dual.x).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        println!("Bn {bn}: {} iterations, {:.1e}", dual.history.len(), worst / largest);
        assert!(worst < 1e-4 * largest, "{worst}");
    }
}

#[test]
fn as_much_flows_to_the_right_as_to_the_left() {
    let outcome = run("section_2d_cavity_bn5", &["grid.cells=16"]);
    let profile = outcome.profile.unwrap();
    let u = profile.get(&crate::result::quantity::U_MIXTURE).unwrap();
    // The discrete stream function vanishes at both ends: the cells of the profile hold it exactly.
    let z = profile.axis();
    let (mut flow, mut face, mut size) = (0.0, 0.0, 0.0_f64);
    for j in 1..z.len() - 1 {
        let h = 2.0 * (z[j] - face);
        face += h;
        flow += u[j].unwrap() * h;
        size += u[j].unwrap().abs() * h;
    }
    assert!((face - 1.0).abs() < 1e-12 && flow.abs() < 1e-12 * size, "{face} {flow} {size}");
}

#[test]
fn the_unyielded_share_is_right_within_its_error() {
    // Extrapolated from 96 and 192 cells, and the scatter of that.
    for (bn, right, scatter) in [(2, 0.2536, 6e-3), (5, 0.4471, 2e-3), (20, 0.6815, 5e-3), (50, 0.7906, 4e-3)] {
        let errors = [24, 48, 96].map(|cells| {
            let outcome = run(&format!("section_2d_cavity_bn{bn}"), &[&format!("grid.cells={cells}")]);
            let (share, error) = (get(&outcome, "unyielded_share"), get(&outcome, "unyielded_share_error"));
            println!("Bn {bn} on {cells}: {share:.4} ± {error:.4}, right {right}");
            assert!((share - right).abs() < error + scatter, "Bn {bn} on {cells}: {share} {error}");
            error
        });
        assert!(errors[2] < 0.05, "Bn {bn}: {errors:?}");
    }
    let outcome = run("section_2d_cavity_bn0", &["grid.cells=16"]);
    assert_eq!((get(&outcome, "unyielded_share"), get(&outcome, "unyielded_share_error")), (0.0, 0.0));
}
