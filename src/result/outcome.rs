//! What a solver hands back.

use serde_json::{Map, Value};

use super::Premise;
use super::{
    Animation, Balance, Failure, Field, Figure, NumericalError, Profile, Results, Series, SideView, Statement, Status,
    Validity, quantity as q,
};

/// Everything that a run has to say, before it is written.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Outcome {
    /// done or stopped
    pub status: Status,
    /// columns over z
    pub profile: Option<Profile>,
    /// residual history or time series
    pub series: Option<Series>,
    /// named numbers
    pub results: Results,
    /// global balances: relative residuals
    pub balances: Vec<Balance>,
    /// what the model takes for granted, and what this flow says of it
    pub regime: Vec<Premise>,
    /// closures that were used outside their range
    pub validity: Vec<Validity>,
    /// every small number that the run used, by name
    pub regularisation: Map<String, Value>,
    /// fields over a section
    pub field: Option<Field>,
    /// grains at the end, seen from the side
    pub grains: Option<SideView>,
    /// grains as they flowed, seen from the side
    pub animation: Option<Animation>,
    /// figures that only the model has, besides those that its columns give
    pub figures: Vec<Figure>,
    /// the equations that were solved, and the laws in them
    pub statement: Statement,
    /// what was computed: cells or grains, times the systems solved or the steps made
    pub work: f64,
}

impl Outcome {
    /// A run that was stopped before it had anything to show.
    #[must_use]
    pub fn stopped() -> Self {
        Self {
            status: Status::Stopped,
            profile: None,
            series: None,
            results: Results::default(),
            balances: Vec::new(),
            regime: Vec::new(),
            validity: Vec::new(),
            regularisation: Map::new(),
            field: None,
            grains: None,
            animation: None,
            figures: Vec::new(),
            statement: Statement::default(),
            work: 0.0,
        }
    }

    /// How often each cell or grain was computed: the time that was followed over its step, the systems that were solved, or
    /// once.
    #[must_use]
    pub fn steps(&self) -> f64 {
        let of = |quantity: &q::Quantity| self.results.get(quantity.name);
        let followed = || Some((of(&q::TRANSIENT)? + of(&q::AVERAGED_TIME)?) / of(&q::TIME_STEP)?);
        let iterated = || self.series.as_ref().filter(|s| s.get(&q::RESIDUAL).is_some()).map(|s| s.rows() as f64);
        let counted = || of(&q::ITERATIONS).or(of(&q::NEWTON_ITERATIONS));
        followed().or_else(counted).or_else(iterated).unwrap_or(1.0).max(1.0)
    }

    /// The outcome, if every number in it is one and its balances close to `limit`; else a failure that keeps what can be kept.
    ///
    /// # Errors
    /// [`NumericalError::NotRepresentable`] with the first result, balance or variable that is not finite,
    /// [`NumericalError::Unbalanced`] with the first balance that does not close.
    pub fn trusted(mut self, limit: f64) -> Result<Self, Failure> {
        let results =
            self.results.iter().filter(|(_, reported)| reported.overflowed()).map(|(name, _)| name.to_owned());
        let balances =
            self.balances.iter().filter(|b| !b.relative.is_finite()).map(|b| format!("the balance {}", b.name));
        let variables = self.validity.iter().filter(|v| !v.value.is_finite()).map(|v| v.variable.clone());
        let overflowed =
            results.chain(balances).chain(variables).next().map(|name| NumericalError::NotRepresentable { name });
        let unbalanced = self.balances.iter().find(|b| b.relative.abs() > limit).map(|b| NumericalError::Unbalanced {
            balance: b.name.clone(),
            relative: b.relative,
            limit,
        });
        let Some(error) = overflowed.or(unbalanced) else { return Ok(self) };
        self.balances.retain(|b| b.relative.is_finite());
        self.validity.retain(|v| v.value.is_finite());
        Err(Failure { error: error.into(), last: Some(Box::new(self)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_counted_in_steps_systems_or_once() {
        let mut outcome = Outcome::stopped();
        assert_eq!(outcome.steps(), 1.0);
        let mut series = Series::new(vec![1.0, 2.0, 3.0]).unwrap();
        series.push(&q::RESIDUAL, vec![Some(1.0), Some(0.1), Some(1e-9)]).unwrap();
        outcome.series = Some(series);
        assert_eq!(outcome.steps(), 3.0);
        outcome.results.set(&q::NEWTON_ITERATIONS, 40.0);
        assert_eq!(outcome.steps(), 40.0);
        outcome.results.set(&q::TIME_STEP, 0.5);
        outcome.results.set(&q::TRANSIENT, 10.0);
        outcome.results.set(&q::AVERAGED_TIME, 30.0);
        assert_eq!(outcome.steps(), 80.0);
    }
}
