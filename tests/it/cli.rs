//! The command line: every verb, every exit code, what goes to which stream.

use std::fs;

use serde_json::{Value, json};

use crate::support::{Scratch, files, project};

/// The verbs of the program.
fn verbs(scratch: &Scratch) -> Vec<String> {
    let help = scratch.bedload(["--help"]).exits(0).out;
    let list = help.split_once("Commands:\n").and_then(|(_, rest)| rest.split_once("\n\n")).map(|(list, _)| list);
    // What begins further in is the rest of a long line.
    let names = list.unwrap().lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let verbs: Vec<String> = names.filter(|name| !["", "help"].contains(name)).map(str::to_owned).collect();
    let files = files(&project("src/cli"), "rs");
    let written = files.iter().filter(|file| fs::read_to_string(file).unwrap().contains("impl Verb for"));
    // One file is that of all verbs.
    assert_eq!(verbs.len(), written.count() - 1, "{verbs:?}");
    verbs
}

#[test]
fn every_verb_has_help() {
    let scratch = Scratch::new();
    let top = scratch.bedload(["--help"]).exits(0).out;
    for verb in &verbs(&scratch) {
        assert!(top.contains(&format!("\n  {verb} ")), "{verb} is not in\n{top}");
        let help = scratch.bedload([verb.as_str(), "--help"]).exits(0).out;
        assert!(help.contains("Usage: bedload"), "{help}");
    }
    assert!(top.contains("Exit codes: 0 done; 1 "), "{top}");
    let version = scratch.bedload(["--version"]).exits(0).out;
    assert_eq!(version.trim(), format!("bedload {}", env!("CARGO_PKG_VERSION")));
}

#[test]
fn wrong_usage_exits_2_on_standard_error() {
    let scratch = Scratch::new();
    for arguments in [
        &[] as &[&str],
        &["fly"],
        &["run"],
        &["run", "exact_1d_bagnold", "--threads", "0"],
        &["run", "exact_1d_bagnold", "--threads", "many"],
        &["run", "exact_1d_bagnold", "--fast"],
        &["check"],
        &["completions", "tcl"],
        &["list", "planets"],
        &["report"],
    ] {
        let answer = scratch.bedload(arguments).exits(2);
        assert!(answer.out.is_empty() && !answer.err.is_empty(), "{arguments:?}: {}", answer.out);
    }
    assert!(scratch.names(".").is_empty());
}

#[test]
fn run_ends_with_at_most_twelve_lines() {
    let scratch = Scratch::new();
    for case in bedload::case::shipped::quick() {
        let answer = scratch.bedload(["run", case]).exits(0);
        let lines: Vec<&str> = answer.out.lines().collect();
        assert!((5..=12).contains(&lines.len()), "{case}: {} lines", lines.len());
        for label in ["balances", "regime", "cost", "report", "next"] {
            let found = lines.iter().filter(|l| l.trim_start().starts_with(label)).count();
            assert_eq!(found, 1, "{label} in\n{}", answer.out);
        }
        assert!(lines.last().unwrap().contains("bedload "), "no next command");
        assert!(answer.out.contains(&format!("runs/{case}/report.html")), "{}", answer.out);
        assert!(answer.err.is_empty(), "progress where there is no terminal: {}", answer.err);
    }
}

#[test]
fn quiet_prints_nothing() {
    let scratch = Scratch::new();
    let answer = scratch.bedload(["run", "exact_1d_bagnold", "--quiet"]).exits(0);
    assert_eq!((answer.out.as_str(), answer.err.as_str()), ("", ""));
}

#[test]
fn json_is_the_summary_and_where_it_is() {
    let scratch = Scratch::new();
    let answer = scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "here", "--json"]).exits(0);
    assert!(answer.err.is_empty(), "{}", answer.err);
    let mut json = answer.json();
    assert_eq!(json.as_object_mut().unwrap().remove("out"), Some(Value::from("here")));
    assert_eq!(json, scratch.summary("here"));
    let quiet = scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--out", "here", "--json", "--quiet"]).exits(0);
    assert_eq!(quiet.json()["status"], "done");
}

