//! `report` redraws what `run` drew, from the tables alone; `validate` holds the cases to what they claim.

use std::fs;

use bedload::case::shipped;

use crate::support::Scratch;

#[test]
fn a_redrawn_report_is_the_same_file() {
    let scratch = Scratch::new();
    let steep = ["exact_1d_aussillous", "--set", "flow.pressure_gradient=200 Pa/m"];
    let runs = shipped::quick().map(|name| (vec![name], 0)).chain([(steep.to_vec(), 3)]);
    for (arguments, code) in runs {
        let run = ["run", "--out", "out", "--force"].iter().chain(&arguments);
        scratch.bedload(run).exits(code);
        let written = scratch.read("out/report.html");
        fs::remove_file(scratch.path("out/report.html")).unwrap();
        let said = scratch.bedload(["report", "out"]).exits(0).out;
        assert_eq!(said, "out/report.html\n");
        assert!(scratch.read("out/report.html") == written, "{arguments:?}: the report differs");
        let drawn = code == 0 && !["impact", "trial"].iter().any(|few| arguments[0].starts_with(few));
        assert!(written.contains("<svg") == drawn && written.trim_end().ends_with("</html>"));
        assert!(!written.contains("src=\"http") && !written.contains("<script src"), "not self-contained");
    }
}

#[test]
fn a_report_draws_figures_on_demand_from_the_tables_alone() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "out"]).exits(0);
    fs::rename(scratch.path("out"), scratch.path("moved")).unwrap();
    let json = scratch.bedload(["report", "moved", "--png", "--json"]).exits(0).json();
    let files: Vec<&str> = json["files"].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
    assert!(files.len() > 1 && files[0] == "moved/report.html", "{files:?}");
    for file in &files[1..] {
        assert!(fs::read(scratch.path(file)).unwrap().starts_with(b"\x89PNG"), "{file}");
    }
    // With figures it is still a run of ours, which the same command replaces.
    scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "moved"]).exits(0);
}

#[test]
fn a_folder_that_is_no_run_is_refused() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("empty")).unwrap();
    scratch.write("file", "");
    scratch.bedload(["run", "exact_1d_bagnold", "--out", "out"]).exits(0);
    for (spoilt, content) in [("summary.json", "{}"), ("case.toml", "format = 2\n"), ("profile.csv", "z_m,u\n1,2\n")] {
        scratch.bedload(["run", "exact_1d_bagnold", "--out", spoilt]).exits(0);
        scratch.write(&format!("{spoilt}/{spoilt}"), content);
    }
    for (folder, reason) in [
        ("empty", "summary.json"),
        ("file", "summary.json"),
        ("missing", "summary.json"),
        ("summary.json", "summary.json"),
        ("case.toml", "case.toml"),
        ("profile.csv", "profile.csv"),
    ] {
        let before = scratch.names(".");
        let said = scratch.bedload(["report", folder]).exits(2).err;
        assert!(said.contains("is not a run of bedload") && said.contains(reason), "{folder}: {said}");
        let json = scratch.bedload(["report", folder, "--json"]).exits(2).json();
        assert_eq!(json["error"]["code"], "not-a-run");
        assert_eq!(scratch.names("."), before);
    }
}

/// The film with one more check row.
fn film_with(kind: &str, quantity: &str, expect: &str) -> String {
    let case = shipped::find("exact_1d_bagnold").unwrap().content;
    format!(
        "{case}\n[[bagnold-film.check]]\nquantity = \"{quantity}\"\nexpect = {expect}\ntolerance = \"1 %\"\nkind = \"{kind}\"\nsource = \"a | b\"\n"
    )
}

#[test]
fn the_shipped_cases_hold_what_they_claim() {
    let scratch = Scratch::new();
    let json = scratch.bedload(["validate", "--quick", "--json"]).exits(0).json();
    assert_eq!((&json["status"], &json["red"]), (&"done".into(), &0.into()));
    let rows = json["rows"].as_array().unwrap();
    for case in shipped::quick() {
        assert!(rows.iter().any(|row| row["case"] == case), "{case} claims nothing");
    }
    let said = scratch.bedload(["validate"]).exits(0).out;
    let findings = rows.iter().filter(|row| row["kind"] == "finding").count();
    assert!(said.ends_with(&format!("{} pass, 0 fail, {findings} shown\n", rows.len() - findings)), "{said}");
    assert!(scratch.names(".").is_empty(), "the quick tier writes no table");
    let full = ["validate", "--full", "--out", "deep/table.md"];
    scratch.bedload(full.into_iter().chain(shipped::quick())).exits(0);
    let table = scratch.read("deep/table.md");
    let of_a_case = |line: &&str| shipped::names().any(|name| line.starts_with(&format!("| {name} |")));
    assert_eq!(table.lines().filter(of_a_case).count(), rows.len());
}

#[test]
fn a_red_row_exits_3_and_a_finding_is_never_red() {
    let scratch = Scratch::new();
    scratch.write("red.toml", film_with("validation", "inertial_number", "0.1"));
    let said = scratch.bedload(["validate", "red.toml"]).exits(3);
    assert!(said.out.contains("FAIL") && said.out.contains("4 pass, 1 fail"), "{}", said.out);
    assert_eq!(said.err, "1 rows are red\n");
    let json = scratch.bedload(["validate", "red.toml", "exact_1d_bagnold", "--json"]).exits(3).json();
    assert_eq!((&json["status"], &json["red"]), (&"failed".into(), &1.into()));
    assert_eq!(json["rows"].as_array().unwrap().len(), 9);

    scratch.write("finding.toml", film_with("finding", "inertial_number", "0.1"));
    let said = scratch.bedload(["validate", "finding.toml", "--out", "table.md"]).exits(0).out;
    assert!(said.contains("shown") && said.contains("4 pass, 0 fail, 1 shown"), "{said}");
    let table = scratch.read("table.md");
    assert!(table.contains("| finding |") && table.contains("a \\| b"), "{table}");

    // Within the tolerance, a row that is not reported, and a method that fails.
    scratch.write("near.toml", film_with("validation", "inertial_number", "0.0935"));
    scratch.bedload(["validate", "near.toml"]).exits(0);
    scratch.write("absent.toml", film_with("validation", "shields", "0.1"));
    assert!(scratch.bedload(["validate", "absent.toml"]).exits(3).out.contains("not reported"));
    scratch.write("steep.toml", film_with("validation", "inertial_number", "0.1").replace("24 deg", "60 deg"));
    let said = scratch.bedload(["validate", "steep.toml"]).exits(3).out;
    assert!(said.contains("0 pass, 5 fail") && said.contains("no steady film"), "{said}");
    scratch.bedload(["validate", "nowhere"]).exits(2);
}

#[test]
fn a_full_row_waits_for_the_full_tier() {
    let scratch = Scratch::new();
    scratch.write("full.toml", film_with("validation", "inertial_number", "0.1") + "tier = \"full\"\n");
    scratch.bedload(["validate", "full.toml"]).exits(0);
    scratch.bedload(["validate", "full.toml", "--full", "--out", "t.md"]).exits(3);
}
