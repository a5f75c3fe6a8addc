//! A flow, and the tables of the models that solve it. What a case of format 1 stated, its migration states.

use std::fs;

use bedload::case::{Case, CaseError};
use bedload::model::Problem;

use bedload::scene::Scene;
use serde_json::Value;

use crate::support::{REGISTRY, SAND, Scratch, project, run};

pub fn parsed(name: &str, text: &str, set: &[String]) -> (Case, Problem) {
    let read = REGISTRY.parse(name, "scene.toml", text.to_owned(), set);
    read.unwrap_or_else(|error| panic!("{name}: {}\n{text}", error.render(false)))
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
    let rate = |model: &str, set: &[&str]| {
        let (_, problem) = of(model, &flow(), set).unwrap();
        run(&problem).unwrap().results.get("transport_rate_dimensionless").unwrap()
    };
    // Those of flow_theta06-sheet-flow (w_s = 0.54 m/s and the level of the bed in the flow there) and flow_theta06-two-fluid.
    let in_flow = rate("sheet-flow", &["bed_level=in-flow"]);
    assert!((in_flow / 2.94904 - 1.0).abs() < 5e-3, "{in_flow}");
    assert!((rate("two-fluid", &[]) / 2.5765 - 1.0).abs() < 5e-3, "{}", rate("two-fluid", &[]));
    // The bed at rest swells as it moves, and leaves less of the flow over it.
    assert!((0.8..0.95).contains(&(rate("sheet-flow", &[]) / in_flow)), "{}", rate("sheet-flow", &[]));
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
    ] {
        let name = key.split(' ').next().unwrap();
        let found = wrong(of(model, &changed("slope = 0.05", &format!("slope = 0.05\n{key}")), &[]));
        let hit = |(code, path, _): &(String, String, String)| code == "not-used" && *path == format!("flow.{name}");
        assert!(found.iter().any(hit), "{key} in {model}: {found:?}");
    }
    let without = flow().replace("thickness = \"12.5 d\"\n", "");
    let found = wrong(of("two-fluid", &without, &[]));
    assert!(found.len() == 1 && found[0].1 == "bed.thickness" && found[0].2.contains("[bed]"), "{found:?}");
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
    assert!(out.contains("valid, coupled, 1448 grains"), "{out}");
    let every = scratch.bedload(["check", "flow.toml"]).exits(0).out;
    assert_eq!(every.lines().filter(|line| line.contains("--model")).count(), 3, "{every}");
    scratch.bedload(["run", "flow.toml"]).exits(2);
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
}

#[test]
fn a_scene_alone_is_checked_explained_advised_and_compared() {
    let scratch = Scratch::new();
    scratch.write("sand.toml", SAND);
    let valid = scratch.bedload(["check", "sand.toml"]).exits(0).out;
    let taken = |model: &str| valid.lines().any(|line| line.contains(&format!("--model {model}")));
    assert!(["sheet-flow", "two-fluid", "coupled"].iter().all(|model| taken(model)), "{valid}");
    assert!(!taken("laminar") && valid.contains("does not solve a flow whose top is free-surface"), "{valid}");
    let explained = scratch.bedload(["explain", "sand.toml"]).exits(0).out;
    for piece in ["shields_drive", "settling_velocity_m_s", "submergence", "--model coupled", "laminar"] {
        assert!(explained.contains(piece), "{piece}: {explained}");
    }
    // What the file leaves to the model is shown with its value.
    let sheet = scratch.bedload(["explain", "sand.toml", "--model", "sheet-flow"]).exits(0).out;
    for piece in ["Not in the file, and taken as", "closures.friction.mu_s", "0.35", "grid.cells", "300"] {
        assert!(sheet.contains(piece), "{piece}: {sheet}");
    }
    let refused = scratch.bedload(["run", "sand.toml"]).exits(2).err;
    assert!(refused.contains("which-model") && refused.contains("a scene alone"), "{refused}");
    let two = scratch.bedload(["run", "sand.toml", "--model", "sheet-flow", "--model", "two-fluid", "--json"]);
    let two = two.exits(0).json();
    assert_eq!(two.as_array().map(Vec::len), Some(2), "{two}");
    assert_eq!(scratch.names("runs"), ["sand-sheet-flow", "sand-two-fluid"]);
    let compared = ["compare", "sand.toml", "--model", "sheet-flow", "--model", "two-fluid", "--json"];
    let compared = scratch.bedload(compared).exits(0).json();
    assert_eq!(compared["subjects"].as_array().map(Vec::len), Some(2));
    let grains = |i: usize| compared["subjects"][i]["solid_volume_m"].as_f64().unwrap();
    assert!((grains(0) / 0.024 - 1.0).abs() < 1e-9 && (grains(1) / grains(0) - 1.0).abs() < 1e-6, "{compared}");
    let advised = scratch.bedload(["advise", "sand.toml", "--tolerance", "0.3", "--write", "least.toml"]).exits(0).out;
    assert!(advised.contains("Shields number"), "{advised}");
    scratch.bedload(["check", "least.toml"]).exits(0);
    let least = scratch.read("least.toml");
    assert!(least.contains("thickness = 0.04") && least.contains("depth = 0.06"), "the scene is the same: {least}");
}

#[test]
fn the_stiffness_of_grains_follows_the_weight_on_them() {
    let contact = |set: &[&str]| format!("{:?}", of("coupled", SAND, set).unwrap().1.solver());
    // 40 mm of a packing of 0.6 under water on grains of 2 mm: 1e4 p d.
    let k_n = 1e4 * 1650.0 * 9.81 * 0.6 * 40e-3 * 2e-3;
    let found = contact(&[]);
    let of_name = |text: &str, name: &str| -> f64 {
        text.split(&format!("{name}: ")).nth(1).unwrap().split([',', ' ', '}']).next().unwrap().parse().unwrap()
    };
    assert!((of_name(&found, "k_n") / k_n - 1.0).abs() < 1e-12, "{found}");
    assert_eq!(of_name(&found, "k_n"), of_name(&found, "k_s"));
    let given = contact(&["closures.contact.k_n=1e3", "closures.contact.k_s_over_k_n=0.5"]);
    assert_eq!((of_name(&given, "k_n"), of_name(&given, "k_s")), (1e3, 500.0));
}

#[test]
fn a_run_of_format_1_is_named_as_such() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "exact_1d_aussillous", "--out", "old", "--quiet"]).exits(0);
    let summary = scratch.summary("old");
    let of = |key: &str| summary["provenance"][key].as_str().unwrap().to_owned();
    assert_eq!((of("scene_sha256").len(), of("model_sha256").len()), (64, 64));
    // The scene of another model of the flow has the same hash.
    scratch.bedload(["run", "laminar_1d_aussillous", "--out", "other", "--quiet"]).exits(0);
    let other = scratch.summary("other");
    assert_eq!(other["provenance"]["scene_sha256"], of("scene_sha256").as_str());
    assert_ne!(other["provenance"]["model_sha256"], of("model_sha256").as_str());
    scratch.write("old/case.toml", "format = 1\n");
    for more in ["--resume", "--quiet"] {
        let refused = scratch.bedload(["run", "exact_1d_aussillous", "--out", "old", more]).exits(2).err;
        assert!(refused.contains("a run of a case of format 1"), "{refused}");
    }
    scratch.bedload(["run", "exact_1d_aussillous", "--out", "old", "--force", "--quiet"]).exits(0);
}