#[test]
fn json_of_a_wrong_case_is_one_object_with_the_error() {
    let scratch = Scratch::new();
    let wrong = ["--set", "bed.phi=0.9", "--set", "flow.hieght=1"];
    let json = scratch.bedload(["run", "exact_1d_aussillous", "--json"].iter().chain(&wrong)).exits(2).json();
    assert_eq!(json["status"], "failed");
    let keys: Vec<&String> = json["error"].as_object().unwrap().keys().collect();
    assert_eq!(keys, ["code", "message", "path", "line", "allowed", "hint"]);
    assert_eq!(json["error"]["path"], "bed.phi");
    assert_eq!(json["error"]["line"], Value::Null, "an override has no line");
    assert_eq!(json["errors"].as_array().unwrap().len(), 2, "{json}");
    assert!(scratch.names(".").is_empty());
}

#[test]
fn a_panic_is_called_a_bug_only_if_it_is_one() {
    let scratch = Scratch::new();
    for arguments in [["check", "nowhere"], ["report", "nowhere"], ["explain", "nowhere"]] {
        assert!(!scratch.bedload(arguments).exits(2).err.contains("bug"));
    }
}

#[test]
fn check_says_valid_and_writes_nothing() {
    let scratch = Scratch::new();
    let json = scratch.bedload(["check", "exact_1d_bagnold", "--json"]).exits(0).json();
    let wanted = json!({ "status": "valid", "case": "exact_1d_bagnold", "model": "bagnold-film" });
    assert_eq!(json, wanted);
    let said = scratch.bedload(["check", "exact_1d_bagnold", "--set", "grid.cells=77"]).exits(0).out;
    assert!(said.contains("77 levels"), "{said}");
    assert!(scratch.names(".").is_empty());
}

#[test]
fn list_shows_models_cases_and_closures() {
    let scratch = Scratch::new();
    let json = scratch.bedload(["list", "--json"]).exits(0).json();
    let names = |what: &str| -> Vec<String> {
        json[what].as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names("cases"), bedload::case::shipped::names().collect::<Vec<_>>());
    assert!(names("models").contains(&"laminar-exact".to_owned()));
    assert!(names("closures").contains(&"friction/mu-i".to_owned()));
    for rows in json.as_object().unwrap().values() {
        let silent = rows.as_array().unwrap().iter().find(|row| row["about"].as_str().unwrap().is_empty());
        assert_eq!(silent, None, "says nothing of itself");
    }
    let text = scratch.bedload(["list"]).exits(0).out;
    for name in ["models", "cases", "closures"].iter().flat_map(|w| names(w)) {
        assert!(text.contains(&name), "{name} is not in\n{text}");
    }
    let cases = scratch.bedload(["list", "cases"]).exits(0).out;
    assert!(cases.starts_with("cases\n") && !cases.contains("closures"), "{cases}");
}

#[test]
fn explain_fills_in_the_numbers() {
    let scratch = Scratch::new();
    let text = scratch.bedload(["explain", "exact_1d_aussillous"]).exits(0).out;
    for piece in ["0.19200", "closures.friction, coulomb", "U'' + f = 0", "laminar-exact, mixed"] {
        assert!(text.contains(piece), "{piece} is not in\n{text}");
    }
    let other = scratch.bedload(["explain", "exact_1d_aussillous", "--set", "closures.friction.mu_s=0.4"]).exits(0).out;
    assert!(other.contains("0.24000") && !other.contains("0.19200"), "{other}");
    for case in bedload::case::shipped::names() {
        let text = scratch.bedload(["explain", case]).exits(0).out;
        assert!(text.lines().count() > 5 && !text.contains("NaN"), "{text}");
    }
}

