//! Full disks, Ctrl-C, kill -9 and readers that go away: nothing is lost and nothing is half there.
#![cfg(unix)]

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::Scratch;

const CASE: &str = "bed_ouriemi-laminar-exact";
/// Takes long enough to be interrupted.
const LONG: &[&str] = &["run", CASE, "--set", "grid.cells=1000000", "--out", "out"];

fn start(scratch: &Scratch, arguments: &[&str]) -> Child {
    let mut command = scratch.command();
    command.args(arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn signal(child: &Child, name: &str) {
    Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
}

/// Waits until `file` is there; false if the program ended before.
fn appears(scratch: &Scratch, child: &mut Child, file: &str) -> bool {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        if scratch.path(file).exists() {
            return true;
        }
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        sleep(Duration::from_millis(1));
    }
    panic!("{file} does not appear");
}

/// A run that was interrupted after its folder appeared: its exit code.
fn interrupted(scratch: &Scratch, arguments: &[&str]) -> i32 {
    let mut child = start(scratch, arguments);
    if appears(scratch, &mut child, "out/summary.json") {
        signal(&child, "-INT");
    }
    child.wait().unwrap().code().unwrap_or(-1)
}

#[test]
fn ctrl_c_stops_marks_and_can_be_resumed() {
    for _ in 0..5 {
        let scratch = Scratch::new();
        match interrupted(&scratch, LONG) {
            0 => continue, // it was done first
            4 => {}
            code => panic!("exit code {code}"),
        }
        assert_eq!(scratch.summary("out")["status"], "stopped");
        assert!(!scratch.path("out/profile.csv").exists(), "a profile of a stopped closed form");
        assert_eq!(scratch.names("."), ["out"]);
        let reported = scratch.bedload(LONG).exits(2).err;
        assert!(reported.contains("unfinished") && reported.contains("--resume"), "{reported}");
        return;
    }
    panic!("the run was done before Ctrl-C five times");
}

#[test]
fn ctrl_c_on_a_second_run_keeps_the_first() {
    let scratch = Scratch::new();
    scratch.bedload(["run", CASE, "--out", "out"]).exits(0);
    let before = scratch.snapshot("out");
    for _ in 0..5 {
        let mut child = start(&scratch, &[LONG, &["--force"]].concat());
        let beside = format!(".out.new-{}/summary.json", child.id());
        if appears(&scratch, &mut child, &beside) {
            signal(&child, "-INT");
        }
        let output = child.wait_with_output().unwrap();
        match output.status.code() {
            Some(0) => {
                scratch.bedload(["run", CASE, "--out", "out", "--force"]).exits(0);
                continue;
            }
            Some(4) => {}
            code => panic!("exit code {code:?}"),
        }
        let reported = String::from_utf8(output.stderr).unwrap();
        assert!(reported.contains("stopped") && reported.contains("still there"), "{reported}");
        assert_eq!(scratch.names("."), ["out"]);
        assert_eq!(scratch.snapshot("out").keys().collect::<Vec<_>>(), before.keys().collect::<Vec<_>>());
        assert_eq!(scratch.summary("out")["status"], "done");
        return;
    }
    panic!("the run was done before Ctrl-C five times");
}

#[test]
fn kill_leaves_every_file_whole_or_absent() {
    const CELLS: usize = 40_000;
    let scratch = Scratch::new();
    let cells = format!("grid.cells={CELLS}");
    let arguments = ["run", CASE, "--set", &cells, "--out", "out", "--force"];
    let begin = Instant::now();
    scratch.bedload(arguments).exits(0);
    let whole = begin.elapsed();
    let mut seen = [0, 0];
    for i in 0..12 {
        if i % 2 == 0 && scratch.path("out").exists() {
            fs::remove_dir_all(scratch.path("out")).unwrap();
        }
        let mut child = start(&scratch, &arguments);
        sleep(whole.mul_f64(f64::from(i + 1) / 12.0));
        child.kill().unwrap();
        child.wait().unwrap();
        if !scratch.path("out").exists() {
            continue; // killed before it began, or between two renames
        }
        for name in scratch.names("out") {
            if name.contains(".part-") || name == ".probe" {
                continue;
            }
            let text = scratch.read(&format!("out/{name}"));
            match name.as_str() {
                "summary.json" => {
                    let status = scratch.summary("out")["status"].as_str().unwrap().to_owned();
                    seen[usize::from(status == "done")] += 1;
                    assert!(["running", "done"].contains(&status.as_str()), "{status}");
                }
                "case.toml" => assert!(text.contains(".grid]"), "{text}"),
                "profile.csv" => {
                    assert!(text.ends_with('\n'));
                    assert!(text.lines().filter(|l| !l.starts_with('#')).count() > CELLS, "half a profile");
                }
                "series.csv" => assert!(text.ends_with('\n')),
                "page.json" => drop(serde_json::from_str::<serde_json::Value>(&text).expect("half a file")),
                "report.html" => assert!(text.trim_end().ends_with("</html>"), "half a report"),
                other => panic!("{other} in the folder"),
            }
        }
    }
    assert!(seen[0] > 0, "no run was killed in the middle");
    // What is left is ours: it can be replaced.
    scratch.bedload(arguments).exits(0);
    assert_eq!(scratch.summary("out")["status"], "done");
}

#[test]
fn a_kill_between_two_renames_loses_nothing() {
    let scratch = Scratch::new();
    for out in ["out", "deep/out"] {
        let run = ["run", CASE, "--out", out, "--quiet"];
        scratch.bedload(run).exits(0);
        let before = scratch.snapshot(out);
        let old = out.replace("out", ".out.old-77");
        fs::rename(scratch.path(out), scratch.path(&old)).unwrap();
        let reported = scratch.bedload(run.iter().chain(&["--set", "grid.cells=50", "--json"])).exits(2).json();
        assert_eq!(reported["error"]["code"], "other-case");
        assert!(scratch.snapshot(out) == before && !scratch.path(&old).exists(), "{out}");
        // A folder that is there is not replaced by an older one.
        fs::create_dir(scratch.path(&old)).unwrap();
        scratch.bedload(run).exits(0);
        assert!(scratch.path(&old).exists());
        fs::remove_dir(scratch.path(&old)).unwrap();
    }
}

/// Size of the largest file of a finished run [bytes].
fn largest(scratch: &Scratch, folder: &str) -> usize {
    scratch.snapshot(folder).values().map(Vec::len).max().unwrap()
}

#[test]
fn a_full_disk_keeps_the_old_run_and_leaves_nothing_half() {
    let scratch = Scratch::new();
    scratch.bedload(["run", CASE, "--out", "out", "--png"]).exits(0);
    let before = scratch.snapshot("out");
    // A limit on the size of a file stands for the full disk; its unit is 512 bytes or 1 KiB, as the shell has it.
    let most = largest(&scratch, "out") / 1024;
    for limit in [0, 1, 4, most / 8, most / 2, most - 1] {
        let full = format!("trap '' XFSZ; ulimit -f {limit}; exec \"$BEDLOAD\" run {CASE} --png");
        let reported = scratch.shell(&format!("{full} --out out")).exits(1);
        assert!(reported.out.is_empty() && reported.err.contains(" failed: "), "{}", reported.err);
        assert!(scratch.snapshot("out") == before, "limit {limit}: the old run is not intact");
        let reported = scratch.shell(&format!("{full} --out new/folder"));
        assert_ne!(reported.code, 0, "limit {limit}");
        assert_eq!(scratch.names("."), ["out"], "limit {limit}");
        let reported = scratch.shell(&format!("mkdir mine; {full} --out mine --json"));
        assert_ne!(reported.code, 0, "limit {limit}");
        assert_eq!(reported.json()["status"], "failed");
        assert!(scratch.names("mine").is_empty(), "limit {limit}: {:?}", scratch.names("mine"));
        fs::remove_dir(scratch.path("mine")).unwrap();
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let scratch = Scratch::new();
    scratch.bedload(["run", CASE, "--out", "out"]).exits(0);
    for arguments in [
        &["list"] as &[&str],
        &["schema"],
        &["explain", CASE],
        &["completions", "bash"],
        &["check", CASE],
        &["report", "out"],
        &["validate", CASE],
        &["run", CASE, "--json", "--out", "out"],
        &["run", CASE, "--out", "out"],
        &["new", CASE, "-"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = scratch.command().args(arguments).stdout(writer).stderr(Stdio::piped()).output().unwrap();
        let reported = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), reported.as_str()), (Some(0), ""), "{arguments:?}");
    }
}

#[test]
fn a_full_standard_output_is_an_error_without_a_panic() {
    let Ok(full) = fs::File::options().write(true).open("/dev/full") else {
        println!("skipped: no /dev/full on this system");
        return;
    };
    let scratch = Scratch::new();
    for arguments in [&["list"] as &[&str], &["schema"], &["check", CASE, "--json"], &["check", "nothing", "--json"]] {
        let mut command = scratch.command();
        let output = command.args(arguments).stdout(full.try_clone().unwrap()).stderr(Stdio::piped()).output().unwrap();
        let reported = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {reported}");
        assert!(!reported.contains("bug"), "{reported}");
    }
}
