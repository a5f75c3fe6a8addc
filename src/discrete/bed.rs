//! A bed of spheres: let fall, brought to rest, tilted, followed, averaged.

use std::ops::ControlFlow;
use std::time::Instant;

use super::average::Averages;
use super::body::{Nothing, Pushed};
use super::checkpoint::{Reader, Saved, Writer};
use super::engine::{Engine, Settings};
use super::grains::{Grain, Point};
use super::impact::{contact_equations, law};
use super::law::LinearSpring;
use super::outcome::{self, Means};
use super::{pack, picture, stability};
use crate::case::grain_tables::Bottom;
use crate::problem::GrainBed;
use crate::result::{Failure, Outcome, Snapshot, SolveError, Status, Watch, quantity as q};
use crate::units::significant;

/// Kinetic energy per grain over m g d below which a bed has come to rest.
const AT_REST: f64 = 1e-6;
/// Step of the fall over the limit of one contact: more contacts come.
const FALLING: f64 = 0.35;
/// Samples of the profile within the averaged time, and blocks for its standard errors.
const SAMPLES: u64 = 200;
const BLOCKS: u64 = 10;
/// Steps between two looks at the clock, the checkpoint and the wish to stop.
const BETWEEN: u64 = 64;

/// A bed that is followed.
struct Run<'a> {
    bed: &'a GrainBed,
    engine: Engine<LinearSpring>,
    averages: Averages,
    means: Means,
    /// steps of the flow, all and made
    steps: u64,
    made: u64,
}

impl GrainBed {
    /// Mass of a grain [kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        Grain::at_rest([0.0; 3], 0.5 * self.d, self.rho_p).mass()
    }

    fn gravity(&self) -> Point {
        [self.g * self.beta.sin(), 0.0, -self.g * self.beta.cos()]
    }
}

/// Name of a case for its checkpoints.
fn name(bed: &GrainBed) -> [u8; 32] {
    use sha2::{Digest, Sha256};
    Sha256::digest(format!("{bed:?}").as_bytes()).into()
}

/// Whether `bytes` are a checkpoint of `bed`, whole and sound as far as its frame.
///
/// # Errors
/// Why not.
pub fn accepts(bed: &GrainBed, bytes: &[u8]) -> Result<(), super::checkpoint::CheckpointError> {
    Reader::open(bytes, &name(bed)).map(drop)
}

/// Threads: what the system offers, since they change no bit.
fn threads() -> usize {
    crate::runtime::pool::wanted()
}

/// Lets `bed` fall, follows it and averages.
///
/// # Errors
/// [`Failure`] with the grain that cannot go on, and the averages so far.
pub fn run(bed: &GrainBed, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let mut run = match watch.resumed("checkpoint.bin") {
        Some(bytes) => Run::resumed(bed, &bytes)?,
        None => match Run::begin(bed, watch)? {
            ControlFlow::Continue(run) => run,
            ControlFlow::Break(()) => return Ok(outcome::nothing(Status::Stopped)),
        },
    };
    let status = match run.follow(watch) {
        Ok(status) => status,
        Err(error) => {
            let last = run.outcome(Status::Failed).ok().map(Box::new);
            return Err(Failure { error, last });
        }
    };
    let outcome = run.outcome(status)?;
    let mut side = || picture::side_view(run.engine.grains()).into_bytes();
    watch.keep("grains.csv", true, &mut side).map_err(|error| unwritable(&error))?;
    Ok(outcome)
}

fn unwritable(error: &std::io::Error) -> SolveError {
    SolveError::Grains {
        code: "file",
        message: format!("a file of the grains cannot be written: {error}"),
        hint: "free some space, or give another folder with --out",
    }
}

/// Lets grains fall until they rest. Stops where the watch wants it.
fn settle(
    bed: &GrainBed,
    grains: &[Grain],
    watch: &mut dyn Watch,
) -> Result<ControlFlow<(), Engine<LinearSpring>>, SolveError> {
    let law = law(&bed.contact)?;
    let mass = bed.mass();
    let derived = stability::of_pair(&law, 0.5 * mass);
    let dt = bed.discrete.time_step.unwrap_or(f64::INFINITY).min(FALLING * derived);
    let lowest = grains.iter().map(|g| g.position[2]).fold(0.0, f64::min) - 2.0 * bed.d;
    let settings = Settings { skin: bed.discrete.skin * bed.d, lowest, ..Settings::new(dt, [0.0, 0.0, -bed.g], bed.d) };
    let mut engine = Engine::new(grains, pack::domain(bed), law, settings, threads())?;
    // A drag that lets grains fall at sqrt(g d): they land softly.
    let slow = Pushed { force: 0.0, above: f64::INFINITY, drag: mass * (bed.g / bed.d).sqrt() };
    let most = (bed.discrete.settle / dt).ceil() as u64;
    let rest = AT_REST * mass * bed.g * bed.d * bed.mobile as f64;
    while engine.steps() < most {
        for _ in 0..BETWEEN {
            engine.step(&slow)?;
        }
        // At the beginning the grains are at rest, too: then none touches.
        let found = engine.found();
        let held = 2 * (found.contacts + found.wall_contacts) > bed.mobile;
        if held && engine.grains().kinetic_energy() < rest {
            break;
        }
        let fraction = engine.steps() as f64 / most as f64;
        if watch.see(&Snapshot { stage: "falling", fraction, quantity: None }).is_break() {
            return Ok(ControlFlow::Break(()));
        }
    }
    Ok(ControlFlow::Continue(engine))
}

