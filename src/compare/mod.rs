//! Several cases, runs and measured profiles side by side: how far their columns lie apart, their numbers, one figure.
//!
//! ```text
//! Subject (a case that was run, a run folder, a profile CSV) ─► View (datum, units) ─► norms, numbers ─► figure, page, JSON
//! ```
//!
//! The first subject is the reference. [`norms`] says what is measured, [`frame`] in which datum and units.

pub mod data;
mod error;
pub mod frame;
mod headline;
mod inputs;
pub mod norms;
mod numbers;
mod page;
mod record;

use std::path::PathBuf;

use serde::Serialize;

pub use data::{DataError, DataFault};
pub use error::CompareError;
pub use frame::{Align, Scales, View, scaled_unit};
pub use inputs::{InputRow, Stated, of_one_kind};
pub use norms::{Deviation, Side, Sigmas};
pub use numbers::NumberRow;
pub use page::{origin, percent};
pub use record::Request;

use crate::plot::{Trace, shared_figures};
use crate::result::Figure;
use crate::result::Premise;
use crate::result::quantity::{self, COLUMNS, Quantity};
use crate::result::{Outcome, Profile, Results, Status, Summary, Validity};
use error::no_rate;

/// What a subject is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Kind {
    /// a case, run for the comparison
    Case,
    /// the folder of an earlier run
    Run,
    /// a profile CSV
    Data,
}

/// One of the things that are compared.
#[derive(Clone, Debug)]
pub struct Subject {
    /// its name in legends and tables, unique in a comparison
    pub name: String,
    /// the model in words, or the first comment of the data
    pub label: String,
    /// what it is
    pub kind: Kind,
    /// case, folder or file as the user named it
    pub source: String,
    /// further comments of the data
    pub notes: Vec<String>,
    /// columns over z \[m], in SI
    pub profile: Profile,
    /// one sigma of some of its columns, on the same levels
    pub errors: Option<Profile>,
    /// named numbers
    pub results: Results,
    /// premises of its model, and what the flow says of them
    pub regime: Vec<Premise>,
    /// closures that were used outside their range
    pub validity: Vec<Validity>,
    /// time that its solver took, if it was run for the comparison \[s]
    pub solve_s: f64,
    /// cells or grains times steps, if it was run for the comparison
    pub work: f64,
    /// its flow and how it was solved, if that is known
    pub stated: Option<Stated>,
}

impl Subject {
    /// A case that has been run: `source` as the user named it, `solve_s` what its solver took \[s].
    ///
    /// # Errors
    /// [`CompareError::NoProfile`].
    pub fn of_case(
        name: &str,
        source: &str,
        model: String,
        outcome: Outcome,
        solve_s: f64,
    ) -> Result<Self, CompareError> {
        let none = |results: &Results| CompareError::NoProfile { subject: source.into(), reason: no_rate(results) };
        let profile = outcome.profile.ok_or_else(|| none(&outcome.results))?;
        let Outcome { results, regime, validity, work, .. } = outcome;
        let (name, source) = (name.into(), source.into());
        let (kind, notes) = (Kind::Case, Vec::new());
        let errors = profile.standard_errors();
        let stated = None;
        Ok(Self {
            name,
            label: model,
            kind,
            source,
            notes,
            profile,
            errors,
            results,
            regime,
            validity,
            solve_s,
            work,
            stated,
        })
    }

    /// A run as its folder `source` holds it.
    ///
    /// # Errors
    /// [`CompareError::NotDone`], [`CompareError::NoProfile`].
    pub fn of_run(source: &str, summary: Summary, profile: Option<Profile>) -> Result<Self, CompareError> {
        if summary.status != Status::Done {
            return Err(CompareError::NotDone { subject: source.into(), status: summary.status });
        }
        let none = || CompareError::NoProfile { subject: source.into(), reason: no_rate(&summary.results) };
        let profile = profile.ok_or_else(none)?;
        let Summary { results, regime, validity, case: name, model: label, scene, .. } = summary;
        let (kind, source, notes) = (Kind::Run, source.into(), Vec::new());
        let errors = profile.standard_errors();
        let stated = scene.map(|scene| Stated { scene, ..Stated::default() });
        let (solve_s, work) = (0.0, 0.0);
        Ok(Self { name, label, kind, source, notes, profile, errors, results, regime, validity, solve_s, work, stated })
    }

    fn lacks(&self, quantity: &'static Quantity, needed_by: &'static str) -> CompareError {
        CompareError::NoNumber { subject: self.name.clone(), quantity, needed_by }
    }
}

/// One column of one subject against that of the reference.
#[derive(Clone, Debug)]
pub struct NormRow {
    /// index of the subject
    pub subject: usize,
    /// the column
    pub quantity: &'static Quantity,
    /// norms; `None` where no elevation is common
    pub deviation: Option<Deviation>,
    /// deviation in sigmas, where one of the two has errors
    pub sigmas: Option<Sigmas>,
}

/// Everything that a comparison has to say.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Comparison {
    /// where z is 0
    pub align: Align,
    /// whether values are divided by the scales of each subject
    pub scaled: bool,
    /// at least two; the first is the reference
    pub subjects: Vec<Subject>,
    /// each subject in the frame of the comparison
    pub views: Vec<View>,
    /// by subject, then in the order of the columns
    pub norms: Vec<NormRow>,
    /// numbers that two or more report, in the order of the catalogue
    pub numbers: Vec<NumberRow>,
    /// inputs that are not the same in all
    pub inputs: Vec<InputRow>,
}

