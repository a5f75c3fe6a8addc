//! What a rebuilding must not move: the checked problem of every shipped case and of every point that its studies make
//! of it, the numbers of the continuum models, the bits of the grains.
//!
//! `BEDLOAD_GOLDENS=write cargo test --release --test it -- goldens` writes the files anew; a commit that does so says why.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use bedload::case::{Case, shipped};
use bedload::model::Problem;
use bedload::output::fingerprint;
use bedload::result::Outcome;
use bedload::study::{Point, Reference, chart, converge};
use bedload::validate::table::ADVICE_TESTS;
use rayon::prelude::*;

use crate::support::{REGISTRY, project, run};

/// Largest relative change of a number of a continuum model.
const SAME: f64 = 1e-12;
/// Cases that take too long here; `bedload validate --full` has them.
const LONG: &[&str] = &["section_3d_square_bed", "kinetic_1d_settling", "kinetic_1d_settling_oil"];
/// Grains: a case and how long it is followed.
const GRAINS: &[(&str, &[&str])] = &[
    ("grains_2d_column", &["discrete.duration=0.1 s"]),
    ("grains_3d_bed_quick", &["discrete.duration=0.1 s", "discrete.settle=0.2 s"]),
    ("grains_3d_chute", &["discrete.duration=0.1 s", "discrete.settle=0.1 s", "layers=4"]),
    ("flume_exp14_quick", &["discrete.duration=0.4 s", "cell.length=120 mm"]),
    ("flume_exp20_quick", &["discrete.duration=0.3 s", "cell.length=120 mm", "discrete.freeze_below=1e-3"]),
    ("flow_theta04_quick", &["discrete.duration=0.2 s", "cell.length=30 mm", "cell.width=30 mm"]),
    ("impact_1d_headon", &[]),
    ("impact_1d_headon_tension", &[]),
    ("impact_2d_oblique", &[]),
    ("impact_2d_spinning", &[]),
    ("trial_1d_bouncing", &[]),
    ("trial_1d_headon", &[]),
    ("trial_1d_springs", &[]),
    ("trial_1d_stack", &[]),
    ("trial_2d_oblique", &[]),
    ("trial_2d_rolling", &[]),
    ("trial_3d_cluster", &[]),
    ("trial_3d_ledger", &[]),
];

/// A checked case, as the tests here see it.
struct Checked {
    case: Case,
    problem: Problem,
}

impl Checked {
    fn load(name: &str, set: &[String]) -> Option<Self> {
        let (case, problem) = REGISTRY.load(name, set).ok()?;
        Some(Self { case, problem })
    }

    fn kind(&self) -> &str {
        self.problem.kind
    }

    fn cells(&self) -> usize {
        self.problem.cells()
    }

    /// Numbers and switches of the problem, in the order of its fields.
    fn values(&self) -> String {
        values(&format!("{:?}", self.problem.solver()))
    }

    fn equations(&self) -> String {
        self.problem.describe().equations
    }

    fn laws(&self) -> Vec<String> {
        self.problem.describe().laws.iter().map(|law| format!("{}/{}", law.family, law.law)).collect()
    }

    fn run(&self) -> Option<Outcome> {
        run(&self.problem).ok()
    }
}

/// Points that `chart` and both kinds of `converge` make of a case.
pub(super) fn points(name: &str) -> Vec<Point> {
    let request = chart::Request { cases: vec![name.into()], overrides: vec![], quantity: None, reference: None };
    let mut points = chart::plan(&REGISTRY, &request).map(|(plan, _)| plan.points).unwrap_or_default();
    for over in [converge::Over::Regularisation, converge::Over::Mesh] {
        for reference in [None, Some(Reference::Finest)] {
            let mut request = converge::Request::new(name, over);
            request.reference = reference;
            points.extend(converge::plan(&REGISTRY, &request).map(|(plan, _)| plan.points).unwrap_or_default());
        }
    }
    points
}

/// The numbers and switches of a `Debug` text. Names of types and fields may change, and `cells` has its own column.
fn values(debug: &str) -> String {
    let words = debug.split(|c: char| " ,:(){}[]".contains(c)).filter(|word| !word.is_empty());
    let mut kept = Vec::new();
    let mut skip = false;
    for word in words {
        let number = word.parse::<f64>().is_ok();
        if std::mem::replace(&mut skip, word == "cells") && number {
            continue;
        }
        if number || ["true", "false", "None"].contains(&word) {
            kept.push(word);
        }
    }
    kept.join(" ")
}

fn line(name: &str, set: &[String], whole: bool) -> Option<String> {
    let checked = Checked::load(name, set)?;
    let values = checked.values();
    let short = |text: &str| fingerprint(text)[..16].to_owned();
    let values = if whole { values } else { short(&values) };
    let resolved = short(&checked.case.resolved());
    let equations = short(&checked.equations());
    let laws = checked.laws().join(",");
    let set = set.join("; ");
    Some(format!(
        "{name} | {set} | {} | {} | case {resolved} | equations {equations} | {laws} | {values}\n",
        checked.kind(),
        checked.cells()
    ))
}

fn problems() -> String {
    let names: Vec<&str> = shipped::names().collect();
    let texts: Vec<String> = names
        .par_iter()
        .map(|name| {
            let mut text = line(name, &[], true).unwrap_or_else(|| panic!("{name} is refused"));
            let mut seen = Vec::new();
            for point in points(name).iter().filter(|point| point.case.is_none() && !point.overrides.is_empty()) {
                if !seen.contains(&point.overrides) {
                    text.extend(line(name, &point.overrides, false));
                    seen.push(point.overrides.clone());
                }
            }
            text
        })
        .collect();
    let mut text = texts.concat();
    for test in ADVICE_TESTS {
        let owned = |set: &[&str]| set.iter().map(|&s| s.to_owned()).collect::<Vec<_>>();
        let candidates = test.candidates.iter().map(|candidate| (candidate.case, candidate.set));
        for (case, set) in std::iter::once((test.case, test.set)).chain(candidates).filter(|(_, set)| !set.is_empty()) {
            text.extend(line(case, &owned(set), false));
        }
    }
    text
}

