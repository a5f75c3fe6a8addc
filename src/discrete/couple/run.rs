//! A coupled run: deposit the bed, start the fluid, follow both, sample.

use std::ops::ControlFlow;
use std::time::Instant;

use super::exchange::Exchange;
use super::hold::Hold;
use super::limits;
use super::outcome;
use super::record::{BLOCKS, Record};
use super::scene::{gravity, level, relief};
use crate::case::grain_tables::Bottom;
use crate::closures::fluctuation::Fluctuation;
use crate::column::ColumnError;
use crate::discrete::average::Averages;
use crate::discrete::bed::{keep_pictures, refused, threads, unwritable};
use crate::discrete::checkpoint::{CheckpointError, Reader, Saved, Writer};
use crate::discrete::deposit::{CHECKPOINT, Deposit, Stage, deposit};
use crate::discrete::engine::Engine;
use crate::discrete::film::Film;
use crate::discrete::impact::{contact_equations, law};
use crate::discrete::law::LinearSpring;
use crate::discrete::outcome::nothing;
use crate::discrete::{picture, stability};
use crate::problem::{Coupled, Surface};
use crate::result::{Failure, Outcome, Snapshot, SolveError, Status, Watch, quantity as q};
use crate::runtime::rng::Stream;
use crate::units::significant;

/// Stream of random numbers of the eddies.
const EDDIES: u64 = 4;

/// A flow that is followed.
pub(super) struct Run<'a> {
    pub flow: &'a Coupled,
    pub engine: Engine<LinearSpring>,
    pub exchange: Exchange,
    pub averages: Averages,
    pub record: Record,
    /// what is held of the deep bed
    pub hold: Option<Hold>,
    pub film: Film,
    /// steps of the grains in a period; periods in a sample and in the whole run, and those made
    pub steps: u64,
    pub sampled: u64,
    pub periods: u64,
    pub made: u64,
    /// steps until the eddies turn, and draws of them so far
    pub turn: u64,
    draws: u64,
    /// transport rate summed over the periods since the last sample
    rates: f64,
}

impl From<ColumnError> for SolveError {
    fn from(error: ColumnError) -> Self {
        Self::Grains {
            code: "fluid",
            message: format!("the fluid cannot go on: {error}"),
            hint: "a shorter discrete.coupling_period, or more grains in a cell (flow.length, flow.width, discrete.slice)",
        }
    }
}

/// Name of a case for its checkpoints.
fn name(flow: &Coupled) -> [u8; 32] {
    use sha2::{Digest, Sha256};
    Sha256::digest(format!("{flow:?}").as_bytes()).into()
}

/// Whether `bytes` are a checkpoint of `flow`, whole and sound as far as its frame.
///
/// # Errors
/// Why not.
pub fn accepts(flow: &Coupled, bytes: &[u8]) -> Result<(), CheckpointError> {
    Reader::open(bytes, &name(flow)).map(drop)
}

/// Lets the bed of `flow` fall, starts the fluid, follows both and averages.
///
/// # Errors
/// [`Failure`] with the grain or the cell that cannot go on, and the averages so far.
pub fn run(flow: &Coupled, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let half_way = match watch.resumed(CHECKPOINT) {
        Some(bytes) => Some(resume(flow, &bytes).map_err(refused)?),
        None => None,
    };
    let falling = match half_way {
        Some(HalfWay::Flowing(run)) => return go_on(*run, watch),
        Some(HalfWay::Falling(stage, engine)) => Some((stage, *engine)),
        None => None,
    };
    let fixed = (flow.bed.bottom == Bottom::Steps).then(|| relief(flow));
    let what = Deposit { bed: &flow.bed, fixed: fixed.as_deref(), name: &name(flow) };
    match deposit(what, falling, watch)? {
        ControlFlow::Continue(engine) => go_on(Run::begin(flow, engine)?, watch),
        ControlFlow::Break(()) => Ok(nothing(Status::Stopped)),
    }
}

/// A run that was interrupted.
pub(super) enum HalfWay<'a> {
    Falling(Stage, Box<Engine<LinearSpring>>),
    Flowing(Box<Run<'a>>),
}

