use super::{Domain, G, R, RHO, Which, engine, floor, go, grain, law, verification};
use crate::closures::contact::Tension;
use crate::dem::{Grain, Wall};
use crate::models::grains::Verification;
use crate::models::grains::verification::{found, motion};
use crate::result::quantity as q;

/// Overlap of a grain at rest on a floor \[m].
fn sunk() -> f64 {
    Grain::at_rest([0.0; 3], R, RHO).mass() * G / 5e3
}

#[test]
fn a_sliding_grain_rolls_after_two_sevenths_of_v_over_mu_g_with_five_sevenths_of_v() {
    let all = motion::rolling(&Verification { velocity: 0.5, ..verification(Which::Rolling, 0.5, 50.0) }).unwrap();
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    assert!(found(Ok(all.clone()), &q::ROLLING_TIME_ERROR).abs() < 6e-3);
    assert!(found(Ok(all), &q::ROLLING_VELOCITY_ERROR) < 4e-4);
}

#[test]
fn a_bouncing_grain_loses_its_share_of_height_at_each_impact() {
    // Stiff, so that the contact is short.
    let mut stiff = Verification { velocity: 1.4, ..verification(Which::Bouncing, 0.8, 50.0) };
    (stiff.contact.k_n, stiff.contact.k_s) = (5e6, 2.5e6);
    let worst = found(motion::bouncing(&stiff), &q::BOUNCE_ERROR);
    println!("{worst:e}");
    assert!(worst < 3e-3, "{worst}");
}

#[test]
fn three_stacked_grains_carry_each_other() {
    let worst = found(motion::stack(&verification(Which::Stack, 0.5, 50.0)), &q::STACK_ERROR);
    println!("{worst:e}");
    assert!(worst < 1e-9, "{worst}");
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
