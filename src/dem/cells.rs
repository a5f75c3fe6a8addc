//! The grid of cells: the order of the grains, and where to look for neighbours.
//!
//! The axis along which there are most cells is the slowest: a layer of cells across it is the smallest that there is, and what
//! a tile does to grains of the next one remains little however long the bed is.

use super::domain::Domain;
use super::grains::{Grains, Point};

/// Most ranges of one grain: two layers, three rows in each, two runs of cells in a row.
const RANGES: usize = 12;

/// Cells no smaller than the reach of a contact.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    counts: [usize; 3],
    /// the axes, that along which cells follow each other first
    axes: [usize; 3],
    origin: Point,
    per_length: Point,
    periodic: [bool; 3],
    /// first grain of each cell, and the end
    starts: Vec<u32>,
    /// cell of each grain
    keys: Vec<u32>,
}

impl Cells {
    /// Puts the grains into cells of at least `reach` \[m] and sorts them by cell, grains of one cell as they were.
    /// `order[new]` becomes the former place of each grain. Positions along a period are brought into it.
    pub fn sort(&mut self, grains: &mut Grains, domain: &Domain, reach: f64, order: &mut Vec<u32>) {
        wrap(grains, domain);
        self.lay(grains, domain, reach);
        let count = grains.len();
        let cells = self.counts.iter().product::<usize>();
        self.keys = (0..count).map(|i| self.index(self.cell(grains.position(i))) as u32).collect();
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        for &key in &self.keys {
            self.starts[key as usize + 1] += 1;
        }
        for c in 0..cells {
            self.starts[c + 1] += self.starts[c];
        }
        let mut next = self.starts.clone();
        order.clear();
        order.resize(count, 0);
        for (i, &key) in self.keys.iter().enumerate() {
            let place = &mut next[key as usize];
            order[*place as usize] = i as u32;
            *place += 1;
        }
        let pick = |rows: &[super::simd::Row]| order.iter().map(|&i| rows[i as usize]).collect::<Vec<_>>();
        grains.positions = pick(&grains.positions);
        grains.velocities = pick(&grains.velocities);
        grains.spins = pick(&grains.spins);
        grains.ids = order.iter().map(|&i| grains.ids[i as usize]).collect();
        grains.pad();
        let keys = order.iter().map(|&i| self.keys[i as usize]).collect();
        self.keys = keys;
    }

