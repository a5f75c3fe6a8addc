//! Sums over many steps without the round-off of many steps.

/// A sum with the part that rounding took (Neumaier 1974, doi:10.1002/zamm.19740540106).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// the rounded sum
    pub value: f64,
    /// what is missing from it
    pub rest: f64,
}

impl Sum {
    /// Adds `x`.
    pub fn add(&mut self, x: f64) {
        let sum = self.value + x;
        self.rest += if self.value.abs() >= x.abs() { (self.value - sum) + x } else { (x - sum) + self.value };
        self.value = sum;
    }

    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.value + self.rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_million_tenths_are_a_million() {
        let mut sum = Sum::default();
        (0..10_000_000).for_each(|_| sum.add(0.1));
        assert!((sum.total() - 1e6).abs() < 1e-8, "{}", sum.total());
    }
}
