//! A mean with its standard error, or with the reason why it has none.

/// Why a mean has no standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// fewer blocks or samples than an error can be estimated from
    TooFew,
    /// samples that are correlated over the whole time
    TooShort,
    /// samples that are all the same
    Constant,
}

impl Unknown {
    /// In words.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::TooFew => "too few samples",
            Self::TooShort => "too few independent samples, the time is too short",
            Self::Constant => "the same in every sample",
        }
    }
}

/// A mean and its standard error, both in the unit of the quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// mean
    pub mean: f64,
    /// standard error, or why there is none
    pub stderr: Result<f64, Unknown>,
}

impl Estimate {
    /// The mean times a number.
    #[must_use]
    pub fn times(self, scale: f64) -> Self {
        Self { mean: scale * self.mean, stderr: self.stderr.map(|error| scale.abs() * error) }
    }

    /// The sum of two means that fluctuate independently.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let stderr = match (self.stderr, other.stderr) {
            (Ok(a), Ok(b)) => Ok(a.hypot(b)),
            (Err(Unknown::Constant), error) | (error, Err(Unknown::Constant)) => error,
            (Err(why), _) | (_, Err(why)) => Err(why),
        };
        Self { mean: self.mean + other.mean, stderr }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_independent_means_add_as_squares() {
        let estimate = |mean, stderr| Estimate { mean, stderr };
        let (a, b) = (estimate(1.0, Ok(0.3)), estimate(2.0, Ok(0.4)));
        assert_eq!(a.plus(b), estimate(3.0, Ok(0.5)));
        assert_eq!(a.plus(estimate(2.0, Err(Unknown::Constant))), estimate(3.0, Ok(0.3)));
        assert_eq!(a.plus(estimate(2.0, Err(Unknown::TooFew))), estimate(3.0, Err(Unknown::TooFew)));
        assert_eq!(a.times(-2.0), estimate(-2.0, Ok(0.6)));
    }
}
