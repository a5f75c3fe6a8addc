//! Exact derivatives against differences of the residuals.

use super::{CLASSICAL, reference};
use crate::models::two_fluid::face::{Mobilised, bernoulli, mean_inverse};
use crate::models::two_fluid::start::Start;
use crate::models::two_fluid::state::{SIZE, Unknowns};
use crate::models::two_fluid::steady::euler;
use crate::models::two_fluid::system::{Column, Linear, Memory};
use crate::numerics::dual::{Dual, Real};
use crate::numerics::quadrature::simpson;
use approx::assert_relative_eq;

/// Largest deviation of the derivatives along a direction from differences, over their largest entry.
fn deviation(column: &Column, memory: &Memory) -> f64 {
    let mut state = column.from(0.6065, Start::Layer { shields: 0.6, thickness: 1.0 });
    for (i, x) in state.iter_mut().enumerate() {
        for (k, value) in x.iter_mut().enumerate() {
            *value += 1e-3 * ((7 * i + 3 * k) as f64).sin();
        }
    }
    let rate = column.laws.floors.rate;
    // The exact slope of the law of friction: the variable of the iteration agrees with it.
    let mobilised: Vec<Mobilised> = column.shear(&state).map(|s| Mobilised(s / s.hypot(rate))).collect();
    let direction = |i: usize, k: usize| ((11 * i + 5 * k) as f64).cos() * if k == 0 { 1e-3 } else { 1.0 };
    let mut linear = Linear::new(column.cells());
    let mut residual = |h: f64| -> Vec<f64> {
        let moved: Vec<Unknowns> =
            state.iter().enumerate().map(|(i, x)| std::array::from_fn(|k| x[k] + h * direction(i, k))).collect();
        column.linearise(&moved, memory, &mobilised, &mut linear);
        linear.residual.clone()
    };
    let h = 1e-6;
    let (high, low) = (residual(h), residual(-h));
    column.linearise(&state, memory, &mobilised, &mut linear);
    let exact = linear.times(direction);
    let largest = |row: usize| exact.iter().skip(row).step_by(SIZE).fold(0.0_f64, |m, x| m.max(x.abs()));
    let scales: Vec<f64> = (0..SIZE).map(largest).collect();
    exact
        .iter()
        .zip(high.iter().zip(&low))
        .enumerate()
        .map(|(at, (exact, (high, low)))| (exact - (high - low) / (2.0 * h)).abs() / scales[at % SIZE].max(1e-9))
        .fold(0.0, f64::max)
}

#[test]
fn of_every_closure_steady_and_in_time() {
    let smooth = "regularisation.shear_rate=1";
    for set in [
        &[smooth] as &[&str],
        &[smooth, CLASSICAL],
        &[smooth, "closures.granular.law=mu-i", "phi_max=0.61"],
        &[smooth, "closures.dispersion.law=gradient", "fluid_stress=whole"],
        &[smooth, "grains.restitution=0.3"],
    ] {
        let (_, column) = reference(set, 40);
        let steady = deviation(&column, &Memory::steady(40));
        assert!(steady < 1e-5, "{set:?}: {steady:e}");
        let at_rest = column.at_rest(0.6);
        let moving = deviation(&column, &euler(&column, &at_rest, 0.1));
        assert!(moving < 1e-5, "{set:?} in time: {moving:e}");
    }
}

#[test]
fn of_the_pieces() {
    for x in [-800.0, -30.0, -1.0, -1e-3, 1e-5, 9e-4, 1.1e-3, 2.0, 40.0, 800.0] {
        let h = 1e-6 * f64::max(1.0, x.abs());
        let slope = bernoulli(Dual::<1>::variable(x, 0)).slope[0];
        let difference = (bernoulli(x + h) - bernoulli(x - h)) / (2.0 * h);
        assert!((slope - difference).abs() < 1e-7, "{x}: {slope} {difference}");
        // B(-x) - B(x) = x.
        assert!((bernoulli(-x) - bernoulli(x) - x).abs() < 1e-14 * (1.0 + x.abs()), "{x}");
    }
    assert_eq!(bernoulli(0.0), 1.0);
    for (a, b) in [(1.0, 1.01), (1.0, 3.0), (3.0, 0.2)] {
        let mean = simpson(|x| 1.0 / (a + (b - a) * x), 0.0, 1.0, 20_000);
        assert_relative_eq!(mean_inverse(a, b).unwrap(), mean, max_relative = 1e-11);
    }
    assert_eq!(mean_inverse(0.0, 1.0), None);
}

#[test]
fn friction_at_rest_is_found_in_a_few_turns() {
    // mu r = load: r (gamma^2 + lambda^2)^(1/2) = gamma, far beyond the kink of the law at rest.
    for (load, start) in [(0.3, 10.0), (0.999, -1.0), (-0.9, 5.0)] {
        let (rate, viscosity) = (1e-8, 1e-3);
        let (mut shear, mut r) = (start, Mobilised::default());
        let balance = |shear: f64, value: f64| value + viscosity * shear - load;
        let mut iterations = 0;
        while balance(shear, r.law(shear, rate).0).abs() > 1e-12 {
            let (value, slope) = r.law(shear, rate);
            let to = shear - balance(shear, value) / (slope + viscosity);
            r = r.after(shear, to - shear, rate);
            shear = to;
            iterations += 1;
            assert!(iterations < 60, "{load} from {start}: {shear} {r:?}");
        }
        assert!((f64::constant(r.0) - load).abs() < 1e-2);
    }
}
