//! Sheet flow, from outside: the published equations re-evaluated on the profiles that a run returns, balances, agreement of
//! the methods, what a user may change, and the errors.

use bedload::models::sheet_flow::SheetFlowError;
use bedload::result::{Failure, Outcome, Profile, quantity as q};

fn attempt(case: &str, settings: &[&str]) -> Result<Outcome, Failure> {
    crate::support::solve(case, settings)
}

fn solve(case: &str, settings: &[&str]) -> Outcome {
    attempt(case, settings).unwrap()
}

fn get(outcome: &Outcome, name: &str) -> f64 {
    outcome.results.get(name).unwrap_or_else(|| panic!("{name}"))
}

const CASES: [&str; 6] = [
    "sheet_1d_sumer82",
    "sheet_1d_sumer91",
    "sheet_1d_sumer99",
    "sheet_1d_cowen",
    "sheet_1d_type_a",
    "sheet_1d_type_b",
];

struct Grains {
    d: f64,
    rho_p: f64,
    phi_max: f64,
    mu: (f64, f64),
    kappa: f64,
    w_s: f64,
}

const A: Grains = Grains { d: 2.6e-3, rho_p: 1140.0, phi_max: 0.62, mu: (0.51, 0.70), kappa: 0.35, w_s: 0.072 };
const B: Grains = Grains { d: 0.25e-3, rho_p: 2600.0, phi_max: 0.60, mu: (0.30, 0.64), kappa: 0.41, w_s: 0.0326 };
const RHO_F: f64 = 1000.0;
const ETA: f64 = 1e-3;
const G: f64 = 9.81;

