//! One writer at a time: the second process is refused, with the id of the first, and no folder is ever mixed from two.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::os::unix::process::CommandExt;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::grains::case;
use crate::support::Scratch;

const SWEEP: [&str; 5] = ["sweep", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60,90 Pa/m", "--quiet"];
/// Every verb that writes a folder, with the least that it asks for.
const FOLDERS: [&[&str]; 7] = [
    &["run", "exact_1d_bagnold"],
    &["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed"],
    &SWEEP,
    &["chart", "exact_1d_bagnold"],
    &["converge", "bed_ouriemi-laminar", "--over", "mesh"],
    &["stability", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60:90:2"],
    &["calibrate", "exact_1d_bagnold", "--to", "data.csv", "--fit", "mu_2"],
];

fn start<S: AsRef<str>>(scratch: &Scratch, arguments: &[S]) -> Child {
    let mut command = scratch.command();
    command.args(arguments.iter().map(AsRef::as_ref)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

#[track_caller]
fn wait_for(scratch: &Scratch, file: &str) {
    let begin = Instant::now();
    while !scratch.path(file).exists() {
        assert!(begin.elapsed() < Duration::from_secs(60), "{file} does not appear");
        sleep(Duration::from_millis(1));
    }
}

/// What is reported to the second process.
#[track_caller]
fn refused(scratch: &Scratch, arguments: &[&str]) -> String {
    let answer =
        scratch.bedload(arguments.iter().filter(|word| **word != "--quiet").chain(&["--json"])).exits(2).json();
    assert_eq!(answer["error"]["code"], "in-use", "{arguments:?}: {answer}");
    answer["error"]["message"].as_str().unwrap().to_owned()
}

/// A run of grains in `out` that takes some seconds.
fn holder(scratch: &Scratch) -> Child {
    let child = start(scratch, &case(&["--out", "out", "--set", "discrete.duration=60 s", "--checkpoint", "0.01"]));
    wait_for(scratch, "out/checkpoint.bin");
    child
}

#[test]
fn the_second_process_is_told_who_holds_the_folder() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "exact_1d_bagnold", "--out", "data", "--quiet"]).exits(0);
    fs::rename(scratch.path("data/profile.csv"), scratch.path("data.csv")).unwrap();
    symlink("out", scratch.path("alias")).unwrap();
    let mut child = holder(&scratch);
    let name = format!("out is in use: process {} has been writing it since 20", child.id());
    for verb in FOLDERS {
        for flags in
            [&["--out", "out"] as &[&str], &["--out", "alias", "--force"], &["--out", "new/../out", "--resume"]]
        {
            if verb[0] == "compare" && flags.contains(&"--resume") {
                continue;
            }
            let message = refused(&scratch, &[verb, flags].concat());
            assert!(message.starts_with(&name) && message.ends_with('Z'), "{message}");
        }
    }
    let message = refused(&scratch, &["report", "out"]);
    assert!(message.starts_with(&name), "{message}");
    let error = scratch.bedload(SWEEP.iter().chain(&["--out", "out"])).exits(2).err;
    assert!(error.contains("--out"), "{error}");
    // Killed, it blocks nobody, and what it leaves is taken over.
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(scratch.path(".out.lock").exists());
    let begin = Instant::now();
    scratch.bedload(["report", "out"]).exits(0);
    scratch.bedload(["run", "exact_1d_bagnold", "--out", "out", "--force", "--quiet"]).exits(0);
    assert!(begin.elapsed() < Duration::from_secs(30));
    assert_eq!(scratch.names("."), ["alias", "data", "data.csv", "out"]);
}

#[test]
fn studies_hold_their_points_and_comparisons_their_folder() {
    let scratch = Scratch::new();
    let case = bedload::case::shipped::find("exact_1d_ouriemi_mixed").unwrap().content;
    scratch.write("long.toml", case.replacen("form = \"mixed\"", "form = \"mixed\"\ngrid.cells = 1000000", 1));
    scratch.bedload(["check", "long.toml"]).exits(0);
    let mut child =
        start(&scratch, &["sweep", "long.toml", "--over", "flow.pressure_gradient=900:1000:20 Pa/m", "--out", "s"]);
    let begin = Instant::now();
    let point = loop {
        let names = if scratch.path("s/points").exists() { scratch.names("s/points") } else { Vec::new() };
        let there = |name: &&String| scratch.path(&format!("s/points/{name}/case.toml")).exists();
        if let Some(name) = names.iter().find(there) {
            break format!("s/points/{name}");
        }
        assert!(begin.elapsed() < Duration::from_secs(60), "no point begins");
        sleep(Duration::from_millis(1));
    };
    for out in ["s", &point, "s/points/0123456789abcdef"] {
        refused(&scratch, &[&SWEEP[..], &["--out", out, "--force"]].concat());
        refused(&scratch, &["run", "exact_1d_bagnold", "--out", out, "--force"]);
    }
    refused(&scratch, &["report", &point]);
    child.kill().unwrap();
    child.wait().unwrap();
    let mut child = start(&scratch, &["compare", "long.toml", "long.toml", "--out", "c"]);
    wait_for(&scratch, "c");
    refused(&scratch, &["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed", "--out", "c"]);
    refused(&scratch, &["run", "exact_1d_bagnold", "--out", "c"]);
    child.kill().unwrap();
    child.wait().unwrap();
    scratch
        .bedload(["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed", "--out", "c", "--quiet"])
        .exits(0);
}

#[test]
fn a_lock_is_that_of_the_system_and_not_the_file() {
    let scratch = Scratch::new();
    let run = ["run", "exact_1d_bagnold", "--out", "out"];
    let validate = ["validate", "exact_1d_bagnold", "--out", "table.md"];
    for (arguments, file) in [(run, ".out.lock"), (validate, ".table.md.lock")] {
        scratch.write(file, "bedload 77 2026-01-02T03:04:05Z\n");
        let held = fs::File::open(scratch.path(file)).unwrap();
        held.lock().unwrap();
        let message = refused(&scratch, &arguments);
        assert!(
            message.ends_with(" is in use: process 77 has been writing it since 2026-01-02T03:04:05Z"),
            "{message}"
        );
        drop(held);
        scratch.bedload(arguments).exits(0);
        assert!(!scratch.path(file).exists());
        // One that names no holder counts, too.
        let held = fs::File::create(scratch.path(file)).unwrap();
        held.lock().unwrap();
        assert!(refused(&scratch, &arguments).ends_with(" is in use: another process is writing it"));
        drop(held);
        // A file of somebody that has this name stays.
        scratch.write(file, "mine");
        let answer = scratch.bedload(arguments.iter().chain(&["--json"])).exits(2).json();
        assert_eq!(answer["error"]["code"], "foreign-file", "{answer}");
        assert_eq!(scratch.read(file), "mine");
        fs::remove_file(scratch.path(file)).unwrap();
    }
    // A lock in a folder, of a run below it, is nothing foreign.
    scratch.write("out/.below.lock", "bedload 77 2026-01-02T03:04:05Z\n");
    scratch.bedload(run).exits(0);
    assert!(scratch.path("out/.below.lock").exists());
}

#[test]
fn no_folder_is_mixed_from_two() {
    let scratch = Scratch::new();
    let (mut done, mut refused) = (0, 0);
    for race in 0..24 {
        let cells = |i: usize| 1000 * (i + 1) + race;
        let mut processes = Vec::new();
        for i in 0..4 {
            let set = format!("grid.cells={}", cells(i));
            let mut arguments = vec!["run", "bed_ouriemi-laminar-exact", "--set", &set, "--out", "deep/out", "--json"];
            if race % 3 > 0 {
                arguments.push("--force");
            }
            let mut command = scratch.command();
            command.args(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
            processes.push(command.spawn().unwrap());
        }
        let mut last = Vec::new();
        for (i, process) in processes.into_iter().enumerate() {
            let output = process.wait_with_output().unwrap();
            let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            match output.status.code() {
                Some(0) => last.push(cells(i)),
                Some(2) => {
                    let code = answer["error"]["code"].as_str().unwrap();
                    assert!(["in-use", "other-case"].contains(&code), "{answer}");
                    refused += usize::from(code == "in-use");
                }
                code => panic!("{code:?}: {answer}"),
            }
        }
        assert!(!last.is_empty(), "race {race}: nobody wrote");
        done += last.len();
        assert_eq!(
            (scratch.names("."), scratch.names("deep")),
            (vec!["deep".into()], vec!["out".into()]),
            "race {race}"
        );
        let text = scratch.read("deep/out/case.toml");
        let own = *last.iter().find(|cells| text.contains(&format!("\ncells = {cells}\n"))).unwrap();
        let rows = scratch.read("deep/out/profile.csv").lines().filter(|line| !line.starts_with('#')).count() - 1;
        assert!(rows.abs_diff(own) <= 2, "race {race}: a profile of {rows} rows with the case of {own}");
        let summary = scratch.summary("deep/out");
        assert_eq!(summary["status"], "done");
        assert!(summary["provenance"]["overrides"][0] == format!("grid.cells={own}"), "race {race}: {summary}");
        if race % 2 == 0 {
            fs::remove_dir_all(scratch.path("deep")).unwrap();
        }
        if race % 3 == 2 && scratch.path("deep").exists() {
            fs::remove_dir_all(scratch.path("deep")).unwrap();
        }
    }
    println!("{done} done, {refused} refused");
    assert!(done >= 24 && refused > 0, "{done} done, {refused} refused: no race");
}

#[test]
fn a_folder_below_one_that_takes_no_files_is_locked_inside() {
    let scratch = Scratch::new();
    let program = scratch.path("bedload");
    fs::copy(scratch.command().get_program(), &program).unwrap();
    fs::create_dir_all(scratch.path("closed/out")).unwrap();
    let answer = scratch.shell("chmod 755 . bedload; chmod 777 closed/out; chmod 555 closed; touch closed/probe");
    // Nothing is closed to root: then the program runs as somebody else.
    let nobody = (answer.code == 0).then_some(65534);
    if nobody.is_some() {
        fs::remove_file(scratch.path("closed/probe")).unwrap();
    }
    let command = |arguments: &[&str]| {
        let mut command = std::process::Command::new(&program);
        command.args(arguments).current_dir(scratch.path(".")).stdin(Stdio::null());
        if let Some(nobody) = nobody {
            command.uid(nobody);
        }
        command.output().unwrap()
    };
    let run = ["run", "exact_1d_bagnold", "--out", "closed/out", "--json"];
    scratch.write("closed/out/.lock", "");
    scratch.shell("chmod 666 closed/out/.lock").exits(0);
    let held = fs::File::open(scratch.path("closed/out/.lock")).unwrap();
    held.lock().unwrap();
    let output = command(&run);
    assert!(
        output.status.code() == Some(2) && String::from_utf8_lossy(&output.stdout).contains("in-use"),
        "{output:?}"
    );
    drop(held);
    let output = command(&run);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(scratch.names("closed"), ["out"]);
    assert_eq!(scratch.names("closed/out"), ["case.toml", "page.json", "profile.csv", "report.html", "summary.json"]);
    scratch.shell("chmod 755 closed").exits(0);
}
