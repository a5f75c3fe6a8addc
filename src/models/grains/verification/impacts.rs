//! Impacts by the hundred: restitution, duration, gross slip, energy.

use super::super::impact::{Found, follow, follow_from};
use super::{Findings, energy_defect};
use crate::closures::contact::Tension;
use crate::dem::body::Nothing;
use crate::dem::keep::law;
use crate::dem::{Domain, Engine, Grain, Settings, stability};
use crate::models::grains::case::Target;
use crate::models::grains::{Impact, Verification};
use crate::result::{SolveError, quantity as q};

/// Safety of the default time step.
const SAFETY: f64 = 0.7;
/// Moments of touch within a step that are tried.
const MOMENTS: u32 = 20;
/// The same where a contact has few steps.
const MANY: u32 = 200;

/// The head-on impact of a verification case.
fn head(problem: &Verification, e_n: f64, tension: Tension, target: Target) -> Impact {
    let mut contact = problem.contact;
    (contact.e_n, contact.tension) = (e_n, tension);
    Impact {
        d: problem.d,
        rho_p: problem.rho_p,
        velocity: problem.velocity,
        angle: 0.0,
        spin: 0.0,
        target,
        contact,
        steps_per_contact: problem.steps_per_contact,
    }
}

/// Restitution and duration in both conventions, on wall, fixed and mobile grain; order; bias at the default step.
///
/// # Errors
/// If the grains cannot go on.
pub fn head_on(problem: &Verification) -> Result<Findings, SolveError> {
    let (mut worst, mut latest, mut energy) = (0.0_f64, 0.0_f64, 0.0_f64);
    for tension in [Tension::Cut, Tension::Kept] {
        for target in [Target::Wall, Target::Fixed, Target::Mobile] {
            for tenth in 1..=10 {
                let e_n = f64::from(tenth) / 10.0;
                let found = follow(&head(problem, e_n, tension, target))?;
                worst = worst.max((found.restitution - e_n).abs());
                energy = energy.max(found.ledger.abs());
                latest = latest.max((found.duration / found.expected_duration - 1.0).abs());
            }
        }
    }
    let e_n = problem.contact.e_n;
    let pair = head(problem, e_n, problem.contact.tension, Target::Mobile);
    // What is left is the moment of the touch within a step: mean over steps that are close.
    let error = |steps: f64| {
        let sum = (0..MOMENTS).try_fold(0.0, |sum, i| {
            let steps_per_contact = steps * (1.0 + 0.01 * f64::from(i));
            Ok::<_, SolveError>(sum + (follow(&Impact { steps_per_contact, ..pair })?.restitution - e_n).abs())
        });
        sum.map(|sum| sum / f64::from(MOMENTS))
    };
    let order = (error(25.0)? / error(200.0)?).log2() / 3.0;
    let mass = Grain::at_rest([0.0; 3], 0.5 * problem.d, problem.rho_p).mass();
    let step = SAFETY * stability::of_pair(&law(&problem.contact)?, 0.5 * mass);
    let steps_per_contact = follow(&pair)?.expected_duration / step;
    let (mut sum, mut spread) = (0.0, 0.0_f64);
    for i in 0..MANY {
        let touch = (f64::from(i) + 0.5) / f64::from(MANY);
        let off = follow_from(&Impact { steps_per_contact, ..pair }, touch)?.restitution - e_n;
        sum += off;
        spread = spread.max(off.abs());
    }
    Ok(vec![
        (&q::RESTITUTION_WORST, worst),
        (&q::CONTACT_TIME_WORST, latest),
        (&q::RESTITUTION_ORDER, order),
        (&q::RESTITUTION_BIAS, sum / f64::from(MANY)),
        (&q::RESTITUTION_SPREAD, spread),
        (&q::LEDGER_ERROR, energy),
    ])
}

/// The impact on a wall at an angle \[degrees].
///
/// # Errors
/// If the grains cannot go on.
pub fn at_angle(problem: &Verification, e_n: f64, mu: f64, degrees: f64, steps: f64) -> Result<Found, SolveError> {
    let mut one = head(problem, e_n, problem.contact.tension, Target::Wall);
    one.contact.mu = mu;
    one.angle = degrees.to_radians();
    one.steps_per_contact = steps;
    follow(&one)
}

