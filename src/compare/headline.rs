//! What a comparison says of each subject in one line.

use super::{Comparison, NormRow, NumberRow, percent};
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
        if let Some((rate, difference)) =
            self.rate().and_then(|n| Some((n.quantity, n.differences.get(subject).copied()??)))
        {
            let sign = if difference > 0.0 { "+" } else { "" };
            parts.push(format!("{} {sign}{}", rate.title, percent(difference)));
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

    /// The transport rate; of sections there is the flux alone.
    fn rate(&self) -> Option<&NumberRow> {
        let of = |rate: &quantity::Quantity| self.numbers.iter().find(|n| n.quantity.name == rate.name);
        let several = |row: &&NumberRow| row.differences.iter().skip(1).any(Option::is_some);
        of(&quantity::TRANSPORT_RATE)
            .filter(several)
            .or_else(|| of(&quantity::BED_FLUX))
            .or(of(&quantity::TRANSPORT_RATE))
    }

    /// What the others are compared with: its transport rate, where it has one.
    fn reference(&self) -> String {
        let known = self.rate().and_then(|n| Some((n.quantity, n.values.first().copied().flatten()?.0)));
        match known {
            Some((quantity, value)) => format!("the reference; {} {}", quantity.title, self.value(value, quantity)),
            None => "the reference".into(),
        }
    }
}
