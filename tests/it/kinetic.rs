//! Kinetic theory and mu(I) as two fluids, from outside: grains between two walls against those of a discrete simulation, and
//! a dry film against Bagnold's.

use std::fs;
use std::path::Path;

use bedload::result::{Outcome, Quantity, quantity as q};

use super::support::Scratch;

fn solve(case: &str, settings: &[&str]) -> Outcome {
    crate::support::solve(case, settings).unwrap()
}

/// The column `quantity` at the height `z`, linear between the levels.
fn at(outcome: &Outcome, quantity: &'static Quantity, z: f64) -> f64 {
    let profile = outcome.profile.as_ref().unwrap();
    let (levels, values) = (profile.axis(), profile.get(quantity).unwrap());
    let k = levels.partition_point(|level| *level < z).clamp(1, levels.len() - 1);
    let share = (z - levels[k - 1]) / (levels[k] - levels[k - 1]);
    let (low, high) = (values[k - 1].unwrap(), values[k].unwrap());
    low + share * (high - low)
}

/// Root mean square of the deviations from the points of a file of reference data, over the largest of them. Points are a
/// value and its height over that of the gap.
fn deviation(outcome: &Outcome, quantity: &'static Quantity, name: &str) -> Option<f64> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference").join(name);
    let Ok(text) = fs::read_to_string(&file) else {
        println!("skipped: {name} is not here");
        return None;
    };
    let points: Vec<(f64, f64)> = text
        .lines()
        .filter_map(|line| {
            let (value, height) = line.split_once(',')?;
            Some((value.parse().ok()?, height.parse().ok()?))
        })
        .collect();
    assert!(points.len() > 15);
    let height = outcome.results.get(q::FLOW_HEIGHT.name).unwrap();
    let sum: f64 = points.iter().map(|(value, z)| (at(outcome, quantity, z * height) - value).powi(2)).sum();
    let largest = points.iter().map(|(value, _)| value.abs()).fold(0.0, f64::max);
    Some((sum / points.len() as f64).sqrt() / largest)
}

#[test]
fn grains_between_walls_flow_like_those_of_a_discrete_simulation() {
    let outcome = solve("kinetic_1d_shear", &[]);
    for (quantity, name, most) in [
        (&q::U_PARTICLE, "simple_shear_vescovi2014_u.csv", 0.02),
        (&q::PHI, "simple_shear_vescovi2014_phi.csv", 0.05),
        (&q::GRANULAR_TEMPERATURE, "simple_shear_vescovi2014_theta.csv", 0.04),
    ] {
        if let Some(found) = deviation(&outcome, quantity, name) {
            assert!(found < most, "{name}: {found}");
        }
    }
}

#[test]
fn between_walls_only_a_kinetic_theory_will_do() {
    let scratch = Scratch::new();
    for (set, code) in [
        ("closures.granular.law=mu-i", "law-mismatch"),
        ("geometry.phi=0.64", "out-of-range"),
        ("geometry.height=0.5 mm", "thinner-than-a-grain"),
    ] {
        let answer = scratch.bedload(["run", "kinetic_1d_shear", "--set", set]).exits(2);
        assert!(answer.err.contains(code), "{set}: {}", answer.err);
    }
    assert!(!scratch.path("runs").exists());
}

#[test]
fn a_dry_film_becomes_that_of_bagnold() {
    // The surface lies within a cell: first order.
    let exact = 0.005_998_16;
    let error = |cells: &str| {
        let outcome = solve("two_fluid_1d_avalanche", &[cells]);
        outcome.results.get(q::TRANSPORT_RATE.name).unwrap() / exact - 1.0
    };
    let (coarse, fine) = (error("grid.cells=60"), error("grid.cells=120"));
    assert!(fine < 0.03, "{coarse} {fine}");
    let order = (coarse / fine).log2();
    assert!((0.85..1.25).contains(&order), "{coarse} {fine}");
}