/// Every number of an outcome by name; a column is its sum and its sum of squares.
fn numbers(outcome: &Outcome) -> BTreeMap<String, f64> {
    let mut numbers = BTreeMap::new();
    for (name, reported) in outcome.results.iter() {
        numbers.extend(reported.value.map(|value| (name.to_owned(), value)));
    }
    for column in outcome.profile.iter().flat_map(|profile| profile.quantities().map(move |q| (q, profile))) {
        let (quantity, profile) = column;
        let values = || profile.get(quantity).into_iter().flatten().flatten();
        numbers.insert(format!("profile.{} sum", quantity.name), values().map(|x| x.abs()).sum());
        numbers.insert(format!("profile.{} squares", quantity.name), values().map(|x| x * x).sum::<f64>().sqrt());
    }
    numbers
}

fn is_grains(name: &str) -> bool {
    let grains = ["coupled", "grains", "impact", "trial", "flume"].iter().any(|kind| name.starts_with(kind));
    grains || name.ends_with("-coupled") || name.starts_with("flow_") && name.ends_with("_quick")
}

fn outcomes() -> String {
    let names: Vec<&str> = shipped::names().filter(|name| !is_grains(name) && !LONG.contains(name)).collect();
    let one = |name: &&str| {
        let mut text = String::new();
        match Checked::load(name, &[]).and_then(|checked| checked.run()) {
            None => text += &format!("{name} | fails | 0\n"),
            Some(outcome) => {
                for (number, value) in numbers(&outcome) {
                    let _ = writeln!(text, "{name} | {number} | {value:e}");
                }
            }
        }
        text
    };
    names.par_iter().map(one).collect::<Vec<_>>().concat()
}

fn grains() -> String {
    let one = |(name, set): &(&str, &[&str])| {
        let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
        let checked = Checked::load(name, &set).unwrap_or_else(|| panic!("{name} is refused"));
        let outcome = checked.run().unwrap_or_else(|| panic!("{name} fails"));
        let mut text = String::new();
        let hash = |bits: &mut dyn Iterator<Item = u64>| {
            let all: String = bits.map(|bits| format!("{bits:016x}")).collect();
            fingerprint(&all)[..16].to_owned()
        };
        for (number, reported) in outcome.results.iter() {
            let bits = reported.value.map_or(0, f64::to_bits);
            let _ = writeln!(text, "{name} | {number} | {bits:016x}");
        }
        if let Some(profile) = &outcome.profile {
            for quantity in profile.quantities() {
                let values = profile.get(quantity).into_iter().flatten();
                let hash = hash(&mut values.map(|x| x.map_or(1, f64::to_bits)));
                let _ = writeln!(text, "{name} | profile.{} | {hash}", quantity.name);
            }
        }
        if let Some(series) = &outcome.series {
            for quantity in series.quantities() {
                let values = series.get(quantity).into_iter().flatten();
                let hash = hash(&mut values.map(|x| x.map_or(1, f64::to_bits)));
                let _ = writeln!(text, "{name} | series.{} | {hash}", quantity.name);
            }
        }
        text
    };
    GRAINS.par_iter().map(one).collect::<Vec<_>>().concat()
}

/// The committed text, or the new one if it is to be written.
fn golden(file: &str, found: &str) -> Option<String> {
    let path: PathBuf = project(&format!("tests/golden/{file}"));
    if std::env::var_os("BEDLOAD_GOLDENS").is_some_and(|word| word == "write") {
        fs::write(&path, found).unwrap();
        return None;
    }
    Some(fs::read_to_string(&path).unwrap())
}

/// Every line of the golden stands in what was found; what is new there (a case, a column) is no change.
fn kept(golden: &str, found: &str, same: impl Fn(&str, &str) -> bool) {
    let key = |line: &str| line.rsplit_once(" | ").map(|(key, value)| (key.to_owned(), value.to_owned()));
    let found: BTreeMap<String, String> = found.lines().filter_map(key).collect();
    let mut moved = Vec::new();
    for (key, value) in golden.lines().filter_map(key) {
        match found.get(&key) {
            Some(now) if same(&value, now) => {}
            now => moved.push(format!("{key}\n   was {value}\n   now {now:?}")),
        }
    }
    assert!(moved.is_empty(), "{} moved:\n{}", moved.len(), moved[..moved.len().min(20)].join("\n"));
}

#[test]
fn problems_stay_as_they_are() {
    let found = problems();
    let Some(golden) = golden("problems.txt", &found) else { return };
    assert!(golden.lines().count() > 1000);
    kept(&golden, &found, |a, b| a == b);
}

#[test]
fn continuum_numbers_stay_as_they_are() {
    let found = outcomes();
    let Some(golden) = golden("outcomes.txt", &found) else { return };
    assert!(golden.lines().count() > 1000);
    kept(&golden, &found, |a, b| {
        let (a, b): (f64, f64) = (a.parse().unwrap(), b.parse().unwrap());
        (a - b).abs() <= SAME * a.abs().max(b.abs()) || (a.abs() < 1e-12 && b.abs() < 1e-12)
    });
}

#[test]
fn grains_keep_their_bits() {
    let found = grains();
    let Some(golden) = golden("grains.txt", &found) else { return };
    assert!(golden.lines().count() > 100);
    kept(&golden, &found, |a, b| a == b);
}