    /// Chooses the number of cells: whole ones in a period, and not many more than grains.
    fn lay(&mut self, grains: &Grains, domain: &Domain, reach: f64) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for i in 0..grains.len() {
            for (k, x) in grains.position(i).into_iter().enumerate() {
                low[k] = x.min(low[k]);
                high[k] = x.max(high[k]);
            }
        }
        self.periodic = [domain.periods[0].is_some(), domain.periods[1].is_some(), false];
        let mut size = reach;
        loop {
            for k in 0..3 {
                let period = domain.periods.get(k).copied().flatten();
                let (from, length) = period.map_or((low[k], high[k] - low[k]), |l| (0.0, l));
                let most = (length / size).clamp(0.0, 1e9) as usize;
                let count = if self.periodic[k] { most.max(1) } else { most + 1 };
                self.counts[k] = count;
                self.origin[k] = from;
                self.per_length[k] = if self.periodic[k] { count as f64 / length } else { 1.0 / size };
            }
            let slow = (0..3).fold(0, |slow, k| if self.counts[k] > self.counts[slow] { k } else { slow });
            self.axes = [[2, 1, 0], [2, 0, 1], [0, 1, 2]][slow];
            let cells = self.counts.iter().try_fold(1_usize, |all, &n| all.checked_mul(n));
            if cells.is_some_and(|cells| cells <= 8 * grains.len() + 64) {
                return;
            }
            size *= 1.5;
        }
    }

    fn cell(&self, x: Point) -> [usize; 3] {
        std::array::from_fn(|k| {
            let at = ((x[k] - self.origin[k]) * self.per_length[k]).max(0.0) as usize;
            at.min(self.counts[k] - 1)
        })
    }

    fn index(&self, cell: [usize; 3]) -> usize {
        let [fast, middle, slow] = self.axes;
        (cell[slow] * self.counts[middle] + cell[middle]) * self.counts[fast] + cell[fast]
    }

    /// The first and the end of each range of grains that may be neighbours of grain `i`, so that each pair is met once: those
    /// behind it in its layer of cells, and those of the next layer, which is the first again behind the last of a period.
    #[must_use]
    pub fn ahead(&self, i: usize) -> ([[usize; 2]; RANGES], usize) {
        let (mut ranges, mut count) = ([[0; 2]; RANGES], 0);
        let own = self.keys[i] as usize;
        let [fast, middle, slow] = self.axes;
        let [nx, ny, nz] = self.axes.map(|axis| self.counts[axis]);
        let (x, y, z) = (own % nx, own / nx % ny, own / (nx * ny));
        let (xs, x_count) = around(x, nx, self.periodic[fast]);
        let (ys, y_count) = around(y, ny, self.periodic[middle]);
        let start = |cell: usize| self.starts[cell] as usize;
        // Cells that follow each other are one range.
        let runs = if x_count == 3 && xs[2] != xs[0] + 2 {
            if xs[1] == 1 { [(0, 1), (xs[2], xs[2])] } else { [(0, 0), (xs[1], xs[2])] }
        } else {
            [(xs[0], xs[x_count - 1]), (1, 0)]
        };
        let next = match z + 1 {
            next if next < nz => Some(next),
            // Of two layers the first has met the second on both sides.
            _ => (self.periodic[slow] && nz > 2).then_some(0),
        };
        for layer in [Some(z), next].into_iter().flatten() {
            for &row in &ys[..y_count] {
                let first = (layer * ny + row) * nx;
                for (from, to) in runs.into_iter().filter(|(from, to)| from <= to) {
                    let (from, to) = (first + from, first + to);
                    let begin = if layer != z || from > own { start(from) } else { i + 1 };
                    let end = if layer != z || to >= own { start(to + 1) } else { 0 };
                    if begin < end {
                        ranges[count] = [begin, end];
                        count += 1;
                    }
                }
            }
        }
        (ranges, count)
    }
}

/// The cells beside cell `at` of `count`, itself included, each once and in ascending order.
fn around(at: usize, count: usize, periodic: bool) -> ([usize; 3], usize) {
    let mut found = [0; 3];
    let mut n = 0;
    let (last, below, above) = (count - 1, at.checked_sub(1), (at + 1 < count).then_some(at + 1));
    let (below, above) = if periodic { (below.or(Some(last)), above.or(Some(0))) } else { (below, above) };
    for other in [below, Some(at), above].into_iter().flatten() {
        if !found[..n].contains(&other) {
            found[n] = other;
            n += 1;
        }
    }
    found[..n].sort_unstable();
    (found, n)
}

/// Brings positions into the periods.
fn wrap(grains: &mut Grains, domain: &Domain) {
    let count = grains.len();
    for (k, period) in domain.periods.iter().enumerate() {
        let Some(length) = *period else { continue };
        for row in &mut grains.positions[..count] {
            let x = row.0[k];
            if !(0.0..length).contains(&x) {
                let inside = x - length * (x / length).floor();
                row.0[k] = if inside < length { inside } else { 0.0 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::around;

    #[test]
    fn the_cells_around_are_each_there_once() {
        let list = |at, count, periodic| {
            let (cells, n) = around(at, count, periodic);
            cells[..n].to_vec()
        };
        assert_eq!(list(0, 1, true), [0]);
        assert_eq!(list(0, 1, false), [0]);
        assert_eq!(list(0, 2, true), [0, 1]);
        assert_eq!(list(1, 2, false), [0, 1]);
        assert_eq!(list(0, 5, true), [0, 1, 4]);
        assert_eq!(list(4, 5, false), [3, 4]);
        assert_eq!(list(2, 5, false), [1, 2, 3]);
    }
}
