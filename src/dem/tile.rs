//! A tile: consecutive grains, and the contacts of which they are the first. What acts on the grains of those contacts is
//! summed in rows of the tile's own: of its grains, and of those behind them that they touch.
//!
//! The cut into tiles depends on the number of grains only, and sums over tiles are made in their order: no result
//! depends on the number of threads.

use std::ops::Range;

use super::simd::{Pair, Row, Window};

/// Pairs that are looked at before the law is applied to those that touch.
pub const BLOCK: usize = 256;
/// Pairs whose state of contact shares one byte; lists are padded to a multiple of it.
pub const GROUP: usize = 8;

/// What a tile found in one step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Found {
    /// contacts between grains
    pub contacts: usize,
    /// contacts with walls
    pub wall_contacts: usize,
    /// largest overlap over the sum of the radii
    pub overlap: f64,
    /// force of walls on grains \[N]
    pub walls: [f64; 3],
}

/// Sums over the grains of a tile after a step, for the mobile ones.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moved {
    /// bound of the squared velocity of the mobile grains [m2/s2]
    pub fastest: f64,
    /// 0, or not a number if any state is none
    pub sane: f64,
    /// work of contacts with grains and walls \[J]
    pub contact_work: f64,
    /// work of gravity \[J]
    pub gravity_work: f64,
    /// work of the body force \[J]
    pub body_work: f64,
    /// impulse of gravity and body force on the mobile grains [N s]
    pub impulse: [f64; 3],
    /// impulse of mobile grains on the fixed ones [N s]
    pub on_fixed: [f64; 3],
}

/// Contacts with walls: those of wall w are `range[w]`.
#[derive(Clone, Debug, Default)]
pub struct WallList {
    /// grain of each, padded per wall
    pub grains: Vec<u64>,
    /// elongation of the tangential springs \[m], 0 where none touches
    pub springs: Vec<Row>,
    /// which entries of each group may have touched in the last step
    pub touching: Vec<u8>,
    /// entries of each wall without the padding
    pub ranges: Vec<Range<usize>>,
}

/// Grains `grains` and the contacts of which they are the first.
#[derive(Clone, Debug, Default)]
pub struct Tile {
    /// its grains
    pub grains: Range<usize>,
    /// first pair of each of its grains, and the end
    pub starts: Vec<u32>,
    /// pairs, in the order of their first grain, padded to a multiple of [`GROUP`]
    pub pairs: Vec<Pair>,
    /// elongation of the tangential spring of each pair \[m]
    pub springs: Vec<Row>,
    /// which pairs of each group touch
    pub touching: Vec<u8>,
    /// contacts with walls
    pub walls: WallList,
    /// number of its rows of loads: its grains, and those up to the last that they touch
    pub reach: usize,
    /// where these rows are
    pub loads: Range<usize>,
    /// what it found in the last step
    pub found: Found,
    /// grains, pairs and wall entries when every index was last looked at
    pub(super) checked: Option<(usize, usize, usize)>,
}

impl Tile {
    /// Its rows of loads of the grains `wanted`, which are another tile's, and those grains; `count` grains in all.
    pub fn rows_of(&self, wanted: &Range<usize>, count: usize) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let (start, row, own) = (self.grains.start, self.loads.start, self.grains.len());
        let end = start + self.reach;
        // Behind its own grains, and from the first grain on if it reaches beyond the last.
        let behind = (start + own).max(wanted.start)..end.min(count).min(wanted.end);
        let around = wanted.start..end.saturating_sub(count).min(wanted.end);
        let placed = |grains: Range<usize>, shift: usize| {
            let from = row + grains.start + shift - start;
            (from..from + grains.len(), grains)
        };
        let (behind, around) =
            ((!behind.is_empty()).then(|| placed(behind, 0)), (!around.is_empty()).then(|| placed(around, count)));
        behind.into_iter().chain(around)
    }

    /// Number of pairs without the padding.
    #[must_use]
    pub fn listed(&self) -> usize {
        self.starts.last().map_or(0, |&end| end as usize)
    }

    /// Whether the pair in slot `slot` touched in the last step.
    #[must_use]
    pub fn touches(&self, slot: usize) -> bool {
        self.touching[slot / GROUP] >> (slot % GROUP) & 1 == 1
    }

    /// To which grains its rows of loads belong, of `grains` in all.
    #[inline(always)]
    #[must_use]
    pub fn window(&self, grains: usize) -> Window {
        Window { first: self.grains.start as u32, grains: grains as u32 }
    }

    /// The slot of the pair (`i`, `j`), i among its grains, if it is listed.
    #[must_use]
    pub fn slot(&self, i: usize, j: usize) -> Option<usize> {
        let local = i - self.grains.start;
        let (from, to) = (self.starts[local] as usize, self.starts[local + 1] as usize);
        self.pairs[from..to].iter().position(|pair| pair.j as usize == j).map(|at| from + at)
    }
}

/// Cuts `grains` grains into tiles: enough for many threads, thick enough that little spills over.
#[must_use]
pub fn cut(grains: usize) -> Vec<Range<usize>> {
    let count = (grains / 1200).clamp(1, 96);
    (0..count).map(|t| t * grains / count..(t + 1) * grains / count).collect()
}
