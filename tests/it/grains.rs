//! Runs of grains that are interrupted, and their checkpoints: nothing is lost but what came after the last one, and the
//! bits of the result are those of a run that was left alone.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use crate::support::{Scratch, comparable};

/// A few hundred grains on a slice of a bed: deposited twice, then flowing.
const CASE: &[&str] = &[
    "run",
    "grains_3d_bed_quick",
    "--set",
    "bottom=slice",
    "--set",
    "layers=4",
    "--set",
    "cell.length=36 mm",
    "--set",
    "cell.width=36 mm",
    "--set",
    "flow.slope=0.45",
    "--set",
    "flow.slope_definition=tangent",
    "--set",
    "discrete.duration=0.5 s",
    "--set",
    "discrete.frames=4",
    "--quiet",
];

pub fn case(more: &[&str]) -> Vec<String> {
    CASE.iter().chain(more).map(|&word| word.to_owned()).collect()
}

fn start(scratch: &Scratch, more: &[&str]) -> Child {
    let mut command = scratch.command();
    command.args(case(more)).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn interrupt(child: &Child) {
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
}

/// Everything that a run wrote, without what may differ between two identical runs: times, and who ran it when.
pub fn written(scratch: &Scratch, folder: &str) -> BTreeMap<PathBuf, String> {
    let mut files = BTreeMap::new();
    for (path, bytes) in scratch.snapshot(folder) {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if name == "checkpoint.bin" || name == "report.html" {
            continue;
        }
        let mut text = String::from_utf8(bytes).unwrap();
        if name == "summary.json" {
            text = comparable(serde_json::from_str(&text).unwrap()).to_string();
        }
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        files.insert(PathBuf::from(name), lines.collect::<Vec<_>>().join("\n"));
    }
    files
}

/// The run that nothing disturbs, and how long it takes.
fn undisturbed(scratch: &Scratch) -> (BTreeMap<PathBuf, String>, Duration) {
    let begin = Instant::now();
    scratch.bedload(case(&["--out", "whole", "--checkpoint", "0"])).exits(0);
    let whole = written(scratch, "whole");
    assert_eq!(whole.keys().filter(|name| name.extension().is_some_and(|e| e == "vtp")).count(), 4);
    assert!(!scratch.path("whole/checkpoint.bin").exists(), "no checkpoint was asked for");
    (whole, begin.elapsed())
}

#[track_caller]
fn same(found: &BTreeMap<PathBuf, String>, expected: &BTreeMap<PathBuf, String>) {
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, text) in expected {
        assert!(found[name] == *text, "{} differs", name.display());
    }
}

#[test]
fn checkpoints_seldom_often_or_never_and_threads_change_no_bit() {
    let scratch = Scratch::new();
    let (whole, _) = undisturbed(&scratch);
    for (every, threads) in [("0.01", "1"), ("0.05", "2")] {
        let out = format!("out-{every}");
        scratch.bedload(case(&["--out", &out, "--checkpoint", every, "--threads", threads])).exits(0);
        let mut found = written(&scratch, &out);
        // The number of threads is part of the provenance, the rest is not.
        found.remove(&PathBuf::from("case.toml"));
        let mut expected = whole.clone();
        expected.remove(&PathBuf::from("case.toml"));
        same(&found, &expected);
    }
    scratch.bedload(case(&["--checkpoint", "-1"])).exits(2);
}

#[test]
fn ctrl_c_at_any_stage_keeps_all_that_was_done() {
    let scratch = Scratch::new();
    let (whole, takes) = undisturbed(&scratch);
    let mut stopped = 0;
    for share in [0.05, 0.2, 0.4, 0.6, 0.8] {
        let mut child = start(&scratch, &["--out", "out", "--checkpoint", "0", "--resume"]);
        sleep(takes.mul_f64(0.1 + 0.3 * share));
        interrupt(&child);
        let code = child.wait().unwrap().code();
        if code == Some(4) {
            assert_eq!(scratch.summary("out")["status"], "stopped");
            stopped += 1;
        }
    }
    assert!(stopped > 0, "no run was stopped");
    scratch.bedload(case(&["--out", "out", "--resume"])).exits(0);
    same(&written(&scratch, "out"), &whole);
}

#[test]
fn kill_at_a_random_moment_loses_no_more_than_the_time_since_the_last_checkpoint() {
    const EVERY: f64 = 0.02;
    let scratch = Scratch::new();
    let (whole, takes) = undisturbed(&scratch);
    let mut killed = 0;
    for turn in 0..8_u32 {
        // Moments that no clock of the program knows.
        let noise = f64::from(SystemTime::UNIX_EPOCH.elapsed().unwrap().subsec_nanos() % 1000) / 1000.0;
        let mut child = start(&scratch, &["--out", "out", "--checkpoint", &EVERY.to_string(), "--resume"]);
        let planned = takes.mul_f64((0.1 + 0.5 * noise) * f64::from(turn + 1) / 4.0);
        let begun = Instant::now();
        sleep(planned);
        // The machine may be busy with other tests, and the clock is looked at between some steps only.
        let slack = 1.0 + 4.0 * begun.elapsed().saturating_sub(planned).as_secs_f64();
        let at = SystemTime::now();
        child.kill().unwrap();
        if child.wait().unwrap().code() == Some(0) {
            break;
        }
        killed += 1;
        if let Ok(kept) = fs::metadata(scratch.path("out/checkpoint.bin")) {
            let age = at.duration_since(kept.modified().unwrap()).unwrap_or_default().as_secs_f64();
            assert!(age < EVERY + slack, "the last checkpoint was made {age} s before");
        }
    }
    assert!(killed > 1, "killed {killed} times");
    scratch.bedload(case(&["--out", "out", "--resume"])).exits(0);
    same(&written(&scratch, "out"), &whole);
}

