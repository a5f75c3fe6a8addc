//! Whatever the file holds: no panic, diagnostics that point into the text, and results that are finite or say that they
//! are not. The same inputs every time.

use std::cell::Cell;
use std::collections::BTreeMap;

use bedload::case::{Case, CaseError};
use bedload::model::Problem;
use bedload::plot::{Page, profile_figures, report_html};
use bedload::result::quantity::TRANSPORT_RATE;
use bedload::result::{Cost, Figure, Outcome, Provenance, Status, Summary};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use serde_json::Map;

use crate::mutate::{Input, input};
use crate::support::{REGISTRY, Scratch, run};

/// How the inputs ended.
#[derive(Debug, Default)]
struct Tally {
    refused: Cell<usize>,
    failed: Cell<usize>,
    solved: Cell<usize>,
    followed: Cell<usize>,
}

fn count(cell: &Cell<usize>) {
    cell.set(cell.get() + 1);
}

macro_rules! require {
    ($condition:expr, $($message:tt)*) => {
        if !$condition {
            return Err(TestCaseError::fail(format!($($message)*)));
        }
    };
}

/// A diagnostic points into the text, can be shown, and commands no terminal.
fn refusal_is_sound(error: &CaseError) -> Result<(), TestCaseError> {
    require!(!error.violations.is_empty(), "refused without a reason");
    for violation in &error.violations {
        require!(!violation.spans.is_empty(), "no place: {violation:?}");
        for span in &violation.spans {
            let content = &error.text(span).content;
            require!(content.get(span.bytes.clone()).is_some(), "{span:?} is not in the text: {violation:?}");
        }
    }
    let shown = error.render(false);
    let control = shown.chars().find(|&c| c.is_control() && !matches!(c, '\n' | '\t'));
    require!(control.is_none(), "{control:?} reaches the terminal");
    require!(shown.contains(error.violations[0].fault.code()), "the code is not shown: {shown}");
    for report in error.reports() {
        require!(report.message.len() < 4000, "a message of {} bytes", report.message.len());
        require!(report.line != Some(0), "line 0");
    }
    Ok(())
}

/// Numbers are finite or say why not, and levels ascend.
fn numbers_are_sound(problem: &Problem, outcome: &Outcome) -> Result<(), TestCaseError> {
    for (name, reported) in outcome.results.iter() {
        let reason = reported.reason.as_deref().is_some_and(|said| !said.is_empty());
        require!(reported.value.map_or(reason, f64::is_finite), "{name}: {reported:?}");
    }
    for balance in &outcome.balances {
        require!(balance.relative.is_finite(), "{balance:?}");
    }
    for validity in &outcome.validity {
        require!(validity.value.is_finite() && validity.z_m.is_none_or(f64::is_finite), "{validity:?}");
    }
    // An impact or a trial happens at one place: it has numbers and no levels. Nor has a sheet flow in which no layer moves: its rate is
    // nothing below the threshold of motion, and empty with a reason above it.
    let Some(profile) = &outcome.profile else {
        if problem.kind == "sheet-flow" && outcome.status == Status::Done {
            let (name, rate) = (TRANSPORT_RATE.name, outcome.results.get(TRANSPORT_RATE.name));
            let reason = outcome.results.reason(name).is_some_and(|why| why.starts_with("no layer of grains moves"));
            require!(rate == Some(0.0) || reason, "no layer and a rate of {rate:?}");
            return Ok(());
        }
        require!(["impact", "trial"].contains(&problem.kind), "no profile");
        return Ok(());
    };
    let z = profile.axis();
    // Levels of a layer that is thinner than round-off coincide.
    require!(z.windows(2).all(|pair| pair[0] <= pair[1]), "levels do not ascend: {z:?}");
    for quantity in profile.quantities() {
        let finite = profile.get(quantity).into_iter().flatten().flatten().all(|x| x.is_finite());
        require!(finite, "{} is not finite", quantity.name);
    }
    Ok(())
}

/// The report of an outcome can be drawn.
fn page_is_sound(problem: &Problem, case: &Case, outcome: &Outcome) -> Result<(), TestCaseError> {
    let summary = Summary {
        format: Summary::FORMAT,
        status: outcome.status,
        case: problem.name.clone(),
        model: problem.model_name(),
        scene: problem.scene.as_ref().map(bedload::scene::Scene::record),
        results: outcome.results.clone(),
        balances: outcome.balances.clone(),
        regime: Vec::new(),
        validity: outcome.validity.clone(),
        regularisation: Map::new(),
        error: None,
        cost: Cost::default(),
        provenance: Provenance::of_this_program(),
    };
    let stored: Result<Summary, _> = serde_json::from_str(&summary.to_json().to_string());
    require!(stored.as_ref().is_ok_and(|s| *s == summary), "the summary does not read back: {:?}", stored.err());
    let mut figures = outcome.profile.as_ref().map(|p| profile_figures(p, &summary)).unwrap_or_default();
    for figure in &outcome.figures {
        let stored = serde_json::to_string(figure).and_then(|text| serde_json::from_str::<Figure>(&text));
        require!(stored.as_ref().is_ok_and(|s| s == figure), "{} does not read back: {:?}", figure.stem, stored.err());
    }
    figures.extend(outcome.figures.iter().cloned());
    let resolved = case.resolved();
    let page = report_html(&Page {
        summary: &summary,
        figures: &figures,
        drawing: None,
        animation: None,
        statement: &outcome.statement,
        case_toml: &resolved,
        notes: &[],
    });
    let nan = page.split(|c: char| !c.is_alphanumeric()).any(|word| word == "NaN");
    require!(!nan, "NaN in the report");
    Ok(())
}