/// Largest relative error of each published equation over the rows where it can be differenced, written here a second time
/// from the paper, with three-point derivatives on the uneven levels. Nothing of the solver is used.
fn reevaluate(profile: &Profile, grains: &Grains, sine: f64, bed: f64) -> Vec<(&'static str, f64)> {
    let z = profile.axis();
    let column = |q| profile.get(q).unwrap();
    let (phi, u, w) = (column(&q::PHI), column(&q::U_MIXTURE), column(&q::U_PARTICLE));
    let (tf, r, tp) = (column(&q::TAU_VISCOUS), column(&q::TAU_REYNOLDS), column(&q::TAU_PARTICLE));
    let (p, l) = (column(&q::P_PARTICLE), column(&q::MIXING_LENGTH));
    let derivative = |f: &[Option<f64>], i: usize| {
        let (a, b) = (z[i] - z[i - 1], z[i + 1] - z[i]);
        let (f0, f1, f2) = (f[i - 1]?, f[i]?, f[i + 1]?);
        Some((f2 - f1) / b * a / (a + b) + (f1 - f0) / a * b / (a + b))
    };
    let mut worst: Vec<(&'static str, f64)> = Vec::new();
    let mut note = |name: &'static str, error: f64| match worst.iter_mut().find(|(n, _)| *n == name) {
        Some((_, w)) => *w = w.max(error.abs()),
        None => worst.push((name, error.abs())),
    };
    // Its lower and its upper side: velocity of the fluid and flux jump there.
    let interface = z.iter().position(|&x| (x - bed).abs() < 1e-12).unwrap();
    let upper = z.iter().rposition(|&x| (x - bed).abs() < 1e-12).unwrap();
    assert_eq!(upper, interface + 1);
    // Scales: stress of the interface over the grain diameter, shear rate of the mixture.
    let tau_b = tf[upper + 1].unwrap() + r[upper + 1].unwrap();
    for i in 2..z.len() - 1 {
        let dz = |f: &[Option<f64>]| derivative(f, i);
        let (Some(phi_i), Some(rate)) = (phi[i], dz(u)) else { continue };
        // The rows beside the interface are one-sided; under it the shear rate goes like the root of the depth, which is no
        // three points' parabola over the first cells, however small they are.
        if (interface - 2..upper + 3).contains(&i) || (i < interface && bed - z[i] < 0.05 * grains.d) {
            continue;
        }
        let eps = 1.0 - phi_i;
        if i < interface {
            let (wi, pi) = (w[i].unwrap(), p[i].unwrap());
            let depth = bed - z[i];
            let slip = u[i].unwrap() - wi;
            let drag = RHO_F * phi_i / (grains.d * eps.powf(3.1))
                * (0.3 * slip.abs() + 18.3 * ETA / (RHO_F * grains.d))
                * slip;
            // That of the fluid is not defined in grains at rest, which carry the whole.
            let f = dz(tf).or((tf[i].is_none() && phi_i >= 0.999 * grains.phi_max).then_some(0.0)).unwrap_or(f64::NAN);
            let (big_r, s) = (dz(r).unwrap(), dz(tp).unwrap());
            let unit = tau_b / grains.d;
            // Near the corner at the yield level no derivative is smooth; below it U = 0 and the stress is what balances.
            let moving = phi_i < 0.97 * grains.phi_max;
            let still = |j: usize| (phi[j].unwrap() - grains.phi_max).abs() < 1e-12;
            let below = still(i) && still(i + 1) && still(i + 2);
            if phi_i < 0.9 * grains.phi_max || below {
                note("mixture momentum (29)", (big_r + f + s + (eps * RHO_F + phi_i * grains.rho_p) * G * sine) / unit);
                let normal = dz(p).unwrap() + phi_i * (grains.rho_p - RHO_F) * G * (1.0 - sine * sine).sqrt();
                note("pressure (12)", normal / ((grains.rho_p - RHO_F) * G));
            }
            if moving && depth > 4.0 * grains.d {
                note("grain momentum (14)", (s + phi_i * f + drag + phi_i * grains.rho_p * G * sine) / unit);
                note("fluid momentum (13)", (big_r + eps * f - drag + eps * RHO_F * G * sine) / unit);
            }
            if moving {
                let gamma = dz(w).unwrap();
                let free = grains.d * (grains.rho_p / pi).sqrt();
                let c = 4.0 / 3.0 * (0.3 + 18.3 * ETA / (RHO_F * slip.abs() * grains.d));
                let time = free.max(ETA / pi).max(grains.d * (RHO_F * c / pi).sqrt());
                let i_number = time * gamma;
                let mu = grains.mu.0 + (grains.mu.1 - grains.mu.0) / (0.3 / i_number + 1.0);
                note("friction (20)", tp[i].unwrap() / (mu * pi) - 1.0);
                note("dilatancy (24)", phi_i * (1.0 + 0.75 * i_number.sqrt()) / grains.phi_max - 1.0);
                let boyer = ETA * (1.0 + 2.5 * phi_i / (1.0 - phi_i / grains.phi_max));
                // The viscosity is steep beside the corner of the solid fraction.
                if phi_i < 0.9 * grains.phi_max {
                    note("viscous stress (15)", tf[i].unwrap() / (boyer * rate) - 1.0);
                }
            }
        } else if let (Some(f), Some(big_r)) = (dz(tf), dz(r)) {
            note("fluid momentum (25)", (f + big_r + RHO_F * G * sine) / (tau_b / grains.d));
            // The grains end where the stress changes sign.
            if phi_i > 1e-6 && phi[i + 1] > Some(0.0) {
                let eddy = RHO_F * eps * l[i].unwrap().powi(2) * rate.abs();
                let fall = dz(phi).unwrap() * eddy / RHO_F;
                note("Rouse (26)", (fall + grains.w_s * phi_i) / (grains.w_s * 0.25));
            }
        }
        let turbulent = (phi_i < 0.97 * grains.phi_max) && l[i].unwrap() > 0.02 * grains.d;
        if turbulent && rate.abs() * grains.d > 0.02 * (tau_b / RHO_F).sqrt() {
            let reynolds = RHO_F * eps * l[i].unwrap().powi(2) * rate.abs() * rate;
            note("Reynolds stress (17)", (reynolds - r[i].unwrap()) / tau_b);
            note("mixing length (18)", dz(l).unwrap() / grains.kappa - (1.0 - phi_i / grains.phi_max));
        }
    }
    worst
}

#[test]
fn the_published_equations_hold_on_the_returned_profiles() {
    for (case, grains) in [("sheet_1d_sumer82", &A), ("sheet_1d_sumer91", &A), ("sheet_1d_cowen", &B)] {
        let errors: Vec<Vec<(&str, f64)>> = [600, 1200]
            .map(|cells| {
                let outcome = solve(case, &[&format!("grid.cells={cells}")]);
                let sine = get(&outcome, "slope_sine");
                reevaluate(outcome.profile.as_ref().unwrap(), grains, sine, get(&outcome, "bed_level_m"))
            })
            .into();
        assert!(errors[0].len() >= 11, "{errors:?}");
        for ((name, coarse), (_, fine)) in errors[0].iter().zip(&errors[1]) {
            println!("{case} {name}: {coarse:.2e} {fine:.2e}");
            assert!(*fine < 0.02 && *fine < 0.7 * coarse.max(4e-3), "{case} {name}: {coarse} {fine}");
        }
    }
}

