//! What a change costs, by making it: patches that add a law, a model, a column, a verb and a figure touch no more than they may,
//! and the program with all of them compiles and has them.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::{Scratch, project};

/// A patch: files that it adds, files that it changes, and lines that it adds to those.
const PATCHES: &[(&str, usize, usize, usize)] =
    &[("law", 1, 1, 1), ("model", 1, 1, 1), ("column", 0, 2, 2), ("verb", 1, 1, 3), ("figure", 1, 1, 1)];

/// What else a project is made of.
const FILES: &[&str] =
    &["Cargo.toml", "Cargo.lock", "build.rs", "README.md", "src", "cases", "docs", "benches", "tests", "examples"];

/// Files added, files changed, lines added to those, lines removed.
fn cost(patch: &str) -> [usize; 4] {
    let mut cost = [0; 4];
    for file in patch.split("diff --git ").skip(1) {
        let (head, body) = file.split_once("\n@@").unwrap_or((file, ""));
        let lines = |sign: char| body.lines().filter(|line| line.starts_with(sign)).count();
        if head.contains("new file mode") {
            cost[0] += 1;
        } else {
            cost[1] += 1;
            cost[2] += lines('+');
        }
        cost[3] += lines('-');
    }
    cost
}

fn copy(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::copy(from, to).unwrap();
        return;
    }
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        copy(&entry.path(), &to.join(entry.file_name()));
    }
}

#[test]
fn a_change_touches_what_it_may_and_compiles() {
    let patch = |name: &str| project(&format!("tests/patches/{name}.patch"));
    for &(name, new, changed, lines) in PATCHES {
        let text = fs::read_to_string(patch(name)).unwrap();
        assert_eq!(cost(&text), [new, changed, lines, 0], "{name}");
    }
    let scratch = Scratch::new();
    for file in FILES {
        copy(&project(file), &scratch.path(file));
    }
    let run = |command: &mut Command| {
        let output = command.current_dir(scratch.path(".")).output();
        let Ok(output) = output else { return false };
        assert!(output.status.success(), "{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
        true
    };
    for &(name, ..) in PATCHES {
        if !run(Command::new("git").arg("apply").arg(patch(name))) {
            println!("skipped: no git");
            return;
        }
    }
    // Checked, not built: nothing that other tests run is written over, and clippy finds the dependencies checked.
    let target = Path::new(env!("CARGO_BIN_EXE_bedload")).ancestors().nth(2).unwrap();
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut check = Command::new(cargo);
    check.args(["check", "--release", "--offline", "--quiet", "--lib", "--bins"]).env("CARGO_TARGET_DIR", target);
    if !run(&mut check) {
        println!("skipped: no cargo");
    }
}

#[test]
fn the_cost_of_a_patch_is_counted() {
    let text = "diff --git a/new b/new\nnew file mode 100644\n--- /dev/null\n+++ b/new\n@@ -0,0 +1 @@\n+one\n\
                diff --git a/old b/old\n--- a/old\n+++ b/old\n@@ -1,2 +1,3 @@\n one\n+two\n+three\n-four\n";
    assert_eq!(cost(text), [1, 1, 2, 1]);
}
