//! The regime of an answer: what its model takes for granted, each premise as a number with the range in which it holds and the one in
//! which it is broken. Between the two it is doubtful.

use serde::{Deserialize, Serialize};

use crate::units::significant;

/// What a number says of a premise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// the model is meant for this
    Holds,
    /// between, or outside of what was tried
    Doubtful,
    /// the answer is one of a flow that there is not
    Broken,
}

/// A premise of a model, and what a run says of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Premise {
    /// what is taken for granted
    pub premise: String,
    /// the number that decides, with its symbol
    pub number: String,
    /// its value
    pub value: f64,
    /// where it holds and where it is broken, in words
    pub range: String,
    /// what that says
    pub verdict: Verdict,
    /// what is wrong with the answer where it is broken
    pub why: String,
    /// where the thresholds come from
    pub source: String,
}

impl Premise {
    /// The premise in a line: `flow is laminar: Re = 3.2e5 (holds below 1000, broken above 3000)`.
    #[must_use]
    pub fn line(&self) -> String {
        format!("{}: {} = {} ({})", self.premise, self.number, significant(self.value, 3), self.range)
    }
}

/// A rule by which a number decides on a premise.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// what is taken for granted
    pub premise: &'static str,
    /// the number, with its symbol
    pub number: &'static str,
    /// where it holds and where it is broken
    pub limits: Limits,
    /// what is wrong with the answer where it is broken
    pub why: &'static str,
    /// where the thresholds come from
    pub source: &'static str,
}

/// Where a premise holds and where it is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// holds up to the first, broken from the second on
    Below(f64, f64),
    /// holds from the first on, broken up to the second
    Above(f64, f64),
    /// holds from the first to the second, doubtful outside
    Within(f64, f64),
}

/// What round-off may do to a number, relative: at a threshold it is taken as that.
const ROUND_OFF: f64 = 1e-9;

impl Rule {
    /// What `value` says of the premise.
    #[must_use]
    pub fn of(&self, value: f64) -> Premise {
        let most = |limit: f64| value <= limit + ROUND_OFF * limit.abs();
        let least = |limit: f64| value >= limit - ROUND_OFF * limit.abs();
        let (holds, broken) = match self.limits {
            Limits::Below(holds, broken) => (most(holds), least(broken)),
            Limits::Above(holds, broken) => (least(holds), most(broken)),
            Limits::Within(low, high) => (least(low) && most(high), false),
        };
        let verdict = match (holds, broken) {
            (true, _) => Verdict::Holds,
            (false, true) => Verdict::Broken,
            (false, false) => Verdict::Doubtful,
        };
        Premise {
            premise: self.premise.into(),
            number: self.number.into(),
            value,
            range: match self.limits {
                Limits::Below(holds, broken) => format!("holds up to {holds}, broken from {broken}"),
                Limits::Above(holds, broken) => format!("holds from {holds}, broken up to {broken}"),
                Limits::Within(low, high) => format!("holds from {low} to {high}, doubtful outside"),
            },
            verdict,
            why: self.why.into(),
            source: self.source.into(),
        }
    }

    /// The same, if there is a value that is a number.
    #[must_use]
    pub fn maybe(&self, value: Option<f64>) -> Option<Premise> {
        value.filter(|value| value.is_finite()).map(|value| self.of(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_holds_is_doubtful_or_breaks() {
        let rule = |limits| Rule { premise: "p", number: "x", limits, why: "w", source: "s" };
        let verdicts = |limits, values: [f64; 3]| values.map(|value| rule(limits).of(value).verdict);
        let all = [Verdict::Holds, Verdict::Doubtful, Verdict::Broken];
        assert_eq!(verdicts(Limits::Below(1000.0, 3000.0), [1000.0, 2000.0, 3000.0]), all);
        assert_eq!(verdicts(Limits::Above(5.0, 2.0), [5.0, 3.0, 2.0]), all);
        let within = [Verdict::Holds, Verdict::Doubtful, Verdict::Doubtful];
        assert_eq!(verdicts(Limits::Within(0.2, 1.0), [0.2, 0.1, 2.0]), within);
        let next = |x: f64| [1.0 - 1e-14, 1.0, 1.0 + 1e-14].map(|near| near * x);
        assert_eq!(verdicts(Limits::Below(1000.0, 3000.0), next(1000.0)), [Verdict::Holds; 3]);
        assert_eq!(verdicts(Limits::Above(5.0, 2.0), next(2.0)), [Verdict::Broken; 3]);
        assert_eq!(verdicts(Limits::Within(0.2, 1.0), next(1.0)), [Verdict::Holds; 3]);
        assert_eq!(rule(Limits::Below(1.0, 2.0)).maybe(Some(f64::NAN)), None);
        assert!(Verdict::Broken > Verdict::Doubtful);
    }
}
