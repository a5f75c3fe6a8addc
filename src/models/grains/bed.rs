//! A bed of spheres: let fall, brought to rest, tilted, followed, averaged.

use std::ops::ControlFlow;
use std::time::Instant;

use crate::dem::Bottom;
use crate::dem::GrainBed;
use crate::dem::average::Averages;
use crate::dem::body::Nothing;
use crate::dem::checkpoint::{Reader, Saved, Writer};
use crate::dem::deposit::{BETWEEN, CHECKPOINT, Deposit, Stage, deposit, pace};
use crate::dem::engine::Engine;
use crate::dem::film::Film;

use crate::dem::keep::{contact_equations, keep_pictures, law, refused, threads, unwritable};
use crate::dem::law::LinearSpring;
use crate::dem::outcome::{self, Means};
use crate::dem::{picture, stability};
use crate::result::CheckpointError;
use crate::result::{Failure, Outcome, Snapshot, SolveError, Status, Watch, quantity as q};
use crate::units::significant;

/// Samples of the profile within the averaged time, and blocks for its standard errors.
const SAMPLES: u64 = 200;
const BLOCKS: u64 = 10;

/// A bed that is followed.
struct Run<'a> {
    bed: &'a GrainBed,
    engine: Engine<LinearSpring>,
    averages: Averages,
    means: Means,
    film: Film,
    /// steps of the flow, all and made
    steps: u64,
    made: u64,
}

/// Name of a case for its checkpoints.
pub(super) fn name(bed: &GrainBed) -> [u8; 32] {
    use sha2::{Digest, Sha256};
    Sha256::digest(format!("{bed:?}").as_bytes()).into()
}

/// Whether `bytes` are a checkpoint of `bed`, whole and sound as far as its frame.
///
/// # Errors
/// Why not.
pub fn accepts(bed: &GrainBed, bytes: &[u8]) -> Result<(), CheckpointError> {
    Reader::open(bytes, &name(bed)).map(drop)
}

/// Lets `bed` fall, follows it and averages.
///
/// # Errors
/// [`Failure`] with the grain that cannot go on, and the averages so far.
pub fn run(bed: &GrainBed, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let half_way = match watch.resumed(CHECKPOINT) {
        Some(bytes) => Some(resume(bed, &bytes).map_err(refused)?),
        None => None,
    };
    let falling = match half_way {
        Some(HalfWay::Flowing(run)) => return go_on(*run, watch),
        Some(HalfWay::Falling(stage, engine)) => Some((stage, *engine)),
        None => None,
    };
    match deposit(Deposit { bed, fixed: None, name: &name(bed) }, falling, watch)? {
        ControlFlow::Continue(engine) => go_on(Run::begin(bed, engine)?, watch),
        ControlFlow::Break(()) => Ok(outcome::nothing(Status::Stopped)),
    }
}

fn go_on(mut run: Run<'_>, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let status = match run.follow(watch) {
        Ok(status) => status,
        Err(error) => {
            let last = run.outcome(Status::Failed).ok().map(Box::new);
            return Err(Failure { error, last });
        }
    };
    let outcome = run.outcome(status)?;
    keep_pictures(run.engine.grains(), &run.film, watch)?;
    Ok(outcome)
}

/// A run that was interrupted.
enum HalfWay<'a> {
    Falling(Stage, Box<Engine<LinearSpring>>),
    Flowing(Box<Run<'a>>),
}

fn resume<'a>(bed: &'a GrainBed, bytes: &[u8]) -> Result<HalfWay<'a>, CheckpointError> {
    let mut from = Reader::open(bytes, &name(bed))?;
    let stage = Stage::read(&mut from)?;
    let law = law(&bed.contact).map_err(|_| CheckpointError::OtherCase)?;
    let engine = Engine::restore(&mut from, stage.domain(bed), law, threads())?;
    let half_way = match stage {
        Stage::Below | Stage::Falling => HalfWay::Falling(stage, Box::new(engine)),
        Stage::Flowing => HalfWay::Flowing(Box::new(Run::restore(bed, engine, &mut from)?)),
    };
    from.close()?;
    Ok(half_way)
}

impl<'a> Run<'a> {
    /// Tilts the bed that has come to rest.
    fn begin(bed: &'a GrainBed, mut engine: Engine<LinearSpring>) -> Result<Self, SolveError> {
        let limit = stability::limit(&engine).step.min(stability::of_pair(&law(&bed.contact)?, 0.5 * bed.mass()));
        let dt = bed.discrete.time_step.unwrap_or(bed.discrete.safety * limit);
        engine.change(dt, bed.gravity());
        if !bed.discrete.force_time_step {
            engine.check_step()?;
        }
        engine.begin_ledger();
        let top = (0..engine.grains().len()).map(|i| engine.grains().position(i)[2]).fold(0.0, f64::max);
        let bottom = (0..engine.grains().len()).map(|i| engine.grains().position(i)[2]).fold(0.0, f64::min);
        // A bed that flows dilates.
        let (low, high) = (bottom - 0.5 * bed.d, top + 3.0 * bed.d);
        let area = bed.size[0] * bed.size[1];
        let averages = Averages::new(low, high, bed.discrete.slice * bed.d, area, bed.rho_p, BLOCKS as usize);
        let steps = (bed.discrete.duration / dt).round() as u64;
        let film = Film::new(bed, engine.grains(), dt);
        Ok(Self { bed, engine, averages, means: Means::default(), film, steps, made: 0 })
    }

