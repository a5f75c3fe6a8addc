use crate::case::grain_tables::Target;
use crate::closures::contact::{LinearSpring, Tension};
use crate::discrete::impact::{Found, follow};
use crate::problem::Impact;

fn impact(e_n: f64, tension: Tension, target: Target, steps_per_contact: f64) -> Impact {
    let contact = LinearSpring { k_n: 5e3, k_s: 2.5e3, mu: 0.4, e_n, tension };
    Impact { d: 6e-3, rho_p: 2500.0, velocity: 0.1, angle: 0.0, spin: 0.0, target, contact, steps_per_contact }
}

fn oblique(e_n: f64, mu: f64, degrees: f64, steps: f64) -> Found {
    let mut one = impact(e_n, Tension::Cut, Target::Wall, steps);
    one.contact.mu = mu;
    one.angle = degrees.to_radians();
    follow(&one).unwrap()
}

#[test]
fn head_on_impacts_meet_e_n_in_both_conventions_against_grains_walls_and_fixed_grains() {
    for tension in [Tension::Cut, Tension::Kept] {
        for target in [Target::Wall, Target::Fixed, Target::Mobile] {
            for tenth in 1..=10 {
                let e_n = f64::from(tenth) / 10.0;
                let found = follow(&impact(e_n, tension, target, 50.0)).unwrap();
                assert!((found.restitution - e_n).abs() < 1e-3, "{tension:?} {target:?} {e_n}: {}", found.restitution);
                let late = (found.duration / found.expected_duration - 1.0).abs();
                // The force begins and ends within a step: two steps of fifty.
                assert!(late < 0.041, "{tension:?} {target:?} {e_n}: duration off by {late}");
                assert!(found.ledger.abs() < 1e-13, "{}", found.ledger);
            }
        }
    }
}

#[test]
fn the_simulated_restitution_converges_with_the_time_step() {
    let error = |steps| {
        let found = follow(&impact(0.5, Tension::Cut, Target::Mobile, steps)).unwrap();
        (found.restitution - 0.5).abs()
    };
    // What is left is the moment of the touch within a step.
    let mean = |n: f64| (0..20).map(|i| error(n * (1.0 + 0.01 * f64::from(i)))).sum::<f64>() / 20.0;
    let (coarse, fine) = (mean(25.0), mean(200.0));
    let order = (coarse / fine).log2() / 3.0;
    println!("order {order}: {coarse:.3e} {fine:.3e}");
    assert!(order > 1.5 && fine < 1e-4, "order {order}: {coarse:.3e} {fine:.3e}");
}

#[test]
fn gross_slip_obeys_its_line_at_every_angle_and_spin() {
    for e_n in [1.0, 0.5] {
        let mut checked = 0;
        for degrees in 1..=89 {
            let found = oblique(e_n, 0.1, f64::from(degrees), 400.0);
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let Some(expected) = found.gross_slip else { continue };
            // The dashpot pushes at once, while the tangential spring must first be stretched to its cap: with damping
            // a share mu 2 zeta^2 (k_n/k_s) cot(angle)/(1 + e) of the line is not reached; without, nothing is missing.
            let change = 0.1 * (1.0 + e_n) * 0.1 * cos;
            let missing = if e_n < 1.0 { 0.3 * 0.1 * cos / sin } else { 0.0 };
            let off = (found.tangential - expected).abs();
            assert!(off < (2e-3 + missing) * change, "{e_n} {degrees}: {} {expected}", found.tangential);
            let spin = 2.5 * change / 3e-3;
            // The arm of the friction is shorter than the radius by the overlap, at most v_n/(w R) of it.
            let missing = missing + 0.1 * cos / (4206.0 * 3e-3);
            assert!((found.spin / spin - 1.0).abs() < 2e-3 + missing, "{e_n} {degrees}: {} {spin}", found.spin);
            checked += 1;
        }
        assert!(checked > 20, "{checked}");
    }
    let spinning = Impact { spin: 2000.0, ..impact(0.5, Tension::Cut, Target::Wall, 50.0) };
    let found = follow(&spinning).unwrap();
    assert!((found.tangential - 0.06).abs() < 1e-4 && (found.spin - 1950.0).abs() < 50.0 * 8e-3, "{found:?}");
}

#[test]
fn no_impact_at_any_angle_creates_energy() {
    for e_n in [0.1, 0.5, 0.9, 1.0] {
        for mu in [0.0, 0.1, 0.4, 2.0] {
            for degrees in 0..=89 {
                let found = oblique(e_n, mu, f64::from(degrees), 50.0);
                assert!(found.gained < 1e-4, "{e_n} {mu} {degrees}: {:+.2e}", found.gained);
            }
        }
    }
}
