//! What a coupled run reports: profiles with their errors, transport rate, Shields numbers, balances.

use super::Surface;
use super::freeze::FrozenBed;
use super::record::{FLUID, Sample};
use super::run::Run;
use super::theory;
use crate::closures::contact::linear_spring::RIGID_RANGE;
use crate::closures::drag::dallavalle_grain::RANGE as HINDRANCE_RANGE;
use crate::dem::average::Averaged;
use crate::dem::budget;
use crate::dem::outcome::{bed_level, nothing, profile};
use crate::dem::stability;
use crate::result::{Balance, Estimate, Outcome, Results, Series, SolveError, Status, Validity, quantity as q};

/// Everything that a coupled run has to say.
///
/// # Errors
/// [`NumericalError::NotFinite`](crate::result::NumericalError::NotFinite) if a number is none.
pub fn outcome(run: &mut Run<'_>, status: Status) -> Result<Outcome, SolveError> {
    let (flow, bed) = (run.flow, &run.flow.bed);
    let (first, over) = run.record.transient();
    let averages = run.averages.after(first);
    let mut averaged = averages.profile();
    let resolved = run.record.resolved(first);
    if let Err(why) = resolved {
        averaged = averaged.without_errors(why);
    }
    let blind = run.frozen.as_ref().and_then(FrozenBed::blind_below);
    if let Some(level) = blind {
        let below = averaged.z.iter().take_while(|z| **z < level).count();
        let columns = [&mut averaged.shear, &mut averaged.pressure, &mut averaged.flux, &mut averaged.contact_loss];
        columns.into_iter().for_each(|column| column.iter_mut().take(below).for_each(|mean| *mean = None));
    }
    let fluid = run.record.fluid(first);
    let mut results = Results::default();
    results.set(&q::GRAINS, bed.mobile as f64);
    results.set(&q::SOLID_VOLUME, bed.mobile as f64 * bed.mass() / (bed.rho_p * bed.size[0] * bed.size[1]));
    let stress = flow.stress_scale();
    let velocity = ((bed.rho_p / flow.rho_f - 1.0) * bed.g * bed.d).sqrt();
    let grain = std::f64::consts::PI / 6.0 * bed.d.powi(3);
    let rate = run.record.mean(|sample| sample.transport_rate, first);
    let level = run.record.mean(|sample| sample.level, first);
    let mut set = |quantity, estimate: Option<Estimate>, scale: f64| match estimate {
        Some(estimate) => results.set_mean(quantity, estimate.times(scale)),
        None => results.undefined(quantity, "nothing was sampled yet"),
    };
    set(&q::TRANSPORT_RATE, rate, 1.0);
    set(&q::TRANSPORT_RATE_DIMENSIONLESS, rate, 1.0 / (bed.d * velocity));
    set(&q::TRANSPORT_RATE_BEADS, rate, bed.size[1] / grain);
    set(&q::TRANSPORT_RATE_MASS, rate, bed.rho_p);
    set(&q::BED_LEVEL, level, 1.0);
    set(&q::BED_LEVEL_DRIFT, run.record.drift(|sample| sample.level, first), 1.0);
    let mean_velocity = run.record.mean(|sample| sample.velocity, first);
    set(&q::MEAN_VELOCITY, mean_velocity, 1.0);
    // The largest of the mean stress; its error is that of the cell where it is.
    let largest = fluid.iter().map(|cell| cell[1]).reduce(|a, b| if b.mean > a.mean { b } else { a });
    set(&q::SHIELDS_BED, largest, 1.0 / stress);
    let star = largest.filter(|stress| stress.mean > 0.0).map(|stress| {
        let u = (stress.mean / flow.rho_f).sqrt();
        Estimate { mean: u, stderr: stress.stderr.map(|error| 0.5 * u * error / stress.mean) }
    });
    set(&q::U_STAR_BED, star, 1.0);
    let height = run.exchange.cell_height() * fluid.len() as f64;
    let pull = flow.rho_f * bed.g * bed.beta.sin();
    let depth = level.map(|level| Estimate { mean: height - level.mean, ..level });
    set(&q::WATER_DEPTH, depth, 1.0);
    set(&q::SHIELDS_NOMINAL, depth, pull / stress);
    total_stress(run, &fluid, &averaged, [depth, mean_velocity], &mut results);
    results.set(&q::FLOW_HEIGHT, height);
    if let Surface::Depth(depth) = flow.surface {
        results.set(&q::BED_LEVEL_REST, height - depth);
    }
    results.set(&q::SLOPE_SINE, bed.beta.sin());
    if let Some((_, bulk)) = bed_level(&averaged) {
        results.set(&q::PHI_BULK, bulk);
    }
    let start = run.record.samples.iter().find(|sample| sample.block >= first).map_or(0.0, |sample| sample.time);
    results.set(&q::TRANSIENT, start);
    results.set(&q::AVERAGED_TIME, run.time() - start);
    results.set(&q::TIME_STEP, run.engine.settings().dt);
    let limit = stability::limit(&run.engine).step;
    if limit.is_finite() {
        results.set(&q::TIME_STEP_RATIO, run.engine.settings().dt / limit);
    }
    if let Some(frozen) = &run.frozen {
        results.set(&q::FROZEN_BELOW, frozen.level());
    }
    let drag = run.exchange.drag_limit();
    if drag.is_finite() {
        results.set(&q::DRAG_LIMIT, drag);
    }
    if let Some(limit) = run.exchange.fluid_limit().filter(|limit| limit.is_finite()) {
        results.set(&q::EXPLICIT_LIMIT, limit);
    }
    let mut table = None;
    if let Some(mut made) = profile(bed, &averaged)? {
        let column = |k: usize| fluid.iter().map(|cell| Some(cell[k].mean)).collect::<Vec<_>>();
        let errors = |k: usize| fluid.iter().map(|cell| cell[k].stderr.ok()).collect::<Vec<_>>();
        let mixture = |((cell, phi), u): ((&[Estimate; 5], &Option<Estimate>), &Option<Estimate>)| {
            let phi = phi.map_or(0.0, |phi| phi.mean);
            Some((1.0 - phi) * cell[0].mean + phi * u.map_or(0.0, |u| u.mean))
        };
        let mixtures = fluid.iter().zip(&averaged.phi).zip(&averaged.velocity).map(mixture).collect();
        made.push(&q::U_FLUID, column(0))?;
        made.push(&q::U_MIXTURE, mixtures)?;
        made.push(&q::TAU_REYNOLDS, column(1))?;
        made.push(&q::TAU_VISCOUS, column(2))?;
        made.push(&q::MIXING_LENGTH, column(3))?;
        made.push(&q::EDDY_VISCOSITY, column(4))?;
        for (value, error, means) in budget::columns(bed, &averages) {
            made.push(value, means.iter().map(|mean| mean.map(|x| x.mean)).collect())?;
            if let Some(error) = error {
                let errors = means.iter().map(|mean| mean.and_then(|x| x.stderr.ok()).filter(|_| resolved.is_ok()));
                made.push(error, errors.collect())?;
            }
        }
        made.push(&q::U_FLUID_STDERR, errors(0))?;
        made.push(&q::TAU_REYNOLDS_STDERR, errors(1))?;
        theory::push(flow, &mut made)?;
        table = Some(made);
    }
    let mut series = None;
    let samples = &run.record.samples;
    if !samples.is_empty() {
        let column = |value: fn(&Sample) -> f64| samples.iter().map(|sample| Some(value(sample))).collect();
        let shields = samples.iter().map(|sample| Some(1.0 / stress * sample.reynolds)).collect();
        let mut made = Series::new((0..samples.len()).map(|i| i as f64).collect())?;
        made.push(&q::TIME, column(|sample| sample.time))?;
        made.push(&q::KINETIC_ENERGY, column(|sample| sample.kinetic_energy))?;
        made.push(&q::RATE_IN_TIME, column(|sample| sample.transport_rate))?;
        made.push(&q::SHIELDS_IN_TIME, shields)?;
        made.push(&q::LEVEL_IN_TIME, column(|sample| sample.level))?;
        series = Some(made);
    }
    let densest = averaged.phi.iter().flatten().map(|phi| phi.mean).fold(0.0, f64::max);
    let deepest = run.engine.contacts().map(|contact| contact.ratio).fold(0.0, f64::max);
    let mut validity = Vec::new();
    let mut warn = |closure: &str, variable: &str, value: f64, range: String| {
        validity.push(Validity { closure: closure.into(), variable: variable.into(), value, range, z_m: None });
    };
    if !RIGID_RANGE.contains(deepest) {
        warn("contact/linear-spring", RIGID_RANGE.variable, deepest, RIGID_RANGE.to_string());
    }
    if !HINDRANCE_RANGE.contains(densest) {
        warn("drag/dallavalle-grain", HINDRANCE_RANGE.variable, densest, HINDRANCE_RANGE.to_string());
    }
    if let Some(level) = blind {
        warn(
            "contact/held",
            "elevation below which contacts were frozen [m]",
            level,
            "stresses above it alone".to_owned(),
        );
    }
    if !over {
        let range = "the transport rate settles in the first half".to_owned();
        warn("mean/transient", "time of the transient [s]", start, range);
    }
    let kinetic = run.engine.grains().kinetic_energy();
    let ledger = run.engine.ledger();
    let (defect, scale) = (ledger.defect(kinetic), ledger.scale(kinetic));
    let balance = |name: &str, relative: f64, how: &str| Balance { name: name.into(), relative, how: how.into() };
    let balances = vec![
        balance(
            "energy",
            if scale > 0.0 { defect / scale } else { 0.0 },
            "kinetic energy of the grains against the work of contacts, gravity and drag, relative to the largest of them",
        ),
        balance(
            "exchange",
            run.exchange.defect(),
            "impulse that the fluid lost to mobile grains, less what they got, less what is carried on, relative to it",
        ),
        balance(
            "fluid_momentum",
            run.exchange.worst,
            "of one step of the fluid, relative to its largest term; the worst of all",
        ),
    ];
    Ok(Outcome { results, balances, validity, profile: table, series, ..nothing(status) })
}