#[test]
fn momentum_and_sediment_close() {
    for case in CASES {
        for reading in ["in-flow", "at-rest"] {
            let outcome = solve(case, &[&format!("bed_level={reading}"), "grid.cells=150"]);
            for balance in &outcome.balances {
                let limit = if balance.name == "sediment" { 1e-12 } else { 1e-10 };
                assert!(balance.relative.abs() < limit, "{case} {reading} {}: {}", balance.name, balance.relative);
            }
            // The grains once more, from the profile: cells of the bed and of the suspension between their middles.
            let volume = get(&outcome, "solid_volume_bed_m") + get(&outcome, "solid_volume_suspension_m");
            let profile = outcome.profile.as_ref().unwrap();
            let (z, phi) = (profile.axis(), profile.get(&q::PHI).unwrap());
            let trapezium: f64 =
                (1..z.len()).map(|i| 0.5 * (z[i] - z[i - 1]) * (phi[i].unwrap() + phi[i - 1].unwrap())).sum();
            assert!((trapezium / volume - 1.0).abs() < 2e-3, "{case} {reading}: {trapezium} {volume}");
            if reading == "at-rest" {
                let level = if case.contains("cowen") || case.ends_with('b') { 0.012 * 0.6 } else { 0.62 };
                let whole = if level < 0.1 { level } else { level * bed_level(case) };
                assert!((volume / whole - 1.0).abs() < 1e-12, "{case}: {volume} {whole}");
                // Loosened grains take more room than those in suspension leave.
                assert!(
                    get(&outcome, "bed_level_m") > bed_level(case) - get(&outcome, "solid_volume_suspension_m") / 0.6
                );
            }
        }
    }
}

fn bed_level(case: &str) -> f64 {
    match case {
        "sheet_1d_sumer82" => 0.084,
        "sheet_1d_sumer99" => 0.088,
        "sheet_1d_cowen" | "sheet_1d_type_b" => 0.012,
        _ => 0.085,
    }
}

#[test]
fn the_transport_rate_converges_with_the_mesh() {
    for case in CASES {
        // The limits for light, coarse grains and for sand.
        let limit = if case.contains("cowen") || case.ends_with('b') { 1e-3 } else { 1e-4 };
        let at = |cells: usize| solve(case, &[&format!("grid.cells={cells}")]);
        let (coarse, shipped, fine) = (at(75), at(300), at(4800));
        for (name, limit) in
            [("transport_rate_dimensionless", limit), ("sheet_thickness_m", 1e-4), ("phi_interface", 3e-4)]
        {
            let error = |o: &Outcome| (get(o, name) / get(&fine, name) - 1.0).abs();
            println!("{case} {name}: {:.1e} {:.1e}", error(&coarse), error(&shipped));
            assert!(error(&shipped) < limit, "{case} {name}: {}", error(&shipped));
            assert!(error(&shipped) < 0.2 * error(&coarse), "{case} {name}");
        }
    }
}

#[test]
fn the_answer_does_not_depend_on_the_cut() {
    for (case, limit) in [("sheet_1d_sumer91", 5e-4), ("sheet_1d_cowen", 2e-3)] {
        let rate = |cut: &str| {
            get(&solve(case, &[&format!("regularisation.interface_cut={cut}")]), "transport_rate_dimensionless")
        };
        let reference = rate("0.3");
        for cut in ["0.15", "0.6", "1.0"] {
            assert!((rate(cut) / reference - 1.0).abs() < limit, "{case} {cut}: {} {reference}", rate(cut));
        }
    }
}

#[test]
fn creep_goes_like_lambda_and_the_transport_rate_does_not() {
    let at = |lambda: &str| {
        solve("sheet_1d_sumer91", &["regularisation.law=simple", &format!("regularisation.lambda={lambda}")])
    };
    let creep = |o: &Outcome| o.profile.as_ref().unwrap().get(&q::U_PARTICLE).unwrap()[2].unwrap();
    let error = |o: &Outcome| get(o, "regularisation_error_transport_rate").abs();
    let (coarse, fine) = (at("1e-6"), at("1e-9"));
    let exponent = (creep(&coarse) / creep(&fine)).log10() / 3.0;
    assert!((exponent - 1.0).abs() < 0.1, "{exponent}");
    let exponent = (error(&coarse) / error(&fine)).log10() / 3.0;
    assert!((0.25..0.6).contains(&exponent), "{exponent}");
}