    /// Reads the rest of a checkpoint of the flow.
    fn restore(
        bed: &'a GrainBed,
        engine: Engine<LinearSpring>,
        from: &mut Reader<'_>,
    ) -> Result<Self, CheckpointError> {
        let (steps, made) = (from.whole()?, from.whole()?);
        let corrupt = CheckpointError::Corrupt { what: "the number of slices" };
        let slices = usize::try_from(from.whole()?).ok().filter(|&n| n <= 1_000_000).ok_or(corrupt)?;
        let mut averages = Averages::empty(slices, BLOCKS as usize, [0.0; 4]);
        averages.fill(from)?;
        let mut means = Means::default();
        means.fill(from)?;
        let film = Film::restore(from, engine.grains().len())?;
        Ok(Self { bed, engine, averages, means, film, steps, made })
    }

    fn checkpoint(&self) -> Vec<u8> {
        let mut to = Writer::default();
        to.whole(Stage::Flowing.number());
        self.engine.save(&mut to);
        to.whole(self.steps);
        to.whole(self.made);
        to.whole(self.averages.shape()[0] as u64);
        self.averages.save(&mut to);
        self.means.save(&mut to);
        self.film.save(&mut to);
        to.seal(&name(self.bed))
    }

    /// Makes the steps of the flow and samples the last share of them.
    fn follow(&mut self, watch: &mut dyn Watch) -> Result<Status, SolveError> {
        let (clock, begun) = (Instant::now(), self.made);
        let averaged = ((self.steps as f64 * self.bed.discrete.averaged) as u64).max(1).min(self.steps);
        let start = self.steps - averaged;
        let every = (averaged / SAMPLES).max(1);
        let frame = self.steps / u64::from(self.bed.discrete.frames).max(1);
        if self.steps == 0 {
            self.sample(0);
        }
        while self.made < self.steps {
            self.engine.step(&Nothing)?;
            self.made += 1;
            if self.made > start && (self.made - start).is_multiple_of(every) {
                self.sample(((self.made - start - 1) * BLOCKS / averaged) as usize);
            }
            if self.film.is_due(self.made) {
                self.film.see(self.engine.grains(), self.made as f64 * self.engine.settings().dt);
            }
            if self.bed.discrete.frames > 0 && self.made.is_multiple_of(frame.max(1)) {
                let number = self.made / frame.max(1);
                let time = self.made as f64 * self.engine.settings().dt;
                let mut content = || picture::vtp(self.engine.grains(), time).into_bytes();
                let kept = watch.keep(&format!("grains_{number:05}.vtp"), true, &mut content);
                kept.map_err(|error| unwritable(&error))?;
            }
            if self.made.is_multiple_of(BETWEEN) || self.made == self.steps {
                let stage = pace("flowing", self.made - begun, clock, self.steps - self.made);
                let fraction = self.made as f64 / self.steps as f64;
                let quantity = self.means.velocity().map(|u| (&q::MEAN_VELOCITY, u));
                let stop = watch.see(&Snapshot { stage: &stage, fraction, quantity }).is_break();
                let kept = watch.keep(CHECKPOINT, stop, &mut || self.checkpoint());
                kept.map_err(|error| unwritable(&error))?;
                if stop {
                    return Ok(Status::Stopped);
                }
            }
        }
        if !self.bed.discrete.force_time_step {
            self.engine.check_step()?;
        }
        Ok(Status::Done)
    }

    fn sample(&mut self, block: usize) {
        self.averages.sample(&self.engine, block, |_| [0.0; 3]);
        self.means.sample(&self.engine, self.bed);
    }

    fn outcome(&self, status: Status) -> Result<Outcome, SolveError> {
        outcome::outcome(self.bed, &self.engine, &self.averages, &self.means, status)
    }
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(bed: &GrainBed) -> String {
    let n = |x: f64| significant(x, 5);
    let bottom = match bed.bottom {
        Bottom::Steps => "fixed spheres, elevations in three steps of d/3",
        Bottom::Slice => "a fixed slice of a deposited bed",
        Bottom::Plane => "a plane with the friction of the grains",
    };
    format!(
        "{} mobile spheres, d = {} m, ρ_p = {} kg/m³, on {bottom}; x periodic over {} m, y {} {} m; slope angle {} rad, g = {} m/s².\n\n{}",
        bed.mobile,
        n(bed.d),
        n(bed.rho_p),
        n(bed.size[0]),
        if bed.side_walls { "between walls at a distance of" } else { "periodic over" },
        n(bed.size[1]),
        n(bed.beta),
        n(bed.g),
        contact_equations(&bed.contact)
    )
}
