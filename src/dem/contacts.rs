//! The contacts as they stand, one by one: for stresses, energies, stability and errors. The step loop does not use this.

use super::engine::Engine;
use super::grains::Point;
use super::law::{Contact, ContactLaw};
use super::simd::Row;
use super::simd::scalar::One;
use super::simd::{cross, dot, minus, plus, scale};
use super::tile::Tile;

/// A contact of a grain with another one or with a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactState {
    /// place of the grain
    pub first: usize,
    /// place of the other grain; none for a wall
    pub second: Option<usize>,
    /// unit vector from the first to the second
    pub normal: Point,
    /// distance of the centres, or of the centre from the wall \[m]
    pub distance: f64,
    /// force on the second \[N]; the first takes the opposite
    pub force: Point,
    /// overlap \[m]
    pub overlap: f64,
    /// overlap over the sum of the radii
    pub ratio: f64,
    /// energy of both springs \[J]
    pub energy: f64,
}

impl<C: ContactLaw> Engine<C> {
    /// Every pair and wall contact that touches at the present positions, with the springs of the last step.
    pub fn contacts(&self) -> impl Iterator<Item = ContactState> + '_ {
        self.tiles.iter().flat_map(move |tile| {
            let pairs = (0..tile.listed()).filter_map(move |slot| self.pair(tile, slot));
            let walls = (0..tile.walls.ranges.len())
                .flat_map(move |w| tile.walls.ranges[w].clone().filter_map(move |at| self.wall(tile, w, at)));
            pairs.chain(walls)
        })
    }

    fn pair(&self, tile: &Tile, slot: usize) -> Option<ContactState> {
        let (i, j) = (tile.pairs[slot].i as usize, tile.pairs[slot].j as usize);
        let grains = &self.grains;
        let apart = self.domain.apart(grains.position(i), grains.position(j));
        let squared: f64 = apart.iter().map(|x| x * x).sum();
        let reach = grains.radius(i) + grains.radius(j);
        if squared >= reach * reach {
            return None;
        }
        let spring = if tile.touches(slot) { tile.springs[slot] } else { Row::default() };
        let velocity = minus(grains.velocity(j).map(One), grains.velocity(i).map(One));
        let turn: Point = std::array::from_fn(|k| grains.spins[i].0[k] + grains.spins[j].0[k]);
        let inverse = grains.spins[i].0[3] + grains.spins[j].0[3];
        let distance = squared.sqrt();
        Some(self.state(i, Some(j), apart, distance, reach, velocity, turn, spring, inverse))
    }

    fn wall(&self, tile: &Tile, w: usize, at: usize) -> Option<ContactState> {
        let wall = &self.domain.walls[w];
        let i = tile.walls.grains[at] as usize;
        let grains = &self.grains;
        let (distance, radius) = (wall.distance(grains.position(i)), grains.radius(i));
        if distance >= radius {
            return None;
        }
        // As seen from the grain the wall is the second body: all that is relative changes its sign.
        let apart = wall.normal.map(|n| -n * distance);
        let velocity = minus(wall.velocity.map(One), grains.velocity(i).map(One));
        let turn: Point = std::array::from_fn(|k| grains.spins[i].0[k]);
        let Row([x, y, z, _]) = tile.walls.springs[at];
        let spring = if wall.rough { Row([-x, -y, -z, 0.0]) } else { Row::default() };
        let mut contact = self.state(i, None, apart, distance, radius, velocity, turn, spring, grains.spins[i].0[3]);
        if !wall.rough {
            let along: f64 = (0..3).map(|k| contact.force[k] * contact.normal[k]).sum();
            contact.force = contact.normal.map(|n| along * n);
        }
        Some(contact)
    }

    #[allow(clippy::too_many_arguments, reason = "one contact has as many numbers")]
    fn state(
        &self,
        first: usize,
        second: Option<usize>,
        apart: Point,
        distance: f64,
        reach: f64,
        velocity: [One; 3],
        turn: Point,
        Row([sx, sy, sz, _]): Row,
        inverse_mass: f64,
    ) -> ContactState {
        let unit = if distance == 0.0 { [0.0, 0.0, 1.0] } else { apart.map(|x| x / distance.abs()) };
        let normal = unit.map(One);
        let lever = One(if self.law.full_lever() { 1.0 } else { distance / reach });
        let parting = dot(velocity, normal);
        let turning = cross(scale(lever, turn.map(One)), normal);
        let sliding = minus(minus(velocity, scale(parting, normal)), turning);
        let overlap = reach - distance;
        let contact = Contact {
            overlap: One(overlap),
            normal,
            parting,
            sliding,
            spring: [One(sx), One(sy), One(sz)],
            inverse_mass: One(inverse_mass),
        };
        let response = self.law.respond((), contact, 0.0);
        let force = plus(scale(response.normal, normal), response.tangential).map(|x| x.0);
        let (k_n, k_s) = self.law.stiffness();
        let energy = 0.5 * (k_n * overlap * overlap + k_s * dot(response.spring, response.spring).0);
        ContactState { first, second, normal: unit, distance, force, overlap, ratio: overlap / reach, energy }
    }

    /// Energy of all springs at the present positions \[J].
    #[must_use]
    pub fn spring_energy(&self) -> f64 {
        self.contacts().map(|contact| contact.energy).sum()
    }
}
