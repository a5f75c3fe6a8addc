//! `bedload advise`: the least model, what can go, and the case that it writes.

use crate::support::Scratch;

#[test]
fn the_least_model_follows_the_scene_and_the_tolerance() {
    let scratch = Scratch::new();
    for (case, tolerance, model) in [
        ("bed_ouriemi-laminar", "0.05", "laminar-exact"),
        ("laminar_1d_muiv", "0.05", "laminar"),
        ("sheet_1d_sumer91", "0.05", "sheet-flow"),
        ("flow_theta04_quick", "0.3", "two-fluid"),
        ("flow_theta04_quick", "0.15", "two-fluid"),
        ("flow_theta04_quick", "0.05", "coupled"),
        // At 0.2 kinetic theory misses half of the transport.
        ("flow_theta02_quick", "0.15", "coupled"),
        // Sheet flow was measured on gentle slopes under deep water alone.
        ("coupled_3d_shields_quick", "0.3", "coupled"),
        // Side walls are in no other model.
        ("flume_exp20", "0.5", "coupled"),
    ] {
        let found = scratch.bedload(["advise", case, "--tolerance", tolerance, "--json"]).exits(0).json();
        assert_eq!(found["model"], model, "{case} {tolerance}");
    }
}

#[test]
fn terms_are_assessed_by_what_dropping_them_costs() {
    let scratch = Scratch::new();
    let term = |case: &str, set: &str, what: &str| {
        let found = scratch.bedload(["advise", case, "--set", set, "--json"]).exits(0).json();
        let terms = found["terms"].as_array().unwrap();
        let term = terms.iter().find(|term| term["what"] == what).unwrap();
        (term["keep"].as_bool().unwrap(), term["error"].as_f64())
    };
    let slip = "slip between the phases";
    let (keep, error) = term("bed_ouriemi-laminar", "grains.diameter=1 mm", slip);
    assert!(!keep && error.unwrap() < 1e-3, "{error:?}");
    let (keep, error) = term("bed_ouriemi-laminar", "grains.diameter=12 mm", slip);
    assert!(keep && error.unwrap() > 0.05, "{error:?}");
    let (keep, error) = term("sheet_1d_type_b", "flow.shields=1.5", "suspension");
    assert!(keep && error.unwrap() > 0.3, "{error:?}");
}

#[test]
fn side_walls_of_a_section_decide_and_the_section_is_advised() {
    let scratch = Scratch::new();
    let found = scratch.bedload(["advise", "section_2d_square_bed", "--json"]).exits(0).json();
    assert_eq!(found["model"], "duct-bed", "{found}");
    // Fluxes per width of both runs, each on its own.
    let flux = |set: &[&str]| {
        let line = [&["run", "section_2d_square_bed", "--force", "--json"], set].concat();
        scratch.bedload(line).exits(0).json()["results"]["bed_flux_m3_s"]["value"].as_f64().unwrap()
    };
    let (walls, planes) = (flux(&[]), flux(&["--set", "flow.section=", "--set", "grid.yield_row=false"]));
    let term = &found["terms"][0];
    assert_eq!((&term["what"], &term["keep"]), (&"side walls".into(), &true.into()));
    let error = term["error"].as_f64().unwrap();
    assert!((error - (planes / walls - 1.0)).abs() < 1e-9, "{error} {planes} {walls}");
    // The whole duct has no exact yield of its own: its section has.
    let whole = scratch.bedload(["advise", "section_3d_square_bed", "--json"]).exits(0).json();
    let terms = whole["terms"].as_array().unwrap();
    assert!(terms.iter().all(|term| !term["because"].as_str().unwrap().contains("leaves no such flow")), "{whole}");
}

