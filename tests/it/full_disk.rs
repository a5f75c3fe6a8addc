//! Disks that fill on the way: what was finished stays, and the message says where and how to go on. A limit on the size of
//! a file stands for the full disk, and where the system lets us a small disk in memory is one.
#![cfg(unix)]

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::grains::{case, written};
use crate::support::{Answer, Scratch};

/// Two small points and one whose profile is some megabytes.
const SWEEP: &str = "sweep bed_ouriemi-laminar-exact --over grid.cells=50,100,20000 --threads 1";

/// Runs the program where no file may be larger than `kib`; half as much as some shells count.
fn limited(scratch: &Scratch, kib: usize, arguments: &str) -> Answer {
    scratch.shell(&format!("trap '' XFSZ; ulimit -f {kib}; exec \"$BEDLOAD\" {arguments}"))
}

/// Size of the largest file of a folder [KiB].
fn largest(scratch: &Scratch, folder: &str) -> usize {
    scratch.snapshot(folder).values().map(Vec::len).max().unwrap().div_ceil(1024)
}

/// The run of grains as a shell takes it.
fn grains(more: &[&str]) -> String {
    case(more).iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" ")
}

/// A first run whose disk fills: what is left is its folder with a checkpoint, or nothing. The limit that leaves a
/// checkpoint; `whole` is the largest file of the run that nothing disturbs [KiB].
fn broken(scratch: &Scratch, whole: usize) -> usize {
    let words = grains(&["--checkpoint", "0.01", "--out", "out"]);
    for part in [2, 4, 8, 16, 32, 64] {
        let answer = limited(scratch, whole / part, &words);
        assert_eq!(answer.code, 1, "{}", answer.err);
        if !scratch.path("out/checkpoint.bin").exists() {
            assert!(!scratch.path("out").exists(), "{:?}", scratch.names("out"));
            assert!(answer.err.contains(" failed: ") && !answer.err.contains("keeps"), "{}", answer.err);
            continue;
        }
        let expected = "; out keeps the last checkpoint\n  free some space and go on with --resume\n";
        assert!(answer.err.starts_with("error: writing out/") && answer.err.ends_with(expected), "{}", answer.err);
        assert_eq!(scratch.summary("out")["status"], "running");
        return whole / part;
    }
    panic!("no limit leaves a checkpoint");
}

#[test]
fn a_run_keeps_its_checkpoint() {
    let scratch = Scratch::new();
    scratch.bedload(case(&["--out", "whole", "--checkpoint", "0.01"])).exits(0);
    let (whole, size) = (written(&scratch, "whole"), largest(&scratch, "whole"));
    let limit = broken(&scratch, size);
    // The disk is still full: from the start, or after the run has gone on for a while.
    let resume = case(&["--out", "out", "--resume", "--checkpoint", "0.01"]);
    let again = |limit| {
        let words = grains(&["--out", "out", "--resume", "--checkpoint", "0.01"]);
        let error = limited(&scratch, limit, &words).exits(1).err;
        assert_eq!(scratch.names("."), ["out", "whole"]);
        error
    };
    let error = again(1);
    assert!(error.contains("nothing that stood there before was touched"), "{error}");
    let error = again(limit);
    assert!(error.contains("; out keeps the last checkpoint\n  free some space and go on with --resume"), "{error}");
    scratch.bedload(&resume).exits(0);
    assert!(written(&scratch, "out") == whole, "the run that went on differs");
}

#[test]
fn a_run_over_another_one_keeps_its_checkpoint_beside() {
    let scratch = Scratch::new();
    scratch.bedload(case(&["--out", "whole", "--checkpoint", "0.01"])).exits(0);
    let (whole, size) = (written(&scratch, "whole"), largest(&scratch, "whole"));
    let limit = broken(&scratch, size);
    fs::remove_dir_all(scratch.path("out")).unwrap();
    scratch.bedload(["run", "exact_1d_bagnold", "--out", "out", "--quiet"]).exits(0);
    let before = scratch.snapshot("out");
    let words = grains(&["--out", "out", "--checkpoint", "0.01", "--force"]);
    let error = limited(&scratch, limit, &words).exits(1).err;
    let beside =
        scratch.names(".").into_iter().find(|name| name.starts_with(".out.new-")).unwrap_or_else(|| panic!("{error}"));
    let expected = format!(
        "; {beside} keeps the last checkpoint\n  out is as it was; free some space and go on with --out {beside} --resume\n"
    );
    assert!(error.ends_with(&expected), "{error}");
    assert!(scratch.snapshot("out") == before, "the run that was there is not");
    scratch.bedload(case(&["--out", &beside, "--resume"])).exits(0);
    assert!(written(&scratch, &beside) == whole, "the run that went on differs");
}

