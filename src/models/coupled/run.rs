//! A coupled run: deposit the bed, start the fluid, follow both, sample.

use std::time::Instant;

use super::error::CoupledError::Fluid;
use super::exchange::Exchange;
use super::freeze::FrozenBed;
use super::limits;
use super::outcome;
use super::record::{BLOCKS, Record, Sample};
use super::start::{gravity, level, relief};
use crate::closures::fluctuation::Eddies;
use crate::dem::average::Averages;
use crate::dem::checkpoint::{Reader, Saved, Writer};
use crate::dem::drive::{self, Flow, GrainFlow, Progress};
use crate::dem::engine::Engine;
use crate::dem::grains::Grain;
use crate::dem::keep::law;
use crate::dem::law::LinearSpring;
use crate::dem::stability;
use crate::dem::{Bottom, GrainBed};
use crate::models::coupled::{Coupled, Surface};
use crate::result::CheckpointError;
use crate::result::{Context, Failure, Outcome, SolveError, Status, quantity as q};
use crate::runtime::rng::Stream;

/// Stream of random numbers of the eddies.
const EDDIES: u64 = 4;

/// A flow that is followed.
pub(super) struct Run<'a> {
    pub flow: &'a Coupled,
    pub engine: Engine<LinearSpring>,
    pub exchange: Exchange,
    pub averages: Averages,
    pub record: Record,
    /// the frozen part of the deep bed
    pub frozen: Option<FrozenBed>,
    /// steps of the grains in a period; periods in a sample and in the whole run, and those made
    pub steps: u64,
    pub sampled: u64,
    pub periods: u64,
    pub made: u64,
    /// steps until the fluctuations are drawn anew, and draws of them so far
    pub until_draw: u64,
    draws: u64,
    /// transport rate summed over the periods since the last sample
    rates: f64,
}

impl GrainFlow for Coupled {
    fn bed(&self) -> &GrainBed {
        &self.bed
    }

    fn fixed(&self) -> Option<Vec<Grain>> {
        (self.bed.bottom == Bottom::Steps).then(|| relief(self))
    }
}

/// Lets the bed of `flow` fall, starts the fluid, follows both and averages.
///
/// # Errors
/// [`Failure`] with the grain or the cell that cannot go on, and the averages so far.
pub fn run(flow: &Coupled, context: &mut Context<'_>) -> Result<Outcome, Failure> {
    drive::run::<Run<'_>>(flow, context)
}

