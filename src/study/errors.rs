//! How far a run lies from the reference: norms of the velocity, and the numbers that a user would take from it.

use std::borrow::Cow;

use super::Row;
use crate::compare::norms::deviation;
use crate::model::{Focus, Number, Rule};
use crate::result::quantity as q;
use crate::result::{Profile, Results};

/// What the error is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reference {
    /// the exact yield on the same mesh, or the closed form of the exact yield
    Exact,
    /// the smallest regularisation of each law, or a mesh finer than all others
    Finest,
}

impl Reference {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Finest => "finest",
        }
    }
}

/// Columns of the measures.
pub(super) const L2: &str = "error_velocity_l2";
const LARGEST: &str = "error_velocity_largest";
pub(super) const RMS: &str = "velocity_rms_scaled";
pub(super) const RMS_PAPER: &str = "velocity_rms_paper_scaled";
const AT_BED: &str = "error_velocity_at_bed";
pub(super) const CREEP: &str = "creep_velocity_scaled";

/// Columns, each with one value per row.
pub(super) type Columns = Vec<(String, Vec<Option<f64>>)>;

/// What a run is compared with.
pub(super) struct ReferenceSolution<'a> {
    /// columns over z \[m]
    pub profile: Cow<'a, Profile>,
    /// numbers \[SI]
    pub results: &'a Results,
    /// whether it is the exact yield, against which a run may state errors itself
    pub exact_yield: bool,
}

impl Number {
    /// Column of its error.
    pub fn column(&self) -> String {
        format!("error_{}", self.short)
    }

    /// Relative error of a row.
    fn error(&self, row: &Row, reference: &ReferenceSolution<'_>) -> Option<f64> {
        let stated = self.stated.filter(|_| reference.exact_yield).and_then(|stated| row.result(stated.name));
        let measured = || Some(relative((row.result(self.quantity.name)?, reference.results.get(self.quantity.name)?)));
        stated.map(f64::abs).or_else(measured)
    }
}

impl Rule {
    /// The Bingham number on the mean velocity of `results`, or the one that they have.
    pub fn bingham_number(&self, results: &Results) -> Option<f64> {
        let on_mean = results.get(q::MEAN_VELOCITY.name).filter(|u| *u > 0.0).map(|u| self.yield_velocity / u);
        on_mean.or_else(|| results.get(q::BINGHAM.name))
    }
}

fn relative((a, b): (f64, f64)) -> f64 {
    (a - b).abs() / b.abs()
}

impl Focus {
    /// The errors that are reported in words and drawn: column and title.
    pub(super) fn reported(&self) -> Vec<(String, String)> {
        let mut reported = vec![(L2.to_owned(), "velocity (L2)".to_owned())];
        reported.extend(self.numbers.iter().map(|number| (number.column(), number.quantity.title.into())));
        if self.bed {
            reported.push((AT_BED.into(), "velocity at the bed level".into()));
        }
        reported
    }

    /// The columns of measures; a row without a reference or a profile has none.
    pub(super) fn measures<'a>(
        &self,
        rows: &'a [Row],
        reference: impl Fn(&'a Row) -> Option<ReferenceSolution<'a>>,
    ) -> Columns {
        let mut names = vec![L2.to_owned(), LARGEST.into(), RMS.into()];
        names.extend(self.paper_rms.then(|| RMS_PAPER.to_owned()));
        names.extend(self.numbers.iter().map(Number::column));
        names.extend(self.bed.then(|| AT_BED.to_owned()));
        let found = rows
            .iter()
            .map(|row| reference(row).and_then(|reference| self.measure(row, &reference)).unwrap_or_default());
        let found: Vec<Vec<Option<f64>>> = found.collect();
        let column =
            |i: usize| found.iter().map(|values| values.get(i).copied().flatten().filter(|x| x.is_finite())).collect();
        names.into_iter().enumerate().map(|(i, name)| (name, column(i))).collect()
    }

    /// The measures of one row, in the order of the columns.
    fn measure(&self, row: &Row, reference: &ReferenceSolution<'_>) -> Option<Vec<Option<f64>>> {
        let run = row.profile.as_ref()?;
        let d = deviation(&reference.profile, run, self.velocity)?;
        let rms = d.rms / self.velocity_unit;
        let mut values = vec![d.l2_relative, d.linf_relative, Some(rms)];
        values.extend(self.paper_rms.then(|| Some(rms / (d.levels as f64).sqrt())));
        values.extend(self.numbers.iter().map(|number| number.error(row, reference)));
        values.extend(self.bed.then(|| self.at_bed(run, reference).map(relative)));
        Some(values)
    }

    /// Grain velocity at the highest level that has one, in the run and in its reference.
    fn at_bed(&self, run: &Profile, reference: &ReferenceSolution<'_>) -> Option<(f64, f64)> {
        let values = run.get(self.velocity)?;
        let top = values.iter().rposition(Option::is_some)?;
        let z = run.axis().get(top).copied()?;
        Some((values.get(top).copied().flatten()?, reference.profile.at(self.velocity, z)?))
    }

    /// The velocity half-way between the bottom and the highest level below which nothing moves in the reference, in units of
    /// velocity.
    pub(super) fn creep(&self, row: &Row, reference: &Profile) -> Option<f64> {
        let (levels, values) = (reference.axis(), reference.get(self.velocity)?);
        let resting = values.iter().position(|value| *value != Some(0.0)).unwrap_or(values.len());
        let (bottom, top) = (levels.first()?, levels.get(resting.checked_sub(1)?)?);
        Some(row.profile.as_ref()?.at(self.velocity, 0.5 * (bottom + top))?.abs() / self.velocity_unit)
    }
}

/// A column of the measures.
pub(super) fn column<'a>(measures: &'a Columns, name: &str) -> &'a [Option<f64>] {
    measures.iter().find(|(n, _)| n == name).map_or(&[], |(_, values)| values)
}
