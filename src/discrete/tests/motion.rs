use super::{Domain, G, R, RHO, engine, floor, go, grain, law};
use crate::discrete::{Grain, Tension, Wall};

/// Overlap of a grain at rest on a floor [m].
fn sunk() -> f64 {
    Grain::at_rest([0.0; 3], R, RHO).mass() * G / 5e3
}

#[test]
fn a_sliding_grain_rolls_after_two_sevenths_of_v_over_mu_g_with_five_sevenths_of_v() {
    let v0 = 0.5;
    let dt = 2e-5;
    let start = grain([0.0, 0.0, R - sunk()], [v0, 0.0, 0.0]);
    let mut engine = engine(&[start], floor(), law(0.5, Tension::Cut), dt, [0.0, 0.0, -G]);
    let expected = 2.0 * v0 / (7.0 * 0.4 * G);
    let mut rolling = None;
    for step in 1..=(1.5 * expected / dt) as usize {
        go(&mut engine, 1);
        let (v, w) = (engine.grains().velocity(0)[0], engine.grains().spin(0)[1]);
        if rolling.is_none() && v - w * R <= 0.0 {
            rolling = Some(step as f64 * dt);
        }
    }
    let rolling = rolling.unwrap();
    assert!((rolling / expected - 1.0).abs() < 6e-3, "{rolling} {expected}");
    // The tangential spring goes on swinging a little: mean over its period.
    let mut sums = [0.0; 2];
    for _ in 0..2000 {
        go(&mut engine, 1);
        sums[0] += engine.grains().velocity(0)[0] / 2000.0;
        sums[1] += engine.grains().spin(0)[1] * R / 2000.0;
    }
    for mean in sums {
        assert!((mean / (5.0 / 7.0 * v0) - 1.0).abs() < 4e-4, "{mean}");
    }
}

#[test]
fn a_bouncing_grain_follows_parabolas() {
    // Stiff, so that the contact is short; e = 0.8, dropped from 0.1 m.
    let mut law = law(0.8, Tension::Cut);
    law.k_n = 5e6;
    law.k_s = 2.5e6;
    let (h, e) = (0.1, 0.8);
    let dt = 5e-7;
    let mut engine = engine(&[grain([0.0, 0.0, R + h], [0.0; 3])], floor(), law, dt, [0.0, 0.0, -G]);
    let fall = (2.0 * h / G).sqrt();
    // Highest point after the first, second and third impact: e^2 h each time.
    let mut highest = [0.0_f64; 3];
    let mut ends = [0.0; 4];
    ends[0] = fall;
    for n in 1..4 {
        ends[n] = ends[n - 1] + 2.0 * fall * e_power(e, n);
    }
    let mut step = 0;
    for n in 0..3 {
        while (step as f64) * dt < ends[n + 1] - 0.3 * fall * e_power(e, n + 1) {
            go(&mut engine, 1);
            step += 1;
            if step as f64 * dt > ends[n] + 0.3 * fall * e_power(e, n + 1) {
                highest[n] = highest[n].max(engine.grains().position(0)[2] - R);
            }
        }
        let expected = h * e_power(e, 2 * (n + 1));
        assert!((highest[n] / expected - 1.0).abs() < 2e-3, "{n}: {} {expected}", highest[n]);
    }
}

fn e_power(e: f64, n: usize) -> f64 {
    (0..n).map(|_| e).product()
}

#[test]
fn three_stacked_grains_carry_each_other() {
    let sunk = sunk();
    let mut z = R - 3.0 * sunk;
    let mut grains = Vec::new();
    for above in [2.0, 1.0, 0.0] {
        // A little off the equilibrium.
        grains.push(grain([0.0, 0.0, z + 0.2 * sunk], [0.0; 3]));
        z += 2.0 * R - above * sunk;
    }
    let mut engine = engine(&grains, floor(), law(0.5, Tension::Cut), 2e-5, [0.0, 0.0, -G]);
    go(&mut engine, 20_000);
    let places = engine.grains().places();
    let z: Vec<f64> = places.iter().map(|&i| engine.grains().position(i)[2]).collect();
    let overlaps = [R - z[0], 2.0 * R - (z[1] - z[0]), 2.0 * R - (z[2] - z[1])];
    for (overlap, carried) in overlaps.into_iter().zip([3.0, 2.0, 1.0]) {
        assert!((overlap / (carried * sunk) - 1.0).abs() < 1e-9, "{overlap} {}", carried * sunk);
    }
}

#[test]
fn a_wall_that_moves_drags_a_grain_by_friction_alone() {
    let mut domain = floor();
    domain.walls[0].velocity = [1.0, 0.0, 0.0];
    let start = grain([0.0, 0.0, R - sunk()], [0.0; 3]);
    let mut engine = engine(&[start], domain, law(0.5, Tension::Cut), 2e-5, [0.0, 0.0, -G]);
    go(&mut engine, 1000);
    // mu g t while it slips, and half of it would be without the kick's first half.
    let expected = 0.4 * G * 0.02;
    assert!((engine.grains().velocity(0)[0] / expected - 1.0).abs() < 2e-3, "{:?}", engine.grains().velocity(0));
    let smooth = Domain { walls: vec![Wall { rough: false, ..engine.domain().walls[0] }], ..floor() };
    let mut engine = super::engine(&[start], smooth, law(0.5, Tension::Cut), 2e-5, [0.0, 0.0, -G]);
    go(&mut engine, 1000);
    assert_eq!(engine.grains().velocity(0)[0], 0.0);
}
