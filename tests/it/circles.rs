//! Files of one module that name each other: each circle has its reason here, and the table of them in `docs/design.md` is made from it.
//! A `mod.rs` and its files are one thing, so it is followed through and is no station of a circle.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use super::architecture::{code, drawn, is_test, paths, without_tests};
use crate::support::{files, project};

/// A problem's type carries the methods of `Solve`; each is answered in a file of its own, and that takes the problem.
const METHODS: &str = "the problem's methods are answered in files of their own, which take the problem";

/// The circles that there are, and why each is one.
const EXPLAINED: &[(&str, &[&str], &str)] = &[
    ("case", &["diagnose", "scene"], "one walk reads both formats, and asks format 2 for the model"),
    (
        "closures::kinetic",
        &["garzo_dufty", "theory"],
        "the coefficients of the case make the state that they are evaluated at",
    ),
    ("dem", &["forces", "walls"], "one sweep: pairs, then walls, with the same step of a contact"),
    (
        "models::coupled",
        &[
            "advice",
            "equations",
            "exchange",
            "figures",
            "freeze",
            "limits",
            "outcome",
            "problem",
            "record",
            "run",
            "start",
            "study",
            "theory",
        ],
        METHODS,
    ),
    ("models::exact", &["bagnold", "bagnold_case"], METHODS),
    ("models::exact", &["bingham", "bingham_case"], METHODS),
    ("models::exact", &["log_law", "log_law_case"], METHODS),
    ("models::grains", &["impact", "problem"], METHODS),
    (
        "models::laminar",
        &["bed", "packing", "spreading"],
        "a bed, its packing and how that spreads are one system of equations",
    ),
    ("models::laminar", &["outcome", "problem", "study"], METHODS),
    ("models::section", &["advice", "problem", "study"], METHODS),
    ("models::shear_cell", &["problem", "study"], METHODS),
    (
        "models::sheet_flow",
        &["column", "newton"],
        "the closing equations of a column are linearised where its cells are",
    ),
    ("models::sheet_flow", &["equations", "problem", "study"], METHODS),
    ("models::two_fluid", &["equations", "problem", "study"], METHODS),
    ("models::two_fluid", &["in_time", "outcome"], "a flow in time reports its last state as a steady one does"),
    (
        "output",
        &["comparison", "folder", "grains", "lock", "ours", "run", "study"],
        "runs, studies and comparisons hold one another, and whose a folder is depends on all that it holds",
    ),
    ("plot", &["live", "svg"], "what answers to the pointer is drawn into the same frame"),
    (
        "result",
        &["failure", "outcome"],
        "a failure keeps the outcome so far, and an outcome that cannot be trusted is a failure",
    ),
];

type Place = Vec<String>;

/// Every file of the library that is not a test, by its module.
fn modules() -> BTreeMap<Place, (bool, String)> {
    let root = project("src");
    let files = files(&root, "rs").into_iter().filter(|file| !is_test(file) && !file.ends_with("main.rs"));
    let named = files.map(|file| {
        let inside = file.strip_prefix(&root).unwrap().with_extension("");
        let mut place: Place = inside.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
        let folder = place.pop_if(|last| last == "mod" || last == "lib").is_some();
        (place, (folder, code(without_tests(&fs::read_to_string(file).unwrap()))))
    });
    named.collect()
}

/// Where a path that begins at `at` ends: the longest module, then what it takes from it.
fn walk(modules: &BTreeMap<Place, (bool, String)>, mut at: Place, path: &[String]) -> (Place, Place) {
    let mut rest = path;
    while let [first, others @ ..] = rest {
        let next = [at.as_slice(), std::slice::from_ref(first)].concat();
        if !modules.contains_key(&next) {
            break;
        }
        (at, rest) = (next, others);
    }
    (at, rest.to_vec())
}

/// What each `mod.rs` hands on under a name: from which file it has it.
fn handed_on(modules: &BTreeMap<Place, (bool, String)>) -> BTreeMap<(Place, String), Place> {
    let mut found = BTreeMap::new();
    for (place, (_, text)) in modules.iter().filter(|(_, (folder, _))| *folder) {
        for statement in text.split(';').map(str::trim).filter(|statement| statement.starts_with("pub")) {
            let Some((_, tree)) = statement.split_once("use ") else { continue };
            for path in paths(&format!("at::{tree}"), "at::") {
                let (from, item) = walk(modules, place.clone(), &path);
                if let ([item], true) = (item.as_slice(), from != *place) {
                    found.insert((place.clone(), item.clone()), from);
                }
            }
        }
    }
    found
}

/// The files of the same module that each file names, through what a `mod.rs` hands on as well.
fn graph() -> BTreeMap<Place, BTreeSet<Place>> {
    let modules = modules();
    let handed_on = handed_on(&modules);
    let files = modules.iter().filter(|(_, (folder, _))| !folder);
    let named = files.map(|(place, (_, text))| {
        let mut ends = BTreeSet::new();
        let chains = (1..=place.len()).map(|level| ("super::".repeat(level), place[..place.len() - level].to_vec()));
        for (prefix, root) in chains.chain([("crate::".to_owned(), Vec::new())]) {
            for path in paths(text, &prefix).into_iter().filter(|path| path[0] != "super") {
                let (mut at, item) = walk(&modules, root.clone(), &path);
                while let Some(next) = item.first().and_then(|item| handed_on.get(&(at.clone(), item.clone()))) {
                    at.clone_from(next);
                }
                if at != *place && modules.get(&at).is_some_and(|(folder, _)| !folder) {
                    ends.insert(at);
                }
            }
        }
        (place.clone(), ends)
    });
    named.collect()
}

/// All that can be reached from each file.
fn reached(graph: &BTreeMap<Place, BTreeSet<Place>>, from: &Place) -> BTreeSet<Place> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(at) = open.pop() {
        open.extend(graph[at].iter().filter(|next| seen.insert((*next).clone())));
    }
    seen
}

#[test]
fn circles_between_files_have_their_reason() {
    let graph = graph();
    let reached: BTreeMap<&Place, BTreeSet<Place>> = graph.keys().map(|file| (file, reached(&graph, file))).collect();
    let circle = |file: &Place| -> BTreeSet<String> {
        reached[file].iter().filter(|other| reached[other].contains(file)).map(|file| file.join("::")).collect()
    };
    let found: BTreeSet<BTreeSet<String>> = graph.keys().map(circle).filter(|circle| circle.len() > 1).collect();
    let explained =
        EXPLAINED.iter().map(|(module, files, _)| files.iter().map(|file| format!("{module}::{file}")).collect());
    let explained: BTreeSet<BTreeSet<String>> = explained.collect();
    let new: Vec<_> = found.difference(&explained).collect();
    let gone: Vec<_> = explained.difference(&found).collect();
    assert!(new.is_empty() && gone.is_empty(), "without a reason: {new:#?}\ngone: {gone:#?}");
}

#[test]
fn the_table_of_circles_is_that_of_the_code() {
    let rows = EXPLAINED.iter().map(|(module, files, why)| format!("| `{module}` | {} | {why} |\n", files.join(", ")));
    drawn("circles", "circles", &format!("| module | files | why |\n|---|---|---|\n{}", rows.collect::<String>()));
}
