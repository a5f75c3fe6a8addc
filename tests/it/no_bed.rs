//! Where there is no bed at rest there is no answer, and where no layer moves there is no rate.

use bedload::models::sheet_flow::SheetFlowError;
use bedload::models::two_fluid::TwoFluidError;
use bedload::result::{MethodError, Outcome, Verdict, quantity as q};

use crate::support::{Scratch, solve};

#[test]
fn a_two_fluid_bed_does_not_slide_as_a_whole_under_any_drive() {
    // Balance by hand of a deep bed: tan(beta) = mu_s phi (r - 1)/(1 + phi (r - 1)), r the ratio of densities.
    let grains: f64 = 0.6065 * 1.5;
    let steepest = (0.359_946 * grains / (1.0 + grains)).atan().to_degrees();
    let drives: [&[&str]; 3] =
        [&["flow.slope=0.2"], &["flow.slope=0.2", "flow.depth=", "flow.shields=0.6"], &["flow.slope=0.3"]];
    for drive in drives {
        let failure = solve("flow_theta06-two-fluid", drive).unwrap_err();
        let Some(TwoFluidError::NothingAtRest { slope_deg, steepest_deg, .. }) = failure.error.downcast_ref() else {
            panic!("{drive:?}: {}", failure.error)
        };
        assert!((steepest_deg - steepest).abs() < 1e-3 && *slope_deg > steepest, "{steepest_deg} {steepest}");
    }
    let scratch = Scratch::new();
    let slides = ["run", "flow_theta06", "--model", "two-fluid", "--set", "flow.slope=0.2", "--json"];
    let slides = scratch.bedload(slides).exits(3).json();
    assert_eq!(slides["error"]["code"], "nothing-at-rest");
    // A slope on which a deep bed rests, and this one does not: tan(beta) (h + T + T phi (r - 1)) against mu_s phi (r - 1) T.
    let outcome = solve("flow_theta06-two-fluid", &["flow.slope=0.15"]).unwrap();
    let premise = outcome.regime.iter().find(|p| p.premise.contains("on its bottom")).unwrap();
    let pull = 0.15_f64.asin().tan() * (18.0 + 12.5 * (1.0 + grains)) / (0.359_946 * grains * 12.5);
    assert_eq!(premise.verdict, Verdict::Broken);
    assert!((premise.value / pull - 1.0).abs() < 1e-3, "{} {pull}", premise.value);
}

fn rate(outcome: &Outcome) -> Option<f64> {
    outcome.results.get(q::TRANSPORT_RATE_DIMENSIONLESS.name)
}

#[test]
fn where_no_layer_moves_the_rate_is_empty_and_says_how_far_over_the_threshold() {
    let flow = |case: &str, theta: &str| solve(case, &[&format!("flow.shields={theta}")]).unwrap();
    // Soulsby by hand: D* = 28.9 and 6.26, theta_c = 0.0325 and 0.0417.
    for (case, theta, times) in [
        ("sheet_1d_type_a", "0.1", 3.07),
        ("sheet_1d_type_a", "0.15", 4.61),
        ("sheet_1d_type_a", "0.19", 5.84),
        ("sheet_1d_type_b", "0.1", 2.40),
        ("sheet_1d_type_b", "0.15", 3.60),
    ] {
        let outcome = flow(case, theta);
        assert_eq!(rate(&outcome), None, "{case} {theta}");
        let premise = &outcome.regime[0];
        assert_eq!(premise.verdict, Verdict::Broken, "{premise:?}");
        assert!((premise.value / times - 1.0).abs() < 5e-3, "{} {times}", premise.value);
        let least = outcome.results.get(q::SHIELDS_LEAST.name).unwrap();
        let wanted = if case.ends_with('a') { 0.2001 } else { 0.1535 };
        assert!((least / wanted - 1.0).abs() < 1e-3, "{least} {wanted}");
    }
    // Just over the edge of the exact yield there is one, as the pseudo-time iteration of the paper finds it, too.
    let found = rate(&flow("sheet_1d_type_a", "0.2")).unwrap();
    assert!((found / 0.279 - 1.0).abs() < 5e-3, "{found}");
    let iterated = ["flow.shields=0.2", "method=iteration", "regularisation.law=simple", "regularisation.lambda=1e-6"];
    let iterated = rate(&solve("sheet_1d_type_a", &iterated).unwrap()).unwrap();
    assert!((found / iterated - 1.0).abs() < 5e-3, "{found} {iterated}");
    // Below the range of thresholds, 0.59 of the curve, not a grain moves.
    for (case, theta) in [("sheet_1d_type_a", "0.019"), ("sheet_1d_type_b", "0.024")] {
        assert_eq!(rate(&flow(case, theta)), Some(0.0), "{case}");
    }
}

