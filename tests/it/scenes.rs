//! Format 2: a flow, and the tables of the models that solve it. What a case of format 1 states, its conversion states.

use std::fs;

use bedload::case::{Case, CaseError, shipped};
use bedload::model::Problem;

use bedload::scene::Scene;
use rayon::prelude::*;
use serde_json::Value;

use super::goldens::points;
use crate::support::{REGISTRY, Scratch, project, run};

fn converted(case: &Case) -> String {
    REGISTRY.converted(case).unwrap()
}

fn parsed(name: &str, text: &str, set: &[String]) -> (Case, Problem) {
    let read = REGISTRY.parse(name, "scene.toml", text.to_owned(), set);
    read.unwrap_or_else(|error| panic!("{name}: {}\n{text}", error.render(false)))
}

#[test]
fn the_conversion_of_a_case_is_the_same_problem_to_the_bit() {
    for name in shipped::names() {
        let (case, problem) = REGISTRY.load(name, &[]).unwrap();
        let text = converted(&case);
        let (second, same) = parsed(name, &text, &[]);
        assert_eq!(format!("{:?}", problem.solver()), format!("{:?}", same.solver()), "{name}");
        assert_eq!((problem.kind, problem.stochastic), (same.kind, same.stochastic), "{name}");
        assert_eq!(problem.scene, same.scene, "{name}");
        assert_eq!((case.checks(), case.limit()), (second.checks(), second.limit()), "{name}");
        // The resolved case is the conversion, and so is the resolved case of that.
        assert_eq!(second.resolved(), text, "{name}");
        assert_eq!(converted(&second), text, "{name}");
    }
}

/// The same of every point that the studies make of a case.
#[test]
fn the_conversion_of_a_point_of_a_study_is_the_same_problem_to_the_bit() {
    let moved: Vec<String> = shipped::names()
        .par_bridge()
        .flat_map_iter(|name| {
            points(name).into_iter().filter_map(move |point| {
                let case = point.case.as_deref().unwrap_or(name);
                let (first, problem) = REGISTRY.load(case, &point.overrides).ok()?;
                let same = REGISTRY.parse("scene", "scene.toml", converted(&first), &[]).ok().map(|(_, same)| same);
                let text = |problem: &Problem| format!("{:?}", problem.solver());
                let moved = same.is_none_or(|same| text(&problem) != text(&same));
                moved.then(|| format!("{case} with {:?}", point.overrides))
            })
        })
        .collect();
    assert!(moved.is_empty(), "{}", moved.join("\n"));
}

/// One flow with the tables of three models.
fn flow() -> String {
    fs::read_to_string(project("examples/flow_theta06.toml")).unwrap()
}

fn of(model: &str, text: &str, set: &[&str]) -> Result<(Case, Problem), CaseError> {
    let set: Vec<String> = set.iter().map(|&set| set.to_owned()).collect();
    REGISTRY.clone().choosing(model).parse("flow", "flow.toml", text.to_owned(), &set)
}

/// Code, path and text of each violation.
fn wrong(read: Result<(Case, Problem), CaseError>) -> Vec<(String, String, String)> {
    let violations = read.err().map(|error| error.violations).unwrap_or_default();
    violations.iter().map(|v| (v.fault.code().to_owned(), v.path.clone(), v.fault.to_string())).collect()
}

#[test]
fn several_models_share_a_flow() {
    let mut scenes = Vec::new();
    for model in ["sheet-flow", "two-fluid", "coupled"] {
        let (case, problem) = of(model, &flow(), &[]).unwrap_or_else(|error| panic!("{}", error.render(false)));
        assert_eq!((case.name.as_str(), problem.kind), (format!("flow-{model}").as_str(), model));
        // The resolved case is this model's alone, and the same again.
        let (_, again) = parsed("again", &case.resolved(), &[]);
        assert_eq!(format!("{:?}", problem.solver()), format!("{:?}", again.solver()));
        scenes.push(problem.scene.unwrap());
    }
    assert!(scenes.windows(2).all(|pair| pair[0] == pair[1]));
    let Scene::Bed(scene) = &scenes[0] else { panic!("a flow over a bed") };
    assert_eq!((scene.bed.thickness, scene.flow.depth), (Some(0.075), Some(0.108)));
    assert!((scene.shields_drive().unwrap() / 0.6 - 1.0).abs() < 1e-12);
    let rate = |model: &str| {
        let (_, problem) = of(model, &flow(), &[]).unwrap();
        run(&problem).unwrap().results.get("transport_rate_dimensionless").unwrap()
    };
    // Those of sheet_1d_theta06 (w_s = 0.54 m/s there) and kinetic_1d_theta06, whose flow this is.
    assert!((rate("sheet-flow") / 2.94904 - 1.0).abs() < 5e-3, "{}", rate("sheet-flow"));
    assert!((rate("two-fluid") / 2.5765 - 1.0).abs() < 5e-3, "{}", rate("two-fluid"));
}

#[test]
fn the_bed_of_the_flow_is_that_of_the_grains() {
    // 12.5 d at 0.6065 are 14.48 layers: 10 d by 10 d of them.
    let (_, problem) = of("coupled", &flow(), &[]).unwrap();
    assert_eq!(problem.cells(), 1448);
    let (_, given) = of("coupled", &flow(), &["layers=14.6"]).unwrap();
    assert_eq!(given.cells(), 1460);
}

