//! Leapfrog: velocities at half steps, positions at whole ones.
//!
//! v(t + h/2) = v(t - h/2) + h f(t)/m, x(t + h) = x(t) + h v(t + h/2), and R ω as v with 5/2 of the torque over R.
//! The work of a force over the kick is f · (v- + v+) h/2 exactly, so the kinetic energy can be accounted for to round-off.
#![allow(unsafe_code, reason = "instructions chosen at run time")]

use super::body::{Body, Seen};
use super::grains::Point;
#[cfg(target_arch = "x86_64")]
use super::lanes::avx2::Four;
use super::lanes::{Backend, Load, Quad, Row};
use super::tile::{Moved, Tile};

/// Lengths of one step [s].
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
}

/// What moves the grains of one tile.
#[derive(Debug)]
pub struct Mover<'a, B> {
    /// all tiles
    pub tiles: &'a [Tile],
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

/// Moves the grains of tile `t` by one step.
pub fn advance<B: Body>(backend: Backend, mover: Mover<'_, B>, t: usize, rows: Rows<'_>) -> Moved {
    match backend {
        Backend::Scalar => moved::<B, Row>((), mover, t, rows),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(proof) => unsafe { on_avx2(proof, mover, t, rows) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(proof) => unsafe { on_avx2(proof.narrower(), mover, t, rows) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2<B: Body>(proof: <Four as Quad>::Proof, mover: Mover<'_, B>, t: usize, rows: Rows<'_>) -> Moved {
    moved::<B, Four>(proof, mover, t, rows)
}

#[inline(always)]
fn moved<B: Body, Q: Quad>(proof: Q::Proof, mover: Mover<'_, B>, t: usize, rows: Rows<'_>) -> Moved {
    let Mover { tiles, gravity: [gx, gy, gz], body, step } = mover;
    let tile = &tiles[t];
    let start = tile.grains.start;
    // What earlier tiles did to these grains, added in the order of the tiles.
    let spilled = |other: &'_ Tile| other.grains.start + other.loads.len() > start;
    let from = tiles[..t].iter().position(spilled).unwrap_or(t);
    let earlier = &tiles[from..t];
    let Rows { positions, velocities, spins, ids } = rows;
    let zero = Q::of(proof, &Row::default());
    let gravity = Q::of(proof, &Row([gx, gy, gz, 0.0]));
    let (mut contact, mut weight, mut driven, mut given, mut sane, mut fastest) = (zero, zero, zero, zero, zero, zero);
    let loads = &tile.loads[..positions.len()];
    for (local, ((x, v), w)) in positions.iter_mut().zip(velocities).zip(spins).enumerate() {
        let [mut force, mut turn] = [Q::of(proof, &loads[local].0[0]), Q::of(proof, &loads[local].0[1])];
        for other in earlier {
            if let Some(Load([more, twist])) = other.loads.get(start + local - other.grains.start) {
                force = force.plus(Q::of(proof, more));
                turn = turn.plus(Q::of(proof, twist));
            }
        }
        let (inverse, mass) = (w.0[3], v.0[3]);
        let (place, velocity, spin) = (Q::of(proof, x), Q::of(proof, v), Q::of(proof, w));
        let old = velocity.with_last(zero);
        if inverse == 0.0 {
            *x = place.plus(old.times(step.drift)).row();
            continue;
        }
        let seen = Seen {
            id: ids[local],
            position: [x.0[0], x.0[1], x.0[2]],
            velocity: [v.0[0], v.0[1], v.0[2]],
            radius: x.0[3],
        };
        let [bx, by, bz] = body.force(&seen);
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
    let [px, py, pz, _] = given.times(step.kick).row().0;
    Moved {
        fastest: total(fastest),
        sane: total(sane),
        contact_work: step.kick * total(contact),
        gravity_work: step.kick * total(weight),
        body_work: step.kick * total(driven),
        impulse: [px, py, pz],
    }
}