#[test]
fn a_person_reads_that_no_layer_moves() {
    let scratch = Scratch::new();
    let run = ["run", "sheet_1d_type_b", "--set", "flow.shields=0.15", "--out", "b"];
    let text = scratch.bedload(run).exits(0).out;
    assert!(text.starts_with("broken premise: a layer of grains moves: θ/θ_c"), "{text}");
    let summary = scratch.summary("b");
    let rate = &summary["results"]["transport_rate_m2_s"];
    assert!(rate["value"].is_null() && rate["reason"].as_str().unwrap().contains("3.60 times"), "{rate}");
}

#[test]
fn the_effect_of_the_cut_is_reported() {
    let effect = |case: &str, theta: &str| {
        let outcome = solve(case, &[&format!("flow.shields={theta}")]).unwrap();
        outcome.results.get(q::CUT_EFFECT.name).unwrap()
    };
    assert!((effect("sheet_1d_type_a", "0.3") / 0.025 - 1.0).abs() < 0.05);
    assert!((0.035..0.055).contains(&effect("sheet_1d_type_b", "0.2")));
    for case in ["sheet_1d_type_a", "sheet_1d_type_b"] {
        for theta in ["0.65", "1.5"] {
            assert!(effect(case, theta) < 5e-4, "{case} {theta}");
        }
    }
}

#[test]
fn a_bed_too_steep_for_a_sheet_flow_says_how_much_less_it_bears() {
    let failure = solve("sheet_1d_limit_slope_a", &["flow.slope=0.03"]).unwrap_err();
    let Some(SheetFlowError::NothingAtRest { most: Some(most), .. }) = failure.error.downcast_ref() else {
        panic!("{}", failure.error)
    };
    // The sine at which the balance of all that moves by hand lets the last grain rest.
    assert!((most * 0.03 / 0.02933 - 1.0).abs() < 0.01, "{most}");
}

#[test]
fn grains_at_rest_carry_the_whole_stress_and_the_interface_is_a_jump() {
    let outcome = solve("sheet_1d_sumer91", &[""; 0]).unwrap();
    let (profile, result) = (outcome.profile.as_ref().unwrap(), |q: &q::Quantity| outcome.results.get(q.name).unwrap());
    let z = profile.axis();
    let column = |q: &'static q::Quantity| profile.get(q).unwrap();
    let (viscous, reynolds, grains) = (column(&q::TAU_VISCOUS), column(&q::TAU_REYNOLDS), column(&q::TAU_PARTICLE));
    let still: Vec<usize> = (1..z.len()).filter(|&i| z[i] < result(&q::YIELD_LEVEL) * 0.99).collect();
    assert!(still.len() > 10);
    for &i in &still {
        assert_eq!(viscous[i], None);
        assert!(reynolds[i].unwrap().abs() < 1e-9);
    }
    // The stress grows downwards by the weight of the mixture along the slope.
    let (low, high) = (still[0], still[still.len() - 1]);
    let weight = 9.81 * result(&q::SLOPE_SINE) * (z[high] - z[low]);
    let phi = column(&q::PHI)[low].unwrap();
    let density = 1000.0 + phi * (outcome_density() - 1000.0);
    let grown = grains[low].unwrap() - grains[high].unwrap();
    assert!((grown / (weight * density) - 1.0).abs() < 0.01, "{grown} {}", weight * density);
    // Two values on one level: below, the fluid is faster than the mixture; above, all move alike.
    let level = z.iter().position(|x| (x - result(&q::BED_LEVEL)).abs() < 1e-12).unwrap();
    assert!((z[level + 1] - z[level]).abs() < 1e-12);
    let (fluid, mixture) = (column(&q::U_FLUID), column(&q::U_MIXTURE));
    assert!(fluid[level].unwrap() > 1.001 * mixture[level].unwrap());
    assert_eq!(fluid[level + 1], mixture[level + 1]);
    let flux = column(&q::FLUX);
    assert!(flux[level + 1].unwrap() > 1.001 * flux[level].unwrap());
}

