//! The flow in time, by the two-step backward differentiation formula with steps as long as the wanted accuracy allows.
//!
//! With `s = dt/dt_before`: `dX/dt = [(1 + 2s)/(1 + s) X - (1 + s) X_n + s^2/(1 + s) X_(n-1)]/dt`, order 2 and damping for any step
//! with s below 2.41 (Hairer, Norsett & Wanner 1993, section III.5). The first step is one of backward Euler. The error of a
//! step is 2/9 of what it misses the parabola through the three states before by. A step whose error is too large, or on which
//! Newton's method fails, is taken again, shorter.

use super::face::Mobilised;
use super::newton::{NotConverged, StepControl};
use super::state::{GRAINS, HEAT, LOGIT, RISE, Unknowns};
use super::system::{Column, Linear, Memory, carried};

/// Control of a step: the forces balance after it, and the iteration leaves less than this share of the error of the step.
const CONTROL: StepControl = StepControl { tolerance: 1e-4, force: 1e-8, max_iterations: 16 };
/// First step for an error of 1, and smallest step, in the time in which grains fall.
const FIRST_STEP: f64 = 3e-2;
const MIN_STEP: f64 = 1e-9;
/// Smallest and largest factor between two steps, and that after a failure of Newton's method.
const MIN_GROWTH: f64 = 0.2;
const MAX_GROWTH: f64 = 2.0;
const AFTER_FAILURE: f64 = 0.25;
/// A step aims at this share of the allowed error, and is kept up to this multiple of it.
const AIM: f64 = 0.7;
const KEPT: f64 = 1.5;
/// Error of a step over the distance to the extrapolation.
const ERROR: f64 = 2.0 / 9.0;
/// Farthest that a logarithm is extrapolated.
const FARTHEST: f64 = 0.5;

/// A flow in time.
#[derive(Clone, Debug)]
pub struct March {
    /// the column; its drive is that of the end of the last step
    pub column: Column,
    /// time
    pub time: f64,
    /// state
    pub state: Vec<Unknowns>,
    /// friction of enduring contacts that is mobilised at each face
    pub mobilised: Vec<Mobilised>,
    /// steps made, steps made in vain, Newton iterations
    pub steps: usize,
    /// see `steps`
    pub refused: usize,
    /// see `steps`
    pub iterations: usize,
    /// largest deviation of the solid volume from that at rest, relative to it
    pub drift: f64,
    /// next step
    pub dt: f64,
    /// the last two states before, latest first, and the steps that led from them
    before: Vec<(f64, Vec<Unknowns>)>,
    linear: Linear,
}

/// A step that became too small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck {
    /// time
    pub time: f64,
    /// step
    pub dt: f64,
    /// residual of Newton's method, or error of the step
    pub residual: f64,
    /// whether Newton's method failed; else the error of the step is too large
    pub newton: bool,
}

impl March {
    /// From `state` at time 0.
    #[must_use]
    pub fn new(column: Column, state: Vec<Unknowns>) -> Self {
        let (linear, dt) = (Linear::new(column.cells()), 0.0);
        let mobilised = linear.mobilised.clone();
        Self {
            column,
            time: 0.0,
            state,
            mobilised,
            steps: 0,
            refused: 0,
            iterations: 0,
            drift: 0.0,
            dt,
            before: Vec::new(),
            linear,
        }
    }

    /// One step with the relative error `tolerance`, not beyond the time `end`, under the `drive` of its end.
    ///
    /// # Errors
    /// [`Stuck`] if no step is short enough.
    pub fn step(&mut self, tolerance: f64, end: f64, drive: impl Fn(f64) -> [f64; 2]) -> Result<(), Stuck> {
        let control = StepControl { tolerance: (CONTROL.tolerance * tolerance).min(1e-7), ..CONTROL };
        loop {
            if self.before.is_empty() && self.refused == 0 {
                // Backward Euler: its error goes with the square of the step.
                self.dt = FIRST_STEP * tolerance.sqrt() * self.column.laws.fall();
            }
            let dt = self.dt.min(end - self.time);
            let last = dt >= end - self.time;
            self.column.laws.drive = drive(self.time + dt);
            let memory = self.memory(dt);
            let mut next = self.ahead(dt);
            let (residual, newton) = match self.column.newton(&mut next, &memory, &mut self.linear, control) {
                Ok((made, _)) => {
                    self.iterations += made;
                    let error = self.error(dt, &next);
                    let factor = (AIM * tolerance / error.max(f64::MIN_POSITIVE)).cbrt().clamp(MIN_GROWTH, MAX_GROWTH);
                    if error <= KEPT * tolerance {
                        self.keep(dt, next);
                        self.time = if last { end } else { self.time };
                        self.dt = if last { self.dt.max(dt * factor) } else { dt * factor };
                        return Ok(());
                    }
                    self.dt = dt * factor.min(0.8);
                    (error, false)
                }
                Err(NotConverged { residual, iterations, .. }) => {
                    self.iterations += iterations;
                    self.dt = dt * AFTER_FAILURE;
                    (residual, true)
                }
            };
            self.refused += 1;
            if self.dt < MIN_STEP * self.column.laws.fall() {
                return Err(Stuck { time: self.time, dt: self.dt, residual, newton });
            }
        }
    }

