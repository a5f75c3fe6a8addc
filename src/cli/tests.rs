//! The codes that the program can answer with are those of `docs/codes.md`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::run::BROKEN_PREMISE;
use crate::advise::AdviseError;
use crate::case::Fault;
use crate::compare::{CompareError, DataFault};
use crate::dem::{GrainError, RunError};
use crate::models::coupled::CoupledError;
use crate::models::exact::{ExactError, ExactFault};
use crate::models::grains::ImpactError;
use crate::models::section::{SectionError, SectionFault};
use crate::models::sheet_flow::{SheetFlowError, SheetFlowFault};
use crate::models::two_fluid::{TwoFluidError, TwoFluidFault};
use crate::models::{BedError, BedFault, RegularisationSize};
use crate::output::OutputError;
use crate::result::NumericalError;
use crate::study::calibrate::Unfit;
use crate::study::{STOPPED, StudyError};

macro_rules! all {
    ($($type:ident)+) => {
        [$((stringify!($type), $type::CODES)),+]
    };
}

/// The codes of every type that has any, by its name.
const ALL: &[(&str, &[&str])] = &all![
    AdviseError BedError BedFault CompareError CoupledError DataFault ExactError ExactFault Fault GrainError
    ImpactError NumericalError OutputError RegularisationSize RunError SectionError SectionFault SheetFlowError
    SheetFlowFault StudyError TwoFluidError TwoFluidFault Unfit
];
/// Codes of no type: of the command line itself, of a point that was stopped, and of a run of which more is asked than an answer.
const OTHERS: [&str; 4] = ["io", "usage", STOPPED, BROKEN_PREMISE];

fn project(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The words in code in the first cell of each row of the tables of the page.
fn listed(page: &str) -> BTreeSet<&str> {
    let cells = page.lines().filter_map(|line| line.strip_prefix("| `")?.split(" |").next());
    cells.flat_map(|cell| cell.split('`').step_by(2)).filter(|word| !word.is_empty()).collect()
}

#[test]
fn the_page_of_the_codes_has_those_of_the_program_and_no_other() {
    let page = fs::read_to_string(project("docs/codes.md")).unwrap();
    let page = listed(&page);
    let program: BTreeSet<&str> = ALL.iter().flat_map(|(_, codes)| codes.iter().copied()).chain(OTHERS).collect();
    assert!(program.len() > 90, "{program:?}");
    let missing: Vec<_> = program.difference(&page).collect();
    let gone: Vec<_> = page.difference(&program).collect();
    assert!(missing.is_empty() && gone.is_empty(), "not on the page: {missing:?}; not in the program: {gone:?}");
}

#[test]
fn every_type_with_codes_is_in_the_list() {
    let mut open = vec![project("src")];
    let mut found = BTreeSet::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(path).unwrap();
            let types = text.lines().filter_map(|line| line.strip_prefix("codes!(")?.split(' ').next());
            found.extend(types.map(str::to_owned));
        }
    }
    let known: BTreeSet<String> = ALL.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(found, known);
}
