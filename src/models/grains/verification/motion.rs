//! Grains on a plane: sliding, bouncing, stacked.

use super::{Findings, energy_defect};
use crate::closures::contact::restitution;
use crate::dem::body::Nothing;
use crate::dem::keep::law;
use crate::dem::{Domain, Engine, Grain, LinearSpring, Settings, Wall};
use crate::models::grains::Verification;
use crate::result::{SolveError, quantity as q};

/// Grains above a plane at z = 0, with the step of the case.
fn on_plane(problem: &Verification, grains: &[Grain]) -> Result<Engine<LinearSpring>, SolveError> {
    let law = law(&problem.contact)?;
    let mass = grain(problem).mass();
    let lasts = restitution::duration(law.zeta, law.tension) / (law.k_n / mass).sqrt();
    let settings = Settings::new(lasts / problem.steps_per_contact, [0.0, 0.0, -problem.g], problem.d);
    let plane = Domain { periods: [None, None], walls: vec![Wall::through([0.0; 3], [0.0, 0.0, 1.0])] };
    Ok(Engine::new(grains, plane, law, settings, 1)?)
}

fn grain(problem: &Verification) -> Grain {
    Grain::at_rest([0.0; 3], 0.5 * problem.d, problem.rho_p)
}

/// Overlap of a grain at rest on the plane \[m].
fn sunk(problem: &Verification) -> f64 {
    grain(problem).mass() * problem.g / problem.contact.k_n
}

/// Slip turns into rolling at 2 v_0/(7 μ g) with 5/7 v_0.
///
/// # Errors
/// If the grains cannot go on.
pub fn rolling(problem: &Verification) -> Result<Findings, SolveError> {
    let (v0, r) = (problem.velocity, 0.5 * problem.d);
    let start = Grain { position: [0.0, 0.0, r - sunk(problem)], velocity: [v0, 0.0, 0.0], ..grain(problem) };
    let mut engine = on_plane(problem, &[start])?;
    let dt = engine.settings().dt;
    let expected = 2.0 * v0 / (7.0 * problem.contact.mu * problem.g);
    let mut rolling = f64::NAN;
    for step in 1..=(1.5 * expected / dt) as usize {
        engine.step(&Nothing)?;
        let (v, w) = (engine.grains().velocity(0)[0], engine.grains().spin(0)[1]);
        if rolling.is_nan() && v <= w * r {
            rolling = step as f64 * dt;
        }
    }
    // The tangential spring goes on swinging a little: mean over many of its periods.
    let count = 20.0 * problem.steps_per_contact;
    let mut sums = [0.0; 2];
    for _ in 0..count as usize {
        engine.step(&Nothing)?;
        sums[0] += engine.grains().velocity(0)[0];
        sums[1] += engine.grains().spin(0)[1] * r;
    }
    let off = sums.map(|sum| (sum / count.floor() / (5.0 / 7.0 * v0) - 1.0).abs());
    Ok(vec![
        (&q::ROLLING_TIME_ERROR, rolling / expected - 1.0),
        (&q::ROLLING_VELOCITY_ERROR, off[0].max(off[1])),
        (&q::LEDGER_ERROR, energy_defect(&engine)),
    ])
}

/// Three heights after as many impacts, each e² times the one before; dropped with the energy of the velocity.
///
/// # Errors
/// If the grains cannot go on.
pub fn bouncing(problem: &Verification) -> Result<Findings, SolveError> {
    let (r, e) = (0.5 * problem.d, problem.contact.e_n);
    let height = problem.velocity * problem.velocity / (2.0 * problem.g);
    let start = Grain { position: [0.0, 0.0, r + height], ..grain(problem) };
    let mut engine = on_plane(problem, &[start])?;
    let mut worst = 0.0_f64;
    let mut expected = height;
    for _ in 0..3 {
        expected *= e * e;
        while engine.grains().velocity(0)[2] <= 0.0 || engine.grains().position(0)[2] < r {
            engine.step(&Nothing)?;
        }
        while engine.grains().velocity(0)[2] > 0.0 {
            engine.step(&Nothing)?;
        }
        worst = worst.max(((engine.grains().position(0)[2] - r) / expected - 1.0).abs());
    }
    Ok(vec![(&q::BOUNCE_ERROR, worst), (&q::LEDGER_ERROR, energy_defect(&engine))])
}

/// Three grains at rest: each contact is pressed together by what stands on it.
///
/// # Errors
/// If the grains cannot go on.
pub fn stack(problem: &Verification) -> Result<Findings, SolveError> {
    let (r, sunk) = (0.5 * problem.d, sunk(problem));
    let mut z = r - 3.0 * sunk;
    let mut grains = Vec::new();
    for above in [2.0, 1.0, 0.0] {
        // A little off the equilibrium.
        grains.push(Grain { position: [0.0, 0.0, z + 0.2 * sunk], ..grain(problem) });
        z += 2.0 * r - above * sunk;
    }
    let mut engine = on_plane(problem, &grains)?;
    for _ in 0..(800.0 * problem.steps_per_contact) as usize {
        engine.step(&Nothing)?;
    }
    let z: Vec<f64> = engine.grains().listed().iter().map(|grain| grain.position[2]).collect();
    let overlaps = [r - z[0], 2.0 * r - (z[1] - z[0]), 2.0 * r - (z[2] - z[1])];
    let off = overlaps.into_iter().zip([3.0, 2.0, 1.0]).map(|(overlap, load)| (overlap / (load * sunk) - 1.0).abs());
    Ok(vec![(&q::STACK_ERROR, off.fold(0.0, f64::max)), (&q::LEDGER_ERROR, energy_defect(&engine))])
}
