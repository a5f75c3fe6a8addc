//! The closed form against integrations of the momentum equations that do not use it.

use approx::assert_relative_eq;

use super::{Scaled, Solution};
use crate::numerics::quadrature::simpson;

const PAPER: Scaled = Scaled { f: 0.1, resistance: 0.43 * 0.55, e: 1.0 + 2.5 * 0.55, h_p: 0.5, k: None };

fn two_fluid(d: f64, f: f64) -> Scaled {
    Scaled { f, k: Some(0.45_f64.powi(3) * d * d / (180.0 * 0.55 * 0.55)), ..PAPER }
}

fn solve(scaled: Scaled) -> Solution {
    scaled.solve(|_| {}).unwrap()
}

/// Integrates e(z) U'' = rhs upwards from `z` with classical Runge-Kutta steps.
fn climb(e: f64, rhs: impl Fn(f64) -> f64, from: (f64, f64, f64), to: f64) -> (f64, f64) {
    let n = 4000;
    let h = (to - from.0) / f64::from(n);
    let (mut u, mut v) = (from.1, from.2);
    for _ in 0..n {
        let a = |u: f64| rhs(u) / e;
        let (k1u, k1v) = (v, a(u));
        let (k2u, k2v) = (v + 0.5 * h * k1v, a(u + 0.5 * h * k1u));
        let (k3u, k3v) = (v + 0.5 * h * k2v, a(u + 0.5 * h * k2u));
        let (k4u, k4v) = (v + h * k3v, a(u + h * k3u));
        u += h / 6.0 * (k1u + 2.0 * k2u + 2.0 * k3u + k4u);
        v += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
    }
    (u, v)
}

#[test]
fn mixed_form_by_runge_kutta_from_the_yield_level_to_the_wall() {
    let Scaled { f, resistance, e, h_p, .. } = PAPER;
    let solution = solve(PAPER);
    let (u, v) = climb(e, |_| resistance - f, (solution.h_c, 0.0, 0.0), h_p);
    assert_relative_eq!(u, solution.mixture(h_p), max_relative = 1e-11);
    // The stress is continuous, so the velocity gradient jumps by e.
    let (u, _) = climb(1.0, |_| -f, (h_p, u, e * v), 1.0);
    assert_relative_eq!(u, 0.0, epsilon = 1e-13);
}

#[test]
fn mixed_form_flux_by_integrating_the_yield_criterion() {
    // u' = (tau - mu_s P_p)/e where positive: no use of Y, B or h_c.
    let Scaled { f, resistance, e, h_p, .. } = PAPER;
    let solution = solve(PAPER);
    let excess = |z: f64| ((solution.tau_interface + (f - resistance) * (h_p - z)) / e).max(0.0);
    let u = |z: f64| simpson(excess, 0.0, z, 4000);
    let flux = simpson(u, 0.0, h_p, 4000);
    assert_relative_eq!(flux, solution.flux(), max_relative = 1e-5);
    let lost = u(h_p) + solution.tau_interface * 0.5 - 0.125 * f;
    assert_relative_eq!(lost, 0.0, epsilon = 1e-8);
}

#[test]
fn two_fluid_form_by_runge_kutta_through_all_layers() {
    // Coarse grains, so that the unstable climb through the seepage keeps its digits.
    let scaled = two_fluid(1.0, 0.15);
    let Scaled { f, resistance, e, h_p, k } = scaled;
    let k = k.unwrap();
    let solution = solve(scaled);
    assert!(solution.moves());
    let start = (0.0, 0.0, solution.fluid_stress(0.0) / e);
    let (u, v) = climb(e, |u| u / k - f, start, solution.h_c);
    assert_relative_eq!(u, k * resistance, max_relative = 1e-9);
    let (u, v) = climb(e, |_| resistance - f, (solution.h_c, u, v), h_p);
    assert_relative_eq!(u, solution.mixture(h_p), max_relative = 1e-9);
    let (u, _) = climb(1.0, |_| -f, (h_p, u, e * v), 1.0);
    assert_relative_eq!(u, 0.0, epsilon = 1e-10);
}