/// The gross-slip law with the contact of the case, and energy with many contacts, at all angles.
///
/// # Errors
/// If the grains cannot go on.
pub fn oblique(problem: &Verification) -> Result<Findings, SolveError> {
    let (e_n, mu) = (problem.contact.e_n, problem.contact.mu);
    let (mut slip, mut spin, mut angles, mut energy) = (0.0_f64, 0.0_f64, 0.0, 0.0_f64);
    for degrees in 1..=89 {
        let degrees = f64::from(degrees);
        let found = at_angle(problem, e_n, mu, degrees, problem.steps_per_contact)?;
        let Some(expected) = found.gross_slip else { continue };
        let change = mu * (1.0 + e_n) * problem.velocity * degrees.to_radians().cos();
        energy = energy.max(found.ledger.abs());
        slip = slip.max((found.tangential - expected).abs() / change);
        spin = spin.max((found.spin / (2.5 * change / (0.5 * problem.d)) - 1.0).abs());
        angles += 1.0;
    }
    let mut gained = f64::NEG_INFINITY;
    for e_n in [0.1, 0.5, 0.9, 1.0] {
        for mu in [0.0, 0.1, 0.4, 2.0] {
            for degrees in 0..=89 {
                gained = gained.max(at_angle(problem, e_n, mu, f64::from(degrees), 50.0)?.gained);
            }
        }
    }
    Ok(vec![
        (&q::GROSS_SLIP_WORST, slip),
        (&q::GROSS_SLIP_ANGLES, angles),
        (&q::SPIN_WORST, spin),
        (&q::ENERGY_GAINED_WORST, gained),
        (&q::LEDGER_ERROR, energy),
    ])
}

/// Kinetic and spring energy together within an elastic impact without friction, where the defect is largest.
///
/// # Errors
/// If the grains cannot go on.
pub fn springs(problem: &Verification) -> Result<Findings, SolveError> {
    let mut contact = problem.contact;
    (contact.e_n, contact.mu) = (1.0, 0.0);
    let law = law(&contact)?;
    let r = 0.5 * problem.d;
    let still = Grain::at_rest([0.0; 3], r, problem.rho_p);
    let mass = still.mass();
    let lasts = std::f64::consts::PI / (2.0 * contact.k_n / mass).sqrt();
    let mut energy = 0.0_f64;
    let mut defect = |dt: f64| -> Result<f64, SolveError> {
        let gap = 1e-3 * problem.velocity * dt;
        let comes = Grain { velocity: [-problem.velocity, 0.0, 0.0], position: [2.0 * r + gap, 0.0, 0.0], ..still };
        let settings = Settings::new(dt, [0.0; 3], problem.d);
        let mut engine = Engine::new(&[still, comes], Domain::default(), law, settings, 1)?;
        let mut before = engine.grains().kinetic_energy();
        let initial = before + engine.spring_energy();
        let mut worst = 0.0_f64;
        for _ in 0..(1.5 * lasts / dt) as usize {
            let spring = engine.spring_energy();
            engine.step(&Nothing)?;
            let after = engine.grains().kinetic_energy();
            // Velocities stand at half steps: the mean of both sides belongs to the spring between them.
            worst = worst.max((0.5 * (before + after) + spring - initial).abs() / initial);
            before = after;
        }
        energy = energy.max(energy_defect(&engine));
        Ok(worst)
    };
    // How far into a step the touch falls differs: the worst of steps that are close.
    let mut worst = |dt: f64| {
        (0..10).try_fold(0.0_f64, |worst, i| Ok::<_, SolveError>(worst.max(defect(dt * (1.0 - 0.03 * f64::from(i)))?)))
    };
    let step = SAFETY * stability::of_pair(&law, 0.5 * mass);
    let (coarse, fine) = (worst(step)?, worst(0.1 * step)?);
    Ok(vec![
        (&q::SPRING_DEFECT, coarse),
        (&q::SPRING_DEFECT_FINE, fine),
        (&q::SPRING_ORDER, (coarse / fine).log10()),
        (&q::LEDGER_ERROR, energy),
    ])
}
