//! Files that runs of grains write as they go.

use super::folder::{Folder, OutputError, write_whole};

/// State from which a run of grains goes on.
pub const CHECKPOINT: &str = "checkpoint.bin";

/// Pictures of the grains for ParaView.
pub(super) fn is_frame(name: &str) -> bool {
    name.strip_prefix("grains_").and_then(|n| n.strip_suffix(".vtp")).is_some_and(|n| n.parse::<u64>().is_ok())
}

impl Folder {
    /// Writes the checkpoint; of a run that goes on from another one beside that one, too: it may be stopped before it
    /// takes its place.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file.
    pub fn write_checkpoint(&self, bytes: &[u8], going_on: bool) -> Result<(), OutputError> {
        if going_on && self.place != self.target {
            write_whole(&self.target.join(CHECKPOINT), |to| to.write_all(bytes))?;
        }
        self.write(CHECKPOINT, |to| to.write_all(bytes))
    }
}
