//! The list of neighbours of one tile, and the springs that it takes over from the list before.

use super::cells::Cells;
use super::domain::Domain;
use super::grains::Grains;
use super::lanes::{Load, Pair, Row};
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
        let tile = self.tile(a.min(b))?;
        let slot = tile.slot(a.min(b), a.max(b)).filter(|&slot| tile.touches(slot))?;
        let Row([x, y, z, _]) = tile.springs[slot];
        Some(if a < b { Row([x, y, z, 0.0]) } else { Row([-x, -y, -z, 0.0]) })
    }

    fn wall_spring(&self, wall: usize, grain: usize) -> Option<Row> {
        let former = self.order[grain] as usize;
        let walls = &self.tile(former)?.walls;
        let range = walls.ranges.get(wall)?.clone();
        let at = walls.grains[range.clone()].binary_search(&(former as u64)).ok()?;
        Some(walls.springs[range.start + at])
    }
}

impl Tile {
    /// Lists the pairs that are nearer than the sum of their radii and `skin` [m], and the walls likewise.
    pub fn list(&mut self, grains: &Grains, cells: &Cells, domain: &Domain, skin: f64, before: Before<'_>) {
        self.pairs.clear();
        self.springs.clear();
        self.touching.clear();
        self.starts.clear();
        let mut last = self.grains.end;
        let (lengths, halves) = (domain.lengths(), domain.halves());
        for i in self.grains.clone() {
            self.starts.push(self.pairs.len() as u32);
            let Row([xi, yi, zi, ri]) = grains.positions[i];
            let fixed = grains.is_fixed(i);
            let pairs = &mut self.pairs;
            cells.ahead(i, |range| {
                for j in range {
                    let Row([xj, yj, zj, rj]) = grains.positions[j];
                    let mut d = [xj - xi, yj - yi];
                    for k in 0..2 {
                        if d[k] > halves[k] {
                            d[k] -= lengths[k];
                        } else if -halves[k] > d[k] {
                            d[k] += lengths[k];
                        }
                    }
                    let reach = ri + rj + skin;
                    let near = d[0] * d[0] + d[1] * d[1] + (zj - zi) * (zj - zi) < reach * reach;
                    if near && !(fixed && grains.is_fixed(j)) {
                        pairs.push(Pair { i: i as u32, j: j as u32 });
                        last = last.max(j + 1);
                    }
                }
            });
        }
        self.starts.push(self.pairs.len() as u32);
        let listed = self.pairs.len();
        let never = Pair { i: grains.len() as u32, j: grains.len() as u32 + 1 };
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
        self.loads.clear();
        self.loads.resize(last - self.grains.start, Load::default());
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
        let (first, end) = (self.grains.start, self.grains.start + self.loads.len());
        let inside = |pair: &Pair| {
            let (i, j) = (pair.i as usize, pair.j as usize);
            self.grains.contains(&i) && i < j && j < end
        };
        let padding = |pair: &Pair| pair.i as usize == grains && pair.j as usize == grains + 1;
        let starts = self.starts.len() == self.grains.len() + 1 && self.starts.is_sorted();
        let lists = self.pairs.len().is_multiple_of(GROUP)
            && self.springs.len() == self.pairs.len()
            && self.touching.len() == groups
            && listed <= self.pairs.len()
            && first <= self.grains.end
            && self.grains.end <= end
            && end <= grains;
        let walls = &self.walls;
        let ends = walls.ranges.iter().all(|r| {
            r.start % GROUP == 0
                && r.start <= r.end
                && r.end.next_multiple_of(GROUP) <= walls.grains.len()
                && walls.grains[r.clone()].iter().all(|&i| self.grains.contains(&(i as usize)))
        });
        let padded =
            walls.grains.iter().all(|&i| i as usize <= grains + 2) && walls.springs.len() == walls.grains.len();
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
