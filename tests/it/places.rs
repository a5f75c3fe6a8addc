//! Where outputs go: a path is resolved before it is checked, and nothing that a person put anywhere is lost.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::Scratch;

const CASE: &str = "exact_1d_bagnold";
/// Every verb that writes a folder, with the least that it asks for.
const FOLDERS: [&[&str]; 7] = [
    &["run", CASE],
    &["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed"],
    &["sweep", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60,90 Pa/m"],
    &["chart", CASE],
    &["converge", "bed_ouriemi-laminar", "--over", "mesh"],
    &["stability", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60:90:2"],
    &["calibrate", CASE, "--to", "data.csv", "--fit", "mu_2"],
];
/// Takes long enough to be met on its way.
const LONG: [&str; 5] = ["run", "bed_ouriemi-laminar-exact", "--set", "grid.cells=1000000", "--quiet"];

/// A folder with what the verbs need, and with files of a person in `precious`.
fn scratch() -> Scratch {
    let scratch = Scratch::new();
    scratch.bedload(["run", CASE, "--out", "data", "--quiet"]).exits(0);
    fs::rename(scratch.path("data/profile.csv"), scratch.path("data.csv")).unwrap();
    fs::remove_dir_all(scratch.path("data")).unwrap();
    fs::create_dir_all(scratch.path("precious/figures")).unwrap();
    for file in ["case.toml", "report.html", "thesis.tex", "figures/photo.png"] {
        scratch.write(&format!("precious/{file}"), "mine");
    }
    scratch
}

#[track_caller]
fn refused(scratch: &Scratch, arguments: &[&str], code: &str) {
    let before = (scratch.snapshot("."), scratch.names("."));
    let answer = scratch.bedload(arguments.iter().chain(&["--json"])).exits(2).json();
    assert_eq!(answer["error"]["code"], code, "{arguments:?}: {answer}");
    assert!((scratch.snapshot("."), scratch.names(".")) == before, "{arguments:?} left a trace");
}

#[test]
fn a_way_over_a_folder_that_is_not_there_leads_where_it_leads() {
    let scratch = scratch();
    fs::create_dir_all(scratch.path("deep/er")).unwrap();
    symlink("deep/er", scratch.path("link")).unwrap();
    symlink("precious", scratch.path("alias")).unwrap();
    for verb in FOLDERS {
        for out in
            ["new/../precious", "new/er/../../precious/.", "link/../../precious", "alias", "link/no/../../../alias"]
        {
            refused(&scratch, &[verb, &["--out", out]].concat(), "foreign-folder");
            refused(&scratch, &[verb, &["--out", out, "--force"]].concat(), "foreign-folder");
        }
        for out in ["data.csv/..", "data.csv/x", "data.csv/../precious"] {
            refused(&scratch, &[verb, &["--out", out]].concat(), "unwritable");
        }
        scratch.bedload([verb, &["--out", "new/../link/../out", "--quiet"]].concat()).exits(0);
        assert!(scratch.path("deep/out/report.html").exists() && !scratch.path("new").exists(), "{verb:?}");
        fs::remove_dir_all(scratch.path("deep/out")).unwrap();
    }
    // What cannot be written takes nothing along that was there before.
    fs::create_dir(scratch.path("mine")).unwrap();
    let before = scratch.snapshot(".");
    for out in ["new/../mine", "new/../mine/below", "mine/far/below"] {
        let reported = scratch.shell(&format!("trap '' XFSZ; ulimit -f 0; exec \"$BEDLOAD\" run {CASE} --out {out}"));
        assert_eq!(reported.code, 1, "{}", reported.err);
        assert!(scratch.snapshot(".") == before && scratch.names("mine").is_empty(), "{out}");
        assert!(!scratch.path("new").exists());
    }
}

#[test]
fn a_case_that_is_called_like_a_way_up_stays_below_runs() {
    let scratch = Scratch::new();
    fs::create_dir_all(scratch.path("cases")).unwrap();
    fs::create_dir_all(scratch.path("work/empty")).unwrap();
    let text = bedload::case::shipped::find(CASE).unwrap().content;
    for name in ["...toml", "..toml"] {
        scratch.write(&format!("cases/{name}"), text);
        for folder in ["work", "work/empty"] {
            let case = scratch.path(&format!("cases/{name}"));
            let mut command = scratch.command();
            command.current_dir(scratch.path(folder)).arg("run").arg(&case).stdout(Stdio::null());
            assert!(command.status().unwrap().success(), "{name} in {folder}");
            assert_eq!(scratch.names(&format!("{folder}/runs")), ["case"], "{name} in {folder}");
            fs::remove_dir_all(scratch.path(&format!("{folder}/runs"))).unwrap();
            assert!(scratch.names("work/empty").is_empty() && scratch.names("work") == ["empty"], "{name} in {folder}");
        }
    }
}

fn start(scratch: &Scratch, arguments: &[&str]) -> Child {
    scratch.command().args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

#[track_caller]
fn wait_for(scratch: &Scratch, file: &str) {
    let begin = Instant::now();
    while !scratch.path(file).exists() {
        assert!(begin.elapsed() < Duration::from_secs(60), "{file} does not appear");
        sleep(Duration::from_millis(1));
    }
}

#[test]
fn what_a_person_puts_into_a_folder_on_its_way_stays() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "out", "--png", "--quiet"]).exits(0);
    let mut child = start(&scratch, &[&LONG[..], &["--out", "out", "--force"]].concat());
    wait_for(&scratch, &format!(".out.new-{}/summary.json", child.id()));
    scratch.write("out/notes.txt", "mine");
    scratch.write("out/figures/notes.txt", "mine");
    fs::create_dir(scratch.path("out/data")).unwrap();
    scratch.write("out/data/summary.json", "mine");
    assert!(child.wait().unwrap().success());
    assert_eq!(scratch.names("."), ["out"]);
    assert!(scratch.read("out/case.toml").contains("cells = 1000000"), "the new run is not in place");
    for file in ["out/notes.txt", "out/figures/notes.txt", "out/data/summary.json"] {
        assert_eq!(scratch.read(file), "mine", "{file}");
    }
    assert_eq!(scratch.names("out/figures"), ["notes.txt"]);
    // A run that cannot be written takes back its own files and leaves the rest.
    for made in [true, false] {
        if !made {
            fs::create_dir(scratch.path("first")).unwrap();
        }
        let line = format!("trap '' XFSZ; ulimit -f 64; exec \"$BEDLOAD\" {} --out first", LONG.join(" "));
        let command = scratch.command();
        let shell = command.get_program().to_owned();
        let mut child = std::process::Command::new("sh")
            .args(["-c", &line])
            .env("BEDLOAD", shell)
            .current_dir(scratch.path("."))
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        wait_for(&scratch, "first/summary.json");
        scratch.write("first/notes.txt", "mine");
        assert_eq!(child.wait().unwrap().code(), Some(1));
        assert_eq!(scratch.names("first"), ["notes.txt"], "made by the run: {made}");
        fs::remove_dir_all(scratch.path("first")).unwrap();
    }
}