/// The bed as it is once its bottom lies: a slice takes the place of the plane on which it was deposited.
#[must_use]
pub(super) fn resting(bed: &GrainBed) -> GrainBed {
    GrainBed { bottom: if bed.bottom == Bottom::Slice { Bottom::Steps } else { bed.bottom }, ..*bed }
}

/// Lets the mobile grains of `bed` fall onto its bottom, or onto the grains `fixed`, until they rest.
pub(super) fn deposit(
    bed: &GrainBed,
    fixed: Option<Vec<Grain>>,
    watch: &mut dyn Watch,
) -> Result<ControlFlow<(), Engine<LinearSpring>>, SolveError> {
    let mut grains = fixed.unwrap_or_else(|| pack::bottom(bed));
    if bed.bottom == Bottom::Slice {
        // Six layers deposited on a plane; the slice is taken in their middle.
        let few = GrainBed { mobile: (6.0 * bed.size[0] * bed.size[1] / (bed.d * bed.d)).round() as usize, ..*bed };
        let ControlFlow::Continue(below) = settle(&few, &pack::cloud(&few, 0.0), watch)? else {
            return Ok(ControlFlow::Break(()));
        };
        grains = pack::slice(&below.grains().listed(), 2.5 * bed.d, bed.d);
    }
    // Above the highest of the fixed grains.
    let floor = match bed.bottom {
        Bottom::Plane => 0.0,
        Bottom::Steps => 0.5 * bed.d,
        Bottom::Slice => bed.d,
    };
    grains.extend(pack::cloud(bed, floor));
    settle(&resting(bed), &grains, watch)
}

impl<'a> Run<'a> {
    /// Deposits the bed and tilts it.
    fn begin(bed: &'a GrainBed, watch: &mut dyn Watch) -> Result<ControlFlow<(), Self>, SolveError> {
        let ControlFlow::Continue(mut engine) = deposit(bed, None, watch)? else {
            return Ok(ControlFlow::Break(()));
        };
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
        Ok(ControlFlow::Continue(Self { bed, engine, averages, means: Means::default(), steps, made: 0 }))
    }

    fn resumed(bed: &'a GrainBed, bytes: &[u8]) -> Result<Self, SolveError> {
        let read = || {
            let mut from = Reader::open(bytes, &name(bed))?;
            let law = law(&bed.contact).map_err(|_| super::checkpoint::CheckpointError::OtherCase)?;
            let domain = pack::domain(&resting(bed));
            let engine = Engine::restore(&mut from, domain, law, threads())?;
            let (steps, made) = (from.whole()?, from.whole()?);
            let corrupt = super::checkpoint::CheckpointError::Corrupt { what: "the number of slices" };
            let slices = usize::try_from(from.whole()?).ok().filter(|&n| n <= 1_000_000).ok_or(corrupt)?;
            let mut averages = Averages::empty(slices, BLOCKS as usize, [0.0; 4]);
            averages.fill(&mut from)?;
            let mut means = Means::default();
            means.fill(&mut from)?;
            from.close()?;
            Ok(Self { bed, engine, averages, means, steps, made })
        };
        read().map_err(|error: super::checkpoint::CheckpointError| SolveError::Grains {
            code: "checkpoint",
            message: format!("checkpoint.bin cannot be used: {error}"),
            hint: "--force starts again",
        })
    }

    fn checkpoint(&self) -> Vec<u8> {
        let mut to = Writer::default();
        self.engine.save(&mut to);
        to.whole(self.steps);
        to.whole(self.made);
        to.whole(self.averages.shape()[0] as u64);
        self.averages.save(&mut to);
        self.means.save(&mut to);
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
            if self.bed.discrete.frames > 0 && self.made.is_multiple_of(frame.max(1)) {
                let number = self.made / frame.max(1);
                let time = self.made as f64 * self.engine.settings().dt;
                let mut content = || picture::vtp(self.engine.grains(), time).into_bytes();
                let kept = watch.keep(&format!("grains_{number:05}.vtp"), true, &mut content);
                kept.map_err(|error| unwritable(&error))?;
            }
            if self.made.is_multiple_of(BETWEEN) || self.made == self.steps {
                let rate = (self.made - begun) as f64 / clock.elapsed().as_secs_f64().max(1e-9);
                let left = (self.steps - self.made) as f64 / rate;
                let stage = format!("flowing, {rate:.0} steps/s, {left:.0} s left,");
                let fraction = self.made as f64 / self.steps as f64;
                let quantity = self.means.velocity().map(|u| (&q::MEAN_VELOCITY, u));
                let stop = watch.see(&Snapshot { stage: &stage, fraction, quantity }).is_break();
                let kept = watch.keep("checkpoint.bin", stop, &mut || self.checkpoint());
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
        self.averages.sample(&self.engine, block);
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
