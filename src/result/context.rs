//! What a run is given beside its problem. Nothing of it changes a result.

use std::io;

use super::{Quiet, Watch};

/// Keeps the states from which an unfinished run goes on.
pub trait Checkpoints {
    /// Offers a state; `content` is asked for only where it is wanted: always if `now`, else when enough time has passed since
    /// the last one.
    ///
    /// # Errors
    /// Whatever keeps it from being written.
    fn keep(&mut self, now: bool, content: &mut dyn FnMut() -> Vec<u8>) -> io::Result<()>;

    /// The state of an unfinished run of the same problem that is to go on.
    fn resumed(&mut self) -> Option<Vec<u8>>;
}

/// Takes the frames of a run that are too large to be part of its outcome.
pub trait Frames {
    /// Frame `number`, from 1: VTK poly data in text.
    ///
    /// # Errors
    /// Whatever keeps it from being written.
    fn take(&mut self, number: u64, content: &mut dyn FnMut() -> String) -> io::Result<()>;
}

/// Who watches a run, who keeps its states and frames, and the threads that it may use.
#[non_exhaustive]
pub struct Context<'a> {
    /// threads; at least one
    pub threads: usize,
    /// sees the progress and may ask to stop
    pub watch: &'a mut dyn Watch,
    /// keeps states, if anybody does
    pub checkpoints: Option<&'a mut dyn Checkpoints>,
    /// takes frames, if anybody does
    pub frames: Option<&'a mut dyn Frames>,
}

impl<'a> Context<'a> {
    /// A run on one thread that `watch` sees.
    pub fn new(watch: &'a mut dyn Watch) -> Self {
        Self { threads: 1, watch, checkpoints: None, frames: None }
    }

    /// The same on `threads` threads.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads: threads.max(1), ..self }
    }

    /// The same, whose states are kept.
    #[must_use]
    pub fn checkpoints(self, checkpoints: &'a mut dyn Checkpoints) -> Self {
        Self { checkpoints: Some(checkpoints), ..self }
    }

    /// The same, whose frames are taken.
    #[must_use]
    pub fn frames(self, frames: &'a mut dyn Frames) -> Self {
        Self { frames: Some(frames), ..self }
    }
}

impl Context<'_> {
    /// Does `work` in a context that nobody watches.
    pub fn quiet<T>(work: impl FnOnce(&mut Context<'_>) -> T) -> T {
        work(&mut Context::new(&mut Quiet))
    }

    /// Offers a state.
    ///
    /// # Errors
    /// As [`Checkpoints::keep`].
    pub fn keep(&mut self, now: bool, content: &mut dyn FnMut() -> Vec<u8>) -> io::Result<()> {
        self.checkpoints.as_mut().map_or(Ok(()), |checkpoints| checkpoints.keep(now, content))
    }

    /// The state from which the run is to go on.
    pub fn resumed(&mut self) -> Option<Vec<u8>> {
        self.checkpoints.as_mut().and_then(|checkpoints| checkpoints.resumed())
    }

    /// Offers a frame.
    ///
    /// # Errors
    /// As [`Frames::take`].
    pub fn frame(&mut self, number: u64, content: &mut dyn FnMut() -> String) -> io::Result<()> {
        self.frames.as_mut().map_or(Ok(()), |frames| frames.take(number, content))
    }
}