pub(super) fn resume<'a>(flow: &'a Coupled, bytes: &[u8]) -> Result<HalfWay<'a>, CheckpointError> {
    let mut from = Reader::open(bytes, &name(flow))?;
    let stage = Stage::read(&mut from)?;
    let contact = law(&flow.bed.contact).map_err(|_| CheckpointError::OtherCase)?;
    let engine = Engine::restore(&mut from, stage.domain(&flow.bed), contact, threads())?;
    let half_way = match stage {
        Stage::Below | Stage::Falling => HalfWay::Falling(stage, Box::new(engine)),
        Stage::Flowing => HalfWay::Flowing(Box::new(Run::restore(flow, engine, &mut from)?)),
    };
    from.close()?;
    Ok(half_way)
}

fn go_on(mut run: Run<'_>, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let status = match run.follow(watch) {
        Ok(status) => status,
        Err(error) => {
            let last = outcome::outcome(&mut run, Status::Failed).ok().map(Box::new);
            return Err(Failure { error, last });
        }
    };
    let outcome = outcome::outcome(&mut run, status)?;
    keep_pictures(run.engine.grains(), &run.film, watch)?;
    Ok(outcome)
}

impl<'a> Run<'a> {
    /// Starts the fluid over a bed that has come to rest.
    pub(super) fn begin(flow: &'a Coupled, mut engine: Engine<LinearSpring>) -> Result<Self, SolveError> {
        let bed = &flow.bed;
        let contact = law(&bed.contact)?;
        let limit = stability::limit(&engine).step.min(stability::of_pair(&contact, 0.5 * bed.mass()));
        let top = match flow.surface {
            Surface::Height(height) => height,
            Surface::Depth(depth) => {
                let highest = (0..engine.grains().len()).map(|i| engine.grains().position(i)[2]).fold(0.0, f64::max);
                let mut dry = Exchange::new(flow, highest + bed.d, engine.grains().len())?;
                dry.look(&engine, 0.0);
                depth + level(dry.phi(), dry.cell_height(), bed.d)
            }
        };
        let mut exchange = Exchange::new(flow, top, engine.grains().len())?;
        exchange.begin(&engine)?;
        let limit = limit.min(exchange.drag_limit());
        let wanted = bed.discrete.time_step.unwrap_or(bed.discrete.safety * limit);
        let steps = (flow.coupling_period / wanted).ceil().max(1.0);
        engine.change(flow.coupling_period / steps, gravity(flow));
        limits::grains(flow, &engine, &exchange)?;
        engine.begin_ledger();
        let hold = Hold::new(flow, &engine);
        let cells = exchange.phi().len();
        let area = bed.size[0] * bed.size[1];
        let shape = [0.0, exchange.cell_height(), area * exchange.cell_height(), bed.rho_p];
        let sampled = (flow.sample_period / flow.coupling_period).round().max(1.0) as u64;
        let film = Film::new(bed, engine.grains(), flow.coupling_period);
        Ok(Self {
            flow,
            engine,
            exchange,
            film,
            averages: Averages::empty(cells, BLOCKS, shape),
            record: Record::new(cells),
            steps: steps as u64,
            sampled,
            periods: (bed.discrete.duration / flow.coupling_period).round().max(1.0) as u64,
            made: 0,
            hold,
            turn: 0,
            draws: 0,
            rates: 0.0,
        })
    }

