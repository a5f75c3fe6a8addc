//! A flow in time: its samples, its numbers, and where it ended.

use std::f64::consts::TAU;

use super::levels::Levels;
use super::outcome::{column, report};
use super::problem::TimeControl;
use super::transient::{March, Stuck};
use super::waves::Track;
use crate::case::tables::Moment;
use crate::models::exact::balance;
use crate::models::two_fluid::TwoFluid;
use crate::models::two_fluid::TwoFluidError;
use crate::result::{Failure, Outcome, Series, Snapshot, Status, TableError, Watch, quantity as q};

/// One sample.
#[derive(Clone, Copy, Debug)]
struct Sample {
    time: f64,
    /// mean of the transport rate since the sample before
    rate: f64,
    shields: f64,
    level: Option<f64>,
}

/// Fall of pressure [Pa/m] at `time` \[s], straight between the moments of a record.
fn recorded(moments: &[Moment], time: f64) -> f64 {
    let after = moments.partition_point(|moment| moment.time < time);
    match (after.checked_sub(1).map(|i| moments[i]), moments.get(after)) {
        (Some(a), Some(b)) => {
            let share = (time - a.time) / (b.time - a.time);
            a.pressure_gradient + share * (b.pressure_gradient - a.pressure_gradient)
        }
        (a, b) => a.or(b.copied()).map_or(0.0, |moment| moment.pressure_gradient),
    }
}

/// Follows the flow for its whole time on `cells` cells.
///
/// # Errors
/// [`TwoFluidError::StuckInTime`] with the flow until then.
pub(super) fn run(flow: &TwoFluid, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let column = column(flow, cells)?;
    let unit = flow.d / flow.velocity_scale();
    let TimeControl { duration, tolerance, samples: wanted } = flow.time;
    let end = duration / unit;
    let still = column.at_rest(flow.phi);
    let steady = column.laws.drive;
    // -dp/dx over (rho_p - rho_f) g, on the volume of fluid and, over the ratio of densities, on that of the grains.
    let waves = flow.oscillation.map(|waves| (waves.amplitude * flow.d / flow.stress_scale(), waves.period / unit));
    let ratio = column.laws.ratio;
    let drive = |time: f64| {
        let push = match waves {
            None if flow.recorded.is_empty() => return steady,
            None => recorded(&flow.recorded, time * unit) * flow.d / flow.stress_scale(),
            Some((amplitude, period)) => amplitude * (TAU * time / period).cos(),
        };
        [steady[0] + push, steady[1] + push / ratio]
    };
    let mut march = March::new(column, still);
    let period = waves.map(|(_, period)| period);
    let mut track = flow.waves().then(|| Track::new(period, end, &march));
    let mut samples: Vec<Sample> = Vec::with_capacity(wanted);
    let (mut status, mut stuck) = (Status::Done, None);
    'time: for k in 1..=wanted {
        let next = end * k as f64 / wanted as f64;
        let (start, mut moved) = (march.time, 0.0);
        while march.time < next {
            let (time, before) = (march.time, march.flux());
            if let Err(reason) = march.step(tolerance, next, drive) {
                stuck = Some(reason);
                break 'time;
            }
            moved += 0.5 * (before + march.flux()) * (march.time - time);
            track.iter_mut().for_each(|track| track.step(&march));
            let fraction = march.time / end;
            let rate = march.flux() * flow.velocity_scale() * flow.d;
            let snapshot = Snapshot { stage: "time", fraction, quantity: Some((&q::TRANSPORT_RATE, rate)) };
            if watch.see(&snapshot).is_break() {
                status = Status::Stopped;
                break 'time;
            }
        }
        let levels = Levels::new(&march.column, &march.state, &march.mobilised);
        samples.push(Sample {
            time: march.time,
            rate: moved / (march.time - start),
            shields: levels.cells.iter().map(|level| level.turbulent).fold(0.0, f64::max),
            level: levels.bed_level(),
        });
    }
    let outcome = finish(flow, &march, (&samples, track.as_ref()), status)?;
    match stuck {
        None => Ok(outcome),
        Some(Stuck { time, dt, residual, newton }) => {
            let error = TwoFluidError::StuckInTime { time_s: time * unit, step_s: dt * unit, residual, newton };
            Err(Failure { error: error.into(), last: Some(Box::new(outcome)) })
        }
    }
}

fn finish(
    flow: &TwoFluid,
    march: &March,
    (samples, track): (&[Sample], Option<&Track>),
    status: Status,
) -> Result<Outcome, Failure> {
    let velocity = flow.velocity_scale();
    let mut outcome = report(flow, &march.column, (&march.state, &march.mobilised), Vec::new())?;
    outcome.status = status;
    // The balances of a steady flow do not hold in time.
    outcome.balances =
        vec![balance("solids", march.drift, "largest deviation of the grains from those at rest, of all steps")];
    outcome.balances.extend(march.imbalance().map(|(name, relative, how)| balance(name, relative, how)));
    let results = &mut outcome.results;
    results.set(&q::SOLIDS_DRIFT, march.drift);
    results.set(&q::STEPS, march.steps as f64);
    results.set(&q::STEPS_REFUSED, march.refused as f64);
    results.set(&q::NEWTON_ITERATIONS, march.iterations as f64);
    if let Some(track) = track {
        track.report(flow, results);
        if let Some(profile) = &mut outcome.profile {
            track.columns(flow, profile)?;
        }
    }
    outcome.series = series(flow, samples)?;
    // Under waves the means are those of whole periods.
    if track.is_some() {
        return Ok(outcome);
    }
    let results = &mut outcome.results;
    let late: Vec<f64> = samples[samples.len() / 2..].iter().map(|sample| sample.rate).collect();
    if late.is_empty() {
        results.undefined(&q::RATE_MEAN, "the flow did not reach a sample");
        return Ok(outcome);
    }
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    results.set(&q::RATE_MEAN, mean * velocity * flow.d);
    results.set(&q::RATE_MEAN_SCALED, mean);
    let (low, high) = late.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
    if mean.abs() > f64::MIN_POSITIVE {
        results.set(&q::RATE_SWING, (high - low) / mean.abs());
    } else {
        results.undefined(&q::RATE_SWING, "nothing is transported");
    }
    Ok(outcome)
}

/// The samples as a table.
fn series(flow: &TwoFluid, samples: &[Sample]) -> Result<Option<Series>, TableError> {
    if samples.is_empty() {
        return Ok(None);
    }
    let (velocity, unit) = (flow.velocity_scale(), flow.d / flow.velocity_scale());
    let mut series = Series::new((0..samples.len()).map(|k| k as f64).collect())?;
    let column = |of: &dyn Fn(&Sample) -> Option<f64>| samples.iter().map(of).collect::<Vec<_>>();
    series.push(&q::TIME, column(&|sample| Some(sample.time * unit)))?;
    series.push(&q::RATE_IN_TIME, column(&|sample| Some(sample.rate * velocity * flow.d)))?;
    series.push(&q::SHIELDS_IN_TIME, column(&|sample| Some(sample.shields)))?;
    series.push(&q::LEVEL_IN_TIME, column(&|sample| sample.level.map(|z| z * flow.d)))?;
    Ok(Some(series))
}
