//! A solved sheet flow in SI: numbers, balances, closures outside their range, and why there is no solution.

use serde_json::json;

use super::cold::Solved;
use super::column::{Floor, Setting};
use super::continuation::{Found, follow};
use super::flow::Flow;
use super::iteration::StepControl;
use super::layers::Layers;
use super::newton::{NotConverged, Reason};
use super::problem::PseudoTime;
use super::profile::profile;
use super::solve;
use crate::closures::dilatancy::phi_i;
use crate::closures::friction::{FrictionLaw, INERTIAL_RANGE};
use crate::closures::lid::Lid;
use crate::closures::settling;
use crate::closures::suspension::Settling;
use crate::closures::{Info, Range};
use crate::models::BedError;
use crate::models::exact::bed_results::closure_name;
use crate::models::exact::{balance, outcome};
use crate::models::premises::outside;
use crate::models::sheet_flow::SheetFlowError;
use crate::models::sheet_flow::{BedLevel, SheetFlow, SheetMethod};
use crate::result::{
    Balance, Failure, NumericalError, Outcome, Results, Snapshot, SolveError, Validity, Watch, quantity as q,
};

/// A given settling velocity over that of a sphere of this diameter and density: cylinders of Sumer et al. (1996) have 0.93.
const SETTLING: Range = Range { variable: "w_s over that of a sphere", min: 0.667, max: 1.5 };

/// Scaled numbers from which on products of a few of them overflow.
const LARGEST: f64 = 1e60;

/// Solves the flow on `cells` cells.
///
/// # Errors
/// Why there is no steady sheet flow over a bed at rest, or why the method did not find it.
pub fn run<F: FrictionLaw>(sheet: &SheetFlow<F>, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let (flow, setting) = (Flow::scaled(sheet), Setting::scaled(sheet));
    let scaled = [setting.height, setting.level, flow.delta, flow.nu, flow.lambda, flow.cut];
    let given = [setting.tau_b, setting.sine].into_iter().flatten();
    // Not for a number that is none, either.
    let representable = scaled.into_iter().chain(given).all(|x| x.abs() < LARGEST);
    if !representable {
        return Err(NumericalError::NotRepresentable { name: "the flow in units of its grains".into() }.into());
    }
    // Under a free surface, or where it is wanted, the stress on the bed is known beforehand.
    let known = setting.tau_b.is_some() || setting.lid == Lid::FreeSurface;
    let shields = stress(&flow, &setting);
    if known && sheet.all_rest(shields) {
        return sheet.without_layer(shields, None);
    }
    let mut stopped = watch.see(&Snapshot { stage: "column", fraction: 0.0, quantity: None }).is_break();
    let mut solved = match sheet.method {
        _ if stopped => Err(NotConverged::new(f64::INFINITY, 0)),
        SheetMethod::Newton => solve::solve(flow, setting, cells),
        SheetMethod::Iteration => {
            let PseudoTime { step, tolerance, max_iterations } = sheet.pseudo_time;
            let dt = step * sheet.velocity_scale() / sheet.d;
            let control = StepControl { dt, tolerance, max_iterations };
            solve::iterate(flow, setting, cells, &control, |iteration, _| {
                let fraction = iteration as f64 / max_iterations as f64;
                stopped = watch.see(&Snapshot { stage: "iteration", fraction, quantity: None }).is_break();
                stopped
            })
        }
    };
    if stopped {
        return outcome(None, Vec::new(), Results::default(), Vec::new(), Vec::new());
    }
    // Where the iteration ends in packed grains, stronger flows say whether there is more.
    if let Err(failed @ NotConverged { reason: Some(Reason::Jammed(_)), .. }) = &mut solved
        && let Found::NoLayer(least) = follow(flow, setting, cells, &mut Vec::new())
    {
        failed.reason = Some(Reason::NoLayer(least));
    }
    if let Err(NotConverged { reason: Some(Reason::NoLayer(least)), .. }) = solved {
        return sheet.without_layer(shields, Some(least * shields));
    }
    let solved = solved.map_err(|failed| unsolved(sheet, &flow, &setting, failed))?;
    if !sheet.deepen_cut && solved.change_of_type * sheet.d > sheet.cut {
        return Err(SheetFlowError::ChangeOfType { depth_m: solved.change_of_type * sheet.d, cut_m: sheet.cut }.into());
    }
    let layers = Layers::new(&solved.column, &solved.state);
    refuse(sheet, &solved, &layers)?;
    let results = results(sheet, &solved, &layers);
    let validity = validity(sheet, &layers);
    let profile = profile(sheet, &solved, &layers)?;
    let balances = balances(&solved, &layers);
    let mut outcome = outcome(Some(profile), solved.history.clone(), results, balances, validity)?;
    let lambda =
        if sheet.lambda > 0.0 { sheet.lambda } else { solved.column.flow.lambda * sheet.velocity_scale() / sheet.d };
    outcome.regularisation.insert("lambda_1_s".into(), json!(lambda));
    outcome.regularisation.insert("interface_cut_d".into(), json!(solved.column.flow.cut));
    Ok(outcome)
}