/// Compares `subjects` with the first of them. Equal names are told apart by what the user typed, then by number.
///
/// # Errors
/// [`CompareError`]: fewer than two, nothing shared, or a number missing that the frame needs.
pub fn compare(mut subjects: Vec<Subject>, align: Align, scaled: bool) -> Result<Comparison, CompareError> {
    let Some((reference, others)) = subjects.split_first() else {
        return Err(CompareError::TooFew { given: 0, models: Vec::new() });
    };
    if others.is_empty() {
        return Err(CompareError::TooFew { given: 1, models: Vec::new() });
    }
    let shared: Vec<&'static Quantity> = COLUMNS
        .iter()
        .copied()
        .skip(1)
        .filter(|q| !q.name.ends_with("_stderr"))
        .filter(|q| reference.profile.get(q).is_some() && others.iter().any(|s| s.profile.get(q).is_some()))
        .collect();
    let name = reference.name.clone();
    tell_apart(&mut subjects);
    of_one_kind(subjects.iter().filter_map(|s| Some((s.name.clone(), s.stated.as_ref()?.scene.kind.clone()))))?;
    let views =
        subjects.iter().map(|s| View::of(s, align, scaled, &shared)).collect::<Result<Vec<_>, CompareError>>()?;
    let norms = all_norms(&views, &shared);
    let numbers = numbers::rows(&subjects, &views);
    if norms.iter().all(|n| n.deviation.is_none()) && numbers.is_empty() {
        return Err(CompareError::NothingShared { reference: name });
    }
    let inputs = inputs::rows(&subjects);
    Ok(Comparison { align, scaled, subjects, views, norms, numbers, inputs })
}

fn all_norms(views: &[View], shared: &[&'static Quantity]) -> Vec<NormRow> {
    let Some((a, others)) = views.split_first() else { return Vec::new() };
    let mut rows = Vec::new();
    for (i, b) in others.iter().enumerate() {
        for &quantity in shared.iter().filter(|q| b.profile.get(q).is_some()) {
            let sigmas = norms::sigmas((&a.profile, a.errors.as_ref()), (&b.profile, b.errors.as_ref()), quantity);
            let deviation = norms::deviation(&a.profile, &b.profile, quantity);
            rows.push(NormRow { subject: i + 1, quantity, deviation, sigmas });
        }
    }
    rows
}

/// Gives each subject a name of its own.
fn tell_apart(subjects: &mut [Subject]) {
    let names: Vec<String> = subjects.iter().map(|s| s.name.clone()).collect();
    for subject in subjects.iter_mut().filter(|s| names.iter().filter(|n| **n == s.name).count() > 1) {
        subject.name.clone_from(&subject.source);
    }
    let mut given: Vec<String> = Vec::new();
    for subject in subjects {
        let mut name = subject.name.clone();
        for n in 2.. {
            if !given.contains(&name) {
                break;
            }
            name = format!("{} ({n})", subject.name);
        }
        given.push(name.clone());
        subject.name = name;
    }
}

impl Comparison {
    /// The unit in which `quantity` is compared: SI, or the scales that divide it.
    #[must_use]
    pub fn unit(&self, quantity: &Quantity) -> &'static str {
        if self.scaled { scaled_unit(quantity) } else { quantity.unit }
    }

    /// Figures of all profiles on the same axes, over one elevation.
    #[must_use]
    pub fn figures(&self) -> Vec<Figure> {
        let traces: Vec<Trace<'_>> = self.subjects.iter().zip(&self.views).map(|(s, v)| trace(s, v)).collect();
        let (reference, view) = (self.subjects.first(), self.views.first());
        let height = reference.and_then(|r| r.results.get(quantity::FLOW_HEIGHT.name));
        let top = height.zip(view).map(|(h, v)| (h - v.shift_m) / v.scales.map_or(1.0, |s| s.length_m));
        shared_figures(&traces, top, self.scaled.then_some(scaled_unit))
    }

    /// Folder of a comparison unless the user names one: `runs/compare-A-B`, with letters that every system takes, and
    /// with the frame where that is not the default.
    #[must_use]
    pub fn folder(names: &[String], align: Align, scaled: bool) -> PathBuf {
        const LONGEST: usize = 120;
        let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-') { c } else { '_' };
        let mut name: String = format!("compare-{}", names.join("-")).chars().map(plain).take(LONGEST).collect();
        name += match align {
            Align::Bottom => "",
            Align::Bed => "-bed",
            Align::None => "-none",
        };
        name += if scaled { "-scaled" } else { "" };
        PathBuf::from("runs").join(name)
    }
}

fn trace<'a>(subject: &'a Subject, view: &'a View) -> Trace<'a> {
    Trace {
        name: &subject.name,
        profile: &view.profile,
        errors: view.errors.as_ref(),
        measured: subject.kind == Kind::Data,
        bed: view.bed,
        phi_interface: subject.results.get(quantity::PHI_INTERFACE.name),
    }
}

#[cfg(test)]
mod tests;
