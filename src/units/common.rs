//! One unit for the numbers of one kind in a table.

use super::readable::{mean_in, readable_unit, shown_in};

/// Decimal multiples of units, one a kind: lengths that stand in one table are all in millimetres, or all in metres.
#[derive(Clone, Debug, Default)]
pub struct CommonUnits(Vec<(&'static str, f64, &'static str)>);

impl CommonUnits {
    /// Those in which `values`, each with its SI unit, are easy to read together: of the middle, in logarithms, between the
    /// smallest and the largest that are not 0.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = (f64, &'static str)>) -> Self {
        let mut ends: Vec<(&'static str, f64, f64)> = Vec::new();
        for (value, unit) in values {
            let size = value.abs();
            if size == 0.0 || !size.is_finite() {
                continue;
            }
            match ends.iter_mut().find(|(known, ..)| *known == unit) {
                Some((_, least, most)) => (*least, *most) = (least.min(size), most.max(size)),
                None => ends.push((unit, size, size)),
            }
        }
        let multiple = |(unit, least, most): (&'static str, f64, f64)| {
            let (factor, symbol) = readable_unit((0.5 * (least.ln() + most.ln())).exp(), unit);
            (unit, factor, symbol)
        };
        Self(ends.into_iter().map(multiple).collect())
    }

    /// `value` with four significant digits.
    #[must_use]
    pub fn readable(&self, value: f64, unit: &'static str) -> String {
        shown_in(value, self.multiple(value, unit))
    }

    /// `value ± error`, the error with two digits.
    #[must_use]
    pub fn readable_mean(&self, value: f64, error: f64, unit: &'static str) -> String {
        mean_in(value, error, self.multiple(value, unit))
    }

    fn multiple(&self, value: f64, unit: &'static str) -> (f64, &'static str) {
        let known = self.0.iter().find(|(known, ..)| *known == unit);
        known.map_or_else(|| readable_unit(value, unit), |(_, factor, symbol)| (*factor, *symbol))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_one_kind_have_one_unit() {
        let table = [(1.511e-5, "m²/s"), (0.2421, "m²/s"), (0.183, "m"), (3.61e-3, "m"), (0.0, "m/s"), (2.0, "1")];
        let units = CommonUnits::of(table);
        let shown = |(value, unit)| units.readable(value, unit);
        assert_eq!(table.map(shown), ["1.511e-5 m²/s", "0.2421 m²/s", "183.0 mm", "3.610 mm", "0 m/s", "2.000"]);
        assert_eq!(units.readable_mean(0.183, 0.002, "m"), "183.0 ± 2.0 mm");
        // What was not in the table is as easy to read as alone.
        assert_eq!(units.readable(20.0, "Pa"), "20.00 Pa");
    }
}
