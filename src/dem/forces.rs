//! The pair loop, written once: which listed pairs touch, and what the law makes of those.
#![allow(unsafe_code, reason = "indices are checked once per tile, and instructions chosen at run time")]

use super::domain::Domain;
use super::grains::Grains;
use super::law::{Contact, ContactLaw};
use super::simd::scalar::One;
use super::simd::{Backend, Load, Pair, Simd, cross, dot, minus, plus, scale};
#[cfg(target_arch = "x86_64")]
use super::simd::{avx2::Four, avx512::Eight};
use super::tile::{BLOCK, Found, GROUP, Tile};
use super::walls;

/// Pairs of a block that touch: the pair, its slot, and the separation \[m]; or grains at a wall, and their distance \[m]
/// in place of the squared separation. One a thread.
#[derive(Clone, Debug)]
pub struct Touching {
    pub(super) pairs: [Pair; BLOCK + GROUP],
    pub(super) slots: [u64; BLOCK + GROUP],
    apart: [[f64; BLOCK + GROUP]; 3],
    pub(super) squared: [f64; BLOCK + GROUP],
    pub(super) reach: [f64; BLOCK + GROUP],
}

impl Default for Touching {
    fn default() -> Self {
        Self {
            pairs: [Pair::default(); BLOCK + GROUP],
            slots: [0; BLOCK + GROUP],
            apart: [[0.0; BLOCK + GROUP]; 3],
            squared: [0.0; BLOCK + GROUP],
            reach: [0.0; BLOCK + GROUP],
        }
    }
}

impl Touching {
    /// Fills the last vector with copies of the last of `count` entries, which are computed and not used.
    #[inline(always)]
    pub(super) fn fill(&mut self, count: usize, width: usize) {
        let Some(last) = count.checked_sub(1) else { return };
        for at in count..count.next_multiple_of(width) {
            self.pairs[at] = self.pairs[last];
            self.slots[at] = self.slots[last];
            for k in 0..3 {
                self.apart[k][at] = self.apart[k][last];
            }
            self.squared[at] = self.squared[last];
            self.reach[at] = self.reach[last];
        }
    }
}

/// Inputs of a step of the contacts.
#[derive(Clone, Copy, Debug)]
pub struct ContactStep<'a, C> {
    /// the law of contact
    pub law: &'a C,
    /// periods and walls
    pub domain: &'a Domain,
    /// the grains
    pub grains: &'a Grains,
    /// time that the springs follow \[s]; 0 leaves them as they are
    pub dt: f64,
}

/// A tile and its rows of loads.
#[derive(Debug)]
pub struct Part<'a> {
    /// the tile
    pub tile: &'a mut Tile,
    /// its rows: what the last kick left at zero
    pub loads: &'a mut [Load],
}

