//! A few grains, compared with a closed form or a conservation law: verification of the engine.

pub mod clouds;
pub mod impacts;
pub mod motion;

use crate::dem::keep::contact_equations;
use crate::dem::{Engine, LinearSpring};
use crate::models::grains::Verification;
use crate::models::grains::case::VerificationCase as Which;
use crate::result::{Balance, Failure, Outcome, Quantity, Results, SolveError, Status, Watch, quantity as q};
use crate::units::significant;

/// What a verification case found.
pub type Findings = Vec<(&'static Quantity, f64)>;

/// Runs a verification case.
///
/// # Errors
/// [`Failure`] if the grains cannot go on.
pub fn run(problem: &Verification, _: &mut dyn Watch) -> Result<Outcome, Failure> {
    let mut results = Results::default();
    let mut balances = Vec::new();
    for (quantity, value) in findings(problem)? {
        results.set(quantity, value);
        if *quantity == q::LEDGER_ERROR {
            let how = "kinetic energy against all work, relative to the largest of them; the worst of all runs".into();
            balances.push(Balance { name: "energy".into(), relative: value, how });
        }
    }
    Ok(Outcome { results, balances, ..crate::dem::outcome::nothing(Status::Done) })
}

fn findings(problem: &Verification) -> Result<Findings, SolveError> {
    match problem.case {
        Which::HeadOn => impacts::head_on(problem),
        Which::Oblique => impacts::oblique(problem),
        Which::Rolling => motion::rolling(problem),
        Which::Bouncing => motion::bouncing(problem),
        Which::Stack => motion::stack(problem),
        Which::Cluster => clouds::cluster(problem),
        Which::Ledger => clouds::ledger(problem, 1_000_000),
        Which::Springs => impacts::springs(problem),
    }
}

/// Defect of the energy balance of `engine`, relative to the largest of them.
fn energy_defect(engine: &Engine<LinearSpring>) -> f64 {
    let kinetic = engine.grains().kinetic_energy();
    let scale = engine.ledger().scale(kinetic);
    if scale > 0.0 { engine.ledger().defect(kinetic).abs() / scale } else { 0.0 }
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(problem: &Verification) -> String {
    let n = |x: f64| significant(x, 5);
    let what = match problem.case {
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
        n(problem.d),
        n(problem.rho_p),
        n(problem.velocity),
        n(problem.g),
        contact_equations(&problem.contact)
    )
}

#[cfg(test)]
pub(crate) fn found(findings: Result<Findings, SolveError>, quantity: &'static Quantity) -> f64 {
    let found = findings.unwrap();
    found.iter().find(|(q, _)| *q == quantity).map(|(_, value)| *value).unwrap()
}