/// Stress on the interface: given, or of the fluid over it.
fn stress<F: FrictionLaw>(flow: &Flow<F>, setting: &Setting) -> f64 {
    let weight = || flow.fluid_weight(setting.sine.unwrap_or_default()) * (setting.height - setting.level);
    setting.tau_b.unwrap_or_else(weight)
}

/// Why the method found nothing: no bed at rest can exist, or it failed.
fn unsolved<F: FrictionLaw>(
    sheet: &SheetFlow<F>,
    flow: &Flow<F>,
    setting: &Setting,
    failed: NotConverged,
) -> SolveError {
    let tau_b = stress(flow, setting);
    let moves = |most| SheetFlowError::NothingAtRest { bed_m: sheet.level, shields: tau_b, most };
    // It alone needs this much weight of grains to be held.
    let held = tau_b < flow.friction.least() * flow.dilatancy.phi_max * setting.level;
    match failed.reason {
        Some(Reason::RunsAway(level)) => {
            return SheetFlowError::BedRunsAway { rest_m: sheet.level, reached_m: level * sheet.d }.into();
        }
        Some(Reason::AllMove(most)) => return moves(most).into(),
        Some(Reason::Jammed(carried)) => return SheetFlowError::Jammed { carried }.into(),
        Some(Reason::NoLayer(_)) | None => {}
    }
    if setting.tau_b.is_some() && !held {
        return moves(None).into();
    }
    // Grains at rest in a deep bed carry the slope of the whole mixture, at most mu_s P_p.
    let sine = setting.sine.or_else(|| {
        let free = setting.lid == Lid::FreeSurface;
        setting.tau_b.filter(|_| free).map(|tau_b| tau_b * flow.delta / (setting.height - setting.level))
    });
    if let Some(sine) = sine {
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let drive = sine * (1.0 / (flow.delta * flow.dilatancy.phi_max) + 1.0);
        if drive >= flow.friction.least() * cosine {
            return BedError::NoStaticBed { drive, limit: flow.friction.least() * cosine }.into();
        }
    }
    if !held {
        return moves(None).into();
    }
    SolveError::not_converged(failed.residual, failed.iterations)
}

/// Refuses a solution of the equations that is none of the flow.
fn refuse<F: FrictionLaw>(sheet: &SheetFlow<F>, solved: &Solved<F>, layers: &Layers) -> Result<(), SheetFlowError> {
    let (flow, state, d) = (&solved.column.flow, &solved.state, sheet.d);
    let bottom = solved.column.mesh.cells() - 1;
    if state.rest < 0.0 || (solved.column.floor == Floor::Bottom && state.r(bottom) >= flow.friction.least()) {
        return Err(SheetFlowError::NothingAtRest { bed_m: layers.z[0] * d, shields: state.tau_b, most: None });
    }
    if layers.lid < -1e-9 * state.tau_b {
        return Err(SheetFlowError::LidPushes { stress_pa: layers.lid * sheet.stress_scale() });
    }
    let whole = flow.dilatancy.phi_max * sheet.level;
    if sheet.bed_level == BedLevel::AtRest && layers.totals.volume * d >= whole {
        return Err(SheetFlowError::BedSuspended { suspended_m: layers.totals.volume * d, bed_m: whole });
    }
    Ok(())
}

