//! What a solver hands back.

use serde_json::{Map, Value};

use super::{Balance, Failure, Field, Motion, Profile, Results, Series, SideView, SolveError, Status, Validity};

/// Everything that a run has to say, before it is written.
#[derive(Clone, Debug)]
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
    /// closures that were used outside their range
    pub validity: Vec<Validity>,
    /// every small number that the run used, by name
    pub regularisation: Map<String, Value>,
    /// fields over a section
    pub field: Option<Field>,
    /// grains at the end, seen from the side
    pub grains: Option<SideView>,
    /// grains as they flowed, seen from the side
    pub animation: Option<Motion>,
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
            validity: Vec::new(),
            regularisation: Map::new(),
            field: None,
            grains: None,
            animation: None,
        }
    }

    /// The outcome, if every number in it is one and its balances close to `limit`; else a failure that keeps what can be kept.
    ///
    /// # Errors
    /// [`SolveError::NotRepresentable`] with the first result, balance or variable that is not finite,
    /// [`SolveError::Unbalanced`] with the first balance that does not close.
    pub fn trusted(mut self, limit: f64) -> Result<Self, Failure> {
        let results =
            self.results.iter().filter(|(_, reported)| reported.overflowed()).map(|(name, _)| name.to_owned());
        let balances =
            self.balances.iter().filter(|b| !b.relative.is_finite()).map(|b| format!("the balance {}", b.name));
        let variables = self.validity.iter().filter(|v| !v.value.is_finite()).map(|v| v.variable.clone());
        let overflowed =
            results.chain(balances).chain(variables).next().map(|name| SolveError::NotRepresentable { name });
        let unbalanced = self.balances.iter().find(|b| b.relative.abs() > limit).map(|b| SolveError::Unbalanced {
            balance: b.name.clone(),
            relative: b.relative,
            limit,
        });
        let Some(error) = overflowed.or(unbalanced) else { return Ok(self) };
        self.balances.retain(|b| b.relative.is_finite());
        self.validity.retain(|v| v.value.is_finite());
        Err(Failure { error, last: Some(Box::new(self)) })
    }
}
