//! The list of neighbours of one tile, and the springs that it takes over from the list before.
#![allow(unsafe_code, reason = "instructions chosen at run time, and pairs written a vector at a time")]

use super::cells::Cells;
use super::domain::Domain;
use super::grains::Grains;
use super::simd::scalar::One;
use super::simd::{Backend, Pair, Row, Simd};
#[cfg(target_arch = "x86_64")]
use super::simd::{avx2::Four, avx512::Eight};
use super::tile::{GROUP, Tile, WallList};

/// What a new list is made from.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// the tiles of the list before; none at the beginning
    pub tiles: &'a [Tile],
    /// place of each grain in that list
    pub order: &'a [u32],
}

impl Before<'_> {
    fn tile(&self, grain: usize) -> Option<&Tile> {
        let at = self.tiles.partition_point(|tile| tile.grains.end <= grain);
        self.tiles.get(at)
    }

    /// The spring of the pair of the new places `i` and `j`, if they touched.
    fn spring(&self, i: usize, j: usize) -> Option<Row> {
        let (a, b) = (self.order[i] as usize, self.order[j] as usize);
        let listed = |a: usize, b: usize| {
            let tile = self.tile(a)?;
            tile.slot(a, b).map(|slot| tile.touches(slot).then(|| tile.springs[slot]))
        };
        // Mostly the first of a pair comes first; around a period it comes last.
        let [low, high] = [a.min(b), a.max(b)];
        let (first, found) = match listed(low, high) {
            Some(found) => (low, found),
            None => (high, listed(high, low)?),
        };
        let Row([x, y, z, _]) = found?;
        Some(if a == first { Row([x, y, z, 0.0]) } else { Row([-x, -y, -z, 0.0]) })
    }

    fn wall_spring(&self, wall: usize, grain: usize) -> Option<Row> {
        let former = self.order[grain] as usize;
        let walls = &self.tile(former)?.walls;
        let range = walls.ranges.get(wall)?.clone();
        let at = walls.grains[range.clone()].binary_search(&(former as u64)).ok()?;
        Some(walls.springs[range.start + at])
    }
}

/// What a list is made of.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// the grains, sorted
    pub grains: &'a Grains,
    /// their cells
    pub cells: &'a Cells,
    /// periods and walls
    pub domain: &'a Domain,
    /// how much farther apart than touching grains may be to be listed \[m]
    pub skin: f64,
    /// the list before
    pub before: Before<'a>,
}

