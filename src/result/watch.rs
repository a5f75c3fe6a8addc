//! Watching a run: read-only snapshots, and the wish to stop.

use std::io;
use std::ops::ControlFlow;

use super::Quantity;

/// What a run shows of itself while it works.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    /// what is being done
    pub stage: &'a str,
    /// share of the work done, 0 to 1
    pub fraction: f64,
    /// the quantity of interest so far, and its value in SI
    pub quantity: Option<(&'static Quantity, f64)>,
}

/// Sees snapshots and may ask to stop; it cannot change a run.
pub trait Watch {
    /// Called between pieces of work. `Break` asks the run to end with what it has.
    fn see(&mut self, snapshot: &Snapshot<'_>) -> ControlFlow<()>;

    /// Offers a file of the run, such as a checkpoint; `content` is asked for only where it is wanted: always if `now`,
    /// else when enough time has passed since the last one.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    fn keep(&mut self, _name: &str, _now: bool, _content: &mut dyn FnMut() -> Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    /// The file `name` of an unfinished run of the same case that is to go on.
    fn resumed(&mut self, _name: &str) -> Option<Vec<u8>> {
        None
    }
}

/// Watches nothing and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Watch for Quiet {
    fn see(&mut self, _: &Snapshot<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