#[test]
fn both_methods_agree_as_far_as_their_meshes() {
    let common = ["regularisation.law=simple", "regularisation.lambda=1e-6"];
    let rate = |method: &str, cells: usize| {
        let (method, cells) = (format!("method={method}"), format!("grid.cells={cells}"));
        let settings: Vec<&str> = common.iter().copied().chain([method.as_str(), cells.as_str()]).collect();
        get(&solve("sheet_1d_cowen", &settings), "transport_rate_dimensionless")
    };
    // Their meshes differ: each is as far from the other as from the limit at most, at two sizes.
    let limit = rate("newton", 2400);
    for cells in [60, 240] {
        let (iterated, newton) = (rate("iteration", cells), rate("newton", cells));
        let error = (newton / limit - 1.0).abs();
        assert!((iterated / newton - 1.0).abs() < 0.5 * error, "{cells}: {iterated} {newton} {limit}");
    }
}

#[test]
fn drives_and_lids_are_consistent_with_each_other() {
    let wanted = solve("sheet_1d_cowen", &[]);
    let slope = format!("flow.slope={:.17e}", get(&wanted, "slope_sine"));
    let driven = solve("sheet_1d_cowen", &["flow.shields=", &slope, "flow.slope_definition=sine"]);
    assert!((get(&driven, "transport_rate_m2_s") / get(&wanted, "transport_rate_m2_s") - 1.0).abs() < 1e-10);
    assert!((get(&wanted, "slope_sine") - 0.004425).abs() < 1e-6);
    // The stress of the lid as the solved one, given.
    let duct = solve("sheet_1d_sumer82", &[]);
    let stress = format!("flow.top={{ law = \"stress\", stress = {:.17e} }}", get(&duct, "lid_stress_Pa"));
    let given = solve("sheet_1d_sumer82", &["flow.shields=", &stress]);
    assert!((get(&given, "shields") - 1.37).abs() < 1e-9, "{}", get(&given, "shields"));
    assert!((get(&duct, "lid_stress_Pa") - 1.42).abs() < 0.01, "{}", get(&duct, "lid_stress_Pa"));
    let u_star = format!("flow.u_star={:.17e}", get(&duct, "u_star_m_s"));
    let starred = solve("sheet_1d_sumer82", &["flow.shields=", &u_star]);
    assert!((get(&starred, "shields") - 1.37).abs() < 1e-12);
    // A smooth lid takes less than the measured runs need.
    let smooth = solve("sheet_1d_sumer82", &["flow.shields=", "flow.top={ law = \"colebrook-white\" }"]);
    assert!((0.88..1.0).contains(&(get(&smooth, "shields") / 1.37)), "{}", get(&smooth, "shields"));
}

#[test]
fn what_has_no_solution_says_why() {
    let error = |case: &str, settings: &[&str]| attempt(case, settings).unwrap_err().error;
    let thin = error("sheet_1d_sumer99", &["bed.thickness=30 mm"]);
    let Some(SheetFlowError::NothingAtRest { bed_m, .. }) = thin.downcast_ref() else { panic!("{thin:?}") };
    assert!((bed_m - 0.03).abs() < 1e-9, "{thin:?}");
    let pushed = error("sheet_1d_sumer82", &["flow.shields=4", "flow.slope=0.003"]);
    let Some(SheetFlowError::LidPushes { stress_pa }) = pushed.downcast_ref() else { panic!("{pushed:?}") };
    assert!(*stress_pa < 0.0, "{pushed:?}");
    let steep = error("sheet_1d_sumer82", &["flow.slope=0.08"]);
    let named = ["nothing-at-rest", "no-static-bed"];
    assert!(named.contains(&steep.code()), "{steep:?}");
    let gone = error("sheet_1d_cowen", &["bed_level=at-rest", "bed.thickness=1 mm", "flow.shields=3"]);
    assert!(["nothing-at-rest", "bed-suspended"].contains(&gone.code()), "{gone:?}");
}

