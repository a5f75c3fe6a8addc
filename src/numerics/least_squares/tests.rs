use super::*;
use approx::assert_relative_eq;

fn fit(start: &[f64], f: impl Fn(&[f64]) -> Result<Vec<f64>, &'static str> + Sync) -> Fit<&'static str> {
    within(start, &vec![(f64::NEG_INFINITY, f64::INFINITY); start.len()], f)
}

fn within(
    start: &[f64],
    bounds: &[(f64, f64)],
    f: impl Fn(&[f64]) -> Result<Vec<f64>, &'static str> + Sync,
) -> Fit<&'static str> {
    minimise(start, bounds, &f, &|_| ()).unwrap()
}

/// Twelve uniform numbers of a congruential generator (Knuth), less six: mean 0, variance 1.
fn normal(state: &mut u64) -> f64 {
    let mut uniform = || {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..12).map(|_| uniform()).sum::<f64>() - 6.0
}

#[test]
fn a_straight_line_has_the_errors_of_the_textbook() {
    // y = a + b x at x = 0, 1, 2, 3 with residuals by hand: a = 1.3, b = 0.9, sum of squares 0.3
    let y = [1.0, 2.5, 3.0, 4.0 + 0.1];
    let line = |p: &[f64]| Ok((0..4).map(|i| p[0] + p[1] * f64::from(i) - y[i as usize]).collect());
    let found = fit(&[5.0, -3.0], line);
    assert_eq!(found.ended, Ok(()));
    let (mean, slope) = (2.65, (-1.5 * 1.0 - 0.5 * 2.5 + 0.5 * 3.0 + 1.5 * 4.1) / 5.0);
    assert_relative_eq!(found.x[1], slope, epsilon = 1e-9);
    assert_relative_eq!(found.x[0], mean - 1.5 * slope, epsilon = 1e-9);
    let known = Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), &[false; 2], true).unwrap();
    assert_eq!(known.freedom, 2);
    assert_relative_eq!(known.errors[1], (1.0_f64 / 5.0).sqrt(), max_relative = 1e-8);
    assert_relative_eq!(known.errors[0], (0.25_f64 + 2.25 / 5.0).sqrt(), max_relative = 1e-8);
    assert_relative_eq!(known.correlations[0][1], -1.5 / 3.5_f64.sqrt(), max_relative = 1e-8);
    let scaled = Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), &[false; 2], false).unwrap();
    assert_relative_eq!(scaled.errors[1], (scaled.chi2 / 2.0 / 5.0).sqrt(), max_relative = 1e-8);
    assert_relative_eq!(scaled.weakest.1, (scaled.chi2 / 2.0).sqrt() / scaled.singular[1], max_relative = 1e-12);
}

#[test]
fn a_curved_valley_is_followed_and_steps_out_of_the_model_are_damped() {
    let valley = |p: &[f64]| {
        if p[0] > 1.5 { Err("beyond") } else { Ok(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]) }
    };
    let found = fit(&[-1.2, 1.0], valley);
    assert_eq!(found.ended, Ok(()));
    assert_relative_eq!(found.x[0], 1.0, epsilon = 1e-6);
    assert!(found.iterations > 5 && found.evaluations > 5 * found.iterations, "{found:?}");
}

#[test]
fn what_has_no_minimum_says_why_and_keeps_the_best() {
    let wall = |p: &[f64]| if p[0] < 1.0 { Err("wall") } else { Ok(vec![p[0], p[0] - 0.5]) };
    let found = fit(&[3.0], wall);
    assert_eq!(found.ended, Err(Ended::Blocked("wall")));
    assert!(found.x[0] < 1.01 && found.offset > 0.5, "{found:?}");
    let deaf = fit(&[3.0, 1.0], |p| Ok(vec![p[0], p[0] - 1.0, 2.0]));
    assert_eq!(deaf.ended, Err(Ended::NoInfluence(1)));
    let endless = fit(&[0.0], |p| Ok(vec![(-p[0]).exp(), 1e-9]));
    assert!(endless.residuals[0] < 1e-3, "{endless:?}");
    let nothing = |_: &[f64]| Err::<Vec<f64>, _>("nothing");
    assert_eq!(minimise(&[1.0], &[(0.0, 2.0)], &nothing, &|_| ()).unwrap_err(), "nothing");
}

