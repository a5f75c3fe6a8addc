//! A solved two-fluid flow in SI: numbers, balances, laws outside their range.

use serde_json::json;

use super::face::Mobilised;
use super::in_time;
use super::laws::Laws;
use super::levels::{Levels, NONE};
use super::newton::{Left, NotConverged};
use super::profile::profile;
use super::stability::Unknown;
use super::state::Unknowns;
use super::steady;
use super::system::{Column, Spacing};
use crate::closures::friction::INERTIAL_RANGE;
use crate::closures::kinetic::Moving;
use crate::closures::kinetic::garzo_dufty::RESTITUTION_RANGE;
use crate::models::exact::bed_results::closure_name;
use crate::models::exact::{balance, outcome};
use crate::models::premises::outside;
use crate::models::two_fluid::TwoFluidError;
use crate::models::two_fluid::{State, TwoFluid};
use crate::result::{Balance, Failure, NumericalError, Outcome, Results, Snapshot, Validity, Watch, quantity as q};
use crate::units::significant;

/// Scaled numbers from which on products of a few of them overflow.
const LARGEST: f64 = 1e60;

/// Solves the flow on `cells` cells.
///
/// # Errors
/// Why no flow was found.
pub fn run(flow: &TwoFluid, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    if flow.state == State::Transient {
        return in_time::run(flow, cells, watch);
    }
    // A bed that slides as a whole has no steady flow: the deeper it is, the more it carries.
    if flow.thickness_at_rest().is_none() {
        return Err(TwoFluidError::NothingAtRest {
            slope_deg: flow.beta.to_degrees(),
            steepest_deg: flow.steepest(f64::INFINITY).to_degrees(),
            here_deg: flow.steepest(flow.thickness).to_degrees(),
            friction: flow.friction_at_rest(),
        }
        .into());
    }
    let column = column(flow, cells)?;
    let mut stopped = watch.see(&Snapshot { stage: "column", fraction: 0.0, quantity: None }).is_break();
    let solved = if stopped {
        Err(NotConverged { residual: f64::INFINITY, iterations: 0, left: Left::Residual })
    } else {
        steady::solve(&column, flow.phi, flow.shields(), |fraction| {
            stopped |= watch.see(&Snapshot { stage: "steady flow", fraction, quantity: None }).is_break();
            stopped
        })
    };
    if stopped {
        return outcome(None, Vec::new(), Results::default(), Vec::new(), Vec::new());
    }
    let solved = solved.map_err(|failed| no_steady_flow(flow, failed))?;
    let mut outcome = report(flow, &column, (&solved.state, &solved.mobilised), solved.history)?;
    outcome.results.set(&q::NEWTON_ITERATIONS, solved.iterations as f64);
    let unit = flow.d / flow.velocity_scale();
    growth(&column, &solved.state, unit, &mut outcome.results);
    Ok(outcome)
}

/// Why there is no steady flow, as far as the method knows.
fn no_steady_flow(flow: &TwoFluid, NotConverged { residual, iterations, left }: NotConverged) -> TwoFluidError {
    let shields = flow.shields();
    let weak = shields < steady::WEAK[1];
    match left {
        Left::Residual => TwoFluidError::NoSteadyFlow { residual, iterations, shields, weak },
        Left::Force(force) => TwoFluidError::Unbalanced {
            stress_pa: force * flow.stress_scale(),
            allowed_pa: steady::BALANCED * flow.stress_scale(),
            iterations,
            shields,
        },
        Left::March(step) => {
            let fall = (flow.rho_p / flow.rho_f).sqrt() * flow.d / flow.velocity_scale();
            TwoFluidError::DoesNotSettle { step_s: step * fall, iterations, shields, weak }
        }
    }
}

/// Whether the flow is stable; `unit` is that of time \[s].
fn growth(column: &Column, state: &[Unknowns], unit: f64, results: &mut Results) {
    match column.converged_growth(state) {
        Ok((growth, difference)) => {
            results.set(&q::GROWTH_RATE, growth.rate / unit);
            results.set(&q::GROWTH_RATE_ERROR, difference / unit);
            results.set(&q::GROWTH_FREQUENCY, growth.frequency / unit);
        }
        Err(unknown) => {
            let cells = column.cells();
            let reason = match unknown {
                Unknown::NoEigenvalue => "no eigenvalue was found".to_owned(),
                Unknown::NoSecondGrid => format!("no steady flow was found on {} cells to compare with", cells / 2),
                Unknown::OfTheCells(rates) => {
                    let [fine, rough] = rates.map(|rate| significant(rate / unit, 3));
                    format!("not converged: {fine} on {cells} cells, {rough} on {}; take more grid.cells", cells / 2)
                }
            };
            results.undefined(&q::GROWTH_RATE, &reason);
        }
    }
}