fn results<F: FrictionLaw>(sheet: &SheetFlow<F>, solved: &Solved<F>, layers: &Layers) -> Results {
    let (flow, state) = (&solved.column.flow, &solved.state);
    let (d, velocity, stress) = (sheet.d, sheet.velocity_scale(), sheet.stress_scale());
    let rate = layers.psi() * velocity * d;
    let mut results = Results::default();
    results.set(&q::TRANSPORT_RATE, rate);
    results.set(&q::TRANSPORT_RATE_DIMENSIONLESS, layers.psi());
    results.set(&q::TRANSPORT_RATE_MASS, rate * sheet.rho_p);
    results.set(&q::TRANSPORT_RATE_BULK, rate / flow.dilatancy.phi_max);
    results.set(&q::TRANSPORT_RATE_BED, layers.flux * velocity * d);
    results.set(&q::TRANSPORT_RATE_SUSPENSION, layers.totals.flux * velocity * d);
    results.set(&q::TRANSPORT_SHARE_BED, layers.flux / layers.psi());
    let u_star = velocity * state.tau_b.sqrt();
    results.set(&q::SHIELDS_BED, state.tau_b);
    results.set(&q::U_STAR_BED, u_star);
    if solved.column.setting.lid != Lid::FreeSurface {
        results.set(&q::SHIELDS, state.tau_b);
        results.set(&q::U_STAR, u_star);
    }
    match sheet.suspension.settling_velocity() {
        Some(w_s) => results.set(&q::SUSPENSION_NUMBER, w_s / u_star),
        None => results.undefined(&q::SUSPENSION_NUMBER, "no suspension"),
    }
    sheet_results(sheet, solved, layers, &mut results);
    results.set(&q::ROUGHNESS, layers.inflow.length * d);
    results.set(&q::PHI_INTERFACE, layers.inflow.phi);
    results.set(&q::BED_LEVEL, layers.z[0] * d);
    results.set(&q::FLOW_HEIGHT, sheet.height);
    results.set(&q::SOLID_VOLUME_BED, (state.m + state.rest) * d);
    results.set(&q::SOLID_VOLUME_SUSPENSION, layers.totals.volume * d);
    results.set(&q::SLOPE_SINE, state.sine);
    results.set(&q::LID_STRESS, layers.lid * stress);
    let fastest = layers
        .levels
        .iter()
        .map(|level| (level.u, level.z))
        .fold((layers.inflow.u, 0.0), |a, b| if b.0 > a.0 { b } else { a });
    results.set(&q::U_MAX, fastest.0 * velocity);
    results.set(&q::U_MAX_LEVEL, (layers.z[0] + fastest.1) * d);
    results.set(&q::CHANGE_OF_TYPE, solved.change_of_type * d);
    if solved.column.flow.lambda > sheet.lambda * d / velocity {
        // The edge is where the exact yield ends.
        results.set(&q::SHIELDS_LEAST, solved.edge.unwrap_or(state.tau_b));
    }
    match solved.cut_effect(layers.psi()) {
        Some(effect) => results.set(&q::CUT_EFFECT, effect),
        None => results.undefined(&q::CUT_EFFECT, "with another cut no solution was found from this one"),
    }
    if let Some(exact) = &solved.exact {
        let exact = Layers::new(&solved.column.exact_yield(), exact).psi();
        results.set(&q::REGULARISATION_RATE, layers.psi() / exact - 1.0);
    }
    results
}

/// The numbers of the moving layer.
fn sheet_results<F: FrictionLaw>(sheet: &SheetFlow<F>, solved: &Solved<F>, layers: &Layers, results: &mut Results) {
    let (flow, state, d) = (&solved.column.flow, &solved.state, sheet.d);
    let all = [
        &q::SHEET_THICKNESS,
        &q::SHEET_THICKNESS_FULL,
        &q::SHEET_THICKNESS_FLAT,
        &q::SHEET_PHI,
        &q::YIELD_LEVEL,
        &q::STRESS_CROSSOVER,
        &q::VISCOUS_SHARE,
        &q::FREE_FALL_SHARE,
        &q::TURBULENT_SHARE,
    ];
    let Some(moving) = layers.sheet(flow) else {
        all.into_iter().for_each(|quantity| {
            results.undefined(quantity, "the regularisation loosens all of the bed by more than 0.1 %");
        });
        return;
    };
    let thickness = layers.z[0] - moving.bottom;
    let phi = moving.volume / thickness;
    if !(phi.is_finite() && phi > 0.0) {
        all.into_iter().for_each(|quantity| results.undefined(quantity, "the moving layer has no thickness"));
        return;
    }
    let cosine = (1.0 - state.sine * state.sine).sqrt();
    let resistance = flow.friction.least() * phi;
    results.set(&q::SHEET_THICKNESS, thickness * d);
    let net = resistance * cosine - (1.0 / flow.delta + phi) * state.sine;
    if net > 0.0 {
        results.set(&q::SHEET_THICKNESS_FULL, state.tau_b / net * d);
    } else {
        results.undefined(&q::SHEET_THICKNESS_FULL, "the slope is more than the friction of grains at rest holds");
    }
    results.set(&q::SHEET_THICKNESS_FLAT, state.tau_b / resistance * d);
    results.set(&q::SHEET_PHI, phi);
    results.set(&q::YIELD_LEVEL, moving.bottom * d);
    match moving.crossover {
        Some(z) => results.set(&q::STRESS_CROSSOVER, (z - moving.bottom) / thickness),
        None => results.undefined(&q::STRESS_CROSSOVER, "grains and fluid carry equal stresses nowhere"),
    }
    results.set(&q::VISCOUS_SHARE, moving.viscous_share);
    results.set(&q::FREE_FALL_SHARE, moving.free_fall);
    results.set(&q::TURBULENT_SHARE, moving.turbulent_fall);
}

