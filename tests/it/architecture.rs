//! Imports go only upward: every `crate::` path in `src/` leads to a room above its own. And files stay short.

use std::fs;
use std::path::Path;

use crate::support::{files, project};

/// The rooms of `src/lib.rs`, from the top. Rooms of one row do not know each other.
const RANKS: &[&[&str]] = &[
    &["units", "numerics", "runtime"],
    &["closures", "result"],
    &["case"],
    &["problem"],
    &["column"],
    &["continuum", "discrete", "section"],
    &["run"],
    &["plot"],
    &["compare"],
    &["output"],
    &["study", "advise"],
    &["validate"],
    &["cli"],
];

/// Items that the crate exports at its root, all of the room `run`.
const OF_RUN: &[&str] = &["run", "equations", "laws"];

const LONGEST_FILE: usize = 400;

fn rank(room: &str) -> Option<usize> {
    RANKS.iter().position(|rooms| rooms.contains(&room))
}

/// The text without comments, and without the content of string literals.
fn code(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '/' if chars.peek() == Some(&'/') => while chars.next_if(|&c| c != '\n').is_some() {},
            '"' => {
                while let Some(c) = chars.next() {
                    match c {
                        '\\' => drop(chars.next()),
                        '"' => break,
                        _ => {}
                    }
                }
                plain.push_str("\"\"");
            }
            '\'' => {
                // A character literal or a lifetime.
                let mut ahead = chars.clone();
                let first = ahead.next();
                if first == Some('\\') || ahead.next() == Some('\'') {
                    if first == Some('\\') {
                        chars.next();
                    }
                    chars.next();
                    while chars.next().is_some_and(|c| c != '\'') {}
                }
            }
            _ => plain.push(c),
        }
    }
    plain
}

fn identifier(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The first segments of a path, or of each path of a group: `a::b`, `{a, b::{c, d}}`.
fn heads(text: &str) -> Vec<String> {
    let text = text.trim_start();
    let Some(group) = text.strip_prefix('{') else {
        return vec![text.chars().take_while(|&c| identifier(c)).collect()];
    };
    let (mut heads, mut depth, mut item) = (Vec::new(), 0, String::new());
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => heads.push(std::mem::take(&mut item)),
            _ if depth == 0 => item.push(c),
            _ => {}
        }
    }
    heads.push(item);
    let first = |item: &String| item.trim().chars().take_while(|&c| identifier(c)).collect::<String>();
    heads.iter().map(first).filter(|head| !head.is_empty()).collect()
}

/// What the code names after `prefix`, such as `crate::`, where that is a word of its own.
fn named<'a>(code: &'a str, prefix: &'a str) -> impl Iterator<Item = String> + 'a {
    code.match_indices(prefix)
        .filter(|(i, _)| !code[..*i].ends_with(|c| identifier(c) || c == ':'))
        .flat_map(move |(i, _)| heads(&code[i + prefix.len()..]))
}

/// The paths of a file that do not lead upward from `room`; `depth` is that of its module, 1 for `room/mod.rs`.
fn downward(room: &str, depth: usize, text: &str) -> Vec<String> {
    let code = code(text);
    let own = rank(room);
    let mut wrong = Vec::new();
    for name in named(&code, "crate::") {
        let target = if OF_RUN.contains(&name.as_str()) { "run" } else { &name };
        let upward = matches!((rank(target), own), (Some(to), Some(from)) if to < from);
        if target != room && !upward {
            wrong.push(format!("crate::{name}"));
        }
    }
    // A chain of `super` long enough to leave the room must be written as a path from the crate.
    for level in depth..=depth + 2 {
        let chain = "super::".repeat(level);
        let leaves = |name: &String| rank(name).is_some() && name != room;
        wrong.extend(named(&code, &chain).filter(leaves).map(|name| format!("{chain}{name}")));
    }
    wrong
}

/// The room of a file of `src/` and the depth of its module; `None` for `lib.rs` and `main.rs`.
fn place(file: &Path) -> Option<(String, usize)> {
    let inside = file.strip_prefix(project("src")).unwrap();
    let mut parts: Vec<String> =
        inside.iter().map(|p| p.to_str().unwrap().trim_end_matches(".rs").to_owned()).collect();
    if parts == ["lib"] || parts == ["main"] {
        return None;
    }
    if parts.last().is_some_and(|last| last == "mod") {
        parts.pop();
    }
    Some((parts[0].clone(), parts.len()))
}

#[test]
fn imports_go_only_upward() {
    let sources = files(&project("src"), "rs");
    assert!(sources.len() > 50, "{} files", sources.len());
    let mut wrong = Vec::new();
    let mut paths = 0;
    for file in &sources {
        let text = fs::read_to_string(file).unwrap();
        let Some((room, depth)) = place(file) else { continue };
        let name = file.strip_prefix(project("")).unwrap().display().to_string();
        if rank(&room).is_none() {
            wrong.push(format!("{name}: the room {room} has no rank"));
        }
        paths += named(&code(&text), "crate::").count();
        wrong.extend(downward(&room, depth, &text).into_iter().map(|path| format!("{name}: {path}")));
    }
    assert!(paths > 100, "only {paths} paths were seen");
    assert!(wrong.is_empty(), "not upward:\n{}", wrong.join("\n"));
}

#[test]
fn a_wrong_import_is_seen() {
    let wrong = |room, depth, text| downward(room, depth, text).join(" ");
    assert_eq!(wrong("case", 2, "use crate::units; use crate::case::Fault;"), "");
    assert_eq!(wrong("case", 2, "use crate::problem::Problem;"), "crate::problem");
    assert_eq!(wrong("closures", 2, "use crate::result::Outcome;"), "crate::result");
    let nested = "use crate::{\n    units::{self, Unit},\n    cli, plot::{a::{b, c}, d},\n};";
    assert_eq!(wrong("problem", 1, nested), "crate::cli crate::plot");
    assert_eq!(wrong("problem", 1, "fn f() { let x = crate::run(&p); }"), "crate::run");
    assert_eq!(wrong("output", 1, "let x = p.describe().equations; // crate::cli\nlet y = \"crate::cli\";"), "");
    assert_eq!(wrong("plot", 1, "let c = '\"'; let x: &'a str = crate::output::y;"), "crate::output");
    assert_eq!(wrong("case", 1, "use super::plot::Page;"), "super::plot");
    assert_eq!(wrong("case", 2, "use super::super::plot; use super::fault::Fault;"), "super::super::plot");
    assert_eq!(wrong("run", 1, "use crate::models::exact; pub(crate) fn f() {}"), "");
    assert_eq!(wrong("units", 1, "use crate::somewhere::x;"), "crate::somewhere");
}

#[test]
fn files_stay_short() {
    let mut long = Vec::new();
    for file in files(&project("src"), "rs").iter().chain(&files(&project("tests"), "rs")) {
        let lines = fs::read_to_string(file).unwrap().lines().count();
        if lines > LONGEST_FILE {
            long.push(format!("{}: {lines} lines", file.strip_prefix(project("")).unwrap().display()));
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn the_map_in_the_crate_docs_has_every_room() {
    let library = fs::read_to_string(project("src/lib.rs")).unwrap();
    let rooms = library.lines().filter_map(|l| l.strip_prefix("pub mod ").or_else(|| l.strip_prefix("mod ")));
    for room in rooms.map(|r| r.trim_end_matches(';')) {
        assert!(rank(room).is_some(), "{room} has no rank here");
        assert!(
            library.contains(&format!("[`{room}`]")) || library.contains(&format!("| `{room}` |")),
            "{room} is not on the map"
        );
    }
}
