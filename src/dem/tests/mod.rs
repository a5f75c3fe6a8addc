//! The grain engine against closed forms, conservation laws and itself.

mod bits;
mod conservation;
mod guards;
mod impacts;
mod laws;
mod motion;

use super::body::Nothing;
use super::{Domain, Engine, Grain, LinearSpring, Point, Settings, Wall};
use crate::closures::contact;
use crate::closures::contact::Tension;
use crate::models::grains::Verification;
use crate::models::grains::case::VerificationCase as Which;

/// Radius \[m] and density [kg/m3] of the paper's grains.
const R: f64 = 3e-3;
const RHO: f64 = 2500.0;
const G: f64 = 9.81;

fn law(e_n: f64, tension: Tension) -> LinearSpring {
    LinearSpring::new(5e3, 2.5e3, 0.4, e_n, tension).unwrap()
}

fn grain(position: Point, velocity: Point) -> Grain {
    Grain { velocity, ..Grain::at_rest(position, R, RHO) }
}

fn floor() -> Domain {
    Domain { periods: [None, None], walls: vec![Wall::through([0.0; 3], [0.0, 0.0, 1.0])] }
}

fn engine(grains: &[Grain], domain: Domain, law: LinearSpring, dt: f64, gravity: Point) -> Engine<LinearSpring> {
    Engine::new(grains, domain, law, Settings::new(dt, gravity, 2.0 * R), 1).unwrap()
}

fn go(engine: &mut Engine<LinearSpring>, steps: usize) {
    for _ in 0..steps {
        engine.step(&Nothing).unwrap();
    }
}

/// A cloud of `n` grains of a range of sizes that fly about in a box of side `side`.
fn gas(n: u64, side: f64, spread: f64) -> Vec<Grain> {
    crate::models::grains::verification::clouds::cloud(n, side, spread, &Grain::at_rest([0.0; 3], R, RHO), 1.0)
}

/// A verification case of the paper's grains.
fn verification(which: Which, e_n: f64, steps_per_contact: f64) -> Verification {
    let contact = contact::LinearSpring { k_n: 5e3, k_s: 2.5e3, mu: 0.4, e_n, tension: Tension::Cut };
    Verification { case: which, d: 2.0 * R, rho_p: RHO, velocity: 0.1, g: G, contact, steps_per_contact }
}

fn hash(engine: &Engine<LinearSpring>) -> u64 {
    let grains = engine.grains();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for place in grains.places() {
        for rows in [&grains.positions, &grains.velocities, &grains.spins] {
            for x in rows[place].0 {
                hash = (hash ^ x.to_bits()).wrapping_mul(0x100_0000_01b3);
            }
        }
    }
    hash
}
