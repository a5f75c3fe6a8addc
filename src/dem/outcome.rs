//! What a bed of grains reports: profile, means with their errors, the energy balance.

use super::average::{Averaged, Averages};
use super::certainty::{of_series, resolved};
use super::checkpoint::Saved;
use super::engine::Engine;
use super::law::LinearSpring;
use super::stability;
use crate::closures::contact::linear_spring::RIGID_RANGE;
use crate::dem::GrainBed;
use crate::result::CheckpointError;
use crate::result::{
    Balance, Estimate, Outcome, Profile, Quantity, Results, Series, SolveError, Status, Unknown, Validity,
    quantity as q,
};

/// Blocks of the scalar means.
const BLOCKS: usize = 10;
/// Most samples of the time series.
const MAX_SAMPLES: usize = 400;
/// Numbers of a sample.
const WIDTH: usize = 8;

/// Scalars of one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    /// time \[s]
    time: f64,
    /// kinetic energy \[J]
    kinetic_energy: f64,
    /// transport rate [m2/s]
    transport_rate: f64,
    /// mean velocity of the mobile grains along the flow [m/s]
    velocity: f64,
    /// contacts of a mobile grain
    coordination: f64,
    /// normal force of fixed grains and walls over the weight of the mobile grains
    support: f64,
    /// tangential over normal force of fixed grains and walls
    friction: f64,
    /// largest overlap over the sum of the radii
    overlap: f64,
}

impl Sample {
    fn numbers(&self) -> [f64; WIDTH] {
        let Self { time, kinetic_energy, transport_rate, velocity, coordination, support, friction, overlap } = *self;
        [time, kinetic_energy, transport_rate, velocity, coordination, support, friction, overlap]
    }

    fn of(numbers: [f64; WIDTH]) -> Self {
        let [time, kinetic_energy, transport_rate, velocity, coordination, support, friction, overlap] = numbers;
        Self { time, kinetic_energy, transport_rate, velocity, coordination, support, friction, overlap }
    }
}

/// Scalars over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Means {
    samples: Vec<Sample>,
    spare: Vec<[f64; WIDTH]>,
}

impl Saved for Means {
    fn numbers(&mut self) -> Vec<&mut f64> {
        // As many samples as there can be: what is not used is not a number.
        self.spare = self.samples.iter().map(Sample::numbers).collect();
        self.spare.resize(MAX_SAMPLES, [f64::NAN; WIDTH]);
        self.spare.iter_mut().flatten().collect()
    }

    fn fill(&mut self, from: &mut super::checkpoint::Reader<'_>) -> Result<(), CheckpointError> {
        if from.whole()? != (MAX_SAMPLES * WIDTH) as u64 {
            return Err(CheckpointError::Corrupt { what: "the means" });
        }
        self.samples.clear();
        for _ in 0..MAX_SAMPLES {
            let mut numbers = [0.0; WIDTH];
            for x in &mut numbers {
                *x = from.number()?;
            }
            if numbers[0].is_finite() {
                self.samples.push(Sample::of(numbers));
            }
        }
        Ok(())
    }
}

