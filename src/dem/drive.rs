//! One driver for every run of grains: deposit the bed, follow the flow, sample it, keep its states; from the beginning or from
//! a checkpoint.
//!
//! ```text
//!  deposit (deposit.rs) ─► Flow::begin ─► advance, advance, ... ─► Flow::end ─► Flow::outcome
//!       │                                    │ frames, animation, progress
//!       └────────────── checkpoint ──────────┘
//! ```
//!
//! Checkpoint: the stage, the engine, what the flow saves of itself, the animation.

use std::fmt::Debug;
use std::ops::ControlFlow;
use std::time::Instant;

use sha2::{Digest, Sha256};

use super::animation::Recorder;
use super::checkpoint::{Reader, Writer};
use super::deposit::{Deposit, Stage, deposit};
use super::engine::Engine;
use super::error::RunError;
use super::grains::Grain;
use super::keep::law;
use super::law::LinearSpring;
use super::outcome::nothing;
use super::setup::GrainBed;
use super::view;
use crate::result::{CheckpointError, Context, Failure, Outcome, Quantity, Snapshot, SolveError, Status};

/// A flow of grains, as its problem states it.
pub trait GrainFlow: Debug {
    /// its bed
    fn bed(&self) -> &GrainBed;

    /// Fixed grains of a rough bottom, in place of those that the bed itself would have.
    fn fixed(&self) -> Option<Vec<Grain>> {
        None
    }
}

/// How far a run is, for those who watch it.
pub struct Progress {
    /// in words, with the speed of the run
    pub stage: String,
    /// the quantity of interest so far
    pub quantity: Option<(&'static Quantity, f64)>,
}

/// A flow that is followed.
pub trait Flow<'a>: Sized {
    /// its problem
    type Problem: GrainFlow;
    /// Advances between two looks at the watch and the checkpoint.
    const BETWEEN: u64;

    /// Starts it over a bed that has come to rest.
    ///
    /// # Errors
    /// A step or a drive that the grains cannot follow.
    fn begin(problem: &'a Self::Problem, engine: Engine<LinearSpring>) -> Result<Self, SolveError>;

    /// Reads what [`Self::save`] wrote, but for the engine.
    ///
    /// # Errors
    /// [`CheckpointError`] if what it says cannot be.
    fn restore(
        problem: &'a Self::Problem,
        engine: Engine<LinearSpring>,
        from: &mut Reader<'_>,
    ) -> Result<Self, CheckpointError>;

    /// Writes itself into a checkpoint, but for the engine.
    fn save(&self, to: &mut Writer);

    /// its problem
    fn problem(&self) -> &'a Self::Problem;
    /// its grains
    fn engine(&self) -> &Engine<LinearSpring>;
    /// advances in all, and made so far
    fn advances(&self) -> (u64, u64);
    /// time of one advance \[s]
    fn period(&self) -> f64;

    /// What is to be done before the first advance.
    fn first(&mut self) {}

    /// Goes one advance on, and samples where that is due.
    ///
    /// # Errors
    /// The grain or the cell that cannot go on.
    fn advance(&mut self) -> Result<(), SolveError>;

    /// How far it is: `made` advances since `since`.
    fn progress(&self, made: u64, since: Instant) -> Progress;

    /// Whether it may end before its time.
    fn is_known(&self) -> bool {
        false
    }

    /// What is to be checked after the last advance.
    ///
    /// # Errors
    /// A limit that the run passed.
    fn end(&mut self) -> Result<(), SolveError>;

    /// A failure with what a user can change, as far as the flow knows more of it.
    fn advised(&self, error: SolveError) -> SolveError {
        error
    }

    /// What it found so far.
    ///
    /// # Errors
    /// Numbers that are none.
    fn outcome(&mut self, status: Status) -> Result<Outcome, SolveError>;
}

/// A flow with the recorder of its animation.
pub struct Run<F> {
    /// the flow
    pub flow: F,
    recorder: Recorder,
}

/// A run that was interrupted.
pub enum HalfWay<F> {
    /// while its bed fell
    Falling(Stage, Box<Engine<LinearSpring>>),
    /// while it flowed
    Flowing(Box<Run<F>>),
}

/// Name of a problem for its checkpoints.
fn name(problem: &impl GrainFlow) -> [u8; 32] {
    Sha256::digest(format!("{problem:?}").as_bytes()).into()
}

/// Whether `bytes` are a checkpoint of `problem`, whole and sound as far as its frame.
///
/// # Errors
/// Why not.
pub fn accepts(problem: &impl GrainFlow, bytes: &[u8]) -> Result<(), CheckpointError> {
    Reader::open(bytes, &name(problem)).map(drop)
}

/// Lets the bed of `problem` fall, follows the flow over it and averages.
///
/// # Errors
/// [`Failure`] with the grain or the cell that cannot go on, and the averages so far.
pub fn run<'a, F: Flow<'a> + 'a>(problem: &'a F::Problem, context: &mut Context<'_>) -> Result<Outcome, Failure> {
    let half_way = match context.resumed() {
        Some(bytes) => Some(resume::<F>(problem, &bytes, context.threads).map_err(RunError::Checkpoint)?),
        None => None,
    };
    let falling = match half_way {
        Some(HalfWay::Flowing(run)) => return run.finish(context),
        Some(HalfWay::Falling(stage, engine)) => Some((stage, *engine)),
        None => None,
    };
    let fixed = problem.fixed();
    let what = Deposit { bed: problem.bed(), fixed: fixed.as_deref(), name: &name(problem) };
    match deposit(what, falling, context)? {
        ControlFlow::Continue(engine) => Run::<F>::begin(problem, engine)?.finish(context),
        ControlFlow::Break(()) => Ok(nothing(Status::Stopped)),
    }
}

