//! What an engine tells of itself.

use super::engine::Engine;
use super::law::ContactLaw;
use super::tile::{Found, Tile};

impl<C: ContactLaw> Engine<C> {
    /// What the last step found.
    #[must_use]
    pub fn found(&self) -> Found {
        let mut sum = Found::default();
        for tile in &self.tiles {
            sum.contacts += tile.found.contacts;
            sum.wall_contacts += tile.found.wall_contacts;
            for (sum, force) in sum.walls.iter_mut().zip(tile.found.walls) {
                *sum += force;
            }
            sum.overlap = sum.overlap.max(tile.found.overlap);
        }
        sum
    }

    /// Bytes held for the grains, their list and their history.
    #[must_use]
    pub fn memory(&self) -> usize {
        let rows = 3 * self.grains.positions.capacity() + self.reference.capacity();
        let tile = |tile: &Tile| {
            8 * tile.pairs.capacity()
                + 32 * (tile.springs.capacity() + tile.walls.springs.capacity())
                + tile.touching.capacity()
                + 4 * tile.starts.capacity()
                + 8 * tile.walls.grains.capacity()
        };
        32 * rows
            + 64 * self.loads.capacity()
            + 12 * self.grains.len()
            + self.tiles.iter().chain(&self.former).map(tile).sum::<usize>()
    }
}
