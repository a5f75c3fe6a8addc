//! Flows in which no layer of grains moves: the answer is that there is none, and how far the flow is over the threshold of motion.

use super::SheetFlow;
use crate::closures::friction::FrictionLaw;
use crate::closures::suspension::Settling;
use crate::closures::threshold::{RANGE, soulsby};
use crate::models::exact::outcome;
use crate::result::{Failure, Outcome, Premise, Quantity, Results, Status, Verdict, quantity as q};
use crate::units::significant;

/// What has no value without a layer, and is nothing where nothing moves.
const RATES: [&Quantity; 6] = [
    &q::TRANSPORT_RATE,
    &q::TRANSPORT_RATE_DIMENSIONLESS,
    &q::TRANSPORT_RATE_MASS,
    &q::TRANSPORT_RATE_BULK,
    &q::TRANSPORT_RATE_BED,
    &q::TRANSPORT_RATE_SUSPENSION,
];
/// What has none in either case.
const LAYER: [&Quantity; 3] = [&q::SHEET_THICKNESS, &q::YIELD_LEVEL, &q::ROUGHNESS];

impl<F: FrictionLaw> SheetFlow<F> {
    /// Shields number at which single grains begin to move.
    pub(super) fn threshold(&self) -> f64 {
        let size = self.d * (self.g * (self.rho_p / self.rho_f - 1.0) * (self.rho_f / self.eta).powi(2)).cbrt();
        soulsby(size)
    }

    /// Whether not a single grain moves at this Shields number: it is below the range of measured thresholds.
    pub(super) fn all_rest(&self, shields: f64) -> bool {
        shields < self.threshold() * RANGE.0
    }

    /// That there is a layer of moving grains; not said where not a grain moves.
    pub(super) fn a_layer_moves(&self, results: &Results) -> Option<Premise> {
        let of = |quantity: &Quantity| results.get(quantity.name);
        let (shields, least) = (of(&q::SHIELDS)?, of(&q::SHIELDS_LEAST));
        let (threshold, found) = (self.threshold(), of(&q::TRANSPORT_RATE));
        let verdict = match (found, least) {
            (Some(rate), None) if rate > 0.0 => Verdict::Holds,
            (Some(_), None) => return None,
            (Some(_), Some(_)) => Verdict::Doubtful,
            (None, _) => Verdict::Broken,
        };
        Some(Premise {
            premise: "a layer of grains moves".into(),
            number: format!("θ/θ_c, θ_c = {} the threshold of motion", significant(threshold, 3)),
            value: shields / threshold,
            range: least.map_or_else(
                || "a layer was found".into(),
                |least| {
                    let times = significant(least / threshold, 3);
                    format!("a layer moves from {times}, θ = {}, on", significant(least, 4))
                },
            ),
            verdict,
            why: match verdict {
                Verdict::Holds => "",
                Verdict::Doubtful => "right at the edge a layer is found by a creep alone: its rate depends on that",
                Verdict::Broken => {
                    "grains move, but no continuous layer of them: single grains roll and jump. There is no rate; take \
                     grains one by one (model coupled)"
                }
            }
            .into(),
            source: "the fold of the equations; Soulsby (1997), Dynamics of Marine Sands, eq. (77)".into(),
        })
    }

    /// The answer where no layer moves at the Shields number `shields`: `least` is that from which on one does, and where not a grain moves,
    /// there is none to look for.
    pub(super) fn without_layer(&self, shields: f64, least: Option<f64>) -> Result<Outcome, Failure> {
        let mut results = Results::default();
        let ratio = significant(shields / self.threshold(), 3);
        let why = match least {
            Some(least) => format!(
                "no layer of grains moves: θ = {} is {ratio} times the threshold of motion, and a layer moves from θ = {} on",
                significant(shields, 4),
                significant(least, 4)
            ),
            None => format!("no grain moves: θ is {ratio} times the threshold of motion"),
        };
        for quantity in RATES {
            match least {
                Some(_) => results.undefined(quantity, &why),
                None => results.set(quantity, 0.0),
            }
        }
        LAYER.into_iter().for_each(|quantity| results.undefined(quantity, &why));
        results.set(&q::SHIELDS, shields);
        let u_star = self.velocity_scale() * shields.sqrt();
        results.set(&q::U_STAR, u_star);
        if let Some(w_s) = self.suspension.settling_velocity() {
            results.set(&q::SUSPENSION_NUMBER, w_s / u_star);
        }
        if let Some(least) = least {
            results.set(&q::SHIELDS_LEAST, least);
        }
        results.set(&q::BED_LEVEL, self.level);
        results.set(&q::FLOW_HEIGHT, self.height);
        let outcome = outcome(None, Vec::new(), results, Vec::new(), Vec::new())?;
        Ok(Outcome { status: Status::Done, ..outcome })
    }
}