fn balances<F: FrictionLaw>(solved: &Solved<F>, layers: &Layers) -> Vec<Balance> {
    let (column, state) = (&solved.column, &solved.state);
    let n = layers.cells.len();
    // Down to the middle of the lowest cell.
    let height = layers.z[0] - layers.middle(n - 1);
    let solid: f64 = layers.cells.iter().map(|cell| cell.phi * cell.dz).sum();
    let volume = solid - 0.5 * layers.cells[n - 1].dm;
    let weight = column.flow.fluid_weight(state.sine) * height + state.sine * volume;
    let carried = layers.s[n - 1] + layers.cells[n - 1].tau_p;
    let momentum = (carried - weight) / state.tau_b - 1.0;
    let whole = column.flow.dilatancy.phi_max * column.setting.level;
    let (sediment, how) = match column.setting.bed_level {
        BedLevel::AtRest => (
            (solid + layers.totals.volume) / whole - 1.0,
            "grains in the bed and in suspension against those of the bed at rest",
        ),
        BedLevel::InFlow => {
            (solid / (state.m + state.rest) - 1.0, "integral of the solid fraction of the bed against its grains")
        }
    };
    let mut balances = vec![
        balance("momentum", momentum, "stress at the bottom of the bed less its weight against that at the bed level"),
        balance("sediment", sediment, how),
    ];
    if column.setting.lid != Lid::Solved {
        let height = column.setting.height - layers.z[0];
        let flow = column.flow.fluid_weight(state.sine) * height - layers.lid;
        balances.push(balance(
            "momentum_above",
            flow / state.tau_b - 1.0,
            "drive of the flow less the lid against the bed",
        ));
    }
    if let Some(last) = solved.history.iter().copied().reduce(|_, last| last) {
        balances.push(balance("solver", last, "last residual of the method"));
    }
    balances
}

/// Closures used outside their range.
fn validity<F: FrictionLaw>(sheet: &SheetFlow<F>, layers: &Layers) -> Vec<Validity> {
    let at = |info: &Info, range: &Range, value: f64, z: f64| {
        outside(closure_name(info), range, value).map(|v| Validity { z_m: Some(z * sheet.d), ..v })
    };
    let phi = layers.inflow.phi;
    let top = layers.z[0];
    let largest = layers.cells.iter().map(|cell| cell.inertia).fold(0.0, f64::max);
    let mut found: Vec<Validity> = Vec::new();
    for range in F::INFO.ranges.iter().filter(|range| range.variable == INERTIAL_RANGE.variable) {
        found.extend(at(F::INFO, range, largest, top));
    }
    found.extend(at(&phi_i::INFO, &phi_i::RANGE, phi, top));
    for range in sheet.viscosity.info().ranges {
        found.extend(at(sheet.viscosity.info(), range, phi, top));
        found.extend(at(sheet.viscosity.info(), range, sheet.dilatancy.phi_max, 0.0));
    }
    for range in sheet.suspension.info().ranges {
        found.extend(at(sheet.suspension.info(), range, phi, top));
    }
    for range in sheet.lid.info().ranges {
        let Lid::ColebrookWhite(law) = sheet.lid else { continue };
        let reynolds =
            sheet.rho_f * law.diameter.heights() * layers.totals.discharge * sheet.velocity_scale() * sheet.d
                / sheet.eta;
        found.extend(at(sheet.lid.info(), range, reynolds, sheet.height / sheet.d));
    }
    if let Some(w_s) = sheet.suspension.settling_velocity() {
        let buoyant = (sheet.rho_p / sheet.rho_f - 1.0) * sheet.g;
        let sphere = settling::sphere(buoyant, sheet.eta / sheet.rho_f, sheet.d);
        found.extend(outside("grains/settling velocity".into(), &SETTLING, w_s / sphere));
    }
    found
}
