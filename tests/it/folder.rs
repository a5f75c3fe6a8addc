//! The output folder: what a run writes, what may replace it, and that nothing of anyone is lost.

use std::fs;

use serde_json::{Value, json};

use crate::support::{Scratch, comparable};

const CASE: &str = "exact_1d_aussillous";
const OTHER: &str = "grid.cells=50";

fn run(scratch: &Scratch, more: &[&str]) -> crate::support::Answer {
    scratch.bedload(["run", CASE, "--out", "out"].iter().chain(more))
}

/// The lines of a table below its provenance.
fn table(scratch: &Scratch, file: &str) -> String {
    scratch.read(file).lines().filter(|l| !l.starts_with('#')).map(|l| format!("{l}\n")).collect()
}

fn set_status(scratch: &Scratch, status: &str) {
    let mut summary = scratch.summary("out");
    summary["status"] = status.into();
    scratch.write("out/summary.json", summary.to_string());
}

#[test]
fn a_new_folder_holds_the_contract() {
    let scratch = Scratch::new();
    let out = "deep/er/out";
    scratch.bedload(["run", CASE, "--out", out, "--png"]).exits(0);
    assert_eq!(scratch.names(out), ["case.toml", "figures", "page.json", "profile.csv", "report.html", "summary.json"]);
    let summary = scratch.summary(out);
    let keys: Vec<&str> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    let wanted = "format status case model scene results balances regime validity regularisation cost provenance";
    assert_eq!(keys.join(" "), wanted);
    assert_eq!((&summary["format"], &summary["status"], &summary["case"]), (&json!(1), &json!("done"), &json!(CASE)));
    for name in
        ["shields", "u_star_m_s", "transport_rate_m2_s", "transport_rate_dimensionless", "phi_interface", "bed_level_m"]
    {
        assert!(summary["results"][name]["value"].is_f64(), "{name}: {}", summary["results"]);
    }
    let csv = scratch.read(&format!("{out}/profile.csv"));
    assert!(csv.starts_with("# bedload "), "{csv}");
    let mut rows = csv.lines().skip_while(|l| l.starts_with('#'));
    let header: Vec<&str> = rows.next().unwrap().split(',').collect();
    assert!(header.starts_with(&["z_m", "phi", "u_particle_m_s"]), "{header:?}");
    let z: Vec<f64> = rows.map(|row| row.split(',').next().unwrap().parse().unwrap()).collect();
    assert!(z.len() >= 200 && z.windows(2).all(|pair| pair[0] < pair[1]), "z is not ascending");
    assert!(!csv.contains("NaN") && !csv.contains("inf"));
    let png = fs::read(scratch.path(&format!("{out}/figures/profiles.png"))).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.ends_with(b"IEND\xaeB`\x82"));
}

#[test]
fn an_empty_folder_is_used_and_the_default_is_runs() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("out")).unwrap();
    run(&scratch, &[]).exits(0);
    scratch.bedload(["run", CASE]).exits(0);
    assert_eq!(scratch.names("runs"), [CASE]);
    let same = comparable(scratch.summary("out")) == comparable(scratch.summary(&format!("runs/{CASE}")));
    assert!(same, "the folder changes the result");
}

#[test]
fn the_same_command_again_gives_the_same_result() {
    for case in
        ["exact_1d_aussillous", "bed_ouriemi-laminar-exact", "exact_1d_bingham", "exact_1d_bagnold", "exact_1d_loglaw"]
    {
        let scratch = Scratch::new();
        let files = || {
            let all = scratch.names("out").into_iter().filter(|n| n.ends_with(".csv"));
            all.map(|name| table(&scratch, &format!("out/{name}"))).collect::<Vec<_>>()
        };
        scratch.bedload(["run", case, "--out", "out"]).exits(0);
        let first = (comparable(scratch.summary("out")), files(), scratch.read("out/case.toml"), scratch.names("out"));
        scratch.bedload(["run", case, "--out", "out"]).exits(0);
        let second = (comparable(scratch.summary("out")), files(), scratch.read("out/case.toml"), scratch.names("out"));
        assert!(first == second, "{case} differs");
        assert_eq!(scratch.names("."), ["out"], "{case} left something beside");
    }
}

#[test]
fn the_resolved_case_gives_the_same_result() {
    let scratch = Scratch::new();
    run(&scratch, &["--set", "flow.pressure_gradient=90 Pa/m"]).exits(0);
    fs::rename(scratch.path("out"), scratch.path("first")).unwrap();
    scratch.bedload(["run", "first/case.toml", "--out", "second"]).exits(0);
    let mut first = comparable(scratch.summary("first"));
    first["case"] = "case".into();
    assert_eq!(comparable(scratch.summary("second")), first);
    assert_eq!(table(&scratch, "second/profile.csv"), table(&scratch, "first/profile.csv"));
    assert_eq!(scratch.read("second/case.toml"), scratch.read("first/case.toml"));
}

#[test]
fn other_values_do_not_replace_a_run_unless_forced() {
    let scratch = Scratch::new();
    run(&scratch, &[]).exits(0);
    let before = scratch.snapshot("out");
    let reported = run(&scratch, &["--set", OTHER]).exits(2);
    assert!(reported.err.contains("holds a run of exact_1d_aussillous with other values"), "{}", reported.err);
    assert!(reported.err.contains("--force") && reported.out.is_empty());
    let reported = scratch.bedload(["run", "exact_1d_bagnold", "--out", "out", "--resume", "--json"]).exits(2);
    assert_eq!(reported.json()["error"]["code"], "other-case");
    assert!(scratch.snapshot("out") == before, "a refused run touched the old one");
    run(&scratch, &["--set", OTHER, "--force"]).exits(0);
    assert!(scratch.read("out/case.toml").contains("cells = 50"));
    assert_eq!(scratch.names("."), ["out"]);
}