#[test]
fn what_is_advised_has_its_cost_and_its_error() {
    let scratch = Scratch::new();
    let advise = |line: &[&str]| scratch.bedload([&["advise"], line, &["--json"]].concat()).exits(0).json();
    for (case, tolerance) in [
        ("bed_ouriemi-laminar", "0.05"),
        ("laminar_1d_muiv", "0.05"),
        ("sheet_1d_sumer91", "0.05"),
        ("flow_theta06-two-fluid", "0.2"),
        ("section_2d_square_bed", "0.05"),
    ] {
        let found = advise(&[case, "--tolerance", tolerance]);
        let cost = found["cost_s"].as_f64().unwrap();
        assert!(cost > 0.0 && found["cost_measured"] == true, "{case}: {found}");
        assert!(!found["error_of_model"].as_str().unwrap().is_empty(), "{case}");
        let closed = found["model"] == "laminar-exact";
        // On a mesh that is coarser than the finest there is an error, and a small one.
        let mesh = found["error_of_mesh"].as_f64();
        assert!(if closed { mesh.is_none() } else { mesh.is_some_and(|e| e > 0.0 && e < 2e-2) }, "{case}: {found}");
    }
    // It is the one that `converge` finds.
    let over = ["converge", "flow_theta06", "--model", "two-fluid", "--over", "mesh", "--json"];
    let study = scratch.bedload(over).exits(0).json();
    for cells in ["120", "240"] {
        let point =
            |p: &&serde_json::Value| p["series"] == "cells as in the case" && p["values"]["grid.cells"] == cells;
        let point = study["points"].as_array().unwrap().iter().find(point).unwrap();
        let converged = point["measures"]["error_transport_rate"].as_f64().unwrap();
        let set = format!("grid.cells={cells}");
        let found = advise(&["flow_theta06-two-fluid", "--tolerance", "0.2", "--set", &set]);
        let mesh = found["error_of_mesh"].as_f64().unwrap();
        assert!((mesh / converged - 1.0).abs() < 1e-6, "{cells}: {mesh} {converged}");
    }
    // Steps of grains are counted beforehand as a run makes them: 15 million in a second.
    for case in ["flow_theta06_quick-coupled", "flume_exp14_quick"] {
        let short = ["--set", "discrete.duration=0.2 s", "--json"];
        let told = scratch.bedload(["advise", case].into_iter().chain(short)).exits(0).json()["cost_s"].take();
        let made = scratch.bedload(["run", case].into_iter().chain(short)).exits(0).json()["cost"]["work_units"].take();
        let (told, made) = (told.as_f64().unwrap() * 1.5e7, made.as_f64().unwrap());
        assert!((told / made - 1.0).abs() < 0.15, "{case}: {told:e} {made:e}");
    }
    // Grains take minutes, in proportion to the time that they are followed.
    let grains = |set: &str| advise(&["flow_theta06-coupled", "--set", set])["cost_s"].as_f64().unwrap();
    let (short, long) = (grains("discrete.duration=10 s"), grains("discrete.duration=20 s"));
    assert!((long / short - 2.0).abs() < 1e-9 && short > 30.0, "{short} {long}");
}

#[test]
fn terms_that_can_go_one_by_one_but_not_together_do_not_all_go() {
    let scratch = Scratch::new();
    let terms = |tolerance: &str| {
        let found = scratch.bedload(["advise", "sheet_1d_sumer91", "--tolerance", tolerance, "--json"]).exits(0).json();
        let gone = found["terms"].as_array().unwrap().iter().filter(|term| term["keep"] == false).count();
        (gone, found["dropped_together"].as_f64())
    };
    let (gone, together) = terms("0.05");
    assert_eq!(gone, 2);
    assert!(together.is_some_and(|error| error > 0.03 && error < 0.05), "{together:?}");
    // Each of the two changes 2.1 %.
    assert_eq!(terms("0.03"), (1, None));
}

#[test]
fn the_case_that_it_writes_runs_and_is_not_overwritten() {
    let scratch = Scratch::new();
    let words = ["advise", "flow_theta06_quick-coupled", "--tolerance", "0.3", "--write", "least.toml"];
    scratch.bedload(words).exits(0);
    let found = scratch.bedload(["run", "least.toml", "--json"]).exits(0).json();
    let rate = found["results"]["transport_rate_dimensionless"]["value"].as_f64().unwrap();
    // The grains carry 2.38.
    assert!((rate / 2.38 - 1.0).abs() < 0.25, "{rate}");
    scratch.bedload(words).exits(2);
    scratch.bedload(words.into_iter().chain(["--force"])).exits(0);
}