/// The column of the flow, in units of its grains.
pub(super) fn column(flow: &TwoFluid, cells: usize) -> Result<Column, NumericalError> {
    let laws = Laws::scaled(flow);
    let height = (flow.thickness + flow.depth) / flow.d;
    let solids = flow.phi * flow.thickness / flow.d;
    let scaled = [height, solids, laws.nu, laws.ratio, laws.drive[0], laws.elastic.p_0, laws.floors.rate];
    // Not for a number that is none, either.
    let representable = scaled.into_iter().all(|x| x.abs() < LARGEST);
    if !representable {
        return Err(NumericalError::NotRepresentable { name: "the flow in units of its grains".into() });
    }
    let spacing = Spacing { height, level: flow.thickness / flow.d, fine: flow.fine.map(|fine| fine / flow.d) };
    Ok(Column { laws, widths: spacing.widths(cells), spacing, solids })
}

/// Everything that is reported of a state.
pub(super) fn report(
    flow: &TwoFluid,
    column: &Column,
    (state, mobilised): (&[Unknowns], &[Mobilised]),
    history: Vec<f64>,
) -> Result<Outcome, Failure> {
    let levels = Levels::new(column, state, mobilised);
    let mut results = Results::default();
    transport(flow, &levels, &mut results);
    fluid(flow, &levels, &mut results);
    fluctuations(flow, column, &levels, &mut results);
    let mut balances = balances(column, &levels);
    if let Some(last) = history.last() {
        balances.push(balance("solver", *last, "last residual, in units of the change of an unknown that removes it"));
    }
    let validity = validity(flow, column, &levels);
    let mut outcome = outcome(Some(profile(flow, &levels)?), history, results, balances, validity)?;
    outcome.regularisation.insert("granular_temperature_m2_s2".into(), json!(flow.temperature_floor));
    outcome.regularisation.insert("shear_rate_1_s".into(), json!(flow.rate_floor));
    outcome.regularisation.insert("phi".into(), json!(flow.phi_floor));
    Ok(outcome)
}

fn transport(flow: &TwoFluid, levels: &Levels, results: &mut Results) {
    let (d, velocity) = (flow.d, flow.velocity_scale());
    let flux = levels.flux();
    let rate = flux * velocity * d;
    results.set(&q::TRANSPORT_RATE, rate);
    results.set(&q::TRANSPORT_RATE_DIMENSIONLESS, flux);
    results.set(&q::TRANSPORT_RATE_MASS, rate * flow.rho_p);
    results.set(&q::TRANSPORT_RATE_BULK, rate / flow.phi);
    let ends = (levels.quantile(0.01), levels.quantile(0.99));
    match ends {
        (Some(low), Some(high)) => {
            results.set(&q::LAYER_THICKNESS, (high - low) * d);
            results.set(&q::LAYER_BOTTOM, low * d);
            results.set(&q::LAYER_TOP, high * d);
        }
        _ => {
            for quantity in [&q::LAYER_THICKNESS, &q::LAYER_BOTTOM, &q::LAYER_TOP] {
                results.undefined(quantity, "no grains are transported");
            }
        }
    }
}

fn fluid(flow: &TwoFluid, levels: &Levels, results: &mut Results) {
    let (d, velocity) = (flow.d, flow.velocity_scale());
    let turbulent = levels.cells.iter().map(|level| level.turbulent).fold(0.0, f64::max);
    results.set(&q::BED_LEVEL_REST, flow.thickness);
    results.set(&q::SHIELDS_BED, turbulent);
    results.set(&q::U_STAR_BED, turbulent.sqrt() * velocity);
    match levels.bed_level() {
        Some(z) => {
            results.set(&q::BED_LEVEL, z * d);
            results.set(&q::WATER_DEPTH, flow.thickness + flow.depth - z * d);
        }
        None => {
            for quantity in [&q::BED_LEVEL, &q::WATER_DEPTH] {
                results.undefined(quantity, "the solid fraction does not fall to half of its largest value");
            }
        }
    }
    results.set(&q::FLOW_HEIGHT, flow.thickness + flow.depth);
    results.set(&q::SLOPE_SINE, flow.beta.sin());
    results.set(&q::FLUID_DISCHARGE, levels.integral(|level| (1.0 - level.phi) * level.u) * velocity * d);
    if let Some(lowest) = levels.cells.first() {
        results.set(&q::SEEPAGE, lowest.u * velocity);
    }
    results.set(&q::SOLID_VOLUME, levels.integral(|level| level.phi) * d);
}

