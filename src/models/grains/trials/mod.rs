//! A few grains, held against a closed form or a conservation law: what the engine is known to do exactly.

pub mod clouds;
pub mod impacts;
pub mod motion;

use crate::dem::keep::contact_equations;
use crate::dem::{Engine, LinearSpring};
use crate::models::grains::Trial;
use crate::models::grains::case::Trial as Which;
use crate::result::{Balance, Failure, Outcome, Quantity, Results, SolveError, Status, Watch, quantity as q};
use crate::units::significant;

/// What a trial found.
pub type Findings = Vec<(&'static Quantity, f64)>;

/// Makes the trial of a case.
///
/// # Errors
/// [`Failure`] if the grains cannot go on.
pub fn run(trial: &Trial, _: &mut dyn Watch) -> Result<Outcome, Failure> {
    let mut results = Results::default();
    let mut balances = Vec::new();
    for (quantity, value) in findings(trial)? {
        results.set(quantity, value);
        if *quantity == q::LEDGER_ERROR {
            let how = "kinetic energy against all work, relative to the largest of them; the worst of all runs".into();
            balances.push(Balance { name: "energy".into(), relative: value, how });
        }
    }
    Ok(Outcome { results, balances, ..crate::dem::outcome::nothing(Status::Done) })
}

fn findings(trial: &Trial) -> Result<Findings, SolveError> {
    match trial.trial {
        Which::HeadOn => impacts::head_on(trial),
        Which::Oblique => impacts::oblique(trial),
        Which::Rolling => motion::rolling(trial),
        Which::Bouncing => motion::bouncing(trial),
        Which::Stack => motion::stack(trial),
        Which::Cluster => clouds::cluster(trial),
        Which::Ledger => clouds::ledger(trial, 1_000_000),
        Which::Springs => impacts::springs(trial),
    }
}

/// Defect of the account of energies of `engine`, relative to the largest of them.
fn accounted(engine: &Engine<LinearSpring>) -> f64 {
    let kinetic = engine.grains().kinetic_energy();
    let scale = engine.ledger().scale(kinetic);
    if scale > 0.0 { engine.ledger().defect(kinetic).abs() / scale } else { 0.0 }
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(trial: &Trial) -> String {
    let n = |x: f64| significant(x, 5);
    let what = match trial.trial {
        Which::HeadOn => "head-on impacts, e_n from 0.1 to 1",
        Which::Oblique => "oblique impacts at every degree",
        Which::Rolling => "a sphere that slides on a plane until it rolls",
        Which::Bouncing => "a sphere that bounces on a plane",
        Which::Stack => "three spheres, one on the other",
        Which::Cluster => "two hundred spheres that collide, free and in a periodic box",
        Which::Ledger => "eight spheres that collide on a plane, a million steps",
        Which::Springs => "an elastic impact without friction",
    };
    format!(
        "Trial: {what}; d = {} m, ρ_p = {} kg/m³, v = {} m/s, g = {} m/s².\n\n{}",
        n(trial.d),
        n(trial.rho_p),
        n(trial.velocity),
        n(trial.g),
        contact_equations(&trial.contact)
    )
}

#[cfg(test)]
pub(crate) fn found(findings: Result<Findings, SolveError>, quantity: &'static Quantity) -> f64 {
    let found = findings.unwrap();
    found.iter().find(|(q, _)| *q == quantity).map(|(_, value)| *value).unwrap()
}
