//! The grain engine against closed forms, conservation laws and itself.

mod bits;
mod conservation;
mod guards;
mod impacts;
mod motion;

use super::body::Nothing;
use super::{Domain, Engine, Grain, LinearSpring, Point, Settings, Tension, Wall};

/// Radius [m] and density [kg/m3] of the paper's grains.
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
    let per_side = (n as f64).cbrt().ceil() as u64;
    let spacing = side / per_side as f64;
    (0..n)
        .map(|i| {
            let mut stream = crate::runtime::rng::Stream::new([7, 0, i]);
            let mut draw = || 2.0 * stream.uniform() - 1.0;
            let cell = [i % per_side, i / per_side % per_side, i / (per_side * per_side)];
            let radius = R * (1.0 + spread * draw());
            let position = cell.map(|c| (c as f64 + 0.5) * spacing + 0.1 * R * draw());
            let velocity = [draw(), draw(), draw()];
            let spin = [100.0 * draw(), 100.0 * draw(), 100.0 * draw()];
            Grain { position, velocity, spin, radius, density: RHO, fixed: false }
        })
        .collect()
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
