//! The library alone brings no command line and no figures.

use std::process::Command;

use crate::support::project;

/// The crates that the library links with some features, by name; `None` without cargo.
fn linked(features: &[&str]) -> Option<Vec<String>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tree = Command::new(cargo);
    tree.args(["tree", "--offline", "--edges", "normal", "--prefix", "none"]).args(features).current_dir(project(""));
    let Ok(output) = tree.output() else {
        println!("skipped: no cargo");
        return None;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let names = |line: &str| line.split(' ').next().map(str::to_owned);
    Some(String::from_utf8(output.stdout).unwrap().lines().filter_map(names).collect())
}

#[test]
fn the_solvers_alone_link_no_command_line_and_no_figures() {
    let faces = ["clap", "clap_complete", "clap_mangen", "ctrlc", "miette", "plotters"];
    let found =
        |features: &[&str]| linked(features).map(|names| faces.map(|face| names.iter().any(|name| name == face)));
    let (Some(whole), Some(figures), Some(alone)) =
        (found(&[]), found(&["--no-default-features", "--features", "plot"]), found(&["--no-default-features"]))
    else {
        return;
    };
    assert_eq!(whole, [true; 6], "{faces:?}");
    assert_eq!(figures, [false, false, false, false, false, true], "{faces:?}");
    assert_eq!(alone, [false; 6], "{faces:?}");
}