/// Kills a run as soon as it has a checkpoint.
fn half_way(scratch: &Scratch, more: &[&str]) -> Vec<u8> {
    let mut child = start(scratch, &[more, &["--checkpoint", "0.01"]].concat());
    let begin = Instant::now();
    let path = scratch.path(more[1]).join("checkpoint.bin");
    while !path.exists() {
        assert!(begin.elapsed() < Duration::from_secs(60), "no checkpoint");
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    fs::read(path).unwrap()
}

#[test]
fn a_checkpoint_that_cannot_be_used_is_refused_and_stays() {
    let scratch = Scratch::new();
    let good = half_way(&scratch, &["--out", "out"]);
    let other = half_way(&scratch, &["--out", "other", "--set", "discrete.seed=1"]);
    let changed = |place: usize| {
        let mut bytes = good.clone();
        bytes[place] ^= 0x40;
        bytes
    };
    let cases = [
        (good[..good.len() / 2].to_vec(), "truncated"),
        (good[..good.len() - 1].to_vec(), "truncated"),
        (good[..10].to_vec(), "truncated"),
        (Vec::new(), "not a checkpoint of bedload"),
        (b"something else".to_vec(), "not a checkpoint of bedload"),
        (changed(good.len() / 3), "corrupt: its checksum"),
        (changed(good.len() - 1), "corrupt: its checksum"),
        (changed(8), "version"),
        ([&good[..], b"x"].concat(), "corrupt: bytes follow its end"),
        (other, "belongs to another case"),
    ];
    for (bytes, expected) in cases {
        scratch.write("out/checkpoint.bin", &bytes);
        let answer = scratch.bedload(case(&["--out", "out", "--resume"])).exits(2);
        let error = answer.err;
        assert!(error.contains("out/checkpoint.bin") && error.contains(expected), "{expected}: {error}");
        assert!(error.contains("--force"), "{error}");
        assert_eq!(fs::read(scratch.path("out/checkpoint.bin")).unwrap(), bytes, "it was touched");
        let answer = scratch.bedload(case(&["--out", "out", "--resume", "--json"])).exits(2).json();
        assert_eq!(answer["status"], "failed");
    }
    // Without --resume the unfinished run is not overwritten, with --force it is.
    scratch.write("out/checkpoint.bin", &good);
    let error = scratch.bedload(case(&["--out", "out"])).exits(2).err;
    assert!(error.contains("--resume"), "{error}");
    scratch.bedload(case(&["--out", "out", "--force"])).exits(0);
    assert_eq!(scratch.summary("out")["status"], "done");
}

#[test]
fn a_run_that_fails_keeps_its_last_checkpoint() {
    let scratch = Scratch::new();
    half_way(&scratch, &["--out", "out"]);
    // A time step far beyond the limit, forced: the grains fly apart.
    let wild = ["--set", "discrete.time_step=3e-4", "--set", "discrete.force_time_step=true"];
    let arguments = [&["--out", "wild", "--checkpoint", "0.001"], &wild[..]].concat();
    let answer = scratch.bedload(case(&arguments)).exits(3);
    assert!(answer.err.contains("grain ") && answer.err.contains("step "), "{}", answer.err);
    assert_eq!(scratch.summary("wild")["status"], "failed");
    assert!(scratch.path("wild/checkpoint.bin").exists(), "{:?}", scratch.names("wild"));
}

#[test]
fn frames_for_paraview_are_whole_xml_with_a_point_a_grain() {
    let scratch = Scratch::new();
    scratch.bedload(case(&["--out", "out"])).exits(0);
    let text = scratch.read("out/grains_00004.vtp");
    let points: usize = text.split("NumberOfPoints=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    assert!(points > 144, "{points}");
    let mut open = Vec::new();
    for tag in text.split('<').skip(1).map(|t| t.split('>').next().unwrap()).filter(|t| !t.starts_with('?')) {
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        match (tag.starts_with('/'), tag.ends_with('/')) {
            (true, _) => assert_eq!(open.pop(), Some(name)),
            (false, false) => open.push(name),
            (false, true) => {}
        }
    }
    assert!(open.is_empty(), "{open:?}");
    for (name, components) in
        [("velocity_m_s", 3), ("angular_velocity_1_s", 3), ("radius_m", 1), ("fixed", 1), ("grain", 1)]
    {
        let array = text.split(&format!("Name=\"{name}\"")).nth(1).unwrap_or_else(|| panic!("{name}"));
        let body = array.split_once('>').unwrap().1.split('<').next().unwrap();
        let numbers: Vec<f64> = body.split_whitespace().map(|n| n.parse().unwrap()).collect();
        assert_eq!(numbers.len(), components * points, "{name}");
    }
    let page = scratch.read("out/report.html");
    assert!(page.contains("<figure id=\"drawing\">") && page.contains("<circle"), "the report shows the grains");
}