/// Lists the pairs of `tile` that are nearer than the sum of their radii and the skin, and the walls likewise.
pub fn list(backend: Backend, tile: &mut Tile, of: Surroundings<'_>) {
    match backend {
        Backend::Scalar => tile.list::<One>((), of),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the proof says that the machine has the instructions.
        Backend::Avx2(proof) => unsafe { on_avx2(proof, tile, of) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Backend::Avx512(proof) => unsafe { on_avx512(proof, tile, of) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2(proof: <Four as Simd>::Proof, tile: &mut Tile, of: Surroundings<'_>) {
    tile.list::<Four>(proof, of);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn on_avx512(proof: <Eight as Simd>::Proof, tile: &mut Tile, of: Surroundings<'_>) {
    tile.list::<Eight>(proof, of);
}

impl Tile {
    #[inline(always)]
    fn list<L: Simd>(&mut self, proof: L::Proof, of: Surroundings<'_>) {
        let Surroundings { grains, cells, domain, skin, before } = of;
        self.pairs.clear();
        self.springs.clear();
        self.touching.clear();
        self.starts.clear();
        let count = grains.len();
        let window = self.window(count);
        let mut last = self.grains.len();
        let all = |x| L::splat(proof, x);
        let [length_x, length_y] = domain.lengths().map(all);
        let [half_x, half_y] = domain.halves().map(all);
        let zero = all(0.0);
        for i in self.grains.clone() {
            let first = self.pairs.len();
            self.starts.push(first as u32);
            let Row([xi, yi, zi, ri]) = grains.positions[i];
            let ([xi, yi, zi], reach) = ([xi, yi, zi].map(all), all(ri + skin));
            let pairs = &mut self.pairs;
            let (ranges, several) = cells.ahead(i);
            for &[begin, end] in &ranges[..several] {
                assert!(end <= count, "cells hold grains");
                pairs.reserve(end - begin + L::WIDTH);
                let mut listed = pairs.len();
                let mut from = begin;
                while from < end {
                    // Behind the end of the range stands its last grain again, which is not counted.
                    let at: [u64; GROUP] = std::array::from_fn(|l| (from + l).min(end - 1) as u64);
                    let words = at.map(|j| i as u64 | j << 32);
                    // SAFETY: the grains of the range are there, and so is room for a vector of pairs, which are words of
                    // this layout; `listed` counts those that were written.
                    unsafe {
                        let [x, y, z, r] = L::columns(proof, &grains.positions, at.as_ptr());
                        let [mut x, mut y, z] = [x - xi, y - yi, z - zi];
                        x = x - L::select(x.above(half_x), length_x, zero)
                            + L::select((-half_x).above(x), length_x, zero);
                        y = y - L::select(y.above(half_y), length_y, zero)
                            + L::select((-half_y).above(y), length_y, zero);
                        let reach = reach + r;
                        let near = (reach * reach).above(x * x + y * y + z * z);
                        L::pack_words(proof, near, words.as_ptr(), pairs.as_mut_ptr().add(listed).cast());
                        let real = u32::MAX >> (32 - (end - from).min(L::WIDTH));
                        listed += (L::bits(near) & real).count_ones() as usize;
                        pairs.set_len(listed);
                    }
                    from += L::WIDTH;
                }
            }
            if grains.is_fixed(i) {
                let mut kept = first;
                for at in first..pairs.len() {
                    if !grains.is_fixed(pairs[at].j as usize) {
                        pairs[kept] = pairs[at];
                        kept += 1;
                    }
                }
                pairs.truncate(kept);
            }
            let farthest = pairs[first..].iter().map(|pair| window.place(pair.j) + 1);
            last = farthest.fold(last, usize::max);
        }
        self.reach = last;
        self.starts.push(self.pairs.len() as u32);
        let listed = self.pairs.len();
        let never = Pair { i: count as u32, j: count as u32 + 1 };
        self.pairs.resize(listed.next_multiple_of(GROUP), never);
        self.springs.resize(self.pairs.len(), Row::default());
        self.touching.resize(self.pairs.len() / GROUP, 0);
        if !before.tiles.is_empty() {
            for slot in 0..listed {
                let Pair { i, j } = self.pairs[slot];
                if let Some(spring) = before.spring(i as usize, j as usize) {
                    self.springs[slot] = spring;
                    self.touching[slot / GROUP] |= 1 << (slot % GROUP);
                }
            }
        }
        self.list_walls(grains, domain, skin, before);
    }

    fn list_walls(&mut self, grains: &Grains, domain: &Domain, skin: f64, before: Before<'_>) {
        self.walls = WallList::default();
        for (w, wall) in domain.walls.iter().enumerate() {
            let start = self.walls.grains.len();
            let near = |&i: &usize| !grains.is_fixed(i) && wall.distance(grains.position(i)) < grains.radius(i) + skin;
            for i in self.grains.clone().filter(near) {
                self.walls.grains.push(i as u64);
                self.walls.springs.push(before.wall_spring(w, i).unwrap_or_default());
            }
            self.walls.ranges.push(start..self.walls.grains.len());
            let padded = self.walls.grains.len().next_multiple_of(GROUP);
            self.walls.grains.resize(padded, grains.len() as u64 + 2);
            self.walls.springs.resize(padded, Row::default());
            self.walls.touching.resize(padded / GROUP, u8::MAX);
        }
    }

    /// Holds every index of the lists against the rows that it will be used for: the loops do not look again.
    ///
    /// # Panics
    /// If the list does not belong to these grains: a defect of the program.
    pub fn check(&self, grains: &Grains) {
        let rows = grains.len() + super::grains::PADDING;
        assert!(
            grains.positions.len() == rows && grains.velocities.len() == rows && grains.spins.len() == rows,
            "the rows of the grains are padded"
        );
        assert!(self.checked == Some((grains.len(), self.pairs.len(), self.walls.grains.len())), "the list is checked");
    }

    /// Looks at every index once, after the list was made or read.
    #[must_use]
    pub fn is_sound(&mut self, grains: usize) -> bool {
        self.checked = None;
        let listed = self.listed();
        let groups = self.pairs.len() / GROUP;
        let window = self.window(grains);
        let inside = |pair: &Pair| {
            let (i, j) = (pair.i as usize, pair.j as usize);
            self.grains.contains(&i) && i != j && j < grains && window.place(pair.j) < self.reach
        };
        let padding = |pair: &Pair| pair.i as usize == grains && pair.j as usize == grains + 1;
        let starts = self.starts.len() == self.grains.len() + 1 && self.starts.is_sorted();
        let lists = self.pairs.len().is_multiple_of(GROUP)
            && self.springs.len() == self.pairs.len()
            && self.touching.len() == groups
            && listed <= self.pairs.len()
            && self.grains.end <= grains
            && (self.grains.len()..=grains).contains(&self.reach);
        let walls = &self.walls;
        let ends = walls.ranges.iter().all(|r| {
            r.start % GROUP == 0
                && r.start <= r.end
                && r.end.next_multiple_of(GROUP) <= walls.grains.len()
                && walls.grains[r.clone()].iter().all(|&i| self.grains.contains(&(i as usize)))
        });
        let padded = walls.grains.iter().all(|&i| i as usize <= grains + 2)
            && walls.springs.len() == walls.grains.len()
            && walls.touching.len() * GROUP == walls.grains.len();
        let sound = starts
            && lists
            && ends
            && padded
            && self.pairs[..listed].iter().all(inside)
            && self.pairs[listed..].iter().all(padding);
        if sound {
            self.checked = Some((grains, self.pairs.len(), walls.grains.len()));
        }
        sound
    }
}
