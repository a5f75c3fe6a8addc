//! `bedload compare` as a person runs it: what it writes, what it refuses, with which code.

use serde_json::{Value, json};

use crate::support::{Scratch, comparable};

const TWO: &str = "bed_ouriemi-laminar-exact";
const MIXED: &str = "exact_1d_ouriemi_mixed";

#[track_caller]
fn exits(scratch: &Scratch, code: i32, arguments: &[&str]) -> (String, String) {
    let answer = scratch.bedload(arguments).exits(code);
    (answer.out, answer.err)
}

#[track_caller]
fn answer(scratch: &Scratch, arguments: &[&str]) -> Value {
    scratch.bedload(arguments).exits(0).json()
}

fn norm<'a>(answer: &'a Value, column: &str) -> &'a Value {
    answer["norms"].as_array().unwrap().iter().find(|n| n["column"] == column).unwrap()
}

#[test]
fn two_cases_give_a_folder_and_at_most_twelve_lines() {
    let scratch = Scratch::new();
    let (out, err) = exits(&scratch, 0, &["compare", TWO, MIXED, "--png"]);
    assert!((4..=12).contains(&out.lines().count()) && err.is_empty(), "{out}{err}");
    assert!(out.starts_with("bed_ouriemi-laminar-exact is the reference"), "{out}");
    let target = "runs/compare-bed_ouriemi-laminar-exact-exact_1d_ouriemi_mixed";
    assert_eq!(scratch.names(target), ["compare.json", "figures", "norms.csv", "report.html"]);
    assert!(scratch.names(&format!("{target}/figures")).contains(&"profiles.png".into()));
    assert_eq!(scratch.names("runs").len(), 1, "nothing is left beside it");
    let page = scratch.read(&format!("{target}/report.html"));
    let order = [
        "<h1>bed_ouriemi-laminar-exact against",
        "id=\"answer\"",
        "<svg class=\"plot\"",
        "Numbers</h2>",
        "Profiles</h2>",
        "<figure id=\"profiles_2\"",
        "Provenance</h2>",
    ];
    let places: Vec<usize> = order.iter().map(|text| page.find(text).unwrap()).collect();
    assert!(places.is_sorted(), "{places:?}");
    let table = scratch.read(&format!("{target}/norms.csv"));
    assert!(
        table.contains("\nsubject,column,unit,levels,")
            && table.contains("\nexact_1d_ouriemi_mixed,u_mixture_m_s,m/s,")
    );
}

fn inputs(found: &Value) -> Vec<(&str, &Value)> {
    let rows = found["inputs"].as_array().unwrap().iter();
    rows.map(|row| (row["path"].as_str().unwrap(), &row["values"])).collect()
}

#[test]
fn every_input_that_differs_is_named_with_its_values() {
    let scratch = Scratch::new();
    // Of one model every value of the case counts.
    let found = answer(&scratch, &["compare", TWO, MIXED, "--json", "--out", "one"]);
    let expected = [
        ("form", json!(["two-fluid", "mixed"])),
        ("closures.drag.law", json!(["carman-kozeny", "none"])),
        ("closures.drag.k_ck", json!([180.0, null])),
        ("closures.drag.phi_min", json!([0.0, null])),
    ];
    let found = inputs(&found);
    assert_eq!(found, expected.iter().map(|(path, values)| (*path, values)).collect::<Vec<_>>());
    // Of two models, the flow and the laws that both have, a run as well as a case.
    exits(&scratch, 0, &["run", "bed_ouriemi-laminar", "--set", "bed.thickness=14 mm", "--out", "run", "--quiet"]);
    let found = answer(&scratch, &["compare", TWO, "run", "--json", "--out", "two"]);
    let depths = found["inputs"].as_array().unwrap().iter().map(|row| row["path"].as_str().unwrap());
    assert_eq!(depths.collect::<Vec<_>>(), ["bed.thickness"]);
    let warned = found["warnings"].to_string();
    assert!(warned.contains("different amounts of sediment") && warned.contains("7.700 mm"), "{warned}");
    let page = scratch.read("two/report.html");
    assert!(page.contains("Inputs that differ</h2>") && page.contains("solid volume per area"));
    let (out, _) = exits(&scratch, 0, &["compare", TWO, "run", "--out", "two"]);
    assert!(out.contains("\n  flow             bed.thickness 0.01500 | 0.01400\n"), "{out}");
    let (out, _) = exits(&scratch, 0, &["compare", TWO, MIXED, "--out", "one", "--force"]);
    assert!(out.contains("\n  flow             the same in all\n"), "{out}");
    let with = "\n  solved with      form two-fluid | mixed; closures.drag.law carman-kozeny | none; ";
    assert!(out.contains(with), "{out}");
    // What is the same flow differs in nothing.
    let found = answer(&scratch, &["compare", TWO, "bed_ouriemi-laminar", "--json", "--out", "same"]);
    assert_eq!(inputs(&found), []);
}

