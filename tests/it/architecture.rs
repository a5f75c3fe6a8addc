//! Which module may know which: every `crate::` path in `src/` is an edge of a list, and nothing but an edge of the list.
//! The picture of it in `docs/design.md` is made from the code here. And files stay short.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use bedload::models::builtin;

use crate::support::{files, project};

/// Every module and those it may name. A model is a module of its own; what the models share is `models`.
const ALLOWED: &[(&str, &[&str])] = &[
    ("units", &[]),
    ("numerics", &[]),
    ("runtime", &[]),
    ("closures", &["numerics", "runtime"]),
    ("result", &["units"]),
    ("case", &["units", "closures", "result"]),
    ("column", &["closures", "numerics"]),
    ("dem", &["closures", "numerics", "result", "runtime", "units"]),
    ("scene", &["case", "closures", "result"]),
    ("model", &["case", "closures", "result", "scene"]),
    ("models", &["case", "closures", "dem", "model", "models::exact", "result", "scene"]),
    ("plot", &["result", "units"]),
    ("compare", &["case", "plot", "result", "units"]),
    ("output", &["plot", "result", "units"]),
    ("study", &["case", "closures", "compare", "model", "numerics", "output", "plot", "result", "runtime", "units"]),
    ("advise", &["case", "model", "result", "units"]),
    ("prelude", &["case", "model", "models", "result", "scene"]),
    ("validate", &["advise", "case", "model", "plot", "result", "study", "units"]),
    (
        "cli",
        &[
            "advise", "case", "closures", "compare", "model", "output", "plot", "result", "runtime", "scene", "study",
            "units", "validate",
        ],
    ),
];

/// What any model may name; besides that, the models that [`BETWEEN_MODELS`] lists.
const OF_A_MODEL: &[&str] =
    &["case", "closures", "column", "dem", "model", "models", "numerics", "result", "runtime", "scene", "units"];

/// A model that takes something of another, and what.
const BETWEEN_MODELS: &[(&str, &str, &str)] = &[
    ("models::laminar", "models::exact", "its bed, its closed form, how results are reported"),
    ("models::bingham", "models::exact", "its plane and its closed form"),
    ("models::bingham", "models::laminar", "the mesh and the elements of a plane flow"),
    ("models::section", "models::exact", "the bed of a duct, which is that of a plane flow"),
    ("models::sheet_flow", "models::exact", "how closures out of range are reported"),
    ("models::two_fluid", "models::exact", "how results and closures out of range are reported"),
    ("models::shear_cell", "models::exact", "how results are reported"),
];

/// Edges that should not be: this list may only become shorter.
const DEBTS: &[(&str, &str)] = &[];

const LONGEST_FILE: usize = 400;

/// The text without comments, and without the content of string literals.
pub(super) fn code(text: &str) -> String {
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

/// The paths of a text that begins after a prefix: `a::b`, `{a, b::{c, d}}` is `a`, `b::c`, `b::d`.
fn spelt(text: &str) -> Vec<Vec<String>> {
    let text = text.trim_start();
    let Some(group) = text.strip_prefix('{') else {
        let first: String = text.chars().take_while(|&c| identifier(c)).collect();
        let Some(rest) = text[first.len()..].strip_prefix("::") else { return vec![vec![first]] };
        return spelt(rest).into_iter().map(|path| [vec![first.clone()], path].concat()).collect();
    };
    let (mut items, mut depth, mut item) = (Vec::new(), 0, String::new());
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                items.push(std::mem::take(&mut item));
                continue;
            }
            _ => {}
        }
        item.push(c);
    }
    items.push(item);
    items.iter().filter(|item| !item.trim().is_empty()).flat_map(|item| spelt(item)).collect()
}

/// What the code names after `prefix`, such as `crate::`, where that is a word of its own.
pub(super) fn paths(code: &str, prefix: &str) -> Vec<Vec<String>> {
    code.match_indices(prefix)
        .filter(|(i, _)| !code[..*i].ends_with(|c| identifier(c) || c == ':'))
        .flat_map(|(i, _)| spelt(&code[i + prefix.len()..]))
        .filter(|path| path.first().is_some_and(|first| !first.is_empty()))
        .collect()
}

/// The module that a path leads to: `models::<one>` for a model.
fn target(path: &[String]) -> Option<String> {
    match path {
        [first, second, ..] if first == "models" && models().contains(second) => Some(format!("models::{second}")),
        [first, ..] => known(first).then(|| first.clone()),
        [] => None,
    }
}

fn known(module: &str) -> bool {
    ALLOWED.iter().any(|(name, _)| *name == module)
}

/// The folders of the models.
fn models() -> BTreeSet<String> {
    let entries = fs::read_dir(project("src/models")).unwrap().map(|entry| entry.unwrap());
    let folders = entries.filter(|entry| entry.file_type().unwrap().is_dir());
    folders.map(|entry| entry.file_name().into_string().unwrap()).collect()
}