#[test]
fn frames_do_not_follow_a_link() {
    let scratch = scratch();
    scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "out", "--quiet"]).exits(0);
    symlink("../precious/figures", scratch.path("out/figures")).unwrap();
    refused(&scratch, &["report", "out", "--png"], "not-a-folder");
    refused(&scratch, &["run", "bed_ouriemi-laminar-exact", "--out", "out", "--force"], "foreign-folder");
}

#[test]
fn a_table_replaces_only_a_table() {
    let scratch = scratch();
    let validate = |out: &'static str| ["validate", CASE, "--out", out];
    refused(&scratch, &validate("new/../precious/thesis.tex"), "foreign-file");
    refused(&scratch, &validate("precious/figures"), "unwritable");
    scratch.write("figures.md", "# Validation\n\nMade by me.\n");
    refused(&scratch, &validate("figures.md"), "foreign-file");
    fs::create_dir(scratch.path("figures")).unwrap();
    scratch.write("figures/validation.png", "mine");
    refused(&scratch, &validate("table.md"), "foreign-file");
    scratch.bedload(validate("new/../deep/table.md")).exits(0);
    assert_eq!(scratch.names("deep"), ["figures", "table.md"]);
    let made = scratch.read("deep/table.md");
    scratch.bedload(validate("deep/table.md")).exits(0);
    assert!(scratch.read("deep/table.md") == made && !scratch.path("new").exists());
    // A full disk keeps the old one, and leaves no half of a new one.
    let before = scratch.snapshot(".");
    for (limit, out) in [(0, "deep/table.md"), (0, "else/where/table.md"), (4, "deep/table.md"), (4, "else/table.md")] {
        let line = format!("trap '' XFSZ; ulimit -f {limit}; exec \"$BEDLOAD\" validate {CASE} --out {out} --json");
        let answer = scratch.shell(&line).exits(1).json();
        assert_eq!(answer["error"]["code"], "write-failed", "{answer}");
        assert!(scratch.snapshot(".") == before && !scratch.path("else").exists(), "{limit} {out}");
    }
}

#[test]
fn an_unfinished_validation_goes_on() {
    let scratch = scratch();
    let full = ["validate", "bingham_1d_plane", "kinetic_1d_e05", "--full", "--out", "t/table.md"];
    scratch.bedload(full).exits(0);
    let table = scratch.read("t/table.md");
    assert_eq!(scratch.names("t"), ["figures", "table.md"], "what is finished is not unfinished, too");
    // A case that was run before is not run again: what it found is taken as it is, and assessed again.
    let line = format!("trap '' XFSZ; ulimit -f 16; exec \"$BEDLOAD\" {}", full.join(" "));
    scratch.shell(&line).exits(1);
    let kept = scratch.read("t/table.md.partial");
    let cases: serde_json::Value = serde_json::from_str(&kept).unwrap();
    assert_eq!(cases["cases"].as_object().unwrap().len(), 2);
    let found = cases["cases"]["bingham_1d_plane"]["found"][0].as_f64().unwrap();
    scratch.write("t/table.md.partial", kept.replacen(&format!("{found:?}"), "0.5", 1));
    let resumed = scratch.bedload(full.into_iter().chain(["--resume"])).exits(3).out;
    assert!(resumed.contains("FAIL  bingham_1d_plane"), "{resumed}");
    assert!(scratch.read("t/table.md") != table);
    // Without it all are run.
    scratch.bedload(full).exits(0);
    assert_eq!(scratch.read("t/table.md"), table);
}