    /// Follows grains and fluid to the end.
    pub(super) fn follow(&mut self, watch: &mut dyn Watch) -> Result<Status, SolveError> {
        let (clock, begun) = (Instant::now(), self.made);
        let frames = u64::from(self.flow.bed.discrete.frames);
        while self.made < self.periods {
            self.exchange.look(&self.engine, self.engine.settings().dt);
            // What grains were given in the last period is booked before they are held.
            if self.hold.as_mut().is_some_and(|hold| hold.look(self.made, &mut self.engine)) {
                self.exchange.look(&self.engine, self.engine.settings().dt);
            }
            self.rates += self.exchange.rate();
            limits::drag(self.flow, &self.engine, &self.exchange)?;
            for _ in 0..self.steps {
                if self.turn == 0 {
                    self.stir();
                }
                self.turn -= 1;
                self.engine.step(&self.exchange.felt)?;
            }
            self.exchange.advance(self.flow.coupling_period, self.flow.fluid_steps)?;
            limits::fluid(self.flow, &self.exchange)?;
            self.made += 1;
            let sample = self.made.is_multiple_of(self.sampled);
            if sample {
                self.sample();
            }
            if self.film.is_due(self.made) {
                self.film.see(self.engine.grains(), self.time());
            }
            if frames > 0 && self.made.is_multiple_of((self.periods / frames).max(1)) {
                let number = self.made / (self.periods / frames).max(1);
                let mut content = || picture::vtp(self.engine.grains(), self.time()).into_bytes();
                let kept = watch.keep(&format!("grains_{number:05}.vtp"), true, &mut content);
                kept.map_err(|error| unwritable(&error))?;
            }
            let rate = (self.made - begun) as f64 / clock.elapsed().as_secs_f64().max(1e-9);
            let left = (self.periods - self.made) as f64 / rate;
            let known = self.record.rows.last().map(|row| (&q::TRANSPORT_RATE, row[3]));
            let precision = match self.record.precision().filter(|error| sample && *error < 1.0) {
                Some(error) => format!(" ± {:.1} %", 100.0 * error),
                None => String::new(),
            };
            let stage = format!("{:.1} s of flow, {left:.0} s left{precision},", self.time());
            let fraction = self.made as f64 / self.periods as f64;
            let stop = watch.see(&Snapshot { stage: &stage, fraction, quantity: known }).is_break();
            let kept = watch.keep(CHECKPOINT, stop, &mut || self.checkpoint());
            kept.map_err(|error| unwritable(&error))?;
            if stop {
                return Ok(Status::Stopped);
            }
            let good = |wanted: f64| self.record.precision().is_some_and(|error| error <= wanted);
            if sample && self.flow.known_to.is_some_and(good) {
                break;
            }
        }
        self.exchange.look(&self.engine, self.engine.settings().dt);
        limits::grains(self.flow, &self.engine, &self.exchange)?;
        Ok(Status::Done)
    }

    /// Simulated time [s].
    pub(super) fn time(&self) -> f64 {
        self.made as f64 * self.flow.coupling_period
    }

    /// Level of the bed [m], depth of the water over it [m], and its mean velocity [m/s].
    pub(super) fn water(&self) -> [f64; 3] {
        let (phi, height) = (self.exchange.phi(), self.exchange.cell_height());
        let level = level(phi, height, self.flow.bed.d);
        let bed = ((level / height).round() as usize).min(phi.len() - 1);
        let cells = phi[bed..].iter().zip(&self.exchange.column.velocity()[bed..]);
        let discharge: f64 = cells.map(|(phi, u)| (1.0 - phi) * u * height).sum();
        let depth = (phi.len() - bed) as f64 * height;
        [level, depth, discharge / depth]
    }

    /// Draws the eddies that each grain meets anew.
    pub(super) fn stir(&mut self) {
        let Fluctuation::RandomWalk(walk) = self.flow.fluctuation else {
            self.turn = u64::MAX;
            return;
        };
        let [_, depth, speed] = self.water();
        let dt = self.engine.settings().dt;
        let time = if speed > 0.0 { depth / speed } else { f64::INFINITY };
        self.turn = (time / dt).round().clamp(1.0, 1e12) as u64;
        let (phi, reynolds) = (self.exchange.phi(), self.exchange.reynolds());
        let mut deviations: Vec<f64> =
            (0..phi.len()).map(|i| walk.deviation(reynolds[i], 1.0 - phi[i], self.flow.rho_f)).collect();
        deviations.push(0.0);
        let seed = u64::from(self.flow.bed.discrete.seed);
        let grains = self.engine.grains();
        for i in 0..grains.len() {
            let id = grains.ids[i];
            let sigma = deviations[self.exchange.felt.cell(grains.position(i)[2])];
            let mut stream = Stream::new([seed ^ (EDDIES << 32), self.draws, u64::from(id)]);
            self.exchange.felt.set_fluctuation(id, walk.draw(&mut stream, sigma));
        }
        self.draws += 1;
    }