    fn keep(&mut self, dt: f64, next: Vec<Unknowns>) {
        let old = std::mem::replace(&mut self.state, next);
        self.mobilised.clone_from(&self.linear.mobilised);
        self.before.insert(0, (dt, old));
        self.before.truncate(3);
        self.time += dt;
        self.steps += 1;
        let volume: f64 = self.column.solid_volume(&self.state);
        self.drift = self.drift.max((volume / self.column.solids - 1.0).abs());
    }

    fn memory(&self, dt: f64) -> Memory {
        let laws = &self.column.laws;
        let s = self.before.first().map_or(0.0, |(before, _)| dt / before);
        let (new, now, old) = ((1.0 + 2.0 * s) / (1.0 + s), -(1.0 + s), s * s / (1.0 + s));
        let past = self.state.iter().enumerate().map(|(i, x)| {
            let mut past = carried(laws, x).map(|q| now * q / dt);
            if let Some((_, before)) = self.before.first() {
                let older = carried(laws, &before[i]);
                past.iter_mut().zip(older).for_each(|(past, q)| *past += old * q / dt);
            }
            past
        });
        Memory { rate: new / dt, past: past.collect() }
    }

    /// The state extrapolated along the line through the last two.
    fn ahead(&self, dt: f64) -> Vec<Unknowns> {
        let mut next = self.state.clone();
        let Some((before, old)) = self.before.first() else { return next };
        let s = dt / before;
        for (x, old) in next.iter_mut().zip(old) {
            for k in LOGIT..=HEAT {
                let change = s * (x[k] - old[k]);
                x[k] += if matches!(k, LOGIT | HEAT) { change.clamp(-FARTHEST, FARTHEST) } else { change };
            }
            x[RISE] += s * (x[RISE] - old[RISE]);
        }
        self.column.accumulate(&mut next);
        next
    }

    /// Error of the step to `next`, in solid fraction, momenta and fluctuation energy, over the largest of each.
    fn error(&self, dt: f64, next: &[Unknowns]) -> f64 {
        let [(h1, one), (h2, two)] = match self.before.as_slice() {
            [a, b, ..] => [a, b],
            // Nothing is known yet: the first steps are short.
            _ => return 0.0,
        };
        let laws = &self.column.laws;
        let of = |x: &Unknowns| {
            let [_, _, fluid, grains, heat] = carried(laws, x);
            [super::state::solid(laws, x), fluid, grains, heat]
        };
        // Newton's form of the parabola through three states.
        let (mut largest, mut missed) = ([0.0_f64; 4], [0.0_f64; 4]);
        for (((x, now), one), two) in next.iter().zip(&self.state).zip(one).zip(two) {
            let (x, now, one, two) = (of(x), of(now), of(one), of(two));
            for k in 0..4 {
                let (first, second) = ((now[k] - one[k]) / h1, (one[k] - two[k]) / h2);
                let bend = (first - second) / (h1 + h2);
                let ahead = now[k] + dt * (first + (dt + h1) * bend);
                missed[k] = missed[k].max((x[k] - ahead).abs());
                largest[k] = largest[k].max(x[k].abs());
            }
        }
        let slow = 1e-2 / laws.fall();
        let whole = [laws.phi_max, slow, slow, laws.floors.temperature.max(slow * slow)];
        let error = (0..4).map(|k| missed[k] / largest[k].max(whole[k])).fold(0.0, f64::max);
        ERROR * error
    }

    /// What the balances of momentum of the last step miss, over the drive.
    #[must_use]
    pub fn imbalance(&self) -> Option<(&'static str, f64, &'static str)> {
        let (dt, _) = self.before.first()?;
        let earlier = Self { state: self.before[0].1.clone(), before: self.before[1..].to_vec(), ..self.clone() };
        let memory = earlier.memory(*dt);
        let missed: f64 = self.column.missed(&self.state, &memory, &self.mobilised).iter().flatten().sum();
        let height: f64 = self.column.widths.iter().sum();
        let drive = height * self.column.laws.drive[0].abs()
            + self.column.solids * self.column.laws.ratio * self.column.laws.drive[1].abs();
        let scale = drive.max(self.column.solids * 1e-3);
        Some((
            "momentum",
            missed / scale,
            "gain of both phases in the last step against drive and stress on the bottom, over the drive",
        ))
    }

    /// Solid volume that passes per width and time.
    #[must_use]
    pub fn flux(&self) -> f64 {
        let cells = self.state.iter().zip(&self.column.widths);
        cells.map(|(x, dz)| super::state::solid(&self.column.laws, x) * x[GRAINS] * dz).sum()
    }
}