/// The stress on the bed where the scene alone does not fix it: what side walls leave of the drive, or the drive of the depth after the deposit.
/// Its error is that of the depth, and twice that of the velocity for the walls.
fn total_stress(
    run: &Run<'_>,
    fluid: &[[Estimate; FLUID]],
    averaged: &Averaged,
    [deposit, velocity]: [Option<Estimate>; 2],
    results: &mut Results,
) {
    let (flow, bed) = (run.flow, &run.flow.bed);
    let Some((deposit, velocity)) = deposit.zip(velocity) else { return };
    let depth = match flow.surface {
        Surface::Depth(_) if !bed.side_walls => return,
        Surface::Depth(depth) => Estimate { mean: depth, stderr: Ok(0.0) },
        Surface::Height(_) => deposit,
    };
    let (dz, width) = (run.exchange.cell_height(), bed.size[1]);
    let wall = |(cell, phi): (&[Estimate; FLUID], &Option<Estimate>)| {
        let open = 1.0 - phi.map_or(0.0, |phi| phi.mean);
        open * 2.0 / width * flow.side_wall.stress(cell[0].mean, width, flow.nu()).value * dz
    };
    let level = dz * fluid.len() as f64 - deposit.mean;
    let first = ((level / dz + 0.5).max(0.0) as usize).min(fluid.len());
    let above = fluid.iter().zip(&averaged.phi).skip(first).filter(|_| bed.side_walls);
    let taken: f64 = above.map(wall).sum();
    let walls =
        Estimate { mean: -taken, stderr: velocity.stderr.map(|error| 2.0 * taken * error / velocity.mean.abs()) };
    // Per density of the fluid, a velocity squared.
    let stress = depth.times(bed.g * bed.beta.sin()).plus(walls);
    results.set_mean(&q::SHIELDS, stress.times(flow.rho_f / flow.stress_scale()));
    let star = stress.mean.max(0.0).sqrt();
    let stderr = stress.stderr.map(|error| 0.5 * star * error / stress.mean.abs());
    results.set_mean(&q::U_STAR, Estimate { mean: star, stderr });
}