/// Whether the same flow over a bed twice as deep, with the exact yield, moves more than a bed of this level has: its
/// height, or its grains where these are given.
fn moves_more_than(case: &str, settings: &[&str], level: f64) -> bool {
    let heavy = case.ends_with('b');
    let phi_max = if heavy { B.phi_max } else { A.phi_max };
    let deeper = [format!("bed.thickness={}", 2.0 * level)];
    let exact = ["regularisation.law=none", "regularisation.lambda="];
    let deep: Vec<&str> = settings.iter().copied().chain(deeper.iter().map(String::as_str)).chain(exact).collect();
    // To what the rule of 0.1 % and the mesh leave open.
    match attempt(case, &deep) {
        Ok(deep) if settings.contains(&"bed_level=at-rest") => {
            let moving = get(&deep, "sheet_phi") * get(&deep, "sheet_thickness_m");
            moving + get(&deep, "solid_volume_suspension_m") > 0.99 * phi_max * level
        }
        Ok(deep) => get(&deep, "sheet_thickness_m") > 0.99 * level,
        // The deeper bed does not stay either.
        Err(failure) => ["nothing-at-rest", "bed-runs-away", "no-static-bed"].contains(&failure.error.code()),
    }
}

/// Latin hypercube over the ranges of the issue; every point converges or is classified.
fn hypercube(count: usize, reading: &str) -> Vec<(String, usize)> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut columns: Vec<Vec<usize>> = Vec::new();
    for _ in 0..8 {
        let mut column: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            column.swap(i, (uniform() * (i + 1) as f64) as usize);
        }
        columns.push(column);
    }
    let mut tally: Vec<(String, usize)> = Vec::new();
    for k in 0..count {
        let x: Vec<f64> = columns.iter().map(|c| (c[k] as f64 + uniform()) / count as f64).collect();
        let heavy = x[0] >= 0.5;
        let theta = 0.5 * 8f64.powf(x[1]);
        let (weight, d, level) = if heavy { (1.6, B.d, 0.012) } else { (0.14, A.d, 0.084) };
        let u_star = (weight * G * d * theta).sqrt();
        let w_s = u_star * (0.3 + 0.7 * x[6]) * if heavy { 1.0 } else { 2.0 };
        let mut settings = vec![
            format!("flow.shields={theta}"),
            format!("closures.friction.i_0={}", 0.1 * 10f64.powf(x[2])),
            format!("closures.dilatancy.b={}", 0.5 + 0.5 * x[3]),
            format!("closures.mixing_length.kappa={}", 0.35 + 0.06 * x[4]),
            format!("grains.settling_velocity={w_s}"),
            format!("bed.thickness={}", level * (0.5 + x[7])),
            format!("bed_level={reading}"),
            "grid.cells=150".into(),
        ];
        if x[5] >= 0.3 {
            settings.push("regularisation.law=simple".into());
            settings.push(format!("regularisation.lambda={:e}", 10f64.powf(-12.0 + 10.0 * (x[5] - 0.3) / 0.7)));
        }
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let case = if heavy { "sheet_1d_type_b" } else { "sheet_1d_type_a" };
        let key = match attempt(case, &settings) {
            Ok(_) => "solved",
            Err(failure) if failure.error.code() == "nothing-at-rest" => {
                let level = level * (0.5 + x[7]);
                if moves_more_than(case, &settings, level) { "nothing-at-rest" } else { "not-converged" }
            }
            Err(failure) => failure.error.code(),
        };
        if key == "not-converged" {
            println!("{case} {settings:?}");
        }
        match tally.iter_mut().find(|(name, _)| name == key) {
            Some((_, n)) => *n += 1,
            None => tally.push((key.into(), 1)),
        }
    }
    tally
}

#[test]
fn a_small_latin_hypercube_converges_from_cold() {
    let tally = hypercube(60, "in-flow");
    let failed: usize = tally.iter().filter(|(name, _)| name == "not-converged").map(|(_, n)| n).sum();
    assert_eq!(failed, 0, "{tally:?}");
}

#[test]
#[ignore = "two thousand solutions in each reading: about a minute"]
fn the_latin_hypercube_converges_from_cold() {
    for reading in ["in-flow", "at-rest"] {
        let tally = hypercube(2000, reading);
        println!("{reading}: {tally:?}");
        let failed: usize = tally.iter().filter(|(name, _)| name == "not-converged").map(|(_, n)| n).sum();
        // One point with conserved grains, at a Shields number of 3.8, is neither solved nor classified.
        assert!(failed <= usize::from(reading == "at-rest"), "{tally:?}");
    }
}
