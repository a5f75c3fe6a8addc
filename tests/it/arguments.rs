//! What is typed: which model a case is solved by, which values are set in it, and how the next command is spelt.

use serde_json::Value;

use crate::support::{SAND, Scratch};

/// A folder with that scene, under a name that a shell would take apart.
fn sand() -> Scratch {
    let scratch = Scratch::new();
    scratch.write("sand.toml", SAND);
    scratch.write("my sand.toml", SAND);
    scratch
}

/// The error of a command with `--json` that exits with 2.
fn refused(scratch: &Scratch, line: &[&str]) -> Value {
    scratch.bedload(line.iter().chain(&["--json"])).exits(2).json()["error"].take()
}

#[test]
fn a_model_of_no_such_name_is_answered_with_the_nearest_one_and_all() {
    let scratch = sand();
    for line in [["check", "sand.toml", "--model", "sheet-flwo"].as_slice(), &["check", "sand.toml:sheet-flwo"]] {
        let error = refused(&scratch, line);
        assert_eq!(error["message"], "there is no model \"sheet-flwo\"", "{line:?}");
        assert_eq!(error["hint"], "did you mean \"sheet-flow\"?", "{line:?}");
    }
    for (line, name) in [
        (["check", "sand.toml", "--model", "saltation-3"].as_slice(), "saltation-3"),
        (&["check", "sand.toml", "--model", ""], ""),
        (&["run", "sand.toml:"], ""),
        (&["compare", "sand.toml", "sheet_1d_sumer91", "--model", ""], ""),
        (&["chart", "sand.toml", "--model", ""], ""),
        (&["validate", "flow_theta06", "--model", ""], ""),
    ] {
        let error = refused(&scratch, line);
        assert_eq!(
            (&error["code"], &error["message"]),
            (&"which-model".into(), &format!("there is no model \"{name}\"").into())
        );
        assert!(error["allowed"].as_str().unwrap().contains("sheet-flow, two-fluid, coupled"), "{line:?}: {error}");
        assert!(error["hint"].as_str().unwrap().contains("list models"), "{line:?}: {error}");
    }
    let error = refused(&scratch, &["check", "flow_theta06-sheet-flow", "--model", "two-fluid"]);
    assert_eq!(error["message"], "the name of the case chooses sheet-flow, and --model two-fluid");
    assert_eq!(error["hint"], "leave out --model for sheet-flow, or give flow_theta06 --model two-fluid");
    // A file that is not there is no matter of models.
    assert_eq!(refused(&scratch, &["check", "sands.toml:sheet-flwo"])["code"], "no-such-case");
    assert!(!scratch.path("runs").exists());
}

#[test]
fn a_setting_in_the_table_of_a_model_does_not_choose_it() {
    let scratch = sand();
    let set = ["--set", "two-fluid.grid.cells=60"];
    let run = ["run", "sand.toml"];
    let error = refused(&scratch, &[run.as_slice(), &set].concat());
    assert_eq!(error["code"], "which-model");
    assert!(error["allowed"].as_str().unwrap().contains("sheet-flow, two-fluid"), "{error}");
    assert!(error["hint"].as_str().unwrap().ends_with("add --model two-fluid"), "{error}");
    assert!(!scratch.path("runs").exists());
    // The others are not refused for what is none of their business.
    let taken = scratch.bedload([&["check", "sand.toml"], set.as_slice()].concat()).exits(0).out;
    for model in ["sheet-flow", "two-fluid", "coupled"] {
        assert!(taken.contains(&format!("--model {model}")), "{model}: {taken}");
    }
    let chosen = ["check", "sand.toml", "--model", "two-fluid"];
    let out = scratch.bedload([chosen.as_slice(), &set].concat()).exits(0).out;
    assert!(out.contains("two-fluid, 60 levels"), "{out}");
    // Nor does it where a case is given whole.
    scratch.write("whole.toml", format!("{SAND}[sheet-flow]\n"));
    let whole = ["check", "whole.toml", "--set", "sheet-flow={ grid = { cells = 50 } }"];
    let out = scratch.bedload(whole).exits(0).out;
    assert!(out.contains("whole: valid, sheet-flow, 50 levels"), "{out}");
}

#[test]
fn a_setting_that_is_none_is_shown_as_it_was_typed() {
    let scratch = sand();
    for set in ["=3", "grid.=3", "foo", "grid..cells=3"] {
        let error = refused(&scratch, &["check", "exact_1d_aussillous", "--set", set]);
        assert_eq!(error["code"], "bad-set");
        assert_eq!(error["message"], format!("--set \"{set}\" is not of the form table.key=value"));
    }
}

