//! Advice, checked: scenes whose answer is known, the model that `advise` names, and the models that are cheaper or dearer.
//!
//! Advice is right if the model that it names answers within the wanted tolerance, and no other one answers as well in less time. Where
//! it keeps a term, dropping that term must miss the tolerance.

use std::fmt::Write;
use std::time::Instant;

use super::Verdict;
use crate::advise::{self, Least};
use crate::case::CaseError;
use crate::model::{Checked, Registry};
use crate::result::Context;
use crate::units::significant;

/// What the advice is compared with.
#[derive(Clone, Copy, Debug)]
pub enum Reference {
    /// a closed form or a fine solution: case and what is changed in it
    Exact(&'static str, &'static [&'static str]),
    /// a measured or grain-resolved value
    Known {
        /// the value
        value: f64,
        /// its standard error
        stderr: f64,
        /// the grain-resolved run of the flow, which takes too long to be made again here
        run: Option<Run>,
    },
}

/// A grain-resolved run that was made before.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// its answer
    pub value: f64,
    /// its time \[s]
    pub seconds: f64,
}

/// A model of the same scene.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// what it is
    pub name: &'static str,
    /// its case
    pub case: &'static str,
    /// what is changed in it
    pub set: &'static [&'static str],
}

/// A scene whose answer is known, on which advice is tested.
#[derive(Clone, Copy, Debug)]
pub struct AdviceTest {
    /// what it is
    pub name: &'static str,
    /// the case that is advised on
    pub case: &'static str,
    /// what is changed in it
    pub set: &'static [&'static str],
    /// largest relative error that is wanted
    pub tolerance: f64,
    /// the number that is assessed
    pub quantity: &'static str,
    /// its value
    pub reference: Reference,
    /// where that comes from
    pub source: &'static str,
    /// the other models of the scene
    pub candidates: &'static [Candidate],
    /// a term that the advice keeps: its name there, and the scene without it
    pub kept: Option<(&'static str, Candidate)>,
}

/// Two numbers, or why there are none.
pub type Found = Result<(f64, f64), String>;

/// What a model makes of a scene: relative error and time to solve \[s]; or why there is none.
#[derive(Clone, Debug)]
pub struct Answer {
    /// what it is
    pub name: String,
    /// relative error \[1] and time \[s], or the reason
    pub found: Found,
}

/// A test of the advice with what came of it.
#[derive(Clone, Debug)]
pub struct Assessed {
    /// the test
    pub test: AdviceTest,
    /// the advised model
    pub advised: Answer,
    /// the others
    pub candidates: Vec<Answer>,
    /// the scene without the term that is kept
    pub without: Option<Answer>,
    /// whether no other model is as good and faster
    pub front: bool,
    /// whether the advice is right
    pub verdict: Verdict,
}

/// Asks for advice on each scene of [`ADVICE_TESTS`](super::table::ADVICE_TESTS), say, and solves the model that it names and the candidates.
#[must_use]
pub fn assess(registry: &Registry, tests: &[AdviceTest]) -> Vec<Assessed> {
    tests.iter().map(|test| one(registry, *test)).collect()
}

fn owned(set: &[&str]) -> Vec<String> {
    set.iter().map(|&set| set.to_owned()).collect()
}

/// Solves a case: the quantity and the shortest of some times \[s].
fn solve(registry: &Registry, case: &str, set: &[String], quantity: &str) -> Found {
    solved(registry.load(case, set), quantity)
}

fn solved(checked: Result<Checked, CaseError>, quantity: &str) -> Found {
    let (_, problem) = checked.map_err(|error| error.to_string())?;
    let mut best = f64::INFINITY;
    let mut value = None;
    for _ in 0..3 {
        let clock = Instant::now();
        let outcome = Context::quiet(|context| problem.solve(context)).map_err(|failure| failure.error.to_string())?;
        best = best.min(clock.elapsed().as_secs_f64());
        value = outcome.results.get(quantity);
        if best > 1.0 {
            break;
        }
    }
    Ok((value.ok_or_else(|| format!("{quantity} is not defined"))?, best))
}

