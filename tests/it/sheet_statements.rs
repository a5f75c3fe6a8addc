//! What Revil-Baudard & Chauchat (2013) say of their sheet flows, computed: each statement that takes more than one run; and
//! what a run says of its lid and its bottom, by hand.
//! `cargo test --release --test it sheet_statements -- --nocapture` prints the numbers of docs/sheet-flow.md.

use bedload::result::{Outcome, quantity as q};

const RUNS: [&str; 3] = ["sheet_1d_sumer82", "sheet_1d_sumer91", "sheet_1d_sumer99"];

fn solve(case: &str, settings: &[String]) -> Outcome {
    crate::support::solve(case, settings).unwrap()
}

fn get(outcome: &Outcome, name: &str) -> f64 {
    outcome.results.get(name).unwrap_or_else(|| panic!("{name}"))
}

/// Relative changes of the transport rate and of the thickness of the sheet, in per cent.
fn change(case: &str, common: &[&str], setting: &str) -> (f64, f64) {
    let mut settings: Vec<String> = common.iter().map(|&s| s.to_owned()).collect();
    let reference = solve(case, &settings);
    settings.push(setting.to_owned());
    let changed = solve(case, &settings);
    let of = |name: &str| 100.0 * (get(&changed, name) / get(&reference, name) - 1.0);
    let found = (of("transport_rate_dimensionless"), of("sheet_thickness_m"));
    println!("{case} {setting}: psi {:+.1} %, thickness {:+.1} %", found.0, found.1);
    found
}

#[test]
fn inertial_number_moves_the_rate_by_a_quarter_and_the_thickness_by_little() {
    for case in RUNS {
        for i_0 in ["0.1", "1"] {
            let (psi, thickness) = change(case, &[], &format!("closures.friction.i_0={i_0}"));
            // The paper: 25 % and 5 %. The fastest run exceeds the first.
            assert!(psi.abs() < if case == RUNS[2] { 30.0 } else { 25.0 }, "{case} {i_0}: {psi}");
            assert!(thickness.abs() < 5.0, "{case} {i_0}: {thickness}");
            assert_eq!(psi > 0.0, i_0 == "1");
        }
    }
}

#[test]
fn dilatancy_moves_the_thickness_by_an_eighth_and_the_rate_hardly() {
    for case in RUNS.into_iter().chain(["sheet_1d_cowen"]) {
        let (less, thinner) = change(case, &[], "closures.dilatancy.b=0.5");
        let (more, thicker) = change(case, &[], "closures.dilatancy.b=1");
        assert!((-15.0..-10.0).contains(&thinner) && (9.0..15.0).contains(&thicker), "{case}: {thinner} {thicker}");
        // Not reproduced: the paper has 15 % of psi.
        assert!(less.abs() < 6.0 && more.abs() < 6.0, "{case}: {less} {more}");
    }
}

#[test]
fn karman_moves_the_rate_by_some_per_cent() {
    let duct = ["flow.shields=", "flow.top={ law = \"colebrook-white\" }"];
    let at_slope = RUNS.map(|case| change(case, &duct, "closures.mixing_length.kappa=0.41").0);
    // The paper: 8, 2.5 and 2.3 %; the first is not reproduced.
    assert!(at_slope.iter().all(|x| (1.5..4.0).contains(x)), "{at_slope:?}");
    let (at_shields, _) = change(RUNS[1], &[], "closures.mixing_length.kappa=0.41");
    assert!((-8.0..-5.0).contains(&at_shields), "{at_shields}");
}

#[test]
fn the_weight_along_the_slope_doubles_a_sheet_of_light_grains() {
    let thickness = |case: &str, settings: &[&str]| {
        let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
        let outcome = solve(case, &settings);
        let of = |name: &str| get(&outcome, name);
        let (full, flat, found) =
            (of("sheet_thickness_balance_m"), of("sheet_thickness_flat_m"), of("sheet_thickness_m"));
        println!("{case} {settings:?}: (32)/(33) {:.3}, (32)/computed {:.3}", full / flat, full / found);
        (full / flat, full / found)
    };
    // Under the lid of run 99, whose slope and stress grow with the Shields number.
    let slope = format!("flow.slope={}", 0.0119 * 2.6 / 2.3);
    let (duct, good) = thickness("sheet_1d_sumer99", &["flow.shields=2.6", &slope]);
    assert!((1.7..2.1).contains(&duct), "{duct}");
    let (free, _) = thickness("sheet_1d_type_a", &["flow.shields=2.6"]);
    assert!((1.5..1.8).contains(&free), "{free}");
    let (sand, exact) = thickness("sheet_1d_type_b", &["flow.shields=2.6"]);
    assert!((1.05..1.12).contains(&sand), "{sand}");
    assert!((good - 1.0).abs() < 0.05 && (exact - 1.0).abs() < 0.05, "{good} {exact}");
    // The agreement is a matter of the regularisation.
    for (case, low, high) in [("sheet_1d_type_a", 0.93, 0.98), ("sheet_1d_type_b", 0.85, 0.92)] {
        let creep = ["regularisation.law=simple", "regularisation.lambda=1e-6"];
        let (_, creeping) = thickness(case, &creep);
        assert!((low..high).contains(&creeping), "{case}: {creeping}");
    }
}