#[test]
fn json_is_what_the_folder_holds_and_says_how_far_two_forms_are_apart() {
    let scratch = Scratch::new();
    let found = answer(&scratch, &["compare", TWO, MIXED, "--json", "--out", "c"]);
    let mut written: Value = serde_json::from_str(&scratch.read("c/compare.json")).unwrap();
    written["out"] = "c".into();
    assert_eq!(found, written);
    assert_eq!((found["status"].as_str(), found["reference"].as_str()), (Some("done"), Some(TWO)));
    let u = norm(&found, "u_mixture_m_s");
    let l2 = u["l2_relative"].as_f64().unwrap();
    assert!((1e-5..1e-3).contains(&l2), "the slip is small at d/H = 1/30: {l2}");
    assert_eq!(norm(&found, "phi")["linf"].as_f64(), Some(0.0), "nothing is interpolated across the bed level");
    let rate = found["numbers"].as_array().unwrap().iter().find(|n| n["name"] == "transport_rate_m2_s").unwrap();
    let share = rate["relative_differences"][1].as_f64().unwrap();
    let (a, b) = (rate["values"][0].as_f64().unwrap(), rate["values"][1].as_f64().unwrap());
    assert!((share - (b - a) / a).abs() < 1e-15 && (1e-4..1e-3).contains(&share), "{share}");
}

#[test]
fn a_run_and_its_own_case_differ_by_exactly_nothing() {
    let scratch = Scratch::new();
    exits(&scratch, 0, &["run", TWO, "--quiet"]);
    let run = "runs/bed_ouriemi-laminar-exact";
    for more in [&[][..], &["--align", "bed"], &["--scale"], &["--align", "none", "--scale"]] {
        let out = format!("c{}", more.join(""));
        let arguments = [&["compare", TWO, run, "--json", "--out", &out], more].concat();
        let found = answer(&scratch, &arguments);
        assert_eq!(found["subjects"][0]["name"], TWO);
        assert_eq!(found["subjects"][1]["name"], run);
        for row in found["norms"].as_array().unwrap() {
            assert_eq!(
                (&row["l2_relative"], &row["linf"], &row["bias"]),
                (&0.0.into(), &0.0.into(), &0.0.into()),
                "{row}"
            );
        }
        for row in found["numbers"].as_array().unwrap() {
            assert_eq!(row["relative_differences"][1], 0.0, "{row}");
        }
    }
}

#[test]
fn identical_comparisons_differ_only_in_cost_and_provenance_and_replace_each_other() {
    let scratch = Scratch::new();
    let found = [0, 1].map(|_| comparable(answer(&scratch, &["compare", TWO, MIXED, "--json", "--out", "c"])));
    assert_eq!(found[0], found[1]);
}