#[test]
fn what_has_no_choice_is_reported() {
    let scratch = Scratch::new();
    let found = scratch.bedload(["advise", "section_2d_square", "--json"]).exits(2).json();
    assert_eq!(found["error"]["code"], "one-model", "{found}");
    // What is said of it is true: a channel has other models, and so have grains alone.
    for (case, words) in [
        ("exact_1d_bingham", "bingham-exact solves a scene of the kind \"channel\""),
        ("bingham_1d_plane", "bingham solves a scene of the kind \"channel\""),
        ("grains_3d_bed_quick", "dem solves a scene of the kind \"granular\""),
        ("kinetic_1d_waves", "this case of two-fluid is none"),
    ] {
        let message = scratch.bedload(["advise", case, "--json"]).exits(2).json()["error"]["message"].take();
        let message = message.as_str().unwrap();
        assert!(message.starts_with("advice is for steady flows over a bed") && message.ends_with(words), "{message}");
    }
    for case in ["two_fluid_1d_avalanche", "kinetic_1d_waves", "kinetic_1d_settling"] {
        let found = scratch.bedload(["advise", case, "--json"]).exits(2).json();
        assert_eq!(found["error"]["code"], "one-model", "{found}");
    }
    let steep = ["advise", "sheet_1d_limit_slope_a", "--set", "flow.slope=0.1", "--json"];
    assert_eq!(scratch.bedload(steep).exits(2).json()["error"]["code"], "no-flow");
    // Contacts, gravity and all go with the scene.
    let set = [
        "--set",
        "flow.gravity=1.62",
        "--set",
        "grains.restitution=0.9",
        "--tolerance",
        "0.05",
        "--write",
        "moon.toml",
    ];
    scratch.bedload(["advise", "flow_theta06-two-fluid"].into_iter().chain(set)).exits(0);
    let case = scratch.read("moon.toml");
    assert!(
        case.contains("gravity = 1.62") && case.contains("restitution = 0.9") && case.contains("friction = 0.4"),
        "{case}"
    );
    scratch.bedload(["advise", "sheet_1d_sumer91", "--tolerance", "0"]).exits(2);
    scratch.bedload(["advise", "no_such_case"]).exits(2);
}

#[test]
fn a_model_that_is_chosen_for_a_scene_alone_is_that_of_the_advice() {
    let scratch = Scratch::new();
    scratch.write(
        "sand.toml",
        "format = 2\nscene = \"bed\"\ncase.title = \"Sand\"\n\
        fluid = { density = \"1000 kg/m3\", viscosity = \"1e-3 Pa s\" }\n\
        grains = { diameter = \"2 mm\", density = \"2650 kg/m3\" }\nbed.thickness = \"40 mm\"\n\
        flow = { depth = \"60 mm\", slope = \"1.5 deg\" }\n",
    );
    let advise = |line: &[&str]| scratch.bedload([&["advise", "sand.toml"], line].concat()).exits(0);
    // Its terms are those that are assessed, as of a case that has its table.
    scratch.write("sheet.toml", scratch.read("sand.toml") + "[sheet-flow]\n");
    let with_table = scratch.bedload(["advise", "sheet.toml", "--json"]).exits(0).json();
    let chosen = advise(&["--model", "sheet-flow", "--json"]).json();
    assert_eq!(chosen["of"], "sheet-flow");
    assert_eq!((&chosen["terms"], &chosen["numbers"]), (&with_table["terms"], &with_table["numbers"]));
    assert!(chosen["terms"].as_array().unwrap().iter().any(|term| term["what"] == "suspension"), "{chosen}");
    assert!(advise(&["--model", "sheet-flow"]).out.contains("\n  terms of sheet-flow\n"));
    assert!(advise(&["--model", "two-fluid"]).out.contains("two-fluid has no term that is assessed"));
    // Of the scene alone they are those of what is advised.
    let alone = advise(&["--json"]).json();
    assert_eq!((&alone["model"], &alone["of"]), (&"coupled".into(), &"coupled".into()));
    // Where the model that was chosen is the least, its case is written: a scene alone is none.
    let write = ["--model", "coupled", "--set", "layers=12", "--write", "least.toml"];
    let out = advise(&write).out;
    assert!(out.contains("terms of coupled") && out.contains("wrote least.toml"), "{out}");
    let checked = scratch.bedload(["check", "least.toml"]).exits(0).out;
    assert!(checked.contains("least: valid, coupled, 1200 grains"), "{checked}");
}