fn fluctuations(flow: &TwoFluid, column: &Column, levels: &Levels, results: &mut Results) {
    results.set(&q::STATIC_FRICTION, column.laws.mu_s);
    let Moving::Kinetic(law) = column.laws.moving else { return };
    let velocity = flow.velocity_scale();
    match levels.hottest() {
        Some((t, z)) => {
            results.set(&q::TEMPERATURE_MAX, t * velocity * velocity);
            results.set(&q::TEMPERATURE_MAX_SCALED, t);
            results.set(&q::TEMPERATURE_MAX_LEVEL, z * flow.d);
        }
        None => results.undefined(&q::TEMPERATURE_MAX, "there are no grains"),
    }
    results.set(&q::EFFECTIVE_RESTITUTION, law.e_eff);
    let unlimited = levels
        .cells
        .iter()
        .map(|level| level.phi)
        .filter(|phi| law.unlimited(*phi, column.laws.phi_max - phi))
        .fold(f64::INFINITY, f64::min);
    if unlimited.is_finite() {
        results.set(&q::UNLIMITED, unlimited);
    } else if law.saltation.is_some() {
        results.undefined(&q::UNLIMITED, "saltation limits the kinetic parts everywhere");
    }
}

fn balances(column: &Column, levels: &Levels) -> Vec<Balance> {
    let laws = &column.laws;
    let fluid = levels.integral(|level| 1.0 - level.phi) * laws.drive[0];
    let grains = levels.integral(|level| level.phi) * laws.drive[1] * laws.ratio;
    let drag = levels.integral(|level| level.drag);
    let whole = (fluid + grains).abs().max(f64::MIN_POSITIVE);
    let [below, under] = levels.bottom;
    let mut balances = vec![
        balance(
            "momentum",
            (below + under - fluid - grains) / whole,
            "stress on the bottom against the drive of both phases",
        ),
        balance(
            "momentum_fluid",
            (below + drag - fluid) / whole,
            "stress on the bottom and drag against the drive of the fluid, over that of both",
        ),
        balance(
            "momentum_grains",
            (under - drag - grains) / whole,
            "stress on the bottom against drag and drive of the grains, over that of both",
        ),
        balance("solids", levels.integral(|level| level.phi) / column.solids - 1.0, "grains against those at rest"),
    ];
    if let Moving::Kinetic(_) = laws.moving {
        let production = levels.integral(|level| level.production);
        let lost = levels.integral(|level| level.contacts + level.drag_work);
        let scale = production.max(lost.abs()).max(f64::MIN_POSITIVE);
        let how = "work of the stress of moving grains against what contacts and drag take";
        balances.push(balance("fluctuation_energy", (production - lost) / scale, how));
    }
    balances
}

/// Laws used outside their range.
fn validity(flow: &TwoFluid, column: &Column, levels: &Levels) -> Vec<Validity> {
    let mut found = Vec::new();
    for range in flow.granular.info().ranges {
        let value = if range.variable == INERTIAL_RANGE.variable {
            levels
                .cells
                .iter()
                .filter(|level| level.phi > NONE)
                .map(|level| level.shear.abs() * (column.laws.ratio / (level.pressure + level.elastic)).sqrt())
                .fold(0.0, f64::max)
        } else if range.variable == RESTITUTION_RANGE.variable {
            flow.e
        } else {
            continue;
        };
        found.extend(outside(closure_name(flow.granular.info()), range, value));
    }
    let densest = levels.cells.iter().map(|level| level.phi).fold(0.0, f64::max);
    for range in flow.mixing_length.info().ranges {
        found.extend(outside(closure_name(flow.mixing_length.info()), range, densest));
    }
    found
}