#[test]
fn keys_of_set_are_those_of_the_flow_or_of_the_model() {
    let cells = |set: &str| of("two-fluid", &flow(), &[set]).map_or(0, |(_, problem)| problem.cells());
    assert_eq!([cells("grid.cells=60"), cells("two-fluid.grid.cells=60"), cells("flow.depth=20 d")], [60, 60, 240]);
    let (case, problem) = of("two-fluid", &flow(), &["grains.diameter=3 mm"]).unwrap();
    let Some(Scene::Bed(scene)) = problem.scene else { panic!("a flow over a bed") };
    assert_eq!(scene.flow.depth, Some(18.0 * 3e-3), "lengths in d follow the diameter");
    assert!(case.resolved().contains("depth = 0.054\n"), "{}", case.resolved());
}

#[test]
fn what_is_wrong_with_a_flow_is_said_at_its_place() {
    let changed = |from: &str, to: &str| {
        assert!(flow().contains(from), "{from}");
        flow().replacen(from, to, 1)
    };
    let sheet = |text: &str| wrong(of("sheet-flow", text, &[]));
    for (text, code, path, words) in [
        (changed("scene = \"bed\"", "scene = \"bad\""), "unknown-word", "scene", "\"bad\""),
        (
            changed("scene = \"bed\"", "scene = \"channel\""),
            "other-scene",
            "sheet-flow",
            "does not solve a scene of the kind",
        ),
        (changed("scene = \"bed\"\n", ""), "missing-key", "scene", "missing key scene"),
        (changed("thickness = \"12.5 d\"", "thickness = \"12.5 s\""), "wrong-dimension", "bed.thickness", "is a time"),
        (changed("thickness = \"12.5 d\"", "thickness = \"0.5 d\""), "thinner-than-a-grain", "bed.thickness", ""),
        (changed("thickness = \"12.5 d\"\n", ""), "missing-key", "bed.thickness", "thickness in [bed]"),
        (changed("depth = \"18 d\"", "level = \"18 d\""), "unknown-key", "flow.level", "level"),
        (
            changed("suspension = \"rouse\"", "suspension = \"rousse\""),
            "unknown-word",
            "sheet-flow.closures.suspension.law",
            "rousse",
        ),
        (changed("phi = 0.6065", "phi = 0.9"), "out-of-range", "bed.phi", "0.9"),
        (
            changed("[sheet-flow.closures]", "[sheet-flow]\nbed_levle = \"in-flow\"\n[sheet-flow.closures]"),
            "unknown-key",
            "sheet-flow.bed_levle",
            "bed_levle",
        ),
    ] {
        let found = sheet(&text);
        let hit = |(c, p, t): &(String, String, String)| c == code && p == path && t.contains(words);
        assert!(found.iter().any(hit), "{code} at {path}: {found:?}");
    }
    for (key, model) in [
        ("oscillation = { amplitude = \"10 Pa/m\", period = \"5 s\" }", "sheet-flow"),
        ("pressure_gradient = \"10 Pa/m\"", "two-fluid"),
        ("top = \"plane\"", "two-fluid"),
        ("u_star = \"0.1 m/s\"", "coupled"),
    ] {
        let name = key.split(' ').next().unwrap();
        let found = wrong(of(model, &changed("slope = 0.05", &format!("slope = 0.05\n{key}")), &[]));
        let hit = |(code, path, _): &(String, String, String)| code == "not-used" && *path == format!("flow.{name}");
        assert!(found.iter().any(hit), "{key} in {model}: {found:?}");
    }
    let without = flow().replace("restitution = 0.7\n", "");
    assert_eq!(sheet(&without), [], "sheet flow does not need it");
    let found = wrong(of("two-fluid", &without, &[]));
    assert!(found.len() == 1 && found[0].1 == "grains.restitution", "{found:?}");
    let found = wrong(REGISTRY.parse("flow", "flow.toml", flow(), &[]));
    assert!(found.len() == 1 && found[0].0 == "which-model", "{found:?}");
    let found = wrong(of("sheet-flows", &flow(), &[]));
    assert!(found.len() == 1 && found[0].2 == "there is no model \"sheet-flows\"", "{found:?}");
}

#[test]
fn a_flow_is_run_compared_and_migrated_on_the_command_line() {
    let scratch = Scratch::new();
    scratch.write("flow.toml", flow());
    let out = scratch.bedload(["check", "flow.toml", "--model", "coupled"]).exits(0).out;
    assert!(out.contains("valid, coupled, 1448 levels"), "{out}");
    scratch.bedload(["check", "flow.toml"]).exits(2);
    scratch.bedload(["run", "flow.toml", "--model", "sheet-flow", "--quiet"]).exits(0);
    assert_eq!(scratch.names("runs"), ["flow-sheet-flow"]);
    let arguments = ["compare", "flow.toml", "--model", "sheet-flow", "--model", "two-fluid", "--json"];
    let found: Value = scratch.bedload(arguments).exits(0).json();
    let names: Vec<&str> = found["subjects"].as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["flow-sheet-flow", "flow-two-fluid"]);
    for row in found["inputs"].as_array().unwrap() {
        let table = row["path"].as_str().unwrap().split('.').next().unwrap();
        assert!(!["fluid", "grains", "bed", "flow"].contains(&table), "the flow is the same: {row}");
    }
    scratch.bedload(["migrate", "sheet_1d_theta06", "new.toml"]).exits(0);
    scratch.bedload(["migrate", "sheet_1d_theta06", "new.toml"]).exits(2);
    assert!(scratch.read("new.toml").starts_with("format = 2\nscene = \"bed\"\n"));
    let rate = |case: &str| {
        let found: Value =
            scratch.bedload(["run", case, "--json", "--out", case.trim_end_matches(".toml")]).exits(0).json();
        found["results"]["transport_rate_m2_s"]["value"].as_f64().unwrap()
    };
    assert_eq!(rate("new.toml"), rate("sheet_1d_theta06"));
}
