//! What a run is given beside its problem.

use crate::result::{Quiet, Watch};

/// Who watches a run. Nothing of it changes a result.
pub struct Context<'a> {
    /// sees the progress and may ask to stop
    pub watch: &'a mut dyn Watch,
}

impl<'a> Context<'a> {
    /// A run that `watch` sees.
    pub fn new(watch: &'a mut dyn Watch) -> Self {
        Self { watch }
    }
}

impl Context<'_> {
    /// Does `work` in a context that nobody watches.
    pub fn quiet<T>(work: impl FnOnce(&mut Context<'_>) -> T) -> T {
        work(&mut Context { watch: &mut Quiet })
    }
}