    fn sample(&mut self) {
        let block = ((self.made - 1) as usize * BLOCKS / self.periods as usize).min(BLOCKS - 1);
        let largest = self.exchange.column.tau_reynolds().iter().copied().fold(0.0, f64::max);
        let [level, _, speed] = self.water();
        let rate = self.rates / self.sampled as f64;
        self.rates = 0.0;
        let kinetic = self.engine.grains().kinetic_energy();
        let row = [self.time(), block as f64, kinetic, rate, largest, level, speed];
        self.record.sample(row, &self.exchange);
        let (grains, felt) = (self.engine.grains(), &self.exchange.felt);
        let drag = |i: usize| felt.drag(grains.ids[i], grains.position(i)[2], grains.velocity(i)).force;
        self.averages.sample(&self.engine, block, drag);
    }

    pub(super) fn checkpoint(&self) -> Vec<u8> {
        let mut to = Writer::default();
        to.whole(Stage::Flowing.number());
        self.engine.save(&mut to);
        for count in [self.steps, self.sampled, self.periods, self.made, self.turn, self.draws] {
            to.whole(count);
        }
        to.number(self.rates);
        self.exchange.save(&mut to);
        self.averages.save(&mut to);
        self.record.write(&mut to);
        self.hold.iter().for_each(|hold| hold.save(&mut to));
        self.film.save(&mut to);
        to.seal(&name(self.flow))
    }

    /// Reads the rest of a checkpoint of the flow.
    fn restore(
        flow: &'a Coupled,
        engine: Engine<LinearSpring>,
        from: &mut Reader<'_>,
    ) -> Result<Self, CheckpointError> {
        let mut counts = [0; 6];
        for count in &mut counts {
            *count = from.whole()?;
        }
        let [steps, sampled, periods, made, turn, draws] = counts;
        let rates = from.number()?;
        let exchange = Exchange::restore(flow, engine.grains().len(), from)?;
        let cells = exchange.phi().len();
        let mut averages = Averages::empty(cells, BLOCKS, [0.0; 4]);
        averages.fill(from)?;
        let record = Record::read(from, cells)?;
        let hold = Hold::restore(flow, &engine, from)?;
        let film = Film::restore(from, engine.grains().len())?;
        Ok(Self {
            flow,
            engine,
            exchange,
            averages,
            record,
            hold,
            film,
            steps,
            sampled,
            periods,
            made,
            turn,
            draws,
            rates,
        })
    }
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &Coupled) -> String {
    let n = |x: f64| significant(x, 5);
    let bed = &flow.bed;
    let surface = match flow.surface {
        Surface::Height(height) => format!("{} m over the mean centre of the fixed grains", n(height)),
        Surface::Depth(depth) => format!("{} m over the bed at rest", n(depth)),
    };
    format!(
        "ε ρ_f du/dt = d(ε τ_f)/dz + dR/dz + ε ρ_f g sin α - n f - side walls, ρ_f = {} kg/m³, ν = {} m²/s, g sin α = {} m/s²; \
         no slip at z = 0, free surface {surface}.\nm dv/dt = Σ contacts + m g sin α e_x - (m - ρ_f V) g cos α e_z + f\n\
         f = (π d²/8) ρ_f ({} |w| + {} m/s) (1 - φ)^-{} w, w = u + u' - v\nR = ρ_f ε l² |du/dz| du/dz\n\
         fluid solved every {} s, {}\n\n{} mobile spheres, d = {} m, ρ_p = {} kg/m³; x periodic over {} m, y {} {} m.\n\n{}",
        n(flow.rho_f),
        n(flow.nu()),
        n(bed.g * bed.beta.sin()),
        n(flow.drag.constant),
        n(flow.drag.viscous(flow.nu(), bed.d)),
        n(flow.drag.exponent),
        n(flow.coupling_period),
        match flow.fluctuation {
            Fluctuation::None => "no eddies (u' = 0)",
            Fluctuation::RandomWalk(_) => "u' drawn anew for each grain every w_d/U",
        },
        bed.mobile,
        n(bed.d),
        n(bed.rho_p),
        n(bed.size[0]),
        if bed.side_walls { "between walls at a distance of" } else { "periodic over" },
        n(bed.size[1]),
        contact_equations(&bed.contact)
    )
}