/// Computes what acts on the grains of `tile` and behind it.
pub fn compute<C: ContactLaw>(backend: Backend, step: ContactStep<'_, C>, tile: Part<'_>, scratch: &mut Touching) {
    match backend {
        Backend::Scalar => tile_forces::<C, One>((), step, tile, scratch),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(proof) => unsafe { on_avx2(proof, step, tile, scratch) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(proof) => unsafe { on_avx512(proof, step, tile, scratch) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2<C: ContactLaw>(
    proof: <Four as Simd>::Proof,
    step: ContactStep<'_, C>,
    tile: Part<'_>,
    scratch: &mut Touching,
) {
    tile_forces::<C, Four>(proof, step, tile, scratch);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn on_avx512<C: ContactLaw>(
    proof: <Eight as Simd>::Proof,
    step: ContactStep<'_, C>,
    tile: Part<'_>,
    scratch: &mut Touching,
) {
    tile_forces::<C, Eight>(proof, step, tile, scratch);
}

#[inline(always)]
fn tile_forces<C: ContactLaw, L: Simd>(
    proof: L::Proof,
    step: ContactStep<'_, C>,
    Part { tile, loads }: Part<'_>,
    touching: &mut Touching,
) {
    let ContactStep { law, domain, grains, dt } = step;
    tile.check(grains);
    assert!(loads.len() == tile.reach, "every grain that the tile touches has a row of loads");
    tile.found = Found::default();
    let mut from = 0;
    while from < tile.pairs.len() {
        let to = (from + BLOCK).min(tile.pairs.len());
        let count = find::<L>(proof, domain, grains, tile, from, to, touching);
        apply::<C, L>(proof, law, grains, Part { tile, loads }, count, touching, dt);
        tile.found.contacts += count;
        from = to;
    }
    walls::compute::<C, L>(proof, step, tile, loads, touching);
}

/// Finds the pairs of the slots `from..to` that touch; springs of new contacts begin at zero.
#[inline(always)]
fn find<L: Simd>(
    proof: L::Proof,
    domain: &Domain,
    grains: &Grains,
    tile: &mut Tile,
    from: usize,
    to: usize,
    touching: &mut Touching,
) -> usize {
    let [length_x, length_y] = domain.lengths().map(|x| L::splat(proof, x));
    let [half_x, half_y] = domain.halves().map(|x| L::splat(proof, x));
    let zero = L::splat(proof, 0.0);
    // Slots as words: one counter for each SIMD lane.
    let mut slots: [u64; GROUP] = std::array::from_fn(|l| (from + l) as u64);
    let mut count = 0;
    for group in (from..to).step_by(GROUP) {
        let mut now = 0;
        for part in 0..GROUP / L::WIDTH {
            let at = group + part * L::WIDTH;
            // SAFETY: `Tile::check` holds every index of a pair below the rows; `group + GROUP` is at most the length
            // of the pairs, and `count + WIDTH` at most that of the buffers.
            unsafe {
                let pairs = tile.pairs.as_ptr().add(at);
                let [mut x, mut y, z, reach] = L::apart(proof, &grains.positions, pairs);
                x = x - L::select(x.above(half_x), length_x, zero) + L::select((-half_x).above(x), length_x, zero);
                y = y - L::select(y.above(half_y), length_y, zero) + L::select((-half_y).above(y), length_y, zero);
                let squared = x * x + y * y + z * z;
                let mask = (reach * reach).above(squared);
                let bits = L::bits(mask);
                L::pack_words(proof, mask, pairs.cast(), touching.pairs.as_mut_ptr().add(count).cast());
                let slot = slots.as_ptr().add(part * L::WIDTH);
                L::pack_words(proof, mask, slot, touching.slots.as_mut_ptr().add(count));
                x.pack(mask, touching.apart[0].as_mut_ptr().add(count));
                y.pack(mask, touching.apart[1].as_mut_ptr().add(count));
                z.pack(mask, touching.apart[2].as_mut_ptr().add(count));
                squared.pack(mask, touching.squared.as_mut_ptr().add(count));
                reach.pack(mask, touching.reach.as_mut_ptr().add(count));
                count += bits.count_ones() as usize;
                now |= bits << (part * L::WIDTH);
            }
        }
        for slot in &mut slots {
            *slot += GROUP as u64;
        }
        let now = now as u8;
        let before = std::mem::replace(&mut tile.touching[group / GROUP], now);
        let mut new = now & !before;
        while new != 0 {
            tile.springs[group + new.trailing_zeros() as usize] = super::simd::Row::default();
            new &= new - 1;
        }
    }
    count
}

/// Applies the law to the first `count` pairs that touch.
#[inline(always)]
fn apply<C: ContactLaw, L: Simd>(
    proof: L::Proof,
    law: &C,
    grains: &Grains,
    Part { tile, loads }: Part<'_>,
    count: usize,
    touching: &mut Touching,
    dt: f64,
) {
    touching.fill(count, L::WIDTH);
    let mut deepest = L::splat(proof, 0.0);
    let one = L::splat(proof, 1.0);
    let window = tile.window(grains.len());
    let mut at = 0;
    while at < count {
        let vector = |from: &[f64; BLOCK + GROUP]| L::load(proof, &from[at..]);
        let separation = [vector(&touching.apart[0]), vector(&touching.apart[1]), vector(&touching.apart[2])];
        let reach = vector(&touching.reach);
        let distance = vector(&touching.squared).sqrt();
        let normal = scale(one / distance, separation);
        // SAFETY: pairs and slots come from the list that `Tile::check` has looked at; a vector of them stands here.
        unsafe {
            let pairs = touching.pairs.as_ptr().add(at);
            let slots = touching.slots.as_ptr().add(at);
            let [vx, vy, vz, _] = L::apart(proof, &grains.velocities, pairs);
            let [wx, wy, wz, inverse_mass] = L::together(proof, &grains.spins, pairs);
            let [sx, sy, sz, _] = L::columns(proof, &tile.springs, slots);
            // The lever arms share the distance in the ratio of the radii: then nothing turns that nothing turned.
            let lever = if law.full_lever() { one } else { distance / reach };
            let velocity = [vx, vy, vz];
            let parting = dot(velocity, normal);
            let turning = cross(scale(lever, [wx, wy, wz]), normal);
            let sliding = minus(minus(velocity, scale(parting, normal)), turning);
            let overlap = reach - distance;
            let contact = Contact { overlap, normal, parting, sliding, spring: [sx, sy, sz], inverse_mass };
            let response = law.respond(proof, contact, dt);
            let force = plus(scale(response.normal, normal), response.tangential);
            let spin = scale(-lever, cross(normal, response.tangential));
            let relative = overlap / reach;
            deepest = L::select(relative.above(deepest), relative, deepest);
            let used = (count - at).min(L::WIDTH);
            if used == L::WIDTH {
                L::put(response.spring, &mut tile.springs, slots, L::WIDTH);
                L::act(force, spin, loads, window, pairs, L::WIDTH);
            } else {
                L::put(response.spring, &mut tile.springs, slots, used);
                L::act(force, spin, loads, window, pairs, used);
            }
        }
        at += L::WIDTH;
    }
    let deepest = deepest.largest();
    if deepest > tile.found.overlap {
        tile.found.overlap = deepest;
    }
}