impl<'a> Flow<'a> for Run<'a> {
    type Problem = Coupled;
    const BETWEEN: u64 = 1;

    /// Starts the fluid over a bed that has come to rest.
    fn begin(flow: &'a Coupled, mut engine: Engine<LinearSpring>) -> Result<Self, SolveError> {
        let bed = &flow.bed;
        let contact = law(&bed.contact)?;
        let limit = stability::limit(&engine).step.min(stability::of_pair(&contact, 0.5 * bed.mass()));
        let top = match flow.surface {
            Surface::Height(height) => height,
            Surface::Depth(depth) => {
                let highest = (0..engine.grains().len()).map(|i| engine.grains().position(i)[2]).fold(0.0, f64::max);
                let mut dry = Exchange::new(flow, highest + bed.d, engine.grains().len()).map_err(Fluid)?;
                dry.average(&engine, 0.0);
                depth + level(dry.phi(), dry.cell_height(), bed.d)
            }
        };
        let mut exchange = Exchange::new(flow, top, engine.grains().len()).map_err(Fluid)?;
        exchange.begin(&engine).map_err(Fluid)?;
        let limit = limit.min(exchange.drag_limit());
        let wanted = bed.discrete.time_step.unwrap_or(bed.discrete.safety * limit);
        let steps = (flow.coupling_period / wanted).ceil().max(1.0);
        engine.change(flow.coupling_period / steps, gravity(flow));
        limits::grains(flow, &engine, &exchange)?;
        engine.begin_ledger();
        let frozen = FrozenBed::new(flow, &engine);
        let cells = exchange.phi().len();
        let area = bed.size[0] * bed.size[1];
        let shape = [0.0, exchange.cell_height(), area * exchange.cell_height(), bed.rho_p];
        let sampled = (flow.sample_period / flow.coupling_period).round().max(1.0) as u64;
        Ok(Self {
            flow,
            engine,
            exchange,
            averages: Averages::empty(cells, BLOCKS, shape),
            record: Record::new(cells),
            steps: steps as u64,
            sampled,
            periods: (bed.discrete.duration / flow.coupling_period).round().max(1.0) as u64,
            made: 0,
            frozen,
            until_draw: 0,
            draws: 0,
            rates: 0.0,
        })
    }

    fn restore(
        flow: &'a Coupled,
        engine: Engine<LinearSpring>,
        from: &mut Reader<'_>,
    ) -> Result<Self, CheckpointError> {
        let mut counts = [0; 6];
        for count in &mut counts {
            *count = from.whole()?;
        }
        let [steps, sampled, periods, made, until_draw, draws] = counts;
        let rates = from.number()?;
        let exchange = Exchange::restore(flow, engine.grains().len(), from)?;
        let cells = exchange.phi().len();
        let mut averages = Averages::empty(cells, BLOCKS, [0.0; 4]);
        averages.fill(from)?;
        let record = Record::read(from, cells)?;
        let frozen = FrozenBed::restore(flow, &engine, from)?;
        Ok(Self {
            flow,
            engine,
            exchange,
            averages,
            record,
            frozen,
            steps,
            sampled,
            periods,
            made,
            until_draw,
            draws,
            rates,
        })
    }

    fn save(&self, to: &mut Writer) {
        for count in [self.steps, self.sampled, self.periods, self.made, self.until_draw, self.draws] {
            to.whole(count);
        }
        to.number(self.rates);
        self.exchange.save(to);
        self.averages.save(to);
        self.record.write(to);
        self.frozen.iter().for_each(|frozen| frozen.save(to));
    }

    fn problem(&self) -> &'a Coupled {
        self.flow
    }

    fn engine(&self) -> &Engine<LinearSpring> {
        &self.engine
    }

    fn advances(&self) -> (u64, u64) {
        (self.periods, self.made)
    }

    fn period(&self) -> f64 {
        self.flow.coupling_period
    }

    /// One coupling period.
    fn advance(&mut self) -> Result<(), SolveError> {
        self.exchange.average(&self.engine, self.engine.settings().dt);
        // What grains were given in the last period is booked before they are frozen.
        if self.frozen.as_mut().is_some_and(|frozen| frozen.check(self.made, &mut self.engine)) {
            self.exchange.average(&self.engine, self.engine.settings().dt);
        }
        self.rates += self.exchange.rate();
        limits::drag(self.flow, &self.engine, &self.exchange)?;
        for _ in 0..self.steps {
            if self.until_draw == 0 {
                self.resample_fluctuations();
            }
            self.until_draw -= 1;
            self.engine.step(&self.exchange.at_grains)?;
        }
        self.exchange.advance(self.flow.coupling_period, self.flow.fluid_steps).map_err(Fluid)?;
        limits::fluid(self.flow, &self.exchange)?;
        self.made += 1;
        if self.is_sampled() {
            self.sample();
            self.downhill(false)?;
        }
        Ok(())
    }

    fn progress(&self, made: u64, since: Instant) -> Progress {
        let rate = made as f64 / since.elapsed().as_secs_f64().max(1e-9);
        let left = (self.periods - self.made) as f64 / rate;
        let precision = match self.record.precision().filter(|error| self.is_sampled() && *error < 1.0) {
            Some(error) => format!(" ± {:.1} %", 100.0 * error),
            None => String::new(),
        };
        let stage = format!("{:.1} s of flow, {left:.0} s left{precision},", self.time());
        Progress { stage, quantity: self.record.samples.last().map(|last| (&q::TRANSPORT_RATE, last.transport_rate)) }
    }

    fn is_known(&self) -> bool {
        let good = |wanted: f64| self.record.precision().is_some_and(|error| error <= wanted);
        self.is_sampled() && self.flow.known_to.is_some_and(good)
    }

    fn end(&mut self) -> Result<(), SolveError> {
        self.exchange.average(&self.engine, self.engine.settings().dt);
        limits::grains(self.flow, &self.engine, &self.exchange)?;
        Ok(self.downhill(true)?)
    }

    fn advised(&self, error: SolveError) -> SolveError {
        self.hinted(error)
    }

    fn outcome(&mut self, status: Status) -> Result<Outcome, SolveError> {
        outcome::outcome(self, status)
    }
}