impl Means {
    /// Adds the present state.
    pub fn sample(&mut self, engine: &Engine<LinearSpring>, bed: &GrainBed) {
        if self.samples.len() == MAX_SAMPLES {
            return;
        }
        let grains = engine.grains();
        let [gx, _, gz] = engine.settings().gravity;
        let weight = bed.mobile as f64 * bed.mass();
        let volume = bed.mass() / bed.rho_p;
        let (mut rate, mut speed) = (0.0, 0.0);
        for i in (0..grains.len()).filter(|&i| !grains.is_fixed(i)) {
            rate += volume * grains.velocity(i)[0];
            speed += grains.velocity(i)[0];
        }
        let (mut touches, mut push, mut drag, mut overlap) = (0.0, 0.0, 0.0, 0.0_f64);
        for contact in engine.contacts() {
            overlap = overlap.max(contact.ratio);
            let mobile = |i: usize| !grains.is_fixed(i);
            let second = contact.second.is_some_and(mobile);
            touches += f64::from(u8::from(mobile(contact.first))) + f64::from(u8::from(second));
            // What fixed grains and walls do to the mobile ones.
            let sign = match (mobile(contact.first), second) {
                (true, false) => -1.0,
                (false, true) => 1.0,
                _ => continue,
            };
            push += sign * contact.force[2];
            drag -= sign * contact.force[0];
        }
        let area = bed.size[0] * bed.size[1];
        self.samples.push(Sample {
            time: engine.steps() as f64 * engine.settings().dt,
            kinetic_energy: grains.kinetic_energy(),
            transport_rate: rate / area,
            velocity: speed / bed.mobile as f64,
            coordination: touches / bed.mobile as f64,
            support: push / (weight * gz.abs()),
            friction: if gx == 0.0 && push == 0.0 { 0.0 } else { drag / push },
            overlap,
        });
    }

    /// Mean velocity so far [m/s].
    #[must_use]
    pub fn velocity(&self) -> Option<f64> {
        self.mean(|sample| sample.velocity).map(|estimate| estimate.mean)
    }

    fn values(&self, value: fn(&Sample) -> f64) -> Vec<f64> {
        self.samples.iter().map(value).collect()
    }

    /// Mean of `value` and its standard error by blocks.
    fn mean(&self, value: fn(&Sample) -> f64) -> Option<Estimate> {
        of_series(&self.values(value), &[BLOCKS])
    }

    /// Whether the samples of the velocity are enough for standard errors.
    fn resolved(&self) -> Result<(), Unknown> {
        resolved(&self.values(|sample| sample.velocity))
    }
}

/// An outcome without anything.
#[must_use]
pub fn nothing(status: Status) -> Outcome {
    Outcome { status, ..Outcome::stopped() }
}

/// Everything that a bed has to say.
///
/// # Errors
/// [`NumericalError::NotFinite`](crate::result::NumericalError::NotFinite) if a number of the profile is none.
pub fn outcome(
    bed: &GrainBed,
    engine: &Engine<LinearSpring>,
    averages: &Averages,
    means: &Means,
    status: Status,
) -> Result<Outcome, SolveError> {
    let mut averaged = averages.profile();
    if let Err(why) = means.resolved() {
        averaged = averaged.without_errors(why);
    }
    let mut results = Results::default();
    results.set(&q::GRAINS, bed.mobile as f64);
    let mut mean = |quantity, value: fn(&Sample) -> f64, scale: f64| match means.mean(value) {
        Some(estimate) => results.set_mean(quantity, estimate.times(scale)),
        None => results.undefined(quantity, "nothing was averaged yet"),
    };
    mean(&q::TRANSPORT_RATE, |sample| sample.transport_rate, 1.0);
    mean(&q::MEAN_VELOCITY, |sample| sample.velocity, 1.0);
    mean(&q::COORDINATION, |sample| sample.coordination, 1.0);
    mean(&q::WEIGHT_RATIO, |sample| sample.support, 1.0);
    mean(&q::FRICTION_WALLS, |sample| sample.friction, 1.0);
    let potential = bed.mobile as f64 * bed.mass() * bed.g * bed.d;
    mean(&q::KINETIC_LEFT, |sample| sample.kinetic_energy, 1.0 / potential);
    let deepest = means.samples.iter().map(|sample| sample.overlap).fold(0.0, f64::max);
    results.set(&q::OVERLAP, deepest);
    let level = bed_level(&averaged);
    match level {
        Some((level, bulk)) => {
            results.set(&q::BED_LEVEL, level);
            results.set(&q::PHI_BULK, bulk);
        }
        None => results.undefined(&q::BED_LEVEL, "nothing was averaged yet"),
    }
    if let Some((level, _)) = level {
        bulk(bed, &averaged, level, &mut results);
    }
    let dt = engine.settings().dt;
    results.set(&q::TIME_STEP, dt);
    let limit = stability::limit(engine).step;
    if limit.is_finite() {
        results.set(&q::TIME_STEP_RATIO, dt / limit);
    } else {
        results.undefined(&q::TIME_STEP_RATIO, "no contact sets a limit");
    }
    let mut validity = Vec::new();
    if !RIGID_RANGE.contains(deepest) {
        validity.push(Validity {
            closure: "contact/linear-spring".into(),
            variable: RIGID_RANGE.variable.into(),
            value: deepest,
            range: RIGID_RANGE.to_string(),
            z_m: None,
        });
    }
    let profile = profile(bed, &averaged)?;
    let mut series = None;
    if !means.samples.is_empty() {
        let column = |value: fn(&Sample) -> f64| means.values(value).into_iter().map(Some).collect::<Vec<_>>();
        let mut table = Series::new((0..means.samples.len()).map(|i| i as f64).collect())?;
        table.push(&q::TIME, column(|sample| sample.time))?;
        table.push(&q::KINETIC_ENERGY, column(|sample| sample.kinetic_energy))?;
        series = Some(table);
    }
    let kinetic = engine.grains().kinetic_energy();
    let (defect, scale) = (engine.ledger().defect(kinetic), engine.ledger().scale(kinetic));
    let balances = vec![
        Balance {
            name: "energy".into(),
            relative: if scale > 0.0 { defect / scale } else { 0.0 },
            how: "kinetic energy against the work of contacts and gravity, relative to the largest of them".into(),
        },
        Balance {
            name: "momentum".into(),
            relative: engine.ledger().momentum_defect(engine.grains().momentum()),
            how: "momentum of the grains against the impulses of gravity, bottom and walls, relative to the largest of them"
                .into(),
        },
    ];
    Ok(Outcome { results, balances, validity, profile, series, ..nothing(status) })
}