#[test]
fn measured_points_count_in_sigmas() {
    let scratch = Scratch::new();
    exits(&scratch, 0, &["run", TWO, "--quiet", "--out", "r"]);
    let table = scratch.read("r/profile.csv");
    let mut rows = table.lines().filter(|l| !l.starts_with('#')).map(|l| l.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let u = header.iter().position(|h| *h == "u_mixture_m_s").unwrap();
    // every tenth level, two sigmas beside the model, in reversed order
    let mut lines: Vec<String> =
        rows.step_by(10).map(|row| format!("{},{:?},0.001", row[0], row[u].parse::<f64>().unwrap() + 0.002)).collect();
    lines.reverse();
    let head = "# Two sigmas\n# made up\n# transport_rate_m2_s = 2e-5 ± 1e-6\nz_m,u_mixture_m_s,u_mixture_m_s_err\n";
    scratch.write("points.csv", format!("{head}{}\n", lines.join("\n")));
    let found = answer(&scratch, &["compare", TWO, "--data", "points.csv", "--json"]);
    assert_eq!(found["subjects"][1]["label"], "Two sigmas");
    let u = norm(&found, "u_mixture_m_s");
    assert_eq!((&u["levels"], &u["levels_with_errors"]), (&lines.len().into(), &lines.len().into()));
    assert_eq!(u["levels_of"], "Two sigmas");
    for (key, value) in [("rms_sigma", 2.0), ("bias", 0.002), ("linf", 0.002)] {
        assert!((u[key].as_f64().unwrap() / value - 1.0).abs() < 1e-9, "{key} = {}", u[key]);
    }
    assert_eq!(found["numbers"][0]["stderr"][1], 1e-6);
    let (out, _) = exits(&scratch, 0, &["compare", TWO, "--data", "points.csv"]);
    assert!(out.contains("2.00 sigma"), "{out}");
    // Nothing is claimed of the flow that the data are of.
    assert!(!out.contains("\n  flow "), "{out}");
    let (out, _) = exits(&scratch, 0, &["compare", TWO, MIXED, "--data", "points.csv"]);
    assert!(
        out.contains("the same in bed_ouriemi-laminar-exact and exact_1d_ouriemi_mixed; of the others it is not known"),
        "{out}"
    );
}

#[test]
fn wrong_input_exits_2_and_writes_nothing() {
    let scratch = Scratch::new();
    scratch.write("typo.csv", "z_m,u_mixture_ms\n0,1\n");
    scratch.write("nowhere.csv", "z_m,phi\n7,0.1\n8,0.1\n");
    scratch.write("bare.csv", "z_m,u_mixture_m_s\n0,0\n0.01,0.02\n");
    scratch.write("high.csv", "# flow_height_m = 0.03\nz_m,u_mixture_m_s\n0,0\n0.01,0.02\n");
    std::fs::create_dir(scratch.path("empty")).unwrap();
    let before = scratch.names(".");
    for (arguments, code, words) in [
        (&[][..], "too-few", "a comparison takes at least two, 0 given"),
        (&[TWO], "too-few", "1 given"),
        (&[TWO, "--data", "typo.csv"], "data-unknown-column", "did you mean u_mixture_m_s? columns are z_m, phi,"),
        (&[TWO, "--data", "missing.csv"], "data-unreadable", "missing.csv"),
        (&[TWO, "bare.csv"], "usage", "--data bare.csv"),
        (&[TWO, "empty"], "not-a-run", "empty is not a run"),
        (&[TWO, "--data", "nowhere.csv"], "nothing-shared", "common elevation"),
        (&[TWO, "--data", "bare.csv", "--align", "bed"], "no-number", "bare does not report bed_level_m"),
        (&[TWO, "--data", "bare.csv", "--scale"], "no-number", "# flow_height_m = ..."),
        (&[TWO, "--data", "high.csv", "--scale"], "no-scale", "high does not have mean_velocity_m_s, by which --scale"),
        (&[TWO, "exact_1d_ouriemi_mixd"], "", "exact_1d_ouriemi_mixed"),
        (&[TWO, "exact_1d_bagnold"], "different-kinds", "exact_1d_bagnold is a scene of the kind granular"),
    ] {
        let arguments = [&["compare"], arguments].concat();
        let (out, err) = exits(&scratch, 2, &arguments);
        assert!(out.is_empty() && err.contains(words), "{arguments:?}: {err}");
        let (out, _) = exits(&scratch, 2, &[&arguments[..], &["--json"]].concat());
        let found: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(found["status"], "failed");
        assert!(code.is_empty() || found["error"]["code"] == code, "{arguments:?}: {found:#}");
        assert_eq!(scratch.names("."), before, "{arguments:?}");
    }
}

#[test]
fn a_method_that_fails_exits_3_with_its_reason() {
    let scratch = Scratch::new();
    exits(&scratch, 0, &["new", MIXED, "steep.toml"]);
    let steep = scratch.read("steep.toml").replace("1471.5 Pa/m", "5000 Pa/m");
    scratch.write("steep.toml", steep);
    let (_, err) = exits(&scratch, 3, &["compare", MIXED, "steep.toml", "--out", "c"]);
    assert!(err.starts_with("failed: steep.toml: "), "{err}");
    let (out, _) = exits(&scratch, 3, &["compare", MIXED, "steep.toml", "--out", "c", "--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["status"], "failed");
    assert!(!scratch.path("c").exists());
    // its folder says failed, which is nothing to compare with
    exits(&scratch, 3, &["run", "steep.toml", "--out", "r", "--quiet"]);
    let (_, err) = exits(&scratch, 2, &["compare", MIXED, "r"]);
    assert!(err.contains("r is failed, not done"), "{err}");
}

#[test]
fn a_folder_that_is_not_this_comparison_is_refused() {
    let scratch = Scratch::new();
    exits(&scratch, 0, &["compare", TWO, MIXED, "--out", "c", "--quiet"]);
    let other = ["compare", MIXED, TWO, "--out", "c", "--quiet"];
    let (_, err) = exits(&scratch, 2, &other);
    assert!(err.contains("holds another comparison: bed_ouriemi-laminar-exact, exact_1d_ouriemi_mixed"), "{err}");
    exits(&scratch, 2, &["compare", TWO, MIXED, "--out", "c", "--align", "bed"]);
    exits(&scratch, 0, &[&other[..], &["--force"]].concat());
    // runs and comparisons do not replace each other, even by force
    exits(&scratch, 0, &["run", TWO, "--out", "r", "--quiet"]);
    let (_, err) = exits(&scratch, 2, &["compare", TWO, MIXED, "--out", "r", "--force"]);
    assert!(err.contains("r holds a run, not a comparison"), "{err}");
    let (_, err) = exits(&scratch, 2, &["run", TWO, "--out", "c", "--force"]);
    assert!(err.contains("c holds a comparison, not a run"), "{err}");
    assert_eq!(scratch.names("r").len(), 6);
    // what is not ours stays
    scratch.write("c/notes.txt", "mine");
    let (_, err) = exits(&scratch, 2, &[&other[..], &["--force"]].concat());
    assert!(err.contains("it holds notes.txt"), "{err}");
    std::fs::create_dir(scratch.path("foreign")).unwrap();
    scratch.write("foreign/compare.json", "{}");
    exits(&scratch, 2, &["compare", TWO, MIXED, "--out", "foreign", "--force"]);
    assert_eq!(scratch.read("foreign/compare.json"), "{}");
}

#[test]
fn the_work_of_a_comparison_is_that_of_its_runs() {
    let scratch = Scratch::new();
    let work = |args: &[&str]| answer(&scratch, &[args, &["--json"]].concat())["cost"]["work_units"].as_f64().unwrap();
    let runs = work(&["run", TWO, "--out", "a"]) + work(&["run", MIXED, "--out", "b"]);
    assert!(runs > 0.0);
    assert_eq!(work(&["compare", TWO, MIXED, "--out", "c"]), runs);
}

#[test]
fn nothing_from_data_becomes_markup() {
    let scratch = Scratch::new();
    let text = "# </title><script>alert(1)</script>\nz_m,u_mixture_m_s\n0,0\n0.01,0.02\n";
    scratch.write("x.csv", text);
    exits(&scratch, 0, &["compare", TWO, "--data", "x.csv", "--out", "c", "--quiet"]);
    let page = scratch.read("c/report.html");
    assert!(page.matches("<script").count() == 1 && page.contains("&lt;script&gt;alert(1)"));
    assert!(!page.contains("<script>alert"));
}

#[test]
fn one_case_of_several_models_is_refused_with_their_names() {
    let scratch = Scratch::new();
    let found = scratch.bedload(["compare", "bed_ouriemi", "--json"]).exits(2).json();
    assert_eq!(found["error"]["code"], "too-few");
    assert_eq!(found["error"]["hint"], "add --model laminar-exact --model laminar --model duct-bed");
}

#[test]
fn a_broken_premise_comes_first_and_what_has_no_profile_says_why() {
    let scratch = Scratch::new();
    let two = ["compare", "sheet_1d_type_b", "sheet_1d_type_a", "--out", "c", "--force", "--set"];
    let (out, _) = exits(&scratch, 0, &[&two[..], &["flow.shields=0.23"]].concat());
    assert!(out.starts_with("broken premise of sheet_1d_type_b: the bed moves as a sheet: "), "{out}");
    let (_, error) = exits(&scratch, 2, &[&two[..], &["flow.shields=0.13"]].concat());
    assert!(error.contains("sheet_1d_type_b has no profile: no layer of grains moves: "), "{error}");
}

#[test]
fn between_planes_the_section_carries_what_the_closed_form_does() {
    let scratch = Scratch::new();
    let models = ["--model", "laminar-exact", "--model", "duct-bed"];
    let found = answer(&scratch, &[&["compare", "bed_ouriemi"], &models[..], &["--json", "--out", "c"]].concat());
    for name in ["transport_rate_m2_s", "transport_rate_kg_m_s", "transport_rate_dimensionless"] {
        let row = found["numbers"].as_array().unwrap().iter().find(|n| n["name"] == name);
        let row = row.unwrap_or_else(|| panic!("{name}: {}", found["numbers"]));
        let apart = row["relative_differences"][1].as_f64().unwrap();
        assert!(apart.abs() < 1e-5, "{name}: {apart}");
    }
}
