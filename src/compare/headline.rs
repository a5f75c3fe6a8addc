//! What a comparison says of each subject in one line.

use super::{Comparison, NormRow, percent};
use crate::result::quantity;
use crate::units::significant;

impl Comparison {
    /// A velocity, or else the first column in common, and the transport rate.
    #[must_use]
    pub fn headline(&self, subject: usize) -> String {
        let rows: Vec<&NormRow> = self.norms.iter().filter(|n| n.subject == subject && n.deviation.is_some()).collect();
        let column = |wanted: &dyn Fn(&NormRow) -> bool| rows.iter().find(|n| wanted(n));
        let velocity = column(&|n| n.quantity.name == quantity::U_MIXTURE.name)
            .or(column(&|n| n.quantity.unit == quantity::U_MIXTURE.unit))
            .or(rows.first());
        let mut parts = Vec::new();
        if let Some((row, d)) = velocity.and_then(|n| Some((n, n.deviation?))) {
            let l2 = d.l2_relative.map_or_else(String::new, |x| format!("L2 {}, ", percent(x)));
            let largest = self.value(d.linf, row.quantity);
            let at = self.value(d.linf_at, &quantity::Z);
            parts.push(format!("{} {l2}at most {largest} (z {at}) over {} levels", row.quantity.title, d.levels));
            parts.extend(row.sigmas.map(|s| format!("{} sigma", significant(s.rms, 3))));
        }
        let rate = self.numbers.iter().find(|n| n.quantity.name == quantity::TRANSPORT_RATE.name);
        if let Some(difference) = rate.and_then(|n| n.differences.get(subject).copied().flatten()) {
            let sign = if difference > 0.0 { "+" } else { "" };
            parts.push(format!("{} {sign}{}", quantity::TRANSPORT_RATE.title, percent(difference)));
        }
        if parts.is_empty() { "no common elevation".into() } else { parts.join("; ") }
    }

    /// The answer of a comparison: the reference, and each of the others against it.
    #[must_use]
    pub fn answer(&self) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        for (i, subject) in self.subjects.iter().enumerate() {
            let text = if i == 0 { self.reference() } else { self.headline(i) };
            lines.push((subject.name.clone(), text));
        }
        lines
    }

    /// What the others are compared with: its transport rate, where it has one.
    fn reference(&self) -> String {
        let rate = self.numbers.iter().find(|n| n.quantity.name == quantity::TRANSPORT_RATE.name);
        let known = rate.and_then(|n| Some((n.quantity, n.values.first().copied().flatten()?.0)));
        match known {
            Some((quantity, value)) => format!("the reference; {} {}", quantity.title, self.value(value, quantity)),
            None => "the reference".into(),
        }
    }
}