#[test]
fn a_study_keeps_its_finished_points() {
    let scratch = Scratch::new();
    scratch.bedload(["sweep", "bed_ouriemi-laminar-exact", "--over", "grid.cells=50,100", "--out", "small"]).exits(0);
    let limit = 2 * largest(&scratch, "small") + 16;
    let study = |flag: &str| format!("{SWEEP} --out s {flag}");
    let answer = limited(&scratch, limit, &study("--json")).exits(1).json();
    let (message, hint) = (answer["error"]["message"].as_str().unwrap(), answer["error"]["hint"].as_str().unwrap());
    assert_eq!(answer["error"]["code"], "write-failed");
    assert!(message.starts_with("writing s/points/") && message.ends_with("; s keeps 2 finished points"), "{message}");
    assert_eq!(hint, "free some space and go on with --resume");
    assert_eq!((scratch.names("s"), scratch.names("s/points").len()), (vec!["points".into(), "study.json".into()], 2));
    let kept = scratch.snapshot("s/points");
    // Still full: again nothing is lost.
    let error = limited(&scratch, limit, &study("--resume")).exits(1).err;
    assert!(error.contains("; s keeps 2 finished points"), "{error}");
    assert!(scratch.snapshot("s/points") == kept);
    let reported = scratch.shell(&format!("exec \"$BEDLOAD\" {}", study("--resume"))).exits(0).out;
    assert!(reported.contains("3 points, 3 done (2 before)"), "{reported}");
    let after = scratch.snapshot("s/points");
    assert!(kept.iter().all(|(file, content)| after.get(file) == Some(content)), "a finished point was run again");
    // Once more over the finished one: that stays, and nothing beside it.
    let before = scratch.snapshot("s");
    let error = limited(&scratch, limit, &study("")).exits(1).err;
    assert!(error.contains("nothing that stood there before was touched"), "{error}");
    assert!(scratch.snapshot("s") == before && scratch.names(".") == ["s", "small"], "{:?}", scratch.names("."));
    // Over another one: both stay.
    let before = scratch.snapshot("small");
    let error = limited(&scratch, limit, &format!("{SWEEP} --out small --force")).exits(1).err;
    let beside = scratch.names(".").into_iter().find(|name| name.starts_with(".small.new-")).unwrap();
    let expected = format!(
        "; {beside} keeps 2 finished points\n  small is as it was; free some space and go on with --out {beside} --resume\n"
    );
    assert!(error.ends_with(&expected), "{error}");
    assert!(scratch.snapshot("small") == before);
    let reported = scratch.shell(&format!("exec \"$BEDLOAD\" {SWEEP} --out {beside} --resume")).exits(0).out;
    assert!(reported.contains("3 points, 3 done (2 before)"), "{reported}");
    // Where no point is finished there is nothing to keep.
    limited(&scratch, 1, &format!("{SWEEP} --out none")).exits(1);
    assert!(!scratch.path("none").exists());
}

#[test]
fn a_disk_that_fills_keeps_the_points_that_fit() {
    let scratch = Scratch::new();
    let probe = scratch.shell("mkdir disk && unshare -m mount -t tmpfs -o size=1m none disk");
    if probe.code != 0 {
        println!("skipped: no disk in memory on this system: {}", probe.err);
        return;
    }
    let sweep = "sweep bed_ouriemi-laminar-exact --over 'flow.pressure_gradient=800:1400:16 Pa/m' --threads 1 --out s";
    // A point takes five files: each of them is the one that does not fit in one of these.
    let files = (40..45).map(|files| format!("size=50m,nr_inodes={files}"));
    for full in files.chain(["size=1m".to_owned()]) {
        // The disk is only there for the shell inside; what it says comes out in two parts.
        let inside = format!(
            "mount -t tmpfs -o {full} none disk; cd disk; \"$BEDLOAD\" {sweep}; echo code $?; \
             mount -o remount,size=50m,nr_inodes=10000 \"$PWD\"; \"$BEDLOAD\" {sweep} --resume"
        );
        let reported = scratch.shell(&format!("exec unshare -m sh -c '{}'", inside.replace('\'', "'\\''"))).exits(0);
        assert!(reported.out.starts_with("code 1\n"), "{full}: {}{}", reported.out, reported.err);
        let kept =
            reported.err.split("; s keeps ").nth(1).and_then(|rest| rest.split(' ').next()?.parse::<usize>().ok());
        let kept = kept.unwrap_or_else(|| panic!("{full}: {}", reported.err));
        assert!((1..16).contains(&kept) && reported.err.contains("--resume"), "{full}: {}", reported.err);
        assert!(reported.out.contains(&format!("16 points, 16 done ({kept} before)")), "{full}: {}", reported.out);
    }
}

#[test]
fn a_run_that_cannot_take_its_place_stays_beside() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "out", "--quiet"]).exits(0);
    let long =
        ["run", "bed_ouriemi-laminar-exact", "--set", "grid.cells=1000000", "--out", "out", "--force", "--quiet"];
    let child = scratch.command().args(long).stderr(Stdio::piped()).spawn().unwrap();
    let beside = format!(".out.new-{}", child.id());
    let begin = Instant::now();
    while !scratch.path(&beside).join("summary.json").exists() {
        assert!(begin.elapsed() < Duration::from_secs(60), "{beside} does not appear");
        sleep(Duration::from_millis(1));
    }
    fs::rename(scratch.path("out"), scratch.path("elsewhere")).unwrap();
    scratch.write("out", "mine");
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains(&format!("; {beside} keeps the complete result\n  out is as it was; move ")), "{error}");
    assert_eq!(scratch.summary(&beside)["status"], "done");
    assert_eq!(scratch.read("out"), "mine");
    assert_eq!(scratch.names("."), [&beside, "elsewhere", "out"]);
}