#[test]
fn a_bound_holds_a_parameter_and_the_others_are_fitted_beside_it() {
    // Least squares of x + y = 3, x - y = 0.6, y = 1.5 with x at most 1: y = (2 + 0.4 + 1.5)/3.
    let f = |p: &[f64]| {
        assert!(p[0] < 1.0 + 2.0 * STEP && p[1] > -5.0 - 2.0 * STEP, "{p:?}");
        Ok(vec![p[0] + p[1] - 3.0, p[0] - p[1] - 0.6, p[1] - 1.5])
    };
    for start in [[0.2, 5.0], [1.0, -5.0], [-3.0, -4.0]] {
        let found = within(&start, &[(-4.0, 1.0), (-5.0, 9.0)], f);
        assert_eq!((&found.ended, &found.at_bound), (&Ok(()), &vec![true, false]), "{found:?}");
        assert_eq!(found.x[0], 1.0);
        assert_relative_eq!(found.x[1], 1.3, epsilon = 1e-8);
        let statistics =
            Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), &found.at_bound, true).unwrap();
        assert_relative_eq!(statistics.errors[1], (1.0_f64 / 3.0).sqrt(), max_relative = 1e-6);
        assert!(statistics.errors[0].is_nan() && statistics.freedom == 2, "{statistics:?}");
    }
    // From a bound inwards, and from one that the way there leads beyond.
    let valley = |p: &[f64]| Ok(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]);
    for start in [[-1.5, 1.0], [-1.2, 2.0], [1.5, -0.5]] {
        let found = within(&start, &[(-1.5, 1.5), (-0.5, 2.0)], valley);
        assert_eq!((&found.ended, &found.at_bound), (&Ok(()), &vec![false, false]), "{start:?}: {found:?}");
        assert_relative_eq!(found.x[1], 1.0, epsilon = 1e-6);
    }
}

#[test]
fn errors_are_those_of_many_noisy_repeats() {
    // y = a exp(-b t) with noise of one size: the spread of the fits is the error that each of them states.
    let (exact, sigma, repeats) = ([2.0, 0.7], 0.05, 400_u64);
    let model = |p: &[f64], t: f64| p[0] * (-p[1] * t).exp();
    let (mut spread, mut stated, mut product, mut correlation) = ([0.0; 2], [0.0; 2], 0.0, 0.0);
    let mut state = 1;
    for _ in 0..repeats {
        let data: Vec<(f64, f64)> = (0..20_u32)
            .map(|i| {
                let t = 0.2 * f64::from(i);
                (t, model(&exact, t) + sigma * normal(&mut state))
            })
            .collect();
        let found = fit(&[1.0, 1.0], |p| Ok(data.iter().map(|(t, y)| (model(p, *t) - y) / sigma).collect()));
        assert_eq!(found.ended, Ok(()));
        let statistics =
            Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), &found.at_bound, true).unwrap();
        let off = [0, 1].map(|i| found.x[i] - exact[i]);
        for i in 0..2 {
            spread[i] += off[i] * off[i] / repeats as f64;
            stated[i] += statistics.errors[i].powi(2) / repeats as f64;
        }
        product += off[0] * off[1] / repeats as f64;
        correlation += statistics.correlations[0][1] / repeats as f64;
    }
    // A variance of 400 draws is known within 7 %.
    assert!((0..2).all(|i| (spread[i] / stated[i] - 1.0).abs() < 0.2), "{spread:?} {stated:?}");
    let measured = product / (spread[0] * spread[1]).sqrt();
    assert!(correlation > 0.3 && (measured - correlation).abs() < 0.1, "{measured} {correlation}");
}

#[test]
fn what_the_data_do_not_tell_apart_is_a_minimum_all_the_same() {
    // Only the product of the parameters matters: their logarithms have one direction that is known, and one that is not.
    let f = |p: &[f64]| {
        Ok([1.0, 2.0, 4.0].iter().zip([0.1, -0.1, 0.2]).map(|(t, e)| t * (p[0] + p[1] - 1.0) + e).collect())
    };
    let found = fit(&[0.0, 0.5], f);
    assert_eq!(found.ended, Ok(()));
    let statistics = Statistics::of(&found.residuals, found.jacobian.as_ref().unwrap(), &found.at_bound, true).unwrap();
    assert!(statistics.correlations[0][1] < -0.999_999 && statistics.errors[0] > 1e3, "{statistics:?}");
    let (direction, error) = &statistics.weakest;
    assert!((direction[0] + direction[1]).abs() < 1e-6 && *error > 1e3, "{statistics:?}");
}