#[test]
fn momentum_of_each_phase_by_finite_differences() {
    let scaled = two_fluid(1.0 / 30.0, 0.1);
    let Scaled { f, resistance, h_p, k, .. } = scaled;
    let k = k.unwrap();
    let phi = 0.55;
    let solution = solve(scaled);
    let h = 1e-6;
    for z in [0.1, solution.h_c - 0.002, solution.h_c + 0.01, h_p - 0.01] {
        let slope = |g: &dyn Fn(f64) -> f64| (g(z + h) - g(z - h)) / (2.0 * h);
        let force = f + slope(&|z| solution.fluid_stress(z));
        let drag = (solution.mixture(z) - solution.particle(z)) / k;
        assert_relative_eq!(force, drag, epsilon = 1e-8);
        let grains = slope(&|z| solution.particle_stress(z)) + phi * force + (1.0 - phi) * drag;
        assert_relative_eq!(grains, 0.0, epsilon = 1e-8);
    }
    // Friction holds the static grains, and is spent on the moving ones.
    assert!((1..100).all(|i| {
        let z = solution.h_c * f64::from(i) / 100.0;
        solution.particle_stress(z) < resistance * (h_p - z)
    }));
}

#[test]
fn two_fluid_form_tends_to_the_mixed_form_as_grains_get_fine() {
    let mixed = solve(PAPER);
    let error = |d: f64| (solve(two_fluid(d, 0.1)).flux() / mixed.flux() - 1.0).abs();
    assert!(error(1e-3) < 1e-2 && error(1e-4) < error(1e-3) / 5.0, "{} {}", error(1e-3), error(1e-4));
}

#[test]
fn discharge_and_largest_velocity_by_quadrature() {
    for scaled in [PAPER, two_fluid(1.0 / 30.0, 0.1), two_fluid(1.0 / 30.0, 1e-3)] {
        let solution = solve(scaled);
        let faces = [0.0, solution.h_c - 0.05, solution.h_c, scaled.h_p, 1.0];
        let integral: f64 = faces.windows(2).map(|p| simpson(|z| solution.mixture(z), p[0], p[1], 4000)).sum();
        assert_relative_eq!(integral, solution.discharge(), max_relative = 1e-9);
        let super::Maximum { level: z, value: u } = solution.largest_velocity();
        assert_relative_eq!(u, solution.mixture(z), max_relative = 1e-13);
        assert!(u > solution.mixture(z - 1e-3) && u > solution.mixture(z + 1e-3));
    }
}

#[test]
fn static_bed_below_the_threshold_of_the_two_fluid_form() {
    // The threshold of the paper's bed, found independently: f = 1.975e-3.
    let below = solve(two_fluid(1.0 / 30.0, 1.97e-3));
    let above = solve(two_fluid(1.0 / 30.0, 1.98e-3));
    assert!(!below.moves() && above.moves());
    assert_eq!(below.flux(), 0.0);
    // Both layers meet at the interface with one velocity and one stress.
    let h_p = PAPER.h_p;
    assert_relative_eq!(below.mixture(h_p), below.mixture(h_p + 1e-12), max_relative = 1e-8);
    assert_relative_eq!(below.mixture(1.0), 0.0, epsilon = 1e-15);
    assert_relative_eq!(below.fluid_stress(h_p), below.fluid_stress(h_p + 1e-12), max_relative = 1e-8);
}

#[test]
fn limits_of_the_drive_from_both_sides() {
    let limit = PAPER.largest_drive();
    let e = PAPER.e;
    assert_relative_eq!(limit, PAPER.resistance * (1.0 + 2.0 * e) / (1.0 + 3.0 * e), max_relative = 1e-14);
    assert!(Scaled { f: 0.999_999 * limit, ..PAPER }.solve(|_| {}).is_ok());
    let over = Scaled { f: 1.000_001 * limit, ..PAPER }.solve(|_| {}).unwrap_err();
    assert_eq!(over.code(), "whole-bed-moves");
    let over = Scaled { f: PAPER.resistance, ..PAPER }.solve(|_| {}).unwrap_err();
    assert_eq!(over.code(), "no-static-bed");
}
