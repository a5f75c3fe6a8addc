//! What a run answers, in a few lines: the transport rate with what it is worth, and the numbers that stand beside it.

use serde_json::Value;

use super::{Balance, Reported, Summary, quantity};
use crate::units::{CommonUnits, readable, readable_error};

impl Summary {
    /// What a reader wants to know first: names and texts, the transport rate before all.
    #[must_use]
    pub fn answer(&self) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        let shown = [&quantity::TRANSPORT_RATE].into_iter().chain(HEADLINES.iter().copied().flatten().copied());
        let units = CommonUnits::of(shown.filter_map(|q| Some((self.results.get(q.name)?, q.unit))));
        let value = |q: &'static quantity::Quantity| self.results.get(q.name).map(|x| units.readable(x, q.unit));
        let title = quantity::TRANSPORT_RATE.title;
        if let Some(rate) = value(&quantity::TRANSPORT_RATE) {
            let star = value(&quantity::TRANSPORT_RATE_DIMENSIONLESS).map(|x| format!("  (Q* = {x})"));
            lines.push((title.to_owned(), format!("{rate}{}  {}", star.unwrap_or_default(), trust(self))));
        } else if let Some(why) = self.results.reason(quantity::TRANSPORT_RATE.name) {
            lines.push((title.to_owned(), format!("none: {why}")));
        }
        // Between planes the rate of transport is known per width.
        let of_a_section = |group: &&&[&quantity::Quantity]| group.contains(&&quantity::BED_FLUX);
        let per_width = value(&quantity::TRANSPORT_RATE).is_some();
        for group in HEADLINES.iter().filter(|group| !(per_width && of_a_section(group))) {
            let given: Vec<_> =
                group.iter().filter_map(|q| Some((q.title, format!("{} {}", q.symbol, value(q)?)))).collect();
            if let Some((title, _)) = given.first() {
                let text: Vec<&str> = given.iter().map(|(_, text)| text.as_str()).collect();
                lines.push(((*title).to_owned(), text.join("   ")));
            }
        }
        lines
    }
}

/// What the transport rate is worth.
fn trust(summary: &Summary) -> String {
    let known = summary.results.iter().find(|(name, _)| *name == quantity::TRANSPORT_RATE.name);
    if let Some((_, Reported { value: Some(value), stderr, reason })) = known {
        let error = stderr.map(|error| readable_error(*value, error, quantity::TRANSPORT_RATE.unit));
        match (error, reason) {
            (Some(known), _) => return known.unwrap_or_else(|| "error unknown".into()),
            (None, Some(reason)) => return format!("error unknown: {reason}"),
            (None, None) => {}
        }
    }
    let result = |quantity: &quantity::Quantity| summary.results.get(quantity.name);
    if let (Some(_), Some(time)) = (result(&quantity::RATE_AMPLITUDE), result(&quantity::AVERAGED_TIME)) {
        return format!("mean over {}", readable(time, "s"));
    }
    if let Some(mean) = result(&quantity::RATE_MEAN) {
        return format!("at the last instant; {} over the later half", readable(mean, quantity::RATE_MEAN.unit));
    }
    let lambda = |key: &str| summary.regularisation.get(key).and_then(Value::as_f64);
    let lambda = lambda("lambda_scaled").or_else(|| lambda("lambda_1_s"));
    match (summary.results.get(quantity::REGULARISATION_RATE.name), lambda) {
        (Some(error), _) => format!("{:+.2e} by the regularisation", error),
        (None, Some(lambda)) if lambda > 0.0 => "regularised".into(),
        (None, Some(_)) => "exact yield".into(),
        (None, None) if summary.regularisation.contains_key("granular_temperature_m2_s2") => {
            "order 2 in its cells".into()
        }
        // A solver without a word of its error may be anything; a closed form shows itself in its balances.
        (None, None) if at_round_off(&summary.balances) => "closed form, exact to round-off".into(),
        (None, None) => "error unknown".into(),
    }
}

/// Whether there are balances, and all of them close to round-off.
fn at_round_off(balances: &[Balance]) -> bool {
    const ROUND_OFF: f64 = 1e-9;
    !balances.is_empty() && balances.iter().all(|balance| balance.relative.abs() <= ROUND_OFF)
}

/// Numbers of the answer, a line each, named by the first.
const HEADLINES: &[&[&quantity::Quantity]] = &[
    &[&quantity::SHIELDS, &quantity::U_STAR, &quantity::SHIELDS_BED],
    &[&quantity::RATE_AMPLITUDE, &quantity::RATE_FORWARD, &quantity::RATE_BACKWARD],
    &[&quantity::FLOW_RATE, &quantity::BED_FLUX],
    &[&quantity::STREAM_MAX, &quantity::VORTEX_Z, &quantity::UNYIELDED_SHARE, &quantity::UNYIELDED_SHARE_ERROR],
    &[&quantity::MOBILE_DEPTH, &quantity::YIELD_LEVEL],
    &[&quantity::LAYER_THICKNESS, &quantity::TEMPERATURE_MAX, &quantity::GROWTH_RATE],
    &[&quantity::U_MAX, &quantity::MEAN_VELOCITY],
    &[&quantity::BINGHAM, &quantity::HALF_PLUG, &quantity::PLUG_VELOCITY],
    &[&quantity::PLUG_SHARE, &quantity::DEAD_SHARE, &quantity::YIELD_OVER_CRITICAL],
    &[&quantity::PHI_BULK, &quantity::BED_LEVEL, &quantity::COORDINATION],
    &[&quantity::RESTITUTION, &quantity::CONTACT_TIME, &quantity::TANGENTIAL_VELOCITY],
    &[&quantity::SURFACE_VELOCITY, &quantity::INERTIAL_NUMBER_FILM, &quantity::ROUGHNESS_LENGTH],
];