#[test]
fn light_grains_fall_freely_and_sand_in_turbulence() {
    for theta in ["0.5", "1.5", "2.6"] {
        let at = |case: &str| solve(case, &[format!("flow.shields={theta}")]);
        let (a, b) = (at("sheet_1d_type_a"), at("sheet_1d_type_b"));
        println!(
            "theta {theta}: free fall {:.2} of A, turbulent {:.2} of B",
            get(&a, "free_fall_share"),
            get(&b, "turbulent_share")
        );
        assert!(get(&a, "free_fall_share") > 0.6 && get(&b, "turbulent_share") > 0.9);
        let ratio = |o: &Outcome| get(o, "roughness_m") / get(o, "sheet_thickness_m");
        println!("theta {theta}: roughness over thickness {:.3} (A), {:.3} (B)", ratio(&a), ratio(&b));
    }
}

/// Colebrook and White for a smooth wall, by fixed point.
fn smooth_factor(reynolds: f64) -> f64 {
    (0..100).fold(0.02_f64, |f, _| (-2.0 * (2.51 / (reynolds * f.sqrt())).log10()).powi(-2))
}

#[test]
fn a_smooth_lid_takes_what_colebrook_and_white_say() {
    for case in RUNS {
        let settings = ["flow.shields=", "flow.top={ law = \"colebrook-white\" }"].map(str::to_owned);
        let outcome = solve(case, &settings);
        let profile = outcome.profile.as_ref().unwrap();
        let (z, u) = (profile.axis(), profile.get(&q::U_MIXTURE).unwrap());
        let (bed, height) = (get(&outcome, "bed_level_m"), get(&outcome, "flow_height_m"));
        let above: Vec<usize> = (0..z.len()).filter(|&i| z[i] >= bed).collect();
        let last = above[above.len() - 1];
        let inside: f64 =
            above.windows(2).map(|w| 0.5 * (z[w[1]] - z[w[0]]) * (u[w[0]].unwrap() + u[w[1]].unwrap())).sum();
        let depth = height - bed;
        let mean = (inside + (height - z[last]) * u[last].unwrap()) / depth;
        let expect = smooth_factor(mean * 2.0 * depth / 1e-6) / 8.0 * 1000.0 * mean * mean;
        let found = get(&outcome, "lid_stress_Pa");
        assert!((found / expect - 1.0).abs() < 2e-3, "{case}: {found} {expect}");
    }
}

#[test]
fn the_bottom_carries_the_weight_of_the_grains_normal_to_it() {
    for (case, slope, weight) in [("sheet_1d_type_a", 0.016, 140.0 * 9.81), ("sheet_1d_type_b", 0.05, 1600.0 * 9.81)] {
        let drive =
            ["flow.shields=".to_owned(), format!("flow.slope={slope}"), "flow.slope_definition=sine".to_owned()];
        let room = ["bed.thickness=0.15", if slope < 0.02 { "flow.depth=0.04" } else { "flow.depth=0.01" }];
        let settings: Vec<String> = drive.into_iter().chain(room.map(str::to_owned)).collect();
        let outcome = solve(case, &settings);
        let profile = outcome.profile.as_ref().unwrap();
        let (z, p) = (profile.axis(), profile.get(&q::P_PARTICLE).unwrap());
        // Packed grains at rest: linear down to the bottom.
        let (a, b) = (p[1].unwrap(), p[2].unwrap());
        let bottom = a + (a - b) / (z[2] - z[1]) * z[1];
        let sine = get(&outcome, "slope_sine");
        assert_eq!(sine, slope);
        let expect = weight * (1.0 - sine * sine).sqrt() * get(&outcome, "solid_volume_bed_m");
        assert!((bottom / expect - 1.0).abs() < 1e-9, "{case}: {bottom} {expect}");
    }
}
