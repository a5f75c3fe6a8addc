//! What waves carry: means over whole periods and half-cycles, the amplitude, and profiles at four phases of the last period. Of
//! waves that were recorded there is no period: the mean and the amplitude are those of the whole record.
//!
//! The clear fluid under `-dp/dx = G cos(2 pi t/T)` goes with `G T/(2 pi rho_f) sin(2 pi t/T)`: forward in the first half of a period, backward in the
//! second. The transported volume is summed by trapezia over the steps of the solver, and is straight between them.

use super::levels::{Levels, NONE};
use super::transient::March;
use crate::models::two_fluid::TwoFluid;
use crate::result::{Profile, Quantity, Results, TableError, quantity as q};

/// Solid fraction, velocity of the fluid, velocity of the grains of each cell.
type Column = Vec<[f64; 3]>;

/// A flow under waves, followed from step to step. In units of the grains.
#[derive(Clone, Debug)]
pub(super) struct Track {
    /// of waves that have one
    period: Option<f64>,
    /// whole periods of the flow
    whole: usize,
    /// time, volume transported until then, flux
    steps: Vec<[f64; 3]>,
    /// columns at the phases 0, 1/4, 1/2, 3/4 of the last whole period
    phases: Vec<Column>,
    before: Column,
}

/// What stands in place of the last instant.
const MEANS: [&Quantity; 5] = [
    &q::TRANSPORT_RATE,
    &q::TRANSPORT_RATE_DIMENSIONLESS,
    &q::TRANSPORT_RATE_MASS,
    &q::TRANSPORT_RATE_BULK,
    &q::RATE_AMPLITUDE,
];

fn columns(march: &March) -> Column {
    let levels = Levels::new(&march.column, &march.state, &march.mobilised);
    levels.cells.iter().map(|level| [level.phi, level.u, level.v]).collect()
}

impl Track {
    /// From the start of a flow that lasts until `end`.
    pub fn new(period: Option<f64>, end: f64, march: &March) -> Self {
        // A duration of whole periods may be short of the last by round-off.
        let whole = period.map_or(0, |period| (end / period * (1.0 + 1e-12)) as usize);
        let steps = vec![[march.time, 0.0, march.flux()]];
        Self { period, whole, steps, phases: Vec::new(), before: columns(march) }
    }

    /// The time of the next phase to be kept.
    fn next(&self) -> Option<f64> {
        let last = self.whole.checked_sub(1)? as f64;
        (self.phases.len() < 4).then_some((last + 0.25 * self.phases.len() as f64) * self.period?)
    }

    /// Takes the step that was made.
    pub fn step(&mut self, march: &March) {
        let [time, moved, flux] = self.steps[self.steps.len() - 1];
        let now = march.flux();
        self.steps.push([march.time, moved + 0.5 * (flux + now) * (march.time - time), now]);
        // Columns are only looked at near the phases.
        let near = self.period.unwrap_or_default() / 8.0;
        let Some(next) = self.next().filter(|next| march.time + near >= *next) else { return };
        let here = columns(march);
        if march.time >= next {
            let share = ((next - time) / (march.time - time)).clamp(0.0, 1.0);
            let between = |(a, b): (&[f64; 3], &[f64; 3])| std::array::from_fn(|k| a[k] + share * (b[k] - a[k]));
            self.phases.push(self.before.iter().zip(&here).map(between).collect());
        }
        self.before = here;
    }

    /// Volume that was transported until `time`.
    fn moved(&self, time: f64) -> f64 {
        let after = self.steps.partition_point(|step| step[0] < time).clamp(1, self.steps.len() - 1);
        let ([a, x, _], [b, y, _]) = (self.steps[after - 1], self.steps[after]);
        x + (y - x) * ((time - a) / (b - a)).clamp(0.0, 1.0)
    }

    /// Means and amplitude in place of the last instant: over the later half of the whole periods, with its half-cycles, or over the
    /// record.
    pub fn report(&self, flow: &TwoFluid, results: &mut Results) {
        let end = self.steps[self.steps.len() - 1][0];
        let whole = |period: f64| (end / period * (1.0 + 1e-12)) as usize;
        let half_cycles = [&q::RATE_FORWARD, &q::RATE_BACKWARD];
        let Some(period) = self.period else {
            self.over(0.0, end, flow, results);
            for quantity in half_cycles {
                results.undefined(quantity, "recorded waves have no half-cycles: series.csv has the rate over time");
            }
            return;
        };
        let reached = whole(period);
        if reached == 0 || self.steps.len() < 3 {
            for quantity in MEANS.into_iter().chain(half_cycles) {
                results.undefined(quantity, "the flow lasts less than a period of its waves");
            }
            return;
        }
        let periods = reached.div_ceil(2);
        let start = (reached - periods) as f64 * period;
        self.over(start, reached as f64 * period, flow, results);
        for (second, quantity) in [0.0, 1.0].into_iter().zip(half_cycles) {
            let one = |k: usize| start + (k as f64 + 0.5 * second) * period;
            let mean = (0..periods).map(|k| self.mean(one(k), one(k) + 0.5 * period)).sum::<f64>() / periods as f64;
            results.set(quantity, mean * flow.velocity_scale() * flow.d);
        }
    }

    /// Mean of the transport rate from one time to another.
    fn mean(&self, from: f64, to: f64) -> f64 {
        (self.moved(to) - self.moved(from)) / (to - from)
    }

    /// Mean and amplitude from one time to another.
    fn over(&self, from: f64, to: f64, flow: &TwoFluid, results: &mut Results) {
        let (unit, scale) = (flow.d / flow.velocity_scale(), flow.velocity_scale() * flow.d);
        if self.steps.len() < 3 {
            MEANS.iter().for_each(|quantity| results.undefined(quantity, "the flow was not followed"));
            return;
        }
        let mean = self.mean(from, to);
        let inside = self.steps.iter().filter(|step| step[0] >= from).map(|step| step[2]);
        let (low, high) = inside.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), flux| (a.min(flux), b.max(flux)));
        results.set(&q::TRANSPORT_RATE, mean * scale);
        results.set(&q::TRANSPORT_RATE_DIMENSIONLESS, mean);
        results.set(&q::TRANSPORT_RATE_MASS, mean * scale * flow.rho_p);
        results.set(&q::TRANSPORT_RATE_BULK, mean * scale / flow.phi);
        results.set(&q::RATE_AMPLITUDE, 0.5 * (high - low) * scale);
        results.set(&q::TRANSIENT, from * unit);
        results.set(&q::AVERAGED_TIME, (to - from) * unit);
    }

    /// The phases that were reached, beside the columns of the last instant.
    ///
    /// # Errors
    /// [`TableError`] if the profile has other cells.
    pub fn columns(&self, flow: &TwoFluid, profile: &mut Profile) -> Result<(), TableError> {
        let velocity = flow.velocity_scale();
        for (phase, names) in self.phases.iter().zip(&q::PHASES) {
            for (k, scale) in [1.0, velocity, velocity].into_iter().enumerate() {
                // Where there are no grains they have no velocity.
                let there = |cell: &&[f64; 3]| k < 2 || cell[0] > NONE;
                profile.push(
                    names[k],
                    phase.iter().map(|cell| Some(cell).filter(there).map(|cell| cell[k] * scale)).collect(),
                )?;
            }
        }
        Ok(())
    }
}
