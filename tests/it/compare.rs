//! `bedload compare` as a person runs it: what it writes, what it refuses, with which code.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

const TWO: &str = "exact_1d_ouriemi";
const MIXED: &str = "exact_1d_ouriemi_mixed";

fn bedload(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_bedload"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[track_caller]
fn exits(folder: &TempDir, code: i32, arguments: &[&str]) -> (String, String) {
    let output = bedload(folder, arguments);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{arguments:?}\nstdout: {out}\nstderr: {err}");
    (out, err)
}

#[track_caller]
fn answer(folder: &TempDir, arguments: &[&str]) -> Value {
    serde_json::from_str(&exits(folder, 0, arguments).0).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn norm<'a>(answer: &'a Value, column: &str) -> &'a Value {
    answer["norms"].as_array().unwrap().iter().find(|n| n["column"] == column).unwrap()
}

#[test]
fn two_cases_give_a_folder_and_at_most_twelve_lines() {
    let folder = TempDir::new().unwrap();
    let (out, err) = exits(&folder, 0, &["compare", TWO, MIXED, "--png"]);
    assert!((4..=12).contains(&out.lines().count()) && err.is_empty(), "{out}{err}");
    assert!(out.starts_with("exact_1d_ouriemi is the reference"), "{out}");
    let target = folder.path().join("runs/compare-exact_1d_ouriemi-exact_1d_ouriemi_mixed");
    assert_eq!(names(&target), ["compare.json", "figures", "norms.csv", "report.html"]);
    assert!(names(&target.join("figures")).contains(&"profiles.png".into()));
    assert_eq!(names(&folder.path().join("runs")).len(), 1, "nothing is left beside it");
    let page = fs::read_to_string(target.join("report.html")).unwrap();
    let order =
        ["<h1>exact_1d_ouriemi against", "Profiles</h2>", "Numbers</h2>", "<svg class=\"plot\"", "Provenance</h2>"];
    let places: Vec<usize> = order.iter().map(|text| page.find(text).unwrap()).collect();
    assert!(places.is_sorted(), "{places:?}");
    let table = fs::read_to_string(target.join("norms.csv")).unwrap();
    assert!(
        table.contains("\nsubject,column,unit,levels,")
            && table.contains("\nexact_1d_ouriemi_mixed,u_mixture_m_s,m/s,")
    );
}

#[test]
fn json_is_what_the_folder_holds_and_says_how_far_two_forms_are_apart() {
    let folder = TempDir::new().unwrap();
    let found = answer(&folder, &["compare", TWO, MIXED, "--json", "--out", "c"]);
    let mut written: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("c/compare.json")).unwrap()).unwrap();
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
    let folder = TempDir::new().unwrap();
    exits(&folder, 0, &["run", TWO, "--quiet"]);
    let run = "runs/exact_1d_ouriemi";
    for more in [&[][..], &["--align", "bed"], &["--scale"], &["--align", "none", "--scale"]] {
        let out = format!("c{}", more.join(""));
        let arguments = [&["compare", TWO, run, "--json", "--out", &out], more].concat();
        let found = answer(&folder, &arguments);
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
    let folder = TempDir::new().unwrap();
    let mut found: Vec<Value> =
        (0..2).map(|_| answer(&folder, &["compare", TWO, MIXED, "--json", "--out", "c"])).collect();
    for value in &mut found {
        value.as_object_mut().unwrap().remove("cost").unwrap();
        value.as_object_mut().unwrap().remove("provenance").unwrap();
    }
    assert_eq!(found[0], found[1]);
}