#[test]
fn new_writes_a_case_that_runs_and_never_over_another_file() {
    let scratch = Scratch::new();
    let said = scratch.bedload(["new", "exact_1d_bagnold", "mine.toml"]).exits(0).out;
    assert!(said.contains("bedload run mine.toml"), "{said}");
    scratch.bedload(["run", "mine.toml"]).exits(0);
    assert_eq!(scratch.names("runs"), ["mine"]);
    scratch.write("mine.toml", "precious");
    let said = scratch.bedload(["new", "exact_1d_bagnold", "mine.toml"]).exits(2).err;
    assert!(said.contains("mine.toml is there already") && said.contains("--force"), "{said}");
    assert_eq!(scratch.read("mine.toml"), "precious");
    scratch.bedload(["new", "exact_1d_bagnold", "mine.toml", "--force"]).exits(0);
    let written = scratch.read("mine.toml");
    assert!(written.starts_with("# "), "{written}");
    let printed = scratch.bedload(["new", "exact_1d_bagnold", "-"]).exits(0).out;
    assert_eq!(printed, written);
    let said = scratch.bedload(["new", "exact_1d_bagnodl", "other.toml"]).exits(2).err;
    assert!(said.contains("did you mean \"exact_1d_bagnold\"?"), "{said}");
    scratch.bedload(["new", "exact_1d_bagnold", "no/folder/x.toml"]).exits(2);
    assert!(!scratch.path("other.toml").exists() && !scratch.path("no").exists());
}

#[test]
fn completions_know_the_verbs() {
    let scratch = Scratch::new();
    for shell in ["bash", "zsh", "fish"] {
        let script = scratch.bedload(["completions", shell]).exits(0).out;
        for verb in &verbs(&scratch) {
            assert!(script.contains(verb.as_str()), "{shell} does not know {verb}");
        }
    }
}

#[test]
fn the_manual_has_a_page_for_each_verb_and_replaces_nothing_but_itself() {
    let scratch = Scratch::new();
    let mut pages = vec!["bedload.1".to_owned()];
    pages.extend(verbs(&scratch).iter().map(|verb| format!("bedload-{verb}.1")));
    pages.sort();
    scratch.write("other.1", "theirs");
    let said = scratch.bedload(["man", "--out", "share/man1"]).exits(0).out;
    assert_eq!(said, format!("wrote {} pages to share/man1\n", pages.len()));
    assert_eq!(scratch.names("share/man1"), pages);
    let first = scratch.read("share/man1/bedload.1");
    for page in &pages {
        let text = scratch.read(format!("share/man1/{page}").as_str());
        let name = page.trim_end_matches(".1").replace('-', "\\-");
        assert!(first.contains(&name) && text.contains(&format!("{name} \\- ")), "{page}: {text}");
        assert!(text.contains("Exit codes: 0 done; 1 "), "{page}: {text}");
    }
    let printed = scratch.bedload(["man"]).exits(0).out;
    assert!(printed.starts_with(&first) && printed.matches(".TH bedload").count() == pages.len());
    // Its own pages are replaced, whatever their version, beside those of others.
    scratch.write("share/man1/bedload-run.1", first.replace("TH bedload ", "TH bedload-run "));
    scratch.write("share/man1/other.1", "theirs");
    scratch.bedload(["man", "--out", "share/man1"]).exits(0);
    assert!(scratch.read("share/man1/bedload-run.1").contains("bedload\\-run"));
    scratch.write("share/man1/bedload-run.1", "a page about beds, runs and loads");
    scratch.write("share/man1/bedload.1", "");
    let said = scratch.bedload(["man", "--out", "share/man1"]).exits(2).err;
    assert!(said.contains("bedload-run.1 was not written by bedload"), "{said}");
    assert_eq!(
        (scratch.read("share/man1/bedload.1").as_str(), scratch.read("share/man1/other.1").as_str()),
        ("", "theirs")
    );
    scratch.bedload(["man", "--out", "other.1"]).exits(2);
    assert_eq!(scratch.read("other.1"), "theirs");
}

#[cfg(unix)]
#[test]
fn the_manual_can_be_read() {
    let scratch = Scratch::new();
    if scratch.shell("man --version && man -l /dev/null").code != 0 {
        println!("skipped: no man");
        return;
    }
    let read = scratch.shell("$BEDLOAD man | man --warnings -l - 2>&1");
    assert!(read.out.contains("bedload-run(1)"), "{}", read.out);
}