#[test]
fn compare_changes_its_cases_and_nothing_else() {
    let scratch = sand();
    let compare = |line: &[&str]| scratch.bedload([&["compare"], line, &["--json"]].concat());
    let models = ["sand.toml", "--model", "sheet-flow", "--model", "two-fluid", "--out", "a"];
    let set = ["--set", "two-fluid.grid.cells=60", "--set", "flow.depth=70 mm"];
    let found = compare(&[models.as_slice(), &set].concat()).exits(0).json();
    let levels = |i: usize| found["subjects"][i]["levels"].as_u64().unwrap();
    assert!(levels(0) > 200 && levels(1) == 60, "{} and {}", levels(0), levels(1));
    for subject in found["subjects"].as_array().unwrap() {
        assert_eq!(subject["scene"]["inputs"]["flow.depth"], 0.07, "{subject}");
    }
    assert_eq!(found["request"]["overrides"], serde_json::json!(["two-fluid.grid.cells=60", "flow.depth=70 mm"]));
    // Another --set is another comparison.
    assert_eq!(compare(&[models.as_slice(), &set[..2]].concat()).exits(2).json()["error"]["code"], "other-comparison");
    // CASE:MODEL names the model, too, and the next command has every setting.
    let named = ["compare", "sand.toml:sheet-flow", "sand.toml:two-fluid", "--out", "b"];
    let out = scratch.bedload([named.as_slice(), &set].concat()).exits(0).out;
    assert!(out.contains("--set two-fluid.grid.cells=60 --set 'flow.depth=70 mm'"), "{out}");
    // What changes nothing is refused, and so is what a case does not take; nothing is written.
    let idle = compare(&["sand.toml:sheet-flow", "sand.toml:two-fluid", "--set", "coupled.layers=3", "--out", "c"]);
    let error = idle.exits(2).json()["error"].take();
    assert_eq!(error["message"], "--set coupled.layers=3 changes no case of this comparison");
    scratch.bedload(["run", "exact_1d_aussillous", "--quiet"]).exits(0);
    let runs = ["runs/exact_1d_aussillous", "runs/exact_1d_aussillous", "--set", "flow.depth=1 m", "--out", "c"];
    assert_eq!(compare(&runs).exits(2).json()["error"]["code"], "usage");
    let wrong = ["sand.toml:sheet-flow", "sand.toml:two-fluid", "--set", "flow.depht=1 m", "--out", "c"];
    assert_eq!(compare(&wrong).exits(2).json()["error"]["code"], "unknown-key");
    assert!(!scratch.path("c").exists());
}

#[test]
fn the_next_command_can_be_typed_as_it_is_printed() {
    let scratch = sand();
    let next = |out: &str| {
        let (_, line) = out.lines().find_map(|line| line.split_once("bedload ")).unwrap_or_else(|| panic!("{out}"));
        // Grains take minutes: whether the case is found says enough.
        scratch.shell(&format!("\"$BEDLOAD\" {}", line.replacen("run ", "check ", 1))).exits(0);
    };
    next(&scratch.bedload(["new", "exact_1d_aussillous", "a bed.toml"]).exits(0).out);
    let run = ["run", "a bed.toml", "--set", "flow.depth=40 mm", "--out", "r"];
    next(&scratch.bedload(run).exits(0).out);
    let explained = scratch.bedload(["explain", "my sand.toml"]).exits(0).out;
    next(explained.split_once("\nModels\n").unwrap().1.lines().find(|line| line.contains("bedload")).unwrap());
    let advised = ["advise", "my sand.toml", "--tolerance", "0.3", "--write", "the least.toml"];
    next(&scratch.bedload(advised).exits(0).out);
    let old = include_str!("../format1/exact_1d_aussillous.toml");
    scratch.write("old.toml", old);
    next(&scratch.bedload(["migrate", "old.toml", "of format 2.toml"]).exits(0).out);
    scratch.write("a table.csv", "z_m,u_mixture_m_s\n0,0\n");
    let error = refused(&scratch, &["compare", "a table.csv", "exact_1d_aussillous"]);
    assert_eq!(error["hint"], "give it as --data 'a table.csv'");
}

#[test]
fn what_clap_refuses_is_an_object_where_json_is_asked_for() {
    let scratch = sand();
    for (line, words) in [
        (["run", "sand.toml", "--json", "--nosuch"].as_slice(), "--nosuch"),
        (&["run", "--json"], "<CASE>"),
        (&["explain", "--threads", "2", "--json", "sand.toml"], "--threads"),
        (&["run", "sand.toml", "--threads", "0", "--json"], "0"),
    ] {
        let answer = scratch.bedload(line).exits(2);
        let error = answer.json();
        assert!(answer.err.is_empty() && error["status"] == "failed", "{line:?}: {error} {}", answer.err);
        assert_eq!(error["error"]["code"], "usage", "{error}");
        assert!(error["error"]["message"].as_str().unwrap().contains(words), "{error}");
        assert!(error["error"]["hint"].as_str().unwrap().contains("--help"), "{error}");
    }
    // Help is no error, and what follows -- is no option.
    assert!(scratch.bedload(["run", "--help", "--json"]).exits(0).out.contains("Usage"));
    let answer = scratch.bedload(["run", "a", "--", "b", "--json"]).exits(2);
    assert!(answer.out.is_empty() && answer.err.contains("unexpected"), "{}", answer.err);
}

