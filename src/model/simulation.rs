//! A run from the library, in one line.

use std::sync::Arc;

use super::{Model, Problem, Solve};
use crate::result::{Checkpoints, Context, Failure, Frames, Outcome, Quiet, Watch};

/// A problem that is about to be solved.
pub struct Simulation<'a> {
    problem: Problem,
    threads: usize,
    watch: Option<&'a mut dyn Watch>,
    checkpoints: Option<&'a mut dyn Checkpoints>,
    frames: Option<&'a mut dyn Frames>,
}

impl<'a> Simulation<'a> {
    /// A run of `problem` on one thread that nobody watches.
    #[must_use]
    pub fn new(problem: &Problem) -> Self {
        Self { problem: problem.clone(), threads: 1, watch: None, checkpoints: None, frames: None }
    }

    /// A run of a problem that was made without a case file, such as by [`checked`](super::checked).
    #[must_use]
    pub fn of<M: Model>(name: &str, model: M) -> Self {
        let solver: Arc<dyn Solve> = Arc::new(model);
        Self::new(&Problem::of(name, M::INFO, solver))
    }

    /// Threads that the run may use. They change no result.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads: threads.max(1), ..self }
    }

    /// Who sees the progress and may ask to stop.
    #[must_use]
    pub fn watch(self, watch: &'a mut dyn Watch) -> Self {
        Self { watch: Some(watch), ..self }
    }

    /// Who keeps its states.
    #[must_use]
    pub fn checkpoints(self, checkpoints: &'a mut dyn Checkpoints) -> Self {
        Self { checkpoints: Some(checkpoints), ..self }
    }

    /// Who takes its frames.
    #[must_use]
    pub fn frames(self, frames: &'a mut dyn Frames) -> Self {
        Self { frames: Some(frames), ..self }
    }

    /// Solves it.
    ///
    /// # Errors
    /// As [`Problem::run`].
    pub fn run(self) -> Result<Outcome, Failure> {
        let Self { problem, threads, watch, checkpoints, frames } = self;
        let mut quiet = Quiet;
        // Each reference is taken for the time of the run alone.
        let checkpoints = checkpoints.map(|checkpoints| checkpoints as &mut dyn Checkpoints);
        let frames = frames.map(|frames| frames as &mut dyn Frames);
        let watch: &mut dyn Watch = match watch {
            Some(watch) => watch,
            None => &mut quiet,
        };
        problem.run(&mut Context { threads, watch, checkpoints, frames })
    }
}
