//! The steady flow: what it must be, and what it must not depend on.

use super::{CLASSICAL, flow, reference};
use crate::models::two_fluid::levels::Levels;
use crate::models::two_fluid::steady;
use crate::models::two_fluid::{outcome, run};
use crate::result::{Quiet, quantity as q};
use approx::assert_relative_eq;

fn rate(set: &[&str], cells: usize) -> f64 {
    let (flow, column) = reference(set, cells);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    Levels::new(&column, &solved.state, &solved.mobilised).flux()
}

#[test]
fn order_two_on_the_grid() {
    for law in [&["grid.fine="] as &[&str], &["grid.fine=", CLASSICAL]] {
        let [a, b, c] = [60, 120, 240].map(|cells| rate(law, cells));
        let order = ((a - b) / (b - c)).log2();
        assert!((1.5..2.5).contains(&order), "{law:?}: {a} {b} {c}, order {order}");
        assert!((b - c).abs() / 3.0 < 0.003 * c, "{law:?}: {b} {c}");
    }
}

#[test]
fn the_shipped_grid_is_fine_enough_at_all_shields_numbers() {
    for shields in ["0.2", "0.4", "0.6", "0.8", "1"] {
        for law in ["closures.granular.law=frictional-collisional", CLASSICAL] {
            let shields = format!("flow.shields={shields}");
            let set = ["flow.depth=", shields.as_str(), law];
            let [shipped, finer] = [240, 480].map(|cells| rate(&set, cells));
            let error = 4.0 / 3.0 * (shipped / finer - 1.0);
            assert!(error.abs() < 0.005, "{set:?}: {shipped} {finer}");
        }
    }
}

#[test]
fn small_numbers_do_not_matter() {
    let reference = rate(&[], 120);
    for (set, most) in [
        ("regularisation.granular_temperature=1e-10", 1e-5),
        ("regularisation.granular_temperature=1e-6", 1e-4),
        ("regularisation.shear_rate=1e-8", 1e-5),
        ("regularisation.shear_rate=1e-4", 1e-4),
        ("regularisation.phi=1e-15", 1e-7),
        ("regularisation.phi=1e-9", 1e-6),
    ] {
        let change = (rate(&[set], 120) / reference - 1.0).abs();
        assert!(change < most, "{set}: {change:e}");
    }
}

#[test]
fn readings_change_what_an_independent_solution_says_they_change() {
    let reference = rate(&[], 120);
    let share = |set: &str| rate(&[set], 120) / reference;
    // By a third, by 12 %, by 18 %, and by a few per cent.
    assert!((share("closures.mixing_length.phi_max=0.635") - 2.0 / 3.0).abs() < 0.02);
    assert!((share("fluid_stress=whole") - 0.88).abs() < 0.01);
    assert!((share("grains.restitution=0.9") - 1.18).abs() < 0.01);
    for e in ["0.3", "0.5"] {
        assert!((share(&format!("grains.restitution={e}")) - 1.0).abs() < 0.05, "{e}");
    }
    // The classical theory is more than half off.
    assert!(share(CLASSICAL) > 1.5);
}

#[test]
fn balances_close_and_solids_are_kept() {
    for set in [&[] as &[&str], &[CLASSICAL], &["grains.friction=0"], &["grains.restitution=0.3"]] {
        let flow = flow("flow_theta06-two-fluid", set);
        let outcome = run(&flow, 120, &mut Quiet).unwrap();
        for balance in &outcome.balances {
            assert!(balance.relative.abs() < 1e-9, "{set:?}: {} {:e}", balance.name, balance.relative);
        }
        let solids = outcome.balances.iter().find(|balance| balance.name == "solids").unwrap();
        assert!(solids.relative.abs() < 1e-13);
        let volume = outcome.results.get(q::SOLID_VOLUME.name).unwrap();
        assert_relative_eq!(volume, 0.6065 * 0.075, max_relative = 1e-12);
    }
}

#[test]
fn the_pressure_carries_the_weight() {
    let (flow, column) = reference(&[], 240);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let levels = Levels::new(&column, &solved.state, &solved.mobilised);
    let lowest = &levels.cells[0];
    let carried = lowest.pressure + lowest.elastic + 0.5 * lowest.dz * lowest.phi * column.laws.weight;
    assert_relative_eq!(carried, column.solids * column.laws.weight, max_relative = 2e-4);
}

#[test]
fn a_flow_too_large_to_compute_says_so() {
    let mut flow = flow("flow_theta06-two-fluid", &[]);
    flow.eta = f64::MAX;
    assert!(outcome::column(&flow, 40).is_err());
}

#[test]
fn near_the_threshold_the_steady_flow_is_unstable() {
    let growth = |set: &[&str]| {
        let (flow, column) = reference(set, 120);
        let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
        column.growth(&solved.state).unwrap()
    };
    let (unstable, stable) = (growth(&["flow.depth=", "flow.shields=0.2"]), growth(&[]));
    assert!(unstable.rate > 0.0 && unstable.frequency > 0.0, "{unstable:?}");
    assert!(stable.rate < 0.0, "{stable:?}");
    assert!(growth(&["flow.depth=", "flow.shields=0.25"]).rate < 0.0);
}

#[test]
fn without_shear_nothing_moves_but_what_seeps() {
    // A slope without water: the bed holds, and the seepage has the drag that the slope drives.
    let (flow, column) = reference(&["flow.shields=", "flow.depth=0", "flow.slope=0.01", "grid.fine="], 80);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let levels = Levels::new(&column, &solved.state, &solved.mobilised);
    assert!(levels.flux() < 1e-6, "{}", levels.flux());
    let deep = &levels.cells[5];
    assert_relative_eq!(deep.drag, (1.0 - deep.phi) * column.laws.drive[0], max_relative = 1e-3);
    // Contacts carry what the slope drives.
    let driven: f64 = levels.cells[5..]
        .iter()
        .map(|level| level.dz * (level.phi * column.laws.ratio + 1.0 - level.phi) * column.laws.drive[0])
        .sum();
    assert_relative_eq!(
        levels.at(levels.cells[5].z - 0.5 * deep.dz, |level| level.contact).unwrap(),
        driven,
        max_relative = 1e-3
    );
}
