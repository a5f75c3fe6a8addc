//! Leapfrog: velocities at half steps, positions at whole ones.
//!
//! v(t + h/2) = v(t - h/2) + h f(t)/m, x(t + h) = x(t) + h v(t + h/2), and R ω as v with 5/2 of the torque over R.
//! The work of a force over the kick is f · (v- + v+) h/2 exactly, so the kinetic energy can be accounted for to round-off.
#![allow(unsafe_code, reason = "instructions chosen at run time")]

use super::body::{Body, Seen};
use super::grains::Point;
use super::lanes::{Backend, Load, Row};
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

/// Moves the grains of tile `t` by one step.
pub fn advance<B: Body>(
    backend: Backend,
    tiles: &[Tile],
    t: usize,
    rows: Rows<'_>,
    gravity: Point,
    body: &B,
    step: Lengths,
) -> Moved {
    match backend {
        Backend::Scalar => moved(tiles, t, rows, gravity, body, step),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(_) => unsafe { on_avx2(tiles, t, rows, gravity, body, step) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(_) => unsafe { on_avx512(tiles, t, rows, gravity, body, step) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2<B: Body>(tiles: &[Tile], t: usize, rows: Rows<'_>, gravity: Point, body: &B, step: Lengths) -> Moved {
    moved(tiles, t, rows, gravity, body, step)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn on_avx512<B: Body>(tiles: &[Tile], t: usize, rows: Rows<'_>, gravity: Point, body: &B, step: Lengths) -> Moved {
    moved(tiles, t, rows, gravity, body, step)
}

#[inline(always)]
fn moved<B: Body>(tiles: &[Tile], t: usize, rows: Rows<'_>, gravity: Point, body: &B, step: Lengths) -> Moved {
    let tile = &tiles[t];
    let start = tile.grains.start;
    // What earlier tiles did to these grains, added in the order of the tiles.
    let spilled = |other: &'_ Tile| other.grains.start + other.loads.len() > start;
    let from = tiles[..t].iter().position(spilled).unwrap_or(t);
    let earlier = &tiles[from..t];
    let mut moved = Moved::default();
    let Rows { positions, velocities, spins, ids } = rows;
    for (local, ((x, v), w)) in positions.iter_mut().zip(velocities).zip(spins).enumerate() {
        let Load(mut load) = tile.loads[local];
        for other in earlier {
            if let Some(Load(more)) = other.loads.get(start + local - other.grains.start) {
                for k in 0..8 {
                    load[k] += more[k];
                }
            }
        }
        let (inverse, mass) = (w.0[3], v.0[3]);
        if inverse == 0.0 {
            for k in 0..3 {
                x.0[k] += step.drift * v.0[k];
            }
            continue;
        }
        let [px, py, pz, radius] = x.0;
        let seen =
            Seen { id: ids[local], position: [px, py, pz], velocity: [v.0[0], v.0[1], v.0[2]], radius };
        let outer = body.force(&seen);
        let (mut squared, mut contact, mut falling, mut driven) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..3 {
            let weight = mass * gravity[k];
            let total = load[k] + (weight + outer[k]);
            let (old, old_spin) = (v.0[k], w.0[k]);
            let new = old + step.kick * (inverse * total);
            let new_spin = old_spin + step.kick * (2.5 * inverse * load[k + 3]);
            let (mean, mean_spin) = (0.5 * (old + new), 0.5 * (old_spin + new_spin));
            v.0[k] = new;
            w.0[k] = new_spin;
            x.0[k] += step.drift * new;
            squared += new * new;
            contact += load[k] * mean + load[k + 3] * mean_spin;
            falling += weight * mean;
            driven += outer[k] * mean;
            moved.impulse[k] += step.kick * (weight + outer[k]);
        }
        if squared > moved.fastest {
            moved.fastest = squared;
        }
        // Infinity minus itself is none, either.
        let spin = w.0[0] + w.0[1] + w.0[2];
        moved.sane += (squared - squared) + (spin - spin);
        moved.contact_work += step.kick * contact;
        moved.gravity_work += step.kick * falling;
        moved.body_work += step.kick * driven;
    }
    moved
}