fn hold(tally: &Tally, Input { text, overrides }: &Input) -> Result<(), TestCaseError> {
    let parse = |overrides: &[String]| REGISTRY.parse("case", "case.toml", text.clone(), overrides);
    let (case, mut problem) = match parse(overrides) {
        Ok(both) => both,
        Err(error) => {
            count(&tally.refused);
            return refusal_is_sound(&error);
        }
    };
    let resolved = case.resolved();
    let again = Case::parse(REGISTRY.kinds(), "case", "case.toml", resolved.clone(), &[]);
    require!(again.is_ok_and(|again| again.resolved() == resolved), "does not resolve to itself:\n{resolved}");
    // A run that follows grains, or a flow in time, takes as long as its case says: it is held up to its start.
    let in_time = resolved.contains("state = \"transient\"");
    if in_time || problem.stochastic && problem.kind != "impact" {
        count(&tally.followed);
        require!(!problem.describe().equations.contains("NaN"), "NaN in the equations");
        return Ok(());
    }
    // A section has the square of that.
    let most = if problem.kind.starts_with("section") { 12 } else { 64 };
    if problem.cells() > most {
        let fewer = parse(&[&overrides[..], &[format!("grid.cells={most}")]].concat());
        problem = fewer.map_err(|error| TestCaseError::fail(error.render(false)))?.1;
    }
    match run(&problem) {
        Ok(outcome) => {
            count(&tally.solved);
            numbers_are_sound(&problem, &outcome)?;
            let overflowed = outcome.results.iter().find(|(_, reported)| reported.overflowed());
            require!(overflowed.is_none(), "done with {overflowed:?}");
            let open = outcome.balances.iter().find(|b| b.relative.abs() > 1e-3);
            require!(open.is_none(), "done with {open:?}");
            require!(!problem.describe().equations.contains("NaN"), "NaN in the equations");
            if tally.solved.get() % 32 == 1 { page_is_sound(&problem, &case, &outcome) } else { Ok(()) }
        }
        Err(failure) => {
            count(&tally.failed);
            require!(!failure.error.code().is_empty() && !failure.error.hint().is_empty(), "{failure:?}");
            require!(!failure.to_string().contains("NaN"), "a failure without numbers: {failure}");
            failure.last.as_deref().map_or(Ok(()), |last| numbers_are_sound(&problem, last))
        }
    }
}

/// Holds `cases` inputs against the promise; prints how they ended.
fn hold_all(cases: u32) {
    let seed = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 4000, ..Config::default() };
    let tally = Tally::default();
    let result = TestRunner::new_with_rng(config, seed).run(&input(), |input| hold(&tally, &input));
    if let Err(error) = result {
        panic!("{error}");
    }
    println!("{tally:?}");
    let share = |cell: &Cell<usize>| cell.get() as f64 / f64::from(cases);
    let ran = share(&tally.solved) + share(&tally.followed);
    assert!(ran > 0.1 && share(&tally.refused) > 0.3, "the inputs are one-sided: {tally:?}");
}

#[test]
fn two_thousand_inputs() {
    hold_all(2_000);
}

/// `cargo test --release -- --ignored hundred_thousand_inputs`
#[test]
#[ignore = "takes minutes"]
fn hundred_thousand_inputs() {
    hold_all(100_000);
}

#[test]
fn raw_bytes_through_the_program() {
    let scratch = Scratch::new();
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut codes: BTreeMap<i32, usize> = BTreeMap::new();
    for _ in 0..60 {
        let byte = |state: &mut u64| {
            *state ^= *state << 13;
            *state ^= *state >> 7;
            *state ^= *state << 17;
            (*state >> 32) as u8
        };
        let length = usize::from(byte(&mut state));
        let bytes: Vec<u8> = (0..length).map(|_| byte(&mut state)).collect();
        scratch.write("bytes.toml", bytes);
        *codes.entry(scratch.bedload(["check", "bytes.toml"]).code).or_default() += 1;
    }
    assert_eq!(codes.into_iter().collect::<Vec<_>>(), [(2, 60)]);
}