#[test]
fn explain_has_everything_as_json() {
    let scratch = sand();
    let found = scratch.bedload(["explain", "sand.toml", "--model", "coupled", "--json"]).exits(0).json();
    assert_eq!((&found["status"], &found["model"]), (&"done".into(), &"coupled".into()));
    assert!(found["equations"].as_str().unwrap().contains("mobile spheres"), "{found}");
    let rows = |list: &Value| list.as_array().unwrap().clone();
    assert!(rows(&found["laws"]).iter().any(|law| law["law"] == "linear-spring" && law["source"].is_string()));
    assert!(rows(&found["flow"]["numbers"]).iter().any(|n| n["name"] == "shields_drive" && n["value"].is_f64()));
    assert!(rows(&found["flow"]["derived"]).iter().any(|n| n["key"] == "bed.phi" && n["value"] == 0.6));
    // Defaults have their type, and what follows from the flow says from what: 40 mm of a packing of 0.6 under water, d = 2 mm.
    let value = |key: &str| rows(&found["taken"]).into_iter().find(|row| row["key"] == key);
    assert_eq!(value("discrete.fluid_steps").unwrap()["value"], 1);
    for (key, expected) in [
        ("layers", 40e-3 * 0.6 / (std::f64::consts::PI / 6.0 * 2e-3)),
        ("cell.length", 20e-3),
        ("cell.width", 20e-3),
        ("closures.contact.k_n", 1e4 * 1650.0 * 9.81 * 0.6 * 40e-3 * 2e-3),
        ("closures.contact.k_s", 1e4 * 1650.0 * 9.81 * 0.6 * 40e-3 * 2e-3),
        ("relief", 2e-3 / 3.0),
    ] {
        let row = value(key).unwrap_or_else(|| panic!("{key} is not among {}", found["taken"]));
        let relative = (row["value"].as_f64().unwrap() / expected - 1.0).abs();
        assert!(relative < 1e-3 && row["from"].is_string(), "{key}: {row}, not {expected}");
    }
    // What is given is not taken from elsewhere; between walls there is no period across.
    let set = ["--set", "layers=5", "--set", "cell.length=30 mm", "--set", "flow.width=16 mm"];
    let text = ["explain", "sand.toml", "--model", "coupled"];
    let text = scratch.bedload([text.as_slice(), &set].concat()).exits(0).out;
    let list = text.split_once("Not in the file, and taken as\n").unwrap().1;
    let listed = |key: &str| list.lines().any(|line| line.trim_start().starts_with(&format!("{key} ")));
    assert!(!listed("layers") && !listed("cell.length") && !listed("cell.width"), "{list}");
    assert!(listed("closures.contact.k_n") && listed("closures.contact.k_s"), "{list}");
    // A scene alone, and several models.
    let alone = scratch.bedload(["explain", "sand.toml", "--json"]).exits(0).json();
    assert!(rows(&alone["models"]).iter().any(|row| row["model"] == "coupled" && row["refused"].is_null()));
    let two = ["explain", "sand.toml", "--model", "sheet-flow", "--model", "two-fluid", "--json"];
    assert_eq!(scratch.bedload(two).exits(0).json().as_array().map(Vec::len), Some(2));
}

#[test]
fn validate_and_chart_answer_with_one_object_for_all_models() {
    let scratch = sand();
    let models = ["--model", "sheet-flow", "--model", "two-fluid", "--json"];
    let found = scratch.bedload([&["validate", "flow_theta06"], models.as_slice()].concat()).exits(0).json();
    let rows = found["rows"].as_array().unwrap();
    for case in ["flow_theta06-sheet-flow", "flow_theta06-two-fluid"] {
        assert!(rows.iter().any(|row| row["case"] == case), "{case}: {found}");
    }
    let chart = ["chart", "bed_ouriemi", "--model", "laminar-exact", "--model", "laminar", "--json"];
    let found = scratch.bedload(chart).exits(0).json();
    let series = |name: &str| found["points"].as_array().unwrap().iter().any(|point| point["series"] == name);
    assert!(series("laminar-exact") && series("bed_ouriemi:laminar, exact yield"), "{}", found["command"]);
    // A case that claims nothing is no success.
    let error = refused(&scratch, &["validate", "sand.toml"]);
    assert_eq!(error["message"], "sand.toml has no checks: there is nothing to validate");
    assert!(error["hint"].as_str().unwrap().contains("[[sheet-flow.check]]"), "{error}");
    assert_eq!(refused(&scratch, &["validate", "exact_1d_bagnold", "sand.toml:two-fluid"])["code"], "usage");
}
