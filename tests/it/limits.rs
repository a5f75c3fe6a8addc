//! Where methods fail: each limit of the shipped `*_limit_*` cases from both sides. The limits themselves are rows of `validate`.

use serde_json::Value;

use crate::support::Scratch;

/// Runs a case with one value and more.
fn run(case: &str, set: &str, more: &[&str]) -> (i32, Value) {
    let scratch = Scratch::new();
    let sets = [set].iter().chain(more).flat_map(|set| ["--set", *set]).collect::<Vec<_>>();
    let run = scratch.bedload(["run", case, "--json", "--out", "o"].iter().copied().chain(sets));
    (run.code, run.json())
}

/// Just inside it works, just outside it is the typed failure.
fn pinned(case: &str, key: &str, inside: &str, outside: &str, code: &str) {
    let (exit, found) = run(case, &format!("{key}={inside}"), &[]);
    assert_eq!(exit, 0, "{case} {key}={inside}: {found}");
    let (exit, found) = run(case, &format!("{key}={outside}"), &[]);
    assert_eq!((exit, found["error"]["code"].as_str()), (3, Some(code)), "{case} {key}={outside}: {found}");
}

#[test]
fn explicit_steps_end_at_their_limits_and_diverge_beyond() {
    pinned("coupled_3d_limit_drag", "discrete.time_step", "3e-5 s", "6e-5 s", "step-too-long");
    pinned("coupled_3d_limit_sink", "discrete.coupling_period", "12 ms", "22 ms", "step-too-long");
    pinned("coupled_3d_limit_diffusion", "discrete.coupling_period", "1.7 ms", "1.85 ms", "step-too-long");
    pinned("grains_3d_limit_step", "discrete.time_step", "1.1e-4 s", "1.4e-4 s", "step-too-long");
    for (case, far) in [
        ("coupled_3d_limit_drag", "discrete.time_step=1e-4 s"),
        ("coupled_3d_limit_sink", "discrete.coupling_period=60 ms"),
        ("coupled_3d_limit_diffusion", "discrete.coupling_period=4 ms"),
        ("grains_3d_limit_step", "discrete.time_step=4e-4 s"),
    ] {
        let (exit, found) = run(case, far, &["discrete.force_time_step=true"]);
        let code = found["error"]["code"].as_str().unwrap_or_default();
        assert!(exit == 3 && ["overlap", "not-finite", "grain-lost"].contains(&code), "{case} {far}: {found}");
    }
    // The implicit step has no such limit.
    for case in ["coupled_3d_limit_sink", "coupled_3d_limit_diffusion"] {
        let (exit, _) = run(case, "discrete.coupling_period=40 ms", &["discrete.fluid_scheme=implicit"]);
        assert_eq!(exit, 0, "{case}");
    }
}

#[test]
fn a_cell_has_a_smallest_size() {
    let scratch = Scratch::new();
    let words = |length: &'static str| ["check", "coupled_3d_limit_cell", "--set", length];
    assert_eq!(scratch.bedload(words("cell.length=24.1 mm")).code, 0);
    assert_eq!(scratch.bedload(words("cell.length=23.9 mm")).code, 2);
}

#[test]
fn beds_move_as_a_whole_where_the_balance_says() {
    pinned("laminar_1d_limit_bed", "flow.pressure_gradient", "2460 Pa/m", "2466 Pa/m", "whole-bed-moves");
    pinned("sheet_1d_limit_slope_a", "flow.slope", "0.0295", "0.0297", "nothing-at-rest");
    pinned("sheet_1d_limit_slope_b", "flow.slope", "0.1083", "0.1088", "nothing-at-rest");
    pinned("sheet_1d_limit_newton", "flow.shields", "3.55", "3.58", "nothing-at-rest");
}

#[test]
fn jammed_layers_are_no_solution() {
    // Packed grains with an infinite viscosity carry any stress: the discrete equations have solutions in which nothing moves.
    let (exit, found) = run("sheet_1d_limit_newton", "flow.shields=0.25", &[]);
    assert!(exit == 0 && found["results"]["transport_rate_m2_s"]["value"].is_number(), "{found}");
    // Where that is all that there is, no layer moves, whatever the method.
    for (case, more) in [("sheet_1d_limit_newton", &[][..]), ("sheet_1d_limit_pseudotime", &["solver.time_step=1e-2"])]
    {
        let (exit, found) = run(case, "flow.shields=0.05", more);
        assert!(exit == 0 && found["results"]["transport_rate_m2_s"]["value"].is_null(), "{found}");
        let first = &found["regime"][0];
        assert_eq!((&first["premise"], &first["verdict"]), (&"a layer of grains moves".into(), &"broken".into()));
    }
    let (exit, found) = run("sheet_1d_limit_slope_a", "flow.slope=0.02966008742750933", &[]);
    assert_eq!((exit, found["error"]["code"].as_str()), (3, Some("nothing-at-rest")), "{found}");
}

#[test]
fn the_cut_under_the_interface_reaches_the_change_of_type() {
    pinned("sheet_1d_limit_cut_a", "regularisation.interface_cut", "0.08", "0.07", "change-of-type");
    pinned("sheet_1d_limit_cut_b", "regularisation.interface_cut", "0.25", "0.22", "change-of-type");
    // By default it is deepened, and nothing fails.
    let (exit, _) =
        run("sheet_1d_limit_cut_b", "regularisation.interface_cut=0.1", &["regularisation.deepen_cut=true"]);
    assert_eq!(exit, 0);
}

#[test]
fn the_iteration_needs_enough_iterations_and_short_steps() {
    pinned("sheet_1d_limit_pseudotime", "solver.time_step", "2.2e-3", "1.3e-3", "not-converged");
}

#[test]
fn limits_that_fail_nothing_are_found_too() {
    let scratch = Scratch::new();
    let found = scratch.bedload(["stability", "laminar_1d_limit_lambda", "--json", "--force"]).exits(0).json();
    let limit = &found["facts"]["limits"][0];
    assert_eq!(limit["class"], "holds, but inaccurate");
    assert!(limit["holds"].as_f64().unwrap() > 5e-7 && limit["fails"].as_f64().unwrap() < 1.1e-6, "{limit}");
    assert_eq!(found["facts"]["predicted"].as_f64(), Some(1.06e-6));
    // An ill-posed film is solved in one dimension, and flagged.
    let posed = |slope: &str| {
        let (exit, found) = run("exact_1d_limit_posed", slope, &[]);
        assert_eq!(exit, 0);
        found["validity"].to_string().contains("well-posed")
    };
    assert!(posed("flow.slope=21.6 deg") && !posed("flow.slope=21.7 deg"));
}

#[test]
fn a_limit_that_cannot_be_one_is_refused() {
    let scratch = Scratch::new();
    for (set, code) in
        [("limit.over=bla", "limit-key"), ("limit.over==1:2:3", "limit-key"), ("limit.beyond=holds", "limit-holds")]
    {
        let found = scratch.bedload(["check", "sheet_1d_limit_slope_a", "--set", set, "--json"]).exits(2).json();
        assert_eq!(found["error"]["code"], code, "{set} {found}");
    }
    // A limit at which nothing holds is red, whatever it claims to be.
    let case = bedload::case::shipped::find("kinetic_1d_limit_restitution").unwrap().content;
    scratch.write("none.toml", case.replace("grains.restitution=0.1:0.9:5", "flow.nothing=1:2:3"));
    scratch.bedload(["validate", "none.toml"]).exits(3);
}