/// Where the solid fraction falls below half of that of the bed, from above, and that of the bed.
pub(crate) fn bed_level(averaged: &Averaged) -> Option<(f64, f64)> {
    let phi = |s: usize| averaged.phi[s].map_or(0.0, |phi| phi.mean);
    let slices = averaged.z.len();
    let bulk_up_to = |top: usize| {
        let (from, to) = (top / 4, (3 * top / 4).max(top / 4 + 1));
        (from..to).map(phi).sum::<f64>() / (to - from) as f64
    };
    let highest = (0..slices).rev().find(|&s| phi(s) > 0.3)?;
    let bulk = bulk_up_to(highest);
    let top = (0..slices).rev().find(|&s| phi(s) > 0.5 * bulk)?;
    Some((averaged.z[top], bulk))
}

/// What the middle of the bed tells: pressure against the weight above it, friction and inertial number.
fn bulk(bed: &GrainBed, averaged: &Averaged, level: f64, results: &mut Results) {
    let of = |means: &[Option<Estimate>], s: usize| means[s].map_or(0.0, |x| x.mean);
    let slices = averaged.z.len();
    let thickness = bed.discrete.slice * bed.d;
    let inside: Vec<usize> = (0..slices).filter(|&s| (0.25..0.75).contains(&(averaged.z[s] / level))).collect();
    let (Some(&low), Some(&high)) = (inside.first(), inside.last()) else { return };
    let mut above = vec![0.0; slices];
    for s in (0..slices - 1).rev() {
        let half = |s: usize| 0.5 * thickness * of(&averaged.phi, s);
        above[s] = above[s + 1] + bed.rho_p * bed.g * bed.beta.cos() * (half(s) + half(s + 1));
    }
    // The weight of a sphere is spread over its height, its contact forces are not: means over a diameter.
    let window = ((0.5 / bed.discrete.slice).round() as usize).max(1);
    let smooth = |s: usize, of: &dyn Fn(usize) -> f64| {
        let range = s.saturating_sub(window)..(s + window).min(slices);
        let count = range.len() as f64;
        range.map(of).sum::<f64>() / count
    };
    let off = |&s: &usize| smooth(s, &|s| of(&averaged.pressure, s) - above[s]).abs();
    results.set(
        &q::PRESSURE_ERROR,
        inside.iter().map(off).fold(0.0, f64::max) / above[low.min(window)].max(f64::MIN_POSITIVE),
    );
    let mean = |means: &[Option<Estimate>]| inside.iter().map(|&s| of(means, s)).sum::<f64>() / inside.len() as f64;
    let (pressure, shear) = (mean(&averaged.pressure), mean(&averaged.shear));
    if bed.beta == 0.0 || pressure <= 0.0 {
        results.undefined(&q::FRICTION_BULK, "the bed is level");
        return;
    }
    results.set(&q::FRICTION_BULK, shear / pressure);
    let rate = (of(&averaged.velocity, high) - of(&averaged.velocity, low)) / (averaged.z[high] - averaged.z[low]);
    results.set(&q::INERTIAL_NUMBER_BULK, bed.d * rate * (bed.rho_p / pressure).sqrt());
}