/// The run of `problem` that stopped at a checkpoint.
///
/// # Errors
/// [`CheckpointError`]: it is of another problem, another version, or damaged.
pub fn resume<'a, F: Flow<'a> + 'a>(
    problem: &'a F::Problem,
    bytes: &[u8],
    threads: usize,
) -> Result<HalfWay<F>, CheckpointError> {
    let mut from = Reader::open(bytes, &name(problem))?;
    let stage = Stage::read(&mut from)?;
    let contact = law(&problem.bed().contact).map_err(|_| CheckpointError::OtherCase)?;
    let engine = Engine::restore(&mut from, stage.domain(problem.bed()), contact, threads)?;
    let half_way = match stage {
        Stage::Below | Stage::Falling => HalfWay::Falling(stage, Box::new(engine)),
        Stage::Flowing => {
            let flow = F::restore(problem, engine, &mut from)?;
            let recorder = Recorder::restore(&mut from, flow.engine().grains().len())?;
            HalfWay::Flowing(Box::new(Run { flow, recorder }))
        }
    };
    from.close()?;
    Ok(half_way)
}

impl<'a, F: Flow<'a> + 'a> Run<F> {
    /// Starts the flow over a bed that has come to rest.
    ///
    /// # Errors
    /// As [`Flow::begin`].
    pub fn begin(problem: &'a F::Problem, engine: Engine<LinearSpring>) -> Result<Self, SolveError> {
        let flow = F::begin(problem, engine)?;
        let recorder = Recorder::new(problem.bed(), flow.engine().grains(), flow.period());
        Ok(Self { flow, recorder })
    }

    /// Its state.
    pub fn checkpoint(&self) -> Vec<u8> {
        let mut to = Writer::default();
        to.whole(Stage::Flowing.number());
        self.flow.engine().save(&mut to);
        self.flow.save(&mut to);
        self.recorder.save(&mut to);
        to.seal(&name(self.flow.problem()))
    }

    fn finish(mut self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        let status = match self.follow(context) {
            Ok(status) => status,
            Err(error) => {
                let last = self.flow.outcome(Status::Failed).ok().map(Box::new);
                return Err(Failure { error: self.flow.advised(error), last });
            }
        };
        let mut outcome = self.flow.outcome(status)?;
        outcome.grains = Some(view::side_view(self.flow.engine().grains()));
        outcome.animation = self.recorder.animation();
        Ok(outcome)
    }

    /// Follows the flow to its end.
    ///
    /// # Errors
    /// The grain or the cell that cannot go on; a file that cannot be written.
    pub fn follow(&mut self, context: &mut Context<'_>) -> Result<Status, SolveError> {
        let (all, begun) = self.flow.advances();
        let clock = Instant::now();
        let frames = u64::from(self.flow.problem().bed().discrete.frames);
        let frame = (all / frames.max(1)).max(1);
        if all == 0 {
            self.flow.first();
        }
        loop {
            let (_, made) = self.flow.advances();
            if made >= all {
                break;
            }
            self.flow.advance()?;
            let made = made + 1;
            let (grains, time) = (self.flow.engine().grains(), made as f64 * self.flow.period());
            if self.recorder.is_due(made) {
                self.recorder.record(grains, time);
            }
            if frames > 0 && made.is_multiple_of(frame) {
                let taken = context.frame(made / frame, &mut || view::vtp(grains, time));
                taken.map_err(RunError::File)?;
            }
            if made.is_multiple_of(F::BETWEEN) || made == all {
                let Progress { stage, quantity } = self.flow.progress(made - begun, clock);
                let fraction = made as f64 / all as f64;
                let stop = context.watch.see(&Snapshot { stage: &stage, fraction, quantity }).is_break();
                let kept = context.keep(stop, &mut || self.checkpoint());
                kept.map_err(RunError::File)?;
                if stop {
                    return Ok(Status::Stopped);
                }
            }
            if self.flow.is_known() {
                break;
            }
        }
        self.flow.end()?;
        Ok(Status::Done)
    }
}
