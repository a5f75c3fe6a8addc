use super::{Domain, G, R, engine, floor, gas, go, grain, law};
use crate::discrete::{Engine, LinearSpring, Point, Tension};

/// Momentum and angular momentum about the origin, with the positions to which the velocities lead.
fn momenta(engine: &Engine<LinearSpring>) -> (Point, Point, [f64; 2]) {
    let grains = engine.grains();
    let (mut p, mut l, mut scale) = ([0.0; 3], [0.0; 3], [0.0; 2]);
    for i in 0..grains.len() {
        let (x, v, w, m, r) =
            (grains.position(i), grains.velocity(i), grains.spin(i), grains.mass(i), grains.radius(i));
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            p[k] += m * v[k];
            l[k] += m * (x[a] * v[b] - x[b] * v[a]) + 0.4 * m * r * r * w[k];
            scale[0] += (m * v[k]).abs();
            scale[1] += (m * x[a] * v[b]).abs();
        }
    }
    (p, l, scale)
}

#[test]
fn a_free_cluster_keeps_momentum_and_angular_momentum() {
    let mut engine = engine(&gas(200, 0.05, 0.3), Domain::default(), law(0.5, Tension::Cut), 2e-5, [0.0; 3]);
    go(&mut engine, 1);
    let (p0, l0, scale) = momenta(&engine);
    let mut touched = 0;
    for _ in 0..1500 {
        go(&mut engine, 1);
        touched += engine.found().contacts;
    }
    let (p, l, _) = momenta(&engine);
    for k in 0..3 {
        assert!((p[k] - p0[k]).abs() < 1e-13 * scale[0], "{:e}", p[k] - p0[k]);
        assert!((l[k] - l0[k]).abs() < 1e-13 * scale[1], "{:e} of {:e}", l[k] - l0[k], scale[1]);
    }
    assert!(touched > 5000, "{touched} contacts");
}

#[test]
fn a_periodic_gas_keeps_momentum() {
    let domain = Domain { periods: [Some(0.05), Some(0.05)], walls: Vec::new() };
    let mut engine = engine(&gas(200, 0.05, 0.0), domain, law(0.5, Tension::Cut), 2e-5, [0.0; 3]);
    let (p0, _, scale) = momenta(&engine);
    go(&mut engine, 3000);
    let (p, ..) = momenta(&engine);
    for k in 0..3 {
        assert!((p[k] - p0[k]).abs() < 1e-13 * scale[0], "{:e}", p[k] - p0[k]);
    }
    assert!(engine.rebuilds() > 3);
}

#[test]
fn the_account_of_energies_closes_to_round_off_over_a_million_steps() {
    let grains: Vec<_> = gas(8, 0.03, 0.2);
    let mut domain = floor();
    domain.periods = [Some(0.03), Some(0.03)];
    let mut engine = engine(&grains, domain, law(0.9, Tension::Cut), 2e-5, [1.0, 0.0, -G]);
    go(&mut engine, 1_000_000);
    let kinetic = engine.grains().kinetic_energy();
    let relative = engine.ledger().defect(kinetic) / engine.ledger().scale(kinetic);
    assert!(relative.abs() < 1e-12, "{relative:e}");
    assert!(engine.ledger().contacts.total() < 0.0, "contacts take energy");
}

#[test]
fn the_defect_of_the_spring_energy_falls_faster_than_the_time_step() {
    // Two elastic grains without friction: kinetic and spring energy together, where the defect is largest.
    let defect = |dt: f64| {
        let mut law = law(1.0, Tension::Cut);
        law.mu = 0.0;
        let pair = [grain([0.0; 3], [0.0; 3]), grain([2.0 * R + 1e-6, 0.0, 0.0], [-0.1, 0.0, 0.0])];
        let mut engine = engine(&pair, Domain::default(), law, dt, [0.0; 3]);
        let mut before = engine.grains().kinetic_energy();
        let initial = before + engine.spring_energy();
        let mut worst = 0.0_f64;
        for _ in 0..(8e-4 / dt) as usize {
            let spring = engine.spring_energy();
            go(&mut engine, 1);
            let after = engine.grains().kinetic_energy();
            // Velocities stand at half steps: the mean of both sides belongs to the spring between them.
            worst = worst.max((0.5 * (before + after) + spring - initial).abs() / initial);
            before = after;
        }
        worst
    };
    // How far into a step the touch falls differs: the worst of steps that are close.
    let worst = |dt: f64| (0..10).map(|i| defect(dt * (1.0 - 0.03 * f64::from(i)))).fold(0.0, f64::max);
    let (coarse, fine) = (worst(2e-5), worst(2.5e-6));
    let order = (coarse / fine).log2() / 3.0;
    println!("order {order}: {coarse:.2e} {fine:.2e}");
    assert!(order > 1.5 && coarse < 2e-3, "order {order}: {coarse:.2e} {fine:.2e}");
}