/// Density of the cylinders of run 91 [kg/m3].
fn outcome_density() -> f64 {
    1140.0
}

#[test]
fn the_hydraulic_diameter_of_a_lid_has_two_readings() {
    let law = |diameter: &str| format!("flow.top={{ law = \"colebrook-white\", diameter = \"{diameter}\" }}");
    let drive = |diameter: &str| {
        let top = law(diameter);
        let set = ["flow.shields=", "flow.slope=0.006", "flow.slope_definition=sine", &top];
        let outcome = solve("sheet_1d_sumer91", &set).unwrap_or_else(|failure| panic!("{}", failure.error));
        (outcome.results.get(q::LID_STRESS.name).unwrap(), rate(&outcome).unwrap())
    };
    let ((two, slow), (four, fast)) = (drive("2h"), drive("4h"));
    assert!(four < two && fast > slow, "{two} {four} {slow} {fast}");
    assert!((0.02..0.2).contains(&(fast / slow - 1.0)), "{slow} {fast}");
}

#[test]
fn failures_of_two_fluids_name_their_cause() {
    let message = |error: TwoFluidError| format!("{error}; {}", error.hint());
    // Far from the threshold none is blamed on it.
    let far = TwoFluidError::NoSteadyFlow { residual: 0.1, iterations: 9, shields: 2.9, weak: false };
    let near = TwoFluidError::NoSteadyFlow { residual: 0.1, iterations: 9, shields: 0.1, weak: true };
    assert!(!message(far).contains("threshold") && message(near).contains("near the threshold of motion"));
    // A residual of round-off is no reason, and none at all is no number.
    let forces = TwoFluidError::Unbalanced { stress_pa: 1e-3, allowed_pa: 1e-6, iterations: 9, shields: 0.4 };
    assert!(message(forces).contains("miss balance by 1.000e-3 Pa"));
    let march = TwoFluidError::DoesNotSettle { step_s: 1e-5, iterations: 9, shields: 0.1, weak: true };
    assert!(message(march).contains("last step was 1.000e-5 s"));
    let stuck = |newton| TwoFluidError::StuckInTime { time_s: 21.5, step_s: 1e-9, residual: 0.2, newton };
    assert!(message(stuck(true)).contains("Newton") && message(stuck(false)).contains("solver.tolerance, at 2.000e-1"));
    // Below the threshold of the kinetic theory, as it is met in a run: never infinite.
    let failure = solve("flow_theta06-two-fluid", &["flow.depth=", "flow.shields=0.12", "grid.cells=120"]).unwrap_err();
    assert!(!failure.error.to_string().contains("inf"), "{}", failure.error);
}

#[test]
fn the_edge_of_the_moving_layer_is_the_limit_that_stability_finds() {
    let scratch = Scratch::new();
    let over = ["stability", "sheet_1d_type_b", "--over", "flow.shields=0.14:0.3:3", "--json"];
    let found = scratch.bedload(over).exits(0).json();
    let limit = &found["facts"]["limits"][0];
    assert_eq!(limit["class"], "unphysical", "{found}");
    assert!(limit["reason"].as_str().unwrap().starts_with("no layer of grains moves"), "{limit}");
    // The creep that rounds the edge has one of its own, 2 % lower.
    let edge = limit["holds"].as_f64().unwrap();
    assert!((edge / (0.98 * 0.1535) - 1.0).abs() < 3e-3, "{edge}");
}