#[test]
fn measured_points_count_in_sigmas() {
    let folder = TempDir::new().unwrap();
    exits(&folder, 0, &["run", TWO, "--quiet", "--out", "r"]);
    let table = fs::read_to_string(folder.path().join("r/profile.csv")).unwrap();
    let mut rows = table.lines().filter(|l| !l.starts_with('#')).map(|l| l.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let u = header.iter().position(|h| *h == "u_mixture_m_s").unwrap();
    // every tenth level, two sigmas beside the model, in reversed order
    let mut lines: Vec<String> =
        rows.step_by(10).map(|row| format!("{},{:?},0.001", row[0], row[u].parse::<f64>().unwrap() + 0.002)).collect();
    lines.reverse();
    let head = "# Two sigmas\n# made up\n# transport_rate_m2_s = 2e-5 ± 1e-6\nz_m,u_mixture_m_s,u_mixture_m_s_err\n";
    fs::write(folder.path().join("points.csv"), format!("{head}{}\n", lines.join("\n"))).unwrap();
    let found = answer(&folder, &["compare", TWO, "--data", "points.csv", "--json"]);
    assert_eq!(found["subjects"][1]["label"], "Two sigmas");
    let u = norm(&found, "u_mixture_m_s");
    assert_eq!((&u["levels"], &u["levels_with_errors"]), (&lines.len().into(), &lines.len().into()));
    assert_eq!(u["levels_of"], "Two sigmas");
    for (key, value) in [("rms_sigma", 2.0), ("bias", 0.002), ("linf", 0.002)] {
        assert!((u[key].as_f64().unwrap() / value - 1.0).abs() < 1e-9, "{key} = {}", u[key]);
    }
    assert_eq!(found["numbers"][0]["stderr"][1], 1e-6);
    let (out, _) = exits(&folder, 0, &["compare", TWO, "--data", "points.csv"]);
    assert!(out.contains("2.00 sigma"), "{out}");
}

#[test]
fn wrong_input_exits_2_and_writes_nothing() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("typo.csv", "z_m,u_mixture_ms\n0,1\n");
    write("nowhere.csv", "z_m,phi\n7,0.1\n8,0.1\n");
    write("bare.csv", "z_m,u_mixture_m_s\n0,0\n0.01,0.02\n");
    write("high.csv", "# flow_height_m = 0.03\nz_m,u_mixture_m_s\n0,0\n0.01,0.02\n");
    fs::create_dir(folder.path().join("empty")).unwrap();
    let before = names(folder.path());
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
        (&[TWO, "exact_1d_ouriemie"], "", "exact_1d_ouriemi"),
    ] {
        let arguments = [&["compare"], arguments].concat();
        let (out, err) = exits(&folder, 2, &arguments);
        assert!(out.is_empty() && err.contains(words), "{arguments:?}: {err}");
        let (out, _) = exits(&folder, 2, &[&arguments[..], &["--json"]].concat());
        let found: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(found["status"], "failed");
        assert!(code.is_empty() || found["error"]["code"] == code, "{arguments:?}: {found:#}");
        let after: Vec<String> = names(folder.path()).into_iter().filter(|n| n != "runs").collect();
        assert_eq!(after, before, "{arguments:?}");
        assert!(!folder.path().join("runs").exists() || names(&folder.path().join("runs")).is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_method_that_fails_exits_3_with_its_reason() {
    let folder = TempDir::new().unwrap();
    exits(&folder, 0, &["new", MIXED, "steep.toml"]);
    let file = folder.path().join("steep.toml");
    let text = fs::read_to_string(&file).unwrap().replace("1471.5 Pa/m", "5000 Pa/m");
    fs::write(&file, text).unwrap();
    let (_, err) = exits(&folder, 3, &["compare", MIXED, "steep.toml", "--out", "c"]);
    assert!(err.starts_with("failed: steep.toml: "), "{err}");
    let (out, _) = exits(&folder, 3, &["compare", MIXED, "steep.toml", "--out", "c", "--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["status"], "failed");
    assert!(!folder.path().join("c").exists());
    // its folder says failed, which is nothing to compare with
    exits(&folder, 3, &["run", "steep.toml", "--out", "r", "--quiet"]);
    let (_, err) = exits(&folder, 2, &["compare", MIXED, "r"]);
    assert!(err.contains("r is failed, not done"), "{err}");
}

#[test]
fn a_folder_that_is_not_this_comparison_is_refused() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    exits(&folder, 0, &["compare", TWO, MIXED, "--out", "c", "--quiet"]);
    let other = ["compare", MIXED, TWO, "--out", "c", "--quiet"];
    let (_, err) = exits(&folder, 2, &other);
    assert!(err.contains("holds another comparison: exact_1d_ouriemi, exact_1d_ouriemi_mixed"), "{err}");
    exits(&folder, 2, &["compare", TWO, MIXED, "--out", "c", "--align", "bed"]);
    exits(&folder, 0, &[&other[..], &["--force"]].concat());
    // runs and comparisons do not replace each other, even by force
    exits(&folder, 0, &["run", TWO, "--out", "r", "--quiet"]);
    let (_, err) = exits(&folder, 2, &["compare", TWO, MIXED, "--out", "r", "--force"]);
    assert!(err.contains("r holds a run, not a comparison"), "{err}");
    let (_, err) = exits(&folder, 2, &["run", TWO, "--out", "c", "--force"]);
    assert!(err.contains("c holds a comparison, not a run"), "{err}");
    assert_eq!(names(&path("r")).len(), 5);
    // what is not ours stays
    fs::write(path("c/notes.txt"), "mine").unwrap();
    let (_, err) = exits(&folder, 2, &[&other[..], &["--force"]].concat());
    assert!(err.contains("it holds notes.txt"), "{err}");
    fs::create_dir(path("foreign")).unwrap();
    fs::write(path("foreign/compare.json"), "{}").unwrap();
    exits(&folder, 2, &["compare", TWO, MIXED, "--out", "foreign", "--force"]);
    assert_eq!(fs::read_to_string(path("foreign/compare.json")).unwrap(), "{}");
}

#[test]
fn nothing_from_data_becomes_markup() {
    let folder = TempDir::new().unwrap();
    let text = "# </title><script>alert(1)</script>\nz_m,u_mixture_m_s\n0,0\n0.01,0.02\n";
    fs::write(folder.path().join("x.csv"), text).unwrap();
    exits(&folder, 0, &["compare", TWO, "--data", "x.csv", "--out", "c", "--quiet"]);
    let page = fs::read_to_string(folder.path().join("c/report.html")).unwrap();
    assert!(!page.contains("<script") && page.contains("&lt;script&gt;"));
}
