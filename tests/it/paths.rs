//! Cases that cannot be read, folders that cannot be written: exit code 2, and nothing is touched. Tests may run as root,
//! so that permission bits refuse nothing: a path below a file does.

use std::fs;
use std::path::Path;

use crate::support::Scratch;

#[track_caller]
fn refused(scratch: &Scratch, arguments: &[&str], code: &str, pieces: &[&str]) {
    let before = scratch.names(".");
    let json = scratch.bedload(arguments.iter().chain(&["--json"])).exits(2);
    let error = &json.json()["error"];
    assert_eq!(error["code"], code, "{error}");
    let text = scratch.bedload(arguments).exits(2);
    assert!(text.out.is_empty(), "{}", text.out);
    for piece in pieces {
        assert!(text.err.contains(piece), "{piece} is not in {}", text.err);
    }
    assert_eq!(scratch.names("."), before, "{arguments:?}");
}

#[test]
fn cases_that_cannot_be_read() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("folder")).unwrap();
    scratch.write("file", "");
    refused(&scratch, &["check", "folder"], "unreadable", &["cannot read folder", "it is a folder"]);
    refused(&scratch, &["run", "folder"], "unreadable", &["it is a folder"]);
    refused(&scratch, &["check", "no/such/file.toml"], "unreadable", &["cannot read no/such/file.toml"]);
    refused(&scratch, &["check", "./missing.toml"], "unreadable", &["cannot read ./missing.toml"]);
    refused(&scratch, &["check", "file/below.toml"], "unreadable", &["cannot read file/below.toml"]);
    refused(&scratch, &["check", ""], "no-such-case", &["no shipped case \"\""]);
}

#[test]
fn names_that_are_almost_shipped_cases() {
    let scratch = Scratch::new();
    let hint = "did you mean \"exact_1d_bagnold\"?";
    refused(&scratch, &["check", "exact_1d_bagnald"], "no-such-case", &[hint]);
    refused(&scratch, &["run", "Exact_1D_Bagnold.toml"], "no-such-case", &[hint]);
    refused(&scratch, &["check", "seabed"], "no-such-case", &["`bedload list cases`"]);
    let said = scratch.bedload(["explain", "exact_1d_bagnald"]).exits(2).err;
    assert!(said.contains(hint), "{said}");
}

#[test]
fn a_file_of_the_name_of_a_shipped_case_comes_first() {
    let scratch = Scratch::new();
    scratch.write("exact_1d_bagnold", "format = 2\n");
    refused(&scratch, &["check", "exact_1d_bagnold"], "missing-key", &["missing key scene"]);
    scratch.bedload(["check", "exact_1d_bagnold.toml"]).exits(0);
}

#[test]
fn folders_that_cannot_be_written() {
    let scratch = Scratch::new();
    scratch.write("file", "mine");
    let run = |out: &'static str| ["run", "exact_1d_bagnold", "--out", out];
    refused(&scratch, &run("file"), "not-a-folder", &["file is a file, not a folder", "--out"]);
    refused(&scratch, &run("file/below"), "unwritable", &["cannot write file/below", "--out"]);
    refused(&scratch, &run("file/far/below"), "unwritable", &["--out"]);
    refused(&scratch, &["run", "exact_1d_bagnold", "--out", "file", "--force"], "not-a-folder", &[]);
    if Path::new("/proc/self").exists() {
        refused(&scratch, &run("/proc/bedload"), "unwritable", &["cannot write /proc/bedload"]);
        refused(&scratch, &run("/proc/self"), "foreign-folder", &["was not written by bedload"]);
    } else {
        println!("skipped: no /proc on this system");
    }
    assert_eq!(scratch.read("file"), "mine");
}

#[cfg(unix)]
#[test]
fn a_link_to_nowhere_is_not_followed() {
    let scratch = Scratch::new();
    std::os::unix::fs::symlink("nowhere", scratch.path("link")).unwrap();
    refused(&scratch, &["run", "exact_1d_bagnold", "--out", "link"], "not-a-folder", &[]);
    fs::create_dir(scratch.path("real")).unwrap();
    std::os::unix::fs::symlink("real", scratch.path("good")).unwrap();
    for _ in 0..2 {
        scratch.bedload(["run", "exact_1d_bagnold", "--out", "good", "--quiet"]).exits(0);
        assert!(scratch.path("good").is_symlink() && scratch.path("real/summary.json").exists());
    }
}

#[cfg(unix)]
#[test]
fn names_of_files_do_not_command_the_terminal() {
    let scratch = Scratch::new();
    let name = "\u{1b}[31mred\u{9b}2J.toml";
    let bad = bedload::case::shipped::find("exact_1d_bagnold").unwrap().content.replace("mu-i", "mu-j");
    scratch.write(name, bad);
    let titled =
        bedload::case::shipped::find("exact_1d_bagnold").unwrap().content.replace("Bagnold film", "\\u001b[2J\\u009b");
    scratch.write("titled.toml", titled);
    for arguments in [
        vec!["check", name],
        vec!["check", name, "--json"],
        vec!["check", "\u{1b}[31m.toml"],
        vec!["run", "exact_1d_bagnold", "--out", "\u{1b}[31m"],
        vec!["run", "exact_1d_bagnold", "--out", "titled.toml/\u{1b}[31m"],
        vec!["report", "\u{1b}[32m"],
        vec!["explain", "titled.toml"],
        vec!["new", "exact_1d_bagnold", "\u{1b}[33m/x"],
        vec!["new", "\u{1b}[33m", "x"],
    ] {
        let answer = scratch.bedload(&arguments);
        for text in [&answer.out, &answer.err] {
            let control = text.chars().find(|&c| c.is_control() && !matches!(c, '\n' | '\t'));
            assert_eq!(control, None, "{arguments:?}: {text}");
        }
    }
}
