//! Watching a run: read-only snapshots, and the wish to stop.

use std::ops::ControlFlow;

use super::Quantity;

/// What a run shows of itself while it works.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Snapshot<'a> {
    /// what is being done
    pub stage: &'a str,
    /// share of the work done, 0 to 1
    pub fraction: f64,
    /// the quantity of interest so far, and its value in SI
    pub quantity: Option<(&'static Quantity, f64)>,
}

impl<'a> Snapshot<'a> {
    /// The share `fraction` of the work `stage` is done.
    #[must_use]
    pub fn new(stage: &'a str, fraction: f64) -> Self {
        Self { stage, fraction, quantity: None }
    }
}

/// Sees snapshots and may ask to stop; it cannot change a run.
pub trait Watch {
    /// Called between pieces of work. `Break` asks the run to end with what it has.
    fn see(&mut self, snapshot: &Snapshot<'_>) -> ControlFlow<()>;
}

/// Watches nothing and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Watch for Quiet {
    fn see(&mut self, _: &Snapshot<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
