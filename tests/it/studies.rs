//! The folder of a study: what may replace it, what an interrupted one keeps, and that it goes on from there.
#![cfg(unix)]

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use serde_json::Value;

use crate::support::Scratch;

const SHORT: &[&str] = &["sweep", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60,90 Pa/m", "--out", "s"];
/// Takes long enough to be interrupted.
const LONG: &[&str] = &[
    "sweep",
    "bed_ouriemi-laminar-exact",
    "--set",
    "grid.cells=20000",
    "--over",
    "flow.pressure_gradient=800:1400:16 Pa/m",
    "--threads",
    "1",
    "--out",
    "s",
];

fn record(scratch: &Scratch) -> Value {
    serde_json::from_str(&scratch.read("s/study.json")).unwrap()
}

fn code(scratch: &Scratch, arguments: &[&[&str]]) -> String {
    let said = scratch.bedload([&arguments.concat()[..], &["--json"]].concat()).exits(2).json();
    said["error"]["code"].as_str().unwrap().to_owned()
}

/// When each finished point was written.
fn written(scratch: &Scratch) -> Vec<(String, SystemTime)> {
    let names = if scratch.path("s/points").exists() { scratch.names("s/points") } else { Vec::new() };
    let done = names.into_iter().filter(|name| {
        fs::read_to_string(scratch.path(&format!("s/points/{name}/summary.json")))
            .is_ok_and(|text| text.contains("\"status\": \"done\""))
    });
    done.map(|name| {
        let file = scratch.path(&format!("s/points/{name}/summary.json"));
        (name, fs::metadata(file).unwrap().modified().unwrap())
    })
    .collect()
}

#[test]
fn a_study_replaces_itself_and_nothing_else() {
    let scratch = Scratch::new();
    scratch.bedload(SHORT).exits(0);
    scratch.bedload(SHORT).exits(0);
    assert_eq!(scratch.names("."), ["s"]);
    let other = &["sweep", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60,91 Pa/m", "--out", "s"];
    let before = scratch.snapshot("s");
    assert_eq!(code(&scratch, &[other]), "other-study");
    assert_eq!(code(&scratch, &[other, &["--resume"]]), "other-study");
    assert_eq!(code(&scratch, &[&["run", "exact_1d_bagnold", "--out", "s", "--force"]]), "other-kind");
    let compare = ["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed", "--out", "s", "--force"];
    assert_eq!(code(&scratch, &[&compare]), "other-kind");
    assert!(scratch.snapshot("s") == before, "a refused study touched the folder");
    scratch.bedload([other, &["--force"][..]].concat()).exits(0);
    assert_eq!(scratch.names("s/points").len(), 2);
    // the point at 60 Pa/m is in both
    for foreign in ["s/notes.txt", "s/points/notes.txt", "s/points/mine"] {
        let folder = foreign.ends_with("mine");
        if folder {
            fs::create_dir(scratch.path(foreign)).unwrap();
        } else {
            scratch.write(foreign, "mine");
        }
        for flag in [&[][..], &["--force"], &["--resume"]] {
            assert_eq!(code(&scratch, &[other, flag]), "foreign-folder", "{foreign} {flag:?}");
        }
        let gone = scratch.path(foreign);
        if folder { fs::remove_dir(gone).unwrap() } else { fs::remove_file(gone).unwrap() }
    }
    scratch.bedload(["run", "exact_1d_bagnold", "--out", "r"]).exits(0);
    scratch.bedload(compare.map(|a| if a == "s" { "c" } else { a })).exits(0);
    for taken in ["r", "c"] {
        let there: Vec<&str> = SHORT.iter().map(|&a| if a == "s" { taken } else { a }).collect();
        assert_eq!(code(&scratch, &[&there, &["--force"]]), "other-kind");
    }
}

#[test]
fn resume_keeps_what_is_done_and_does_the_rest() {
    let scratch = Scratch::new();
    scratch.bedload(SHORT).exits(0);
    let (before, whole) = (written(&scratch), record(&scratch));
    assert_eq!(before.len(), 2);
    // half of it is lost, and what a kill leaves is in its place
    let lost = format!("s/points/{}", before[0].0);
    fs::remove_dir_all(scratch.path(&lost)).unwrap();
    fs::create_dir(scratch.path(&lost)).unwrap();
    scratch.write(&format!("{lost}/.probe"), "");
    scratch.write(&format!("{lost}/.summary.json.part-7"), "{");
    fs::create_dir(scratch.path("s/points/.0123456789abcdef.new-7")).unwrap();
    let mut running = record(&scratch);
    running["status"] = "running".into();
    scratch.write("s/study.json", running.to_string());
    assert_eq!(code(&scratch, &[SHORT]), "unfinished-study");
    let said = scratch.bedload([SHORT, &["--resume"]].concat()).exits(0).out;
    assert!(said.contains("2 points, 2 done (1 before)"), "{said}");
    let after = written(&scratch);
    assert_eq!(scratch.names("s/points").len(), 2);
    assert_eq!(after[1], before[1], "a finished point was run again");
    assert!(after[0].1 > before[0].1);
    for (a, b) in record(&scratch)["points"].as_array().unwrap().iter().zip(whole["points"].as_array().unwrap()) {
        assert_eq!(
            (&a["results"], &a["measures"], &a["iterations"]),
            (&b["results"], &b["measures"], &b["iterations"])
        );
    }
    // a finished study is only assessed and drawn again
    let said = scratch.bedload([SHORT, &["--resume", "--png"]].concat()).exits(0).out;
    assert!(said.contains("(2 before)") && scratch.path("s/figures/sweep.png").exists(), "{said}");
    assert_eq!(written(&scratch), after);
}

fn start(scratch: &Scratch) -> Child {
    scratch.command().args(LONG).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// Waits for three finished points; false if the program ends before.
fn has_begun(scratch: &Scratch, child: &mut Child) -> bool {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        if written(scratch).len() >= 3 {
            return true;
        }
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        sleep(Duration::from_millis(1));
    }
    panic!("no point is done after a minute");
}

/// What an interrupted study has is kept, and the rest follows.
fn goes_on(scratch: &Scratch, status: &str) {
    assert_eq!(record(scratch)["status"], status);
    let kept = written(scratch);
    assert!((3..16).contains(&kept.len()), "{} points", kept.len());
    assert_eq!(code(scratch, &[LONG]), "unfinished-study");
    let said = scratch.bedload([LONG, &["--resume"]].concat()).exits(0).out;
    assert!(said.contains(&format!("16 points, 16 done ({} before)", kept.len())), "{said}");
    let after = written(scratch);
    assert!(kept.iter().all(|point| after.contains(point)), "a finished point was run again");
    let rates = record(scratch)["points"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| p["results"]["transport_rate_m2_s"]["value"].as_f64())
        .collect::<Option<Vec<_>>>();
    let rates = rates.unwrap();
    assert!(rates.len() == 16 && rates.is_sorted(), "{rates:?}");
    assert_eq!(scratch.names("."), ["s"]);
}

#[test]
fn a_killed_study_goes_on() {
    for _ in 0..5 {
        let scratch = Scratch::new();
        let mut child = start(&scratch);
        let begun = has_begun(&scratch, &mut child);
        child.kill().unwrap();
        if child.wait().unwrap().code() == Some(0) || !begun {
            continue;
        }
        return goes_on(&scratch, "running");
    }
    panic!("the study was done before the kill five times");
}

#[test]
fn ctrl_c_keeps_what_there_is() {
    for _ in 0..5 {
        let scratch = Scratch::new();
        let mut child = start(&scratch);
        if has_begun(&scratch, &mut child) {
            Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        }
        match child.wait().unwrap().code() {
            Some(0) => continue,
            Some(4) => return goes_on(&scratch, "stopped"),
            code => panic!("exit code {code:?}"),
        }
    }
    panic!("the study was done before Ctrl-C five times");
}

#[test]
fn ctrl_c_on_a_second_study_keeps_the_first() {
    let scratch = Scratch::new();
    scratch.bedload(SHORT).exits(0);
    let before = scratch.snapshot("s");
    let mut child = scratch
        .command()
        .args([LONG, &["--force"]].concat())
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let beside = scratch.path(&format!(".s.new-{}/study.json", child.id()));
    while !beside.exists() && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(1));
    }
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(4));
    assert!(scratch.snapshot("s") == before && scratch.names(".") == ["s"]);
}