pub(crate) fn profile(bed: &GrainBed, averaged: &Averaged) -> Result<Option<Profile>, SolveError> {
    if averaged.z.is_empty() {
        return Ok(None);
    }
    let mut profile = Profile::new(averaged.z.clone())?;
    let value = |means: &[Option<Estimate>]| means.iter().map(|m| m.map(|x| x.mean)).collect::<Vec<_>>();
    let error = |means: &[Option<Estimate>]| means.iter().map(|m| m.and_then(|x| x.stderr.ok())).collect::<Vec<_>>();
    let mut push = |quantity: &'static Quantity, values| profile.push(quantity, values);
    push(&q::PHI, value(&averaged.phi))?;
    push(&q::U_PARTICLE, value(&averaged.velocity))?;
    let flux = |(phi, u): (&Option<Estimate>, &Option<Estimate>)| phi.map(|phi| phi.mean * u.map_or(0.0, |u| u.mean));
    push(&q::FLUX, averaged.phi.iter().zip(&averaged.velocity).map(flux).collect())?;
    push(&q::TAU_PARTICLE, value(&averaged.shear))?;
    push(&q::P_PARTICLE, value(&averaged.pressure))?;
    let (rates, numbers) = rates(bed, averaged);
    push(&q::SHEAR_RATE, rates)?;
    push(&q::INERTIAL_NUMBER, numbers)?;
    push(&q::GRANULAR_TEMPERATURE, value(&averaged.temperature))?;
    push(&q::PHI_STDERR, error(&averaged.phi))?;
    push(&q::U_PARTICLE_STDERR, error(&averaged.velocity))?;
    push(&q::TAU_PARTICLE_STDERR, error(&averaged.shear))?;
    push(&q::P_PARTICLE_STDERR, error(&averaged.pressure))?;
    push(&q::GRANULAR_TEMPERATURE_STDERR, error(&averaged.temperature))?;
    Ok(Some(profile))
}

/// Shear rate over one diameter, and the inertial number, where the slices on either side have grains.
fn rates(bed: &GrainBed, averaged: &Averaged) -> (Vec<Option<f64>>, Vec<Option<f64>>) {
    let half = ((0.5 / bed.discrete.slice).round() as usize).max(1);
    let rate = |s: usize| {
        let (below, above) = (s.checked_sub(half)?, s + half);
        let u = |s: usize| averaged.velocity.get(s).copied().flatten().map(|u| u.mean);
        let rate = (u(above)? - u(below)?) / (averaged.z[above] - averaged.z[below]);
        Some(rate.abs())
    };
    let number = |s: usize| {
        let pressure = averaged.pressure[s]?.mean;
        (pressure > 0.0).then(|| rate(s).map(|rate| bed.d * rate * (bed.rho_p / pressure).sqrt()))?
    };
    ((0..averaged.z.len()).map(rate).collect(), (0..averaged.z.len()).map(number).collect())
}