/// The modules that a file names, besides its own; `depth` is that of its module, 1 for `case/mod.rs`.
fn edges(own: &str, depth: usize, text: &str) -> Vec<String> {
    let code = code(text);
    let mut paths: Vec<Vec<String>> = paths(&code, "crate::");
    // A chain of `super` long enough to leave the module.
    for level in depth..=depth + 2 {
        let chain = "super::".repeat(level);
        paths.extend(self::paths(&code, &chain).into_iter().filter(|path| target(path).is_some()));
    }
    // One step less leads from a model to its neighbours.
    if own.starts_with("models") && depth > 1 {
        let beside = self::paths(&code, &"super::".repeat(depth - 1)).into_iter();
        let beside = beside.map(|path| [vec!["models".to_owned()], path].concat());
        paths.extend(beside.filter(|path| target(path).is_some_and(|to| to != "models")));
    }
    let mut found = Vec::new();
    for path in paths {
        let name = target(&path).unwrap_or_else(|| path.join("::"));
        // Macros stand at the root of the crate.
        if name != own && name != "tables" && name != "part" && !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// The module of a file of `src/` and the depth of its place; `None` for `lib.rs` and `main.rs`.
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
    let own = target(&parts).unwrap_or_else(|| parts[0].clone());
    Some((own, parts.len()))
}

/// Tests of a module may take what they need to be tests.
pub(super) fn is_test(file: &Path) -> bool {
    file.iter().any(|part| ["tests", "tests.rs", "samples.rs"].iter().any(|test| part == *test))
        && file.strip_prefix(project("src/models/grains")).is_err()
}

/// The text of a file without the tests at its end.
pub(super) fn without_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text)
}

/// How often each module names each other one.
fn found() -> BTreeMap<(String, String), usize> {
    let mut found = BTreeMap::new();
    for file in files(&project("src"), "rs").iter().filter(|file| !is_test(file)) {
        let text = fs::read_to_string(file).unwrap();
        let Some((own, depth)) = place(file) else { continue };
        for edge in edges(&own, depth, without_tests(&text)) {
            *found.entry((own.clone(), edge)).or_insert(0) += 1;
        }
    }
    found
}

fn allowed(from: &str, to: &str) -> bool {
    let list = ALLOWED.iter().find(|(name, _)| *name == from).map(|(_, list)| *list);
    match list {
        Some(list) => list.contains(&to) || from == "models" && to.starts_with("models::"),
        None => OF_A_MODEL.contains(&to) || BETWEEN_MODELS.iter().any(|(a, b, _)| *a == from && *b == to),
    }
}

#[test]
fn modules_know_what_the_list_says() {
    let found = found();
    assert!(found.len() > 60, "only {} edges were seen", found.len());
    let debt = |from: &str, to: &str| DEBTS.iter().any(|(a, b)| *a == from && *b == to);
    let wrong = found.keys().filter(|(from, to)| !allowed(from, to) && !debt(from, to));
    let wrong: Vec<String> = wrong.map(|(from, to)| format!("{from} names {to}")).collect();
    assert!(wrong.is_empty(), "not on the list:\n{}", wrong.join("\n"));
    let has = |from: &str, to: &str| found.contains_key(&(from.to_owned(), to.to_owned()));
    let paid = DEBTS.iter().filter(|(from, to)| !has(from, to));
    let paid: Vec<_> = paid.chain(DEBTS.iter().filter(|(from, to)| allowed(from, to))).collect();
    assert!(paid.is_empty(), "paid, to be taken off the list: {paid:?}");
    let unused: Vec<_> = BETWEEN_MODELS.iter().filter(|(from, to, _)| !has(from, to)).collect();
    assert!(unused.is_empty(), "no longer taken: {unused:?}");
}

#[test]
fn a_wrong_edge_is_found() {
    let of = |own, depth, text| edges(own, depth, text).join(" ");
    assert_eq!(of("case", 2, "use crate::units; use crate::case::Fault;"), "units");
    assert_eq!(of("study", 2, "use crate::models::laminar::bed::Bed;"), "models::laminar");
    assert_eq!(of("study", 2, "use crate::models::{laminar, two_fluid::State};"), "models::laminar models::two_fluid");
    let nested = "use crate::{\n    units::{self, Unit},\n    cli, plot::{a::{b, c}, d},\n};";
    assert_eq!(of("model", 1, nested), "units cli plot");
    assert_eq!(of("model", 1, "fn f() { let x = crate::run(&p); }"), "run");
    assert_eq!(of("output", 1, "let x = p.y(); // crate::cli\nlet y = \"crate::cli\";"), "");
    assert_eq!(of("plot", 1, "let c = '\"'; let x: &'a str = crate::output::y;"), "output");
    assert_eq!(of("models::shear_cell", 2, "use super::exact::balance; use super::flow::Flow;"), "models::exact");
    assert_eq!(of("models::laminar", 3, "use super::super::exact::balance; use super::exact::x;"), "models::exact");
    assert_eq!(of("case", 1, "use super::plot::Page;"), "plot");
    assert_eq!(of("case", 2, "use super::super::plot; use super::fault::Fault;"), "plot");
    assert!(!allowed("study", "models::laminar") && !allowed("models::laminar", "plot"));
    assert!(!allowed("units", "somewhere") && allowed("models::laminar", "numerics"));
}

