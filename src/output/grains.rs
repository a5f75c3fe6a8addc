//! Files that runs of grains write as they go.

use std::fs;
use std::io::BufReader;
use std::path::Path;

use super::error::OutputError;
use super::folder::{Folder, write_whole};
use super::ours::entries;
use crate::result::Animation;

/// State from which a run of grains goes on.
pub const CHECKPOINT: &str = "checkpoint.bin";

/// The animation of the grains that the report plays.
pub(super) const ANIMATION: &str = "motion.json";

/// The animation of a run, if its folder has one that is sound.
pub(super) fn read_animation(place: &Path) -> Option<Animation> {
    let file = fs::File::open(place.join(ANIMATION)).ok()?;
    serde_json::from_reader(BufReader::new(file)).ok().filter(Animation::is_sound)
}

/// Written and removed to see whether files can be made.
pub(super) const PROBE: &str = ".probe";

/// What a run that was killed may leave behind in its folder, but for locks.
pub(super) fn is_partial(name: &str) -> bool {
    name == PROBE || name.starts_with('.') && name.contains(".part-")
}

/// Frames of the grains for ParaView.
pub(super) fn is_frame(name: &str) -> bool {
    name.strip_prefix("grains_").and_then(|n| n.strip_suffix(".vtp")).is_some_and(|n| n.parse::<u64>().is_ok())
}

impl Folder {
    /// Takes the checkpoint and the frames of the run that goes on: it may fail before it has made its own.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file.
    pub fn carry_over(&mut self) -> Result<(), OutputError> {
        if self.place == self.target {
            return Ok(());
        }
        self.carried = true;
        for (name, _) in entries(&self.target).unwrap_or_default() {
            if name == CHECKPOINT || is_frame(&name) {
                let path = self.place.join(&name);
                let copied = fs::copy(self.target.join(&name), &path);
                copied.map_err(|error| OutputError::Interrupted { path, error })?;
            }
        }
        Ok(())
    }

    /// Writes a file of a run that is on its way; where it goes on from another one beside that one, too: it may be killed
    /// before it takes its place.
    ///
    /// # Errors
    /// [`OutputError::Interrupted`] with the file.
    pub fn write_on_the_way(&self, name: &str, bytes: &[u8], going_on: bool) -> Result<(), OutputError> {
        if going_on && self.place != self.target {
            write_whole(&self.target.join(name), |to| to.write_all(bytes))?;
        }
        self.write(name, |to| to.write_all(bytes))
    }
}
