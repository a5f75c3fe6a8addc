//! Leapfrog: velocities at half steps, positions at whole ones.
//!
//! v(t + h/2) = v(t - h/2) + h f(t)/m, x(t + h) = x(t) + h v(t + h/2), and R ω as v with 5/2 of the torque over R.
//! The work of a force over the kick is f · (v- + v+) h/2 exactly, so the kinetic energy balances to round-off.
#![allow(unsafe_code, reason = "instructions chosen at run time")]

use super::body::{Body, GrainState};
use super::grains::Point;
#[cfg(target_arch = "x86_64")]
use super::simd::avx2::Four;
use super::simd::{Backend, Load, Quad, Row};
use super::tile::Moved;

/// Lengths of one step \[s].
#[derive(Clone, Copy, Debug)]
pub struct Lengths {
    /// of the kick: h, or h/2 to begin with
    pub kick: f64,
    /// of the drift
    pub drift: f64,
}

/// The rows of the grains of one tile.
#[derive(Debug)]
pub struct Rows<'a> {
    /// positions and radii
    pub positions: &'a mut [Row],
    /// velocities and masses
    pub velocities: &'a mut [Row],
    /// R ω and inverse masses
    pub spins: &'a mut [Row],
    /// names
    pub ids: &'a [u32],
    /// what acts on them, by the contacts of this tile and of others; zero afterwards
    pub loads: &'a mut [Load],
}

/// Adds what another tile did to some grains, and leaves zeros there.
pub fn gather(backend: Backend, loads: &mut [Load], others: &mut [Load]) {
    match backend {
        Backend::Scalar => gathered::<Row>((), loads, others),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(proof) => unsafe { gather_on_avx2(proof, loads, others) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(proof) => unsafe { gather_on_avx2(proof.narrower(), loads, others) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn gather_on_avx2(proof: <Four as Quad>::Proof, loads: &mut [Load], others: &mut [Load]) {
    gathered::<Four>(proof, loads, others);
}

#[inline(always)]
fn gathered<Q: Quad>(proof: Q::Proof, loads: &mut [Load], others: &mut [Load]) {
    for (Load(sums), Load(more)) in loads.iter_mut().zip(others) {
        for (sum, more) in sums.iter_mut().zip(more) {
            *sum = Q::of(proof, sum).plus(Q::of(proof, more)).row();
            *more = Row::default();
        }
    }
}

/// What moves the grains of one tile.
#[derive(Debug)]
pub struct Mover<'a, B> {
    /// gravity [m/s2]
    pub gravity: Point,
    /// what acts on each grain besides
    pub body: &'a B,
    /// how far
    pub step: Lengths,
}

impl<B> Clone for Mover<'_, B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<B> Copy for Mover<'_, B> {}

/// Moves the grains of one tile by one step.
pub fn advance<B: Body>(backend: Backend, mover: Mover<'_, B>, rows: Rows<'_>) -> Moved {
    match backend {
        Backend::Scalar => moved::<B, Row>((), mover, rows),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(proof) => unsafe { on_avx2(proof, mover, rows) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(proof) => unsafe { on_avx2(proof.narrower(), mover, rows) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2<B: Body>(proof: <Four as Quad>::Proof, mover: Mover<'_, B>, rows: Rows<'_>) -> Moved {
    moved::<B, Four>(proof, mover, rows)
}

#[inline(always)]
fn moved<B: Body, Q: Quad>(proof: Q::Proof, mover: Mover<'_, B>, rows: Rows<'_>) -> Moved {
    let Mover { gravity: [gx, gy, gz], body, step } = mover;
    let Rows { positions, velocities, spins, ids, loads } = rows;
    let zero = Q::of(proof, &Row::default());
    let gravity = Q::of(proof, &Row([gx, gy, gz, 0.0]));
    let (mut contact, mut weight, mut driven, mut given, mut sane, mut fastest) = (zero, zero, zero, zero, zero, zero);
    let mut on_fixed = zero;
    for ((((x, v), w), load), &id) in positions.iter_mut().zip(velocities).zip(spins).zip(loads).zip(ids) {
        let [force, turn] = [Q::of(proof, &load.0[0]), Q::of(proof, &load.0[1])];
        // Cleared while it is at hand.
        *load = Load::default();
        let (inverse, mass) = (w.0[3], v.0[3]);
        let (place, velocity, spin) = (Q::of(proof, x), Q::of(proof, v), Q::of(proof, w));
        let old = velocity.with_last(zero);
        if inverse == 0.0 {
            on_fixed = on_fixed.plus(force);
            *x = place.plus(old.times(step.drift)).row();
            continue;
        }
        let state =
            GrainState { id, position: [x.0[0], x.0[1], x.0[2]], velocity: [v.0[0], v.0[1], v.0[2]], radius: x.0[3] };
        let [bx, by, bz] = body.force(&state);
        let (outer, falling) = (Q::of(proof, &Row([bx, by, bz, 0.0])), gravity.times(mass));
        let both = falling.plus(outer);
        let new = old.plus(force.plus(both).times(inverse).times(step.kick));
        let new_spin = spin.plus(turn.times(2.5 * inverse).times(step.kick));
        let (mean, mean_spin) = (old.plus(new).times(0.5), spin.plus(new_spin).times(0.5));
        *x = place.plus(new.times(step.drift)).row();
        *v = new.with_last(velocity).row();
        *w = new_spin.row();
        contact = contact.plus(force.by(mean).plus(turn.by(mean_spin)));
        weight = weight.plus(falling.by(mean));
        driven = driven.plus(outer.by(mean));
        given = given.plus(both);
        // A number minus itself is 0, infinity minus itself is none.
        let any = new.plus(new_spin);
        sane = sane.plus(any.minus(any));
        fastest = fastest.max(new.by(new));
    }
    let total = |sum: Q| {
        let [a, b, c, _] = sum.row().0;
        a + b + c
    };
    let impulse = |force: Q| {
        let [x, y, z, _] = force.times(step.kick).row().0;
        [x, y, z]
    };
    Moved {
        fastest: total(fastest),
        sane: total(sane),
        contact_work: step.kick * total(contact),
        gravity_work: step.kick * total(weight),
        body_work: step.kick * total(driven),
        impulse: impulse(given),
        on_fixed: impulse(on_fixed),
    }
}
