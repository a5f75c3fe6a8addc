//! The numbers that two or more subjects report, side by side.

use super::{Subject, View};
use crate::result::quantity::{Quantity, RESULTS};

/// One number of all subjects.
#[derive(Clone, Debug)]
pub struct NumberRow {
    /// what it is
    pub quantity: &'static Quantity,
    /// value and standard error of each subject, in the units of the comparison; `None` where it has none
    pub values: Vec<Option<(f64, Option<f64>)>>,
    /// index of the subject that the differences are relative to: the reference, or the first that reports the number
    pub base: usize,
    /// (value - base)/|base|; `None` without a value, and where the base is 0 and the value is not
    pub differences: Vec<Option<f64>>,
}

/// The rows in the order of the catalogue. With scales, a number whose scale a subject lacks has no value there.
pub(super) fn rows(subjects: &[Subject], views: &[View]) -> Vec<NumberRow> {
    RESULTS.iter().filter_map(|quantity| row(quantity, subjects, views)).collect()
}

fn row(quantity: &'static Quantity, subjects: &[Subject], views: &[View]) -> Option<NumberRow> {
    let value = |(subject, view): (&Subject, &View)| {
        let (_, reported) = subject.results.iter().find(|(name, _)| *name == quantity.name)?;
        let size = view.scales.map_or(Some(1.0), |s| s.of_quantity(quantity))?;
        Some((reported.value? / size, reported.stderr.map(|e| e / size)))
    };
    let values: Vec<_> = subjects.iter().zip(views).map(value).collect();
    let base = values.iter().position(Option::is_some)?;
    if values.iter().flatten().count() < 2 {
        return None;
    }
    let (scale, _) = values.get(base).copied().flatten()?;
    let difference = |value: &Option<(f64, _)>| match value.as_ref()?.0 - scale {
        0.0 => Some(0.0),
        d => Some(d / scale.abs()).filter(|d| d.is_finite()),
    };
    let differences = values.iter().map(difference).collect();
    Some(NumberRow { quantity, values, base, differences })
}