/// Something that a user does to a run folder.
type Change = fn(&Scratch);

#[test]
fn what_bedload_did_not_write_is_never_replaced() {
    let prepare: [(&str, Change); 7] = [
        ("notes.txt", |s| s.write("out/notes.txt", "mine")),
        ("figures/notes.txt", |s| {
            fs::create_dir_all(s.path("out/figures")).unwrap();
            s.write("out/figures/notes.txt", "mine");
        }),
        ("data", |s| fs::create_dir(s.path("out/data")).unwrap()),
        ("no summary.json", |s| fs::remove_file(s.path("out/summary.json")).unwrap()),
        ("a summary.json of something else", |s| s.write("out/summary.json", "{\"format\": 1}")),
        ("a summary.json of something else", |s| s.write("out/summary.json", "not JSON")),
        ("profile.csv", |s| {
            fs::remove_file(s.path("out/profile.csv")).unwrap();
            fs::create_dir(s.path("out/profile.csv")).unwrap();
            s.write("out/profile.csv/mine", "mine");
        }),
    ];
    for (entry, prepare) in prepare {
        let scratch = Scratch::new();
        run(&scratch, &[]).exits(0);
        prepare(&scratch);
        let before = scratch.snapshot("out");
        for flags in [&[] as &[&str], &["--force"], &["--resume"], &["--force", "--set", OTHER]] {
            let reported = run(&scratch, flags).exits(2).err;
            assert!(reported.contains("was not written by bedload") && reported.contains(entry), "{entry}: {reported}");
            assert!(scratch.snapshot("out") == before, "{entry} {flags:?} touched the folder");
        }
        assert_eq!(scratch.names("."), ["out"], "{entry}");
    }
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("home")).unwrap();
    scratch.write("home/thesis.tex", "mine");
    let json = scratch.bedload(["run", CASE, "--out", "home", "--force", "--json"]).exits(2).json();
    assert_eq!(json["error"]["code"], "foreign-folder");
    assert_eq!(scratch.names("home"), ["thesis.tex"]);
}

#[test]
fn an_unfinished_run_waits_for_a_decision() {
    for status in ["running", "stopped", "failed"] {
        for decision in ["--resume", "--force"] {
            let scratch = Scratch::new();
            run(&scratch, &[]).exits(0);
            set_status(&scratch, status);
            let before = scratch.snapshot("out");
            let reported = run(&scratch, &[]).exits(2).err;
            assert!(
                reported.contains("unfinished") && reported.contains("--resume") && reported.contains("--force"),
                "{reported}"
            );
            assert!(scratch.snapshot("out") == before);
            run(&scratch, &["--set", OTHER, "--resume"]).exits(2);
            run(&scratch, &[decision]).exits(0);
            assert_eq!(scratch.summary("out")["status"], "done");
        }
    }
}

#[test]
fn a_failed_run_says_why_with_numbers_and_without_nan() {
    let scratch = Scratch::new();
    let steep = "flow.pressure_gradient=200 Pa/m";
    let answer = run(&scratch, &["--set", steep, "--json"]).exits(3);
    let mut json = answer.json();
    assert_eq!(json.as_object_mut().unwrap().remove("out"), Some(Value::from("out")));
    assert_eq!(json, scratch.summary("out"));
    assert_eq!((&json["status"], &json["error"]["code"]), (&json!("failed"), &json!("whole-bed-moves")));
    assert!(json["error"]["message"].as_str().unwrap().contains("0.083414 m deep where the bed is 0.032240 m"));
    assert!(json["error"]["hint"].as_str().unwrap().contains("158.66"));
    for (file, content) in scratch.snapshot("out") {
        let text = String::from_utf8(content).unwrap();
        let found = text.split(|c: char| !c.is_alphanumeric()).find(|w| w.eq_ignore_ascii_case("nan") || *w == "inf");
        assert_eq!(found, None, "{}", file.display());
    }
    let reported = run(&scratch, &["--set", steep]).exits(2).err;
    assert!(reported.contains("unfinished"), "{reported}");
    let reported = run(&scratch, &["--set", steep, "--force"]).exits(3);
    assert!(reported.err.starts_with("failed: the whole bed moves") && reported.out.is_empty(), "{}", reported.err);
    // The limit of the hint is sharp.
    run(&scratch, &["--set", "flow.pressure_gradient=158.66 Pa/m", "--force"]).exits(0);
    run(&scratch, &["--set", "flow.pressure_gradient=158.67 Pa/m", "--force"]).exits(3);
}

#[test]
fn a_wanted_shields_number_out_of_reach_fails() {
    let scratch = Scratch::new();
    let shields = ["--set", "flow.pressure_gradient=", "--set"];
    let json = run(&scratch, &[&shields[..], &["flow.shields=50", "--json"]].concat()).exits(3).json();
    assert_eq!(json["error"]["code"], "out-of-reach");
    assert!(json["results"].as_object().unwrap().is_empty());
    let json = run(&scratch, &[&shields[..], &["flow.shields=0.5", "--json", "--force"]].concat()).exits(0).json();
    let shields = json["results"]["shields"]["value"].as_f64().unwrap();
    assert!((shields - 0.5).abs() < 1e-12, "{shields}");
}
