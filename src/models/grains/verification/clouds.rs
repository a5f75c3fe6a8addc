//! Grains of several sizes that fly about and collide: conserved quantities, and the energy balance.

use super::{Findings, energy_defect};
use crate::dem::body::Nothing;
use crate::dem::keep::law;
use crate::dem::{Domain, Engine, Grain, LinearSpring, Point, Settings, Wall};
use crate::models::grains::Verification;
use crate::result::{SolveError, quantity as q};
use crate::runtime::rng::Stream;

/// A cloud of `n` grains like `of`, radii spread by the share `spread`, in a box of side `side` \[m], at up to `speed` [m/s].
#[must_use]
pub fn cloud(n: u64, side: f64, spread: f64, of: &Grain, speed: f64) -> Vec<Grain> {
    let per_side = (n as f64).cbrt().ceil() as u64;
    let spacing = side / per_side as f64;
    (0..n)
        .map(|i| {
            let mut stream = Stream::new([7, 0, i]);
            let mut draw = || 2.0 * stream.uniform() - 1.0;
            let cell = [i % per_side, i / per_side % per_side, i / (per_side * per_side)];
            let radius = of.radius * (1.0 + spread * draw());
            let position = cell.map(|c| (c as f64 + 0.5) * spacing + 0.1 * of.radius * draw());
            let velocity = [draw(), draw(), draw()].map(|x| speed * x);
            let spin = [draw(), draw(), draw()].map(|x| 0.3 * speed / of.radius * x);
            Grain { position, velocity, spin, radius, ..*of }
        })
        .collect()
}

/// Momentum, angular momentum about the origin with the positions to which the velocities lead, and sums of magnitudes.
#[must_use]
pub fn momenta(engine: &Engine<LinearSpring>) -> (Point, Point, [f64; 2]) {
    let grains = engine.grains();
    let (mut p, mut l, mut scale) = ([0.0; 3], [0.0; 3], [0.0; 2]);
    for i in 0..grains.len() {
        let (x, v, w, m, r) =
            (grains.position(i), grains.velocity(i), grains.spin(i), grains.mass(i), grains.radius(i));
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            p[k] += m * v[k];
            l[k] += m * (x[a] * v[b] - x[b] * v[a]) + 0.4 * m * r * r * w[k];
            scale[0] += (m * v[k]).abs();
            scale[1] += (m * x[a] * v[b]).abs();
        }
    }
    (p, l, scale)
}

fn step(problem: &Verification, law: &LinearSpring) -> f64 {
    let mass = Grain::at_rest([0.0; 3], 0.5 * problem.d, problem.rho_p).mass();
    std::f64::consts::PI * (0.5 * mass / law.k_n).sqrt() / problem.steps_per_contact
}

/// Momentum and angular momentum of a free cluster, momentum of a periodic gas.
///
/// # Errors
/// If the grains cannot go on.
pub fn cluster(problem: &Verification) -> Result<Findings, SolveError> {
    let law = law(&problem.contact)?;
    let of = Grain::at_rest([0.0; 3], 0.5 * problem.d, problem.rho_p);
    let settings = Settings::new(step(problem, &law), [0.0; 3], problem.d);
    let side = 8.3 * problem.d;
    let grains = cloud(200, side, 0.3, &of, problem.velocity);
    let (mut linear, mut angular, mut energy) = (0.0_f64, 0.0_f64, 0.0_f64);
    for periodic in [false, true] {
        let period = periodic.then_some(side);
        let domain = Domain { periods: [period, period], walls: Vec::new() };
        let mut engine = Engine::new(&grains, domain, law, settings, 1)?;
        engine.step(&Nothing)?;
        let (p0, l0, scale) = momenta(&engine);
        for _ in 0..2000 {
            engine.step(&Nothing)?;
        }
        energy = energy.max(energy_defect(&engine));
        let (p, l, _) = momenta(&engine);
        for k in 0..3 {
            linear = linear.max((p[k] - p0[k]).abs() / scale[0]);
            if !periodic {
                angular = angular.max((l[k] - l0[k]).abs() / scale[1]);
            }
        }
    }
    Ok(vec![(&q::MOMENTUM_ERROR, linear), (&q::ANGULAR_MOMENTUM_ERROR, angular), (&q::LEDGER_ERROR, energy)])
}

/// The energy balance of eight grains that bounce and collide on a tilted plane, after `steps` steps.
///
/// # Errors
/// If the grains cannot go on.
pub fn ledger(problem: &Verification, steps: usize) -> Result<Findings, SolveError> {
    let law = law(&problem.contact)?;
    let of = Grain::at_rest([0.0; 3], 0.5 * problem.d, problem.rho_p);
    let side = 5.0 * problem.d;
    let settings = Settings::new(step(problem, &law), [0.1 * problem.g, 0.0, -problem.g], problem.d);
    let plane = vec![Wall::through([0.0; 3], [0.0, 0.0, 1.0])];
    let domain = Domain { periods: [Some(side), Some(side)], walls: plane };
    let mut engine = Engine::new(&cloud(8, side, 0.2, &of, problem.velocity), domain, law, settings, 1)?;
    for _ in 0..steps {
        engine.step(&Nothing)?;
    }
    Ok(vec![
        (&q::LEDGER_ERROR, energy_defect(&engine)),
        (&q::MOMENTUM_ERROR, engine.ledger().momentum_defect(engine.grains().momentum())),
    ])
}