fn one(registry: &Registry, test: AdviceTest) -> Assessed {
    let reference = match test.reference {
        Reference::Exact(case, set) => solve(registry, case, &owned(set), test.quantity).map(|(value, _)| (value, 0.0)),
        Reference::Known { value, stderr, .. } => Ok((value, stderr)),
    };
    let known =
        reference.as_ref().map_or(0.0, |(value, error)| if *value == 0.0 { *error } else { (error / value).abs() });
    let answer = |name: &str, found: Found| {
        let error =
            |value: f64, reference: f64| if reference == 0.0 { value.abs() } else { (value / reference - 1.0).abs() };
        let found = found.and_then(|(value, time)| Ok((error(value, reference.clone()?.0), time)));
        Answer { name: name.into(), found }
    };
    let set = owned(test.set);
    let advice = advise::advise(registry, test.case, &set, test.tolerance);
    let advised = match &advice {
        Err(error) => Answer { name: "no advice".into(), found: Err(error.to_string()) },
        Ok(advice) => advised(registry, &test, &advice.least, &set, &answer),
    };
    let candidate = |candidate: &Candidate| {
        answer(candidate.name, solve(registry, candidate.case, &owned(candidate.set), test.quantity))
    };
    let candidates: Vec<Answer> = test.candidates.iter().map(candidate).collect();
    let without = test.kept.map(|(_, dropped)| candidate(&dropped));
    let good = |answer: &Answer| answer.found.as_ref().is_ok_and(|(error, _)| *error <= test.tolerance.hypot(known));
    let faster = |other: &&Answer| match (&other.found, &advised.found) {
        (Ok((_, time)), Ok((_, own))) => good(other) && time < own && other.name != advised.name,
        _ => false,
    };
    let front = good(&advised) && candidates.iter().find(faster).is_none();
    let keeps = |what: &str| advice.as_ref().is_ok_and(|a| a.terms.iter().any(|term| term.what == what && term.keep));
    let kept = test.kept.is_none_or(|(what, _)| keeps(what)) && !without.as_ref().is_some_and(good);
    let verdict = if front && kept { Verdict::Green } else { Verdict::Red };
    Assessed { test, advised, candidates, without, front, verdict }
}

/// What the advised model makes of the scene; grains are not run: they are the reference there, with its error and time.
fn advised(
    registry: &Registry,
    test: &AdviceTest,
    least: &Least,
    set: &[String],
    answer: &dyn Fn(&str, Found) -> Answer,
) -> Answer {
    if let (Reference::Known { value, stderr, run: Some(run) }, true) = (test.reference, least.stochastic) {
        // A run that is the reference is as good as that is known.
        let Answer { name, found } = answer(least.kind, Ok((run.value, run.seconds)));
        return Answer { name, found: found.map(|(deviation, time)| (deviation.max((stderr / value).abs()), time)) };
    }
    let checked = match &least.case {
        Some(text) => registry.parse("advised", "advised", text.clone(), &[]),
        None => registry.load(test.case, set),
    };
    answer(least.kind, solved(checked, test.quantity))
}

/// The table as Markdown, a section of `docs/validation.md`.
#[must_use]
pub fn markdown(assessed: &[Assessed]) -> String {
    let mut text = String::from(
        "\n# Advice\n\n`bedload advise` on scenes whose answer is known. The model that it names has to answer within the tolerance (and the error of \
         what is known, as a sum of squares), and no other one as well in less time; where it keeps a term, the scene without that term has to miss the \
         tolerance. Errors are of the number in the second column; grains take the time of the run that is the reference.\n\n\
         | scene | number | tolerance | advised | its error | others | the term that is kept, and the error without it | verdict | reference |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let of = |answer: &Answer| match &answer.found {
        Ok((error, time)) => format!("{}, {}", per_cent(*error), seconds(*time)),
        Err(reason) => reason.clone(),
    };
    for row in assessed {
        let test = &row.test;
        let others: Vec<String> =
            row.candidates.iter().map(|candidate| format!("{}: {}", candidate.name, of(candidate))).collect();
        let kept = match (&test.kept, &row.without) {
            (Some((what, _)), Some(without)) => format!("{what}: {}", of(without)),
            _ => "-".into(),
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            test.name,
            test.quantity,
            per_cent(test.tolerance),
            row.advised.name,
            of(&row.advised),
            if others.is_empty() { "-".into() } else { others.join("; ") },
            kept,
            row.verdict.word(),
            test.source,
        );
    }
    text
}

fn per_cent(share: f64) -> String {
    match share {
        x if x < 1e-12 => "round-off".into(),
        x if x < 1e-4 => format!("{x:.0e}"),
        x => format!("{} %", significant(100.0 * x, 2)),
    }
}

/// A time to one digit: it differs from machine to machine.
fn seconds(time: f64) -> String {
    match time {
        t if t < 1e-3 => "below 1 ms".into(),
        t if t < 1.0 => format!("{} ms", significant(1e3 * t, 1)),
        t => format!("{} s", significant(t, 1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_is_right_on_every_scene() {
        let assessed = assess(&crate::models::builtin(), super::super::table::ADVICE_TESTS);
        for row in &assessed {
            assert_eq!(row.verdict, Verdict::Green, "{row:#?}");
        }
        let exact = |row: &&Assessed| {
            let measured = row.test.source.starts_with("measured");
            measured || row.test.source.starts_with("closed form")
        };
        assert!(assessed.len() >= 12);
        assert!(assessed.iter().filter(exact).count() >= 4);
        assert!(assessed.iter().filter(|row| row.test.kept.is_some()).count() >= 3);
    }
}
