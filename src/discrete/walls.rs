//! Contacts with plane walls: the law of the pairs against a body of no curvature and infinite mass.
#![allow(unsafe_code, reason = "indices are checked once per tile, and instructions chosen at run time")]

use super::forces::Scene;
use super::lanes::{Lanes, Load, cross, dot, minus, plus, scale};
use super::law::{Contact, ContactLaw};
use super::tile::{GROUP, Tile};

/// Adds what the walls do to the grains near them.
#[inline(always)]
pub fn compute<C: ContactLaw, L: Lanes>(proof: L::Proof, scene: Scene<'_, C>, tile: &mut Tile, loads: &mut [Load]) {
    let Scene { law, domain, grains, dt } = scene;
    let all = |x| L::splat(proof, x);
    let (zero, one) = (all(0.0), all(1.0));
    for (wall, range) in domain.walls.iter().zip(tile.walls.ranges.clone()) {
        // The law speaks of the second body: the grain is the second, the wall the first, the normal points inward.
        let normal = wall.normal.map(all);
        let moving = wall.velocity.map(all);
        let offset = all(wall.offset);
        let mut at = range.start;
        while at < range.end {
            // SAFETY: `Tile::check` holds the padded list inside the rows, and its springs beside it.
            let ([x, y, z, radius], [vx, vy, vz, _], [wx, wy, wz, inverse_mass]) = unsafe {
                let list = tile.walls.grains.as_ptr().add(at);
                (
                    L::columns(proof, &grains.positions, list),
                    L::columns(proof, &grains.velocities, list),
                    L::columns(proof, &grains.spins, list),
                )
            };
            let distance = dot([x, y, z], normal) - offset;
            let touches = radius.above(distance);
            let bits = L::bits(touches);
            let slots: [u64; GROUP] = std::array::from_fn(|l| (at + l) as u64);
            // SAFETY: as above.
            let [sx, sy, sz, _] = unsafe { L::columns(proof, &tile.walls.springs, slots.as_ptr()) };
            let lever = if law.full_lever() { one } else { distance / radius };
            let velocity = minus([vx, vy, vz], moving);
            let parting = dot(velocity, normal);
            // The lever arm of the grain points against the normal.
            let turning = cross(scale(lever, [wx, wy, wz]), normal);
            let sliding = minus(minus(velocity, scale(parting, normal)), turning);
            let contact =
                Contact { overlap: radius - distance, normal, parting, sliding, spring: [sx, sy, sz], inverse_mass };
            let mut response = law.respond(proof, contact, dt);
            if !wall.rough {
                response.tangential = [zero; 3];
                response.spring = [zero; 3];
            }
            let spring = response.spring.map(|s| L::select(touches, s, zero));
            let force = plus(scale(response.normal, normal), response.tangential);
            let spin = scale(-lever, cross(normal, response.tangential));
            let used = (range.end - at).min(L::WIDTH);
            // SAFETY: as above.
            unsafe { L::put(spring, &mut tile.walls.springs, slots.as_ptr(), used) };
            if bits != 0 {
                let mut acts = [[0.0; GROUP]; 6];
                for k in 0..3 {
                    force[k].store(&mut acts[k]);
                    spin[k].store(&mut acts[k + 3]);
                }
                let relative = L::select(touches, (radius - distance) / radius, zero).largest();
                if relative > tile.found.overlap {
                    tile.found.overlap = relative;
                }
                for l in (0..used).filter(|l| bits >> l & 1 == 1) {
                    let to = &mut loads[tile.walls.grains[at + l] as usize - tile.grains.start].0;
                    for k in 0..3 {
                        tile.found.walls[k] += acts[k][l];
                        to[0].0[k] += acts[k][l];
                        to[1].0[k] += acts[k + 3][l];
                    }
                }
                tile.found.wall_contacts += bits.count_ones() as usize;
            }
            at += L::WIDTH;
        }
    }
}