impl Run<'_> {
    /// Whether the last period ended a sample.
    fn is_sampled(&self) -> bool {
        self.made.is_multiple_of(self.sampled)
    }

    /// Simulated time \[s].
    pub(super) fn time(&self) -> f64 {
        self.made as f64 * self.flow.coupling_period
    }

    /// Level of the bed \[m], depth of the water over it \[m], and its mean velocity [m/s].
    pub(super) fn water(&self) -> [f64; 3] {
        let (phi, height) = (self.exchange.phi(), self.exchange.cell_height());
        let level = level(phi, height, self.flow.bed.d);
        let bed = ((level / height).round() as usize).min(phi.len() - 1);
        let cells = phi[bed..].iter().zip(&self.exchange.column.velocity()[bed..]);
        let discharge: f64 = cells.map(|(phi, u)| (1.0 - phi) * u * height).sum();
        let depth = (phi.len() - bed) as f64 * height;
        [level, depth, discharge / depth]
    }

    /// Draws anew the velocity fluctuation at each grain.
    pub(super) fn resample_fluctuations(&mut self) {
        let eddies = self.flow.fluctuation;
        if !eddies.are_drawn() {
            self.until_draw = u64::MAX;
            return;
        }
        let [_, depth, speed] = self.water();
        let dt = self.engine.settings().dt;
        let time = if speed > 0.0 { depth / speed } else { f64::INFINITY };
        self.until_draw = (time / dt).round().clamp(1.0, 1e12) as u64;
        let (phi, reynolds) = (self.exchange.phi(), self.exchange.reynolds());
        let mut deviations: Vec<f64> =
            (0..phi.len()).map(|i| eddies.deviation(reynolds[i], 1.0 - phi[i], self.flow.rho_f)).collect();
        deviations.push(0.0);
        let seed = u64::from(self.flow.bed.discrete.seed);
        let grains = self.engine.grains();
        for i in 0..grains.len() {
            let id = grains.ids[i];
            let sigma = deviations[self.exchange.at_grains.cell(grains.position(i)[2])];
            let mut stream = Stream::new([seed ^ (EDDIES << 32), self.draws, u64::from(id)]);
            self.exchange.at_grains.set_fluctuation(id, eddies.draw(&mut stream, sigma));
        }
        self.draws += 1;
    }

    fn sample(&mut self) {
        let block = ((self.made - 1) as usize * BLOCKS / self.periods as usize).min(BLOCKS - 1);
        let reynolds = self.exchange.column.tau_reynolds().iter().copied().fold(0.0, f64::max);
        let [level, _, velocity] = self.water();
        let transport_rate = self.rates / self.sampled as f64;
        self.rates = 0.0;
        let kinetic_energy = self.engine.grains().kinetic_energy();
        let sample = Sample { time: self.time(), block, kinetic_energy, transport_rate, reynolds, level, velocity };
        self.record.add(sample, &self.exchange);
        let (grains, at_grains) = (self.engine.grains(), &self.exchange.at_grains);
        let drag = |i: usize| at_grains.drag(grains.ids[i], grains.position(i)[2], grains.velocity(i)).force;
        self.averages.sample(&self.engine, block, drag);
    }
}
