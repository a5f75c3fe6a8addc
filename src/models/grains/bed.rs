//! A bed of spheres: let fall, brought to rest, tilted, followed, averaged.

use std::time::Instant;

use crate::dem::Bottom;
use crate::dem::GrainBed;
use crate::dem::average::Averages;
use crate::dem::body::Nothing;
use crate::dem::checkpoint::{Reader, Saved, Writer};
use crate::dem::deposit::{BETWEEN, progress_text};
use crate::dem::drive::{self, Flow, GrainFlow, Progress};
use crate::dem::engine::Engine;

use crate::dem::keep::{contact_equations, law};
use crate::dem::law::LinearSpring;
use crate::dem::outcome::{self, Means};
use crate::dem::stability;
use crate::result::CheckpointError;
use crate::result::{Context, Failure, Outcome, SolveError, Status, quantity as q};
use crate::units::significant;

/// Samples of the profile within the averaged time, and blocks for its standard errors.
const SAMPLES: u64 = 200;
const BLOCKS: u64 = 10;

/// A bed that is followed.
struct Tilted<'a> {
    bed: &'a GrainBed,
    engine: Engine<LinearSpring>,
    averages: Averages,
    means: Means,
    /// steps of the flow, all and made
    steps: u64,
    made: u64,
}

impl GrainFlow for GrainBed {
    fn bed(&self) -> &GrainBed {
        self
    }
}

/// Lets `bed` fall, follows it and averages.
///
/// # Errors
/// [`Failure`] with the grain that cannot go on, and the averages so far.
pub fn run(bed: &GrainBed, context: &mut Context<'_>) -> Result<Outcome, Failure> {
    drive::run::<Tilted<'_>>(bed, context)
}

impl<'a> Flow<'a> for Tilted<'a> {
    type Problem = GrainBed;
    const BETWEEN: u64 = BETWEEN;

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
        Ok(Self { bed, engine, averages, means: Means::default(), steps, made: 0 })
    }

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
        Ok(Self { bed, engine, averages, means, steps, made })
    }

    fn save(&self, to: &mut Writer) {
        to.whole(self.steps);
        to.whole(self.made);
        to.whole(self.averages.shape()[0] as u64);
        self.averages.save(to);
        self.means.save(to);
    }

    fn problem(&self) -> &'a GrainBed {
        self.bed
    }

    fn engine(&self) -> &Engine<LinearSpring> {
        &self.engine
    }

    fn advances(&self) -> (u64, u64) {
        (self.steps, self.made)
    }

    fn period(&self) -> f64 {
        self.engine.settings().dt
    }

    fn first(&mut self) {
        self.sample(0);
    }

    /// One step; the last share of them is sampled.
    fn advance(&mut self) -> Result<(), SolveError> {
        let averaged = ((self.steps as f64 * self.bed.discrete.averaged) as u64).max(1).min(self.steps);
        let start = self.steps - averaged;
        let every = (averaged / SAMPLES).max(1);
        self.engine.step(&Nothing)?;
        self.made += 1;
        if self.made > start && (self.made - start).is_multiple_of(every) {
            self.sample(((self.made - start - 1) * BLOCKS / averaged) as usize);
        }
        Ok(())
    }

    fn progress(&self, made: u64, since: Instant) -> Progress {
        let stage = progress_text("flowing", made, since, self.steps - self.made);
        Progress { stage, quantity: self.means.velocity().map(|u| (&q::MEAN_VELOCITY, u)) }
    }

    fn end(&mut self) -> Result<(), SolveError> {
        if !self.bed.discrete.force_time_step {
            self.engine.check_step()?;
        }
        Ok(())
    }

    fn outcome(&mut self, status: Status) -> Result<Outcome, SolveError> {
        outcome::outcome(self.bed, &self.engine, &self.averages, &self.means, status)
    }
}

impl Tilted<'_> {
    fn sample(&mut self, block: usize) {
        self.averages.sample(&self.engine, block, |_| [0.0; 3]);
        self.means.sample(&self.engine, self.bed);
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
