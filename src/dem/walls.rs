//! Contacts with plane walls: the law of the pairs against a body of no curvature and infinite mass.
#![allow(unsafe_code, reason = "indices are checked once per tile, and instructions chosen at run time")]

use super::forces::{ContactStep, Touching};
use super::law::{Contact, ContactLaw};
use super::simd::{Load, Row, Simd, cross, dot, minus, plus, scale};
use super::tile::{BLOCK, GROUP, Tile};

/// Adds what the walls do to the grains near them.
#[inline(always)]
pub fn compute<C: ContactLaw, L: Simd>(
    proof: L::Proof,
    step: ContactStep<'_, C>,
    tile: &mut Tile,
    loads: &mut [Load],
    touching: &mut Touching,
) {
    for wall in 0..step.domain.walls.len() {
        let range = tile.walls.ranges[wall].clone();
        for from in range.clone().step_by(BLOCK) {
            let to = (from + BLOCK).min(range.end);
            let count = find::<C, L>(proof, step, tile, wall, from..to, touching);
            apply::<C, L>(proof, step, tile, wall, count, loads, touching);
        }
    }
}

/// Packs the entries that touch: grain, place in the list, distance and radius; the springs of contacts that ended are zeroed.
#[inline(always)]
fn find<C, L: Simd>(
    proof: L::Proof,
    step: ContactStep<'_, C>,
    tile: &mut Tile,
    wall: usize,
    range: std::ops::Range<usize>,
    touching: &mut Touching,
) -> usize {
    let wall = &step.domain.walls[wall];
    let normal = wall.normal.map(|x| L::splat(proof, x));
    let offset = L::splat(proof, wall.offset);
    let mut count = 0;
    for group in range.step_by(GROUP) {
        let mut now = 0;
        for at in (group..group + GROUP).step_by(L::WIDTH) {
            let places: [u64; GROUP] = std::array::from_fn(|l| (at + l) as u64);
            // SAFETY: `Tile::check` holds the padded list inside the rows; the buffers take a vector behind `BLOCK` entries.
            unsafe {
                let grains = tile.walls.grains.as_ptr().add(at);
                let [x, y, z, radius] = L::columns(proof, &step.grains.positions, grains);
                let distance = dot([x, y, z], normal) - offset;
                let mask = radius.above(distance);
                let bits = L::bits(mask);
                L::pack_words(proof, mask, grains, touching.pairs.as_mut_ptr().add(count).cast());
                L::pack_words(proof, mask, places.as_ptr(), touching.slots.as_mut_ptr().add(count));
                distance.pack(mask, touching.squared.as_mut_ptr().add(count));
                radius.pack(mask, touching.reach.as_mut_ptr().add(count));
                count += bits.count_ones() as usize;
                now |= bits << (at - group);
            }
        }
        let now = now as u8;
        let mut ended = std::mem::replace(&mut tile.walls.touching[group / GROUP], now) & !now;
        while ended != 0 {
            tile.walls.springs[group + ended.trailing_zeros() as usize] = Row::default();
            ended &= ended - 1;
        }
    }
    count
}

/// Applies the law to the first `count` entries of `touching`.
#[inline(always)]
fn apply<C: ContactLaw, L: Simd>(
    proof: L::Proof,
    step: ContactStep<'_, C>,
    tile: &mut Tile,
    wall: usize,
    count: usize,
    loads: &mut [Load],
    touching: &mut Touching,
) {
    touching.fill(count, L::WIDTH);
    let ContactStep { law, domain, grains, dt } = step;
    let wall = &domain.walls[wall];
    let all = |x| L::splat(proof, x);
    let (zero, one) = (all(0.0), all(1.0));
    // The law speaks of the second body: the grain is the second, the wall the first, the normal points inward.
    let normal = wall.normal.map(all);
    let moving = wall.velocity.map(all);
    for at in (0..count).step_by(L::WIDTH) {
        let distance = L::load(proof, &touching.squared[at..]);
        let radius = L::load(proof, &touching.reach[at..]);
        let slots = touching.slots[at..].as_ptr();
        // SAFETY: grains and slots come from the list that `Tile::check` has looked at; a vector of them stands here.
        let ([vx, vy, vz, _], [wx, wy, wz, inverse_mass], [sx, sy, sz, _]) = unsafe {
            let list = touching.pairs[at..].as_ptr().cast();
            (
                L::columns(proof, &grains.velocities, list),
                L::columns(proof, &grains.spins, list),
                L::columns(proof, &tile.walls.springs, slots),
            )
        };
        let lever = if law.full_lever() { one } else { distance / radius };
        let velocity = minus([vx, vy, vz], moving);
        let parting = dot(velocity, normal);
        // The lever arm of the grain points against the normal.
        let turning = cross(scale(lever, [wx, wy, wz]), normal);
        let sliding = minus(minus(velocity, scale(parting, normal)), turning);
        let overlap = radius - distance;
        let contact = Contact { overlap, normal, parting, sliding, spring: [sx, sy, sz], inverse_mass };
        let mut response = law.respond(proof, contact, dt);
        if !wall.rough {
            response.tangential = [zero; 3];
            response.spring = [zero; 3];
        }
        let force = plus(scale(response.normal, normal), response.tangential);
        let spin = scale(-lever, cross(normal, response.tangential));
        let used = (count - at).min(L::WIDTH);
        // SAFETY: as above.
        unsafe { L::put(response.spring, &mut tile.walls.springs, slots, used) };
        let mut acts = [[0.0; GROUP]; 6];
        for k in 0..3 {
            force[k].store(&mut acts[k]);
            spin[k].store(&mut acts[k + 3]);
        }
        tile.found.overlap = tile.found.overlap.max((overlap / radius).largest());
        for (l, &slot) in touching.slots[at..at + used].iter().enumerate() {
            let grain = tile.walls.grains[slot as usize] as usize;
            let to = &mut loads[grain - tile.grains.start].0;
            for k in 0..3 {
                tile.found.walls[k] += acts[k][l];
                to[0].0[k] += acts[k][l];
                to[1].0[k] += acts[k + 3][l];
            }
        }
    }
    tile.found.wall_contacts += count;
}