/// A re-export is a path that the list does not see: none leads out of its module but the prelude, which nothing inside uses.
#[test]
fn nothing_is_exported_again_elsewhere() {
    let mut wrong = Vec::new();
    for file in files(&project("src"), "rs").iter().filter(|file| !is_test(file)) {
        let text = fs::read_to_string(file).unwrap();
        let Some((own, _)) = place(file).filter(|(own, _)| own != "prelude") else { continue };
        let exports = code(&text).split("pub use crate::").skip(1).map(str::to_owned).collect::<Vec<_>>();
        for export in exports {
            let path = paths(&format!("crate::{export}"), "crate::").remove(0);
            if target(&path).is_none_or(|to| to != own && !own.starts_with("models")) {
                wrong.push(format!("{}: {}", file.display(), path.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Outside of the models no code compares with the name of one.
#[test]
fn no_name_stands_in_for_a_model() {
    let registry = builtin();
    let names: Vec<&str> = registry.entries().map(|entry| entry.info.name).collect();
    assert!(names.len() > 10);
    let mut wrong = Vec::new();
    for file in files(&project("src"), "rs").iter().filter(|file| !is_test(file)) {
        let text = fs::read_to_string(file).unwrap();
        let Some((own, _)) = place(file) else { continue };
        if own.starts_with("models") {
            continue;
        }
        for (number, line) in without_tests(&text).lines().enumerate() {
            let line = line.split("//").next().unwrap_or(line);
            let matched = |name: &&&str| {
                [format!("\"{name}\" =>"), format!("== \"{name}\""), format!("!= \"{name}\""), format!("(\"{name}\")")]
                    .iter()
                    .any(|text| line.contains(text.as_str()))
            };
            wrong.extend(names.iter().find(matched).map(|name| format!("{}:{}: {name}", file.display(), number + 1)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The modules from the ground up, and what each of them names.
fn picture() -> String {
    let found = found();
    let mut names: Vec<&str> = ALLOWED.iter().map(|(name, _)| *name).collect();
    let models: Vec<String> = models().into_iter().map(|model| format!("models::{model}")).collect();
    let at = names.iter().position(|name| *name == "models").unwrap();
    names.splice(at..at, models.iter().map(String::as_str));
    let mut text = String::from("| module | names |\n|---|---|\n");
    for name in names {
        let to: Vec<String> = found.keys().filter(|(from, _)| from == name).map(|(_, to)| format!("`{to}`")).collect();
        text += &format!("| `{name}` | {} |\n", if to.is_empty() { "-".into() } else { to.join(" ") });
    }
    text
}

#[test]
fn the_picture_of_the_modules_is_that_of_the_code() {
    drawn("modules", "architecture", &picture());
}

/// Requires that docs/design.md has this text between its marks, or writes it there on request.
pub(super) fn drawn(what: &str, file: &str, text: &str) {
    let begin = format!("<!-- {what}: made by tests/it/{file}.rs -->\n");
    let end = format!("<!-- end of {what} -->\n");
    let path = project("docs/design.md");
    let page = fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(&begin).expect("docs/design.md has a place for it");
    let (there, after) = rest.split_once(&end).expect("it ends");
    if there == text {
        return;
    }
    if std::env::var_os("BEDLOAD_GOLDENS").is_some_and(|word| word == "write") {
        fs::write(&path, format!("{before}{begin}{text}{end}{after}")).unwrap();
    } else {
        panic!("out of step; BEDLOAD_GOLDENS=write cargo test --release --test it -- {file}");
    }
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
fn the_map_in_the_crate_docs_has_every_module() {
    let library = fs::read_to_string(project("src/lib.rs")).unwrap();
    // Links are plain code where a feature may leave the module out.
    let map: String = library.lines().filter(|l| l.starts_with("//! | ")).collect::<String>().replace("`mod@", "`");
    let modules = library.lines().filter_map(|l| l.strip_prefix("pub mod ").or_else(|| l.strip_prefix("mod ")));
    for module in modules.map(|m| m.trim_end_matches(';')) {
        assert!(known(module), "{module} is not on the list here");
        assert!(map.contains(&format!("`{module}`")), "{module} is not on the map");
    }
}
