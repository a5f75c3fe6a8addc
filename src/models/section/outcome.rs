//! A solved duct in SI: numbers, profile on the symmetry plane, fields, balances, and what the regularisation changed.

use std::ops::ControlFlow;

use serde_json::{Map, json};

use super::duct::{Duct, Filling};
use super::full::Full;
use super::newton::{self, Unsolved};
use super::numbers::Numbers;
use super::solve::Solution;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::closures::regularisation::Regularisation;
use crate::models::exact::bed_results::transport;
use crate::models::premises::outside;
use crate::models::section::SectionError;
use crate::models::section::{Contents, DuctFlow, Method, Outline};
use crate::result::{
    Balance, Failure, Outcome, Profile, Results, Series, Snapshot, SolveError, Status, TableError, Validity, Watch,
    quantity as q, quantity::Quantity,
};
use crate::result::{Field, NumericalError};
use crate::units::significant;

impl Unsolved {
    /// The reason in SI; `shear` is the unit of the shear rate [1/s].
    #[must_use]
    pub fn into_error(self, method: Method, shear: f64) -> SolveError {
        match self {
            Self::NotConverged { change, iterations, lambda } if change.is_finite() => SectionError::NotConverged {
                method: if method == Method::Newton { "newton" } else { "first-order" },
                change,
                iterations,
                lambda_1_s: lambda * shear,
            }
            .into(),
            Self::NotConverged { .. } => NumericalError::NotRepresentable { name: "the velocity".into() }.into(),
            Self::Stopped | Self::Matrix(_) => NumericalError::NotRepresentable { name: "the matrix".into() }.into(),
        }
    }
}

impl Duct {
    /// The duct in the units of the model.
    #[must_use]
    pub fn scaled(flow: &DuctFlow) -> Self {
        let filling = match &flow.contents {
            Contents::Bingham { tau_0, .. } => Filling::Bingham(tau_0 / flow.stress_scale()),
            Contents::Bed(bed) => Filling::Bed {
                level: bed.h_p / bed.h,
                e: bed.viscosity.relative(bed.phi),
                resistance: bed.friction.mu_s * bed.phi,
                k: bed.drag.map(|law| law.permeability(bed.phi, bed.d / bed.h)),
            },
        };
        Self { shape: flow.outline, filling, f: flow.gradient * flow.h / flow.stress_scale() }
    }
}

/// Solves the duct on `cells` elements from the bottom to the top.
///
/// # Errors
/// [`SectionError::NotConverged`] if the method does not get there, [`NumericalError::NotRepresentable`] if numbers leave their range.
pub fn run(flow: &DuctFlow, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let duct = Duct::scaled(flow);
    let law = &flow.regularisation;
    let mut iterations = 0_usize;
    let mut see = |unknowns: usize, change: f64| -> ControlFlow<()> {
        iterations += 1;
        let stage = format!("iteration {iterations}, {unknowns} unknowns, change {change:.1e}");
        let fraction = 1.0 - 1.0 / (1.0 + 0.05 * iterations as f64);
        watch.see(&Snapshot { stage: &stage, fraction, quantity: None })
    };
    let mut solution = match duct.solve(cells, law, &flow.solver, &mut see) {
        Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
        solution => solution.map_err(|unsolved| failed(unsolved, flow))?,
    };
    let mut beside = Vec::new();
    if let Some(along) = flow.along {
        match draw_out(flow, along, &mut solution, &mut beside, &mut see) {
            Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
            done => done.map_err(|unsolved| failed(unsolved, flow))?,
        }
    }
    let numbers = Numbers::of(&solution);
    let mut results = results(flow, &solution, &numbers);
    beside.into_iter().for_each(|(quantity, value)| results.set(quantity, value));
    if !law.is_exact() && flow.along.is_none() {
        let mut see = |change: f64| see(solution.solved.x.len(), change);
        match newton::solve(&solution.divided.program, &Regularisation::EXACT, &mut see) {
            Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
            Err(unsolved) => return Err(failed(unsolved, flow).into()),
            Ok(exact) => changed(&solution, &exact.x, &numbers, &mut results),
        }
    }
    let plane = (flow.outline != Outline::Planes).then(|| plane(&duct, cells, flow)).flatten();
    let profile = profile(flow, &solution, plane)?;
    let field = field(flow, &solution, &numbers);
    let solved = &solution.solved;
    let series = history(&solved.history)?;
    let balance = |name: &str, relative: f64, how: &str| Balance { name: name.into(), relative, how: how.into() };
    let balances = vec![
        balance("power", numbers.power, "dissipation against the work of the drive"),
        balance("momentum", solved.imbalance, "sum of the forces that are left on the nodes over that of the drive"),
    ];
    let mut regularisation = Map::new();
    regularisation.insert("law".into(), serde_json::to_value(law.law).unwrap_or_default());
    let lambda = if law.is_exact() { solved.lambda } else { law.lambda };
    regularisation.insert("lambda_1_s".into(), json!(lambda * flow.shear_scale()));
    regularisation.insert("lambda_scaled".into(), json!(lambda));
    Ok(Outcome {
        status: Status::Done,
        profile: Some(profile),
        series,
        results,
        balances,
        validity: validity(flow),
        regularisation,
        field: Some(field),
        ..Outcome::stopped()
    })
}

/// The change of each iteration; a Newtonian flow needs none.
pub(super) fn history(changes: &[f64]) -> Result<Option<Series>, TableError> {
    if changes.is_empty() {
        return Ok(None);
    }
    let mut series = Series::new((1..=changes.len()).map(|i| i as f64).collect())?;
    series.push(&q::RESIDUAL, changes.iter().map(|r| Some(*r)).collect())?;
    Ok(Some(series))
}

fn failed(unsolved: Unsolved, flow: &DuctFlow) -> SolveError {
    unsolved.into_error(flow.solver.method, flow.shear_scale())
}

fn of_the_stop(share: f64) -> String {
    format!("its yield stress is {} of that which stops it", significant(share, 5))
}

fn results(flow: &DuctFlow, solution: &Solution, numbers: &Numbers) -> Results {
    let (h, shear) = (flow.h, flow.shear_scale());
    let area = flow.outline.area() * h * h;
    let rate = numbers.flow_rate * shear * h.powi(3);
    let mut results = Results::default();
    let share = solution.divided.duct.yield_over_critical();
    let moving = [
        (&q::REYNOLDS_GAP, reynolds_gap(flow, numbers)),
        (&q::FLOW_RATE, rate),
        (&q::FLOW_RATE_DIMENSIONLESS, numbers.flow_rate),
        (&q::U_MAX, numbers.u_max.value * shear * h),
        (&q::U_MAX_DIMENSIONLESS, numbers.u_max.value),
        (&q::U_MAX_LEVEL, numbers.u_max.level * h),
        (&q::MEAN_VELOCITY, rate / area),
        (&q::DEAD_SHARE, numbers.dead / flow.outline.area()),
        (&q::PLUG_SHARE, numbers.plug / flow.outline.area()),
    ];
    let bingham = share.is_some();
    for (quantity, value) in moving.into_iter().filter(|(quantity, _)| bingham || quantity.name != q::PLUG_SHARE.name) {
        match share.filter(|share| rate == 0.0 && *share < 1.0) {
            // What should flow, but in a layer that no element fits into.
            Some(share) => results.undefined(quantity, &format!("{}; take more grid.cells", of_the_stop(share))),
            None => results.set(quantity, value),
        }
    }
    results.set(&q::FLOW_HEIGHT, h);
    results.set(&q::SECTION_AREA, area);
    results.set(&q::DRIVE, flow.gradient);
    let rho = match &flow.contents {
        Contents::Bingham { rho, eta, tau_0 } => {
            let share = share.unwrap_or_default();
            results.set(&q::YIELD_OVER_CRITICAL, share);
            if rate > 0.0 {
                results.set(&q::BINGHAM, tau_0 * h * area / (eta * rate));
            } else {
                results.undefined(&q::BINGHAM, &format!("the fluid stands still: {}", of_the_stop(share)));
            }
            *rho
        }
        Contents::Bed(bed) => {
            let flux = bed.phi * numbers.grains * shear * h.powi(3);
            results.set(&q::BED_FLUX, flux);
            results.set(&q::BED_FLUX_DIMENSIONLESS, bed.phi * numbers.grains);
            results.set(&q::BED_FLUX_MASS, flux * bed.rho_p);
            if flow.outline == Outline::Planes {
                // The strip is as wide as high.
                transport(&mut results, bed, flux / h);
            }
            results.set(&q::MOBILE_DEPTH, numbers.mobile * h);
            results.set(&q::YIELD_LEVEL, bed.h_p - numbers.mobile * h);
            results.set(&q::BED_LEVEL, bed.h_p);
            results.set(&q::DRIVE_DIMENSIONLESS, solution.divided.duct.f);
            results.set(&q::SHIELDS, numbers.tau_bed * h / bed.d);
            if bed.drag.is_some() {
                let slip = solution.divided.largest_slip(&solution.solved.x) * shear * h / (1.0 - bed.phi);
                results.set(&q::REYNOLDS_PARTICLE, bed.rho_f * slip * bed.d / bed.eta);
            }
            bed.rho_f
        }
    };
    results.set(&q::REYNOLDS, rho * rate / area * h / flow.viscosity());
    results.set(&q::UNKNOWNS, solution.solved.x.len() as f64);
    results.set(&q::ITERATIONS, solution.iterations as f64);
    results.set(&q::DUALITY_GAP, solution.solved.gap);
    results
}

/// Solves the whole duct on the elements of its section and puts what it has in place of what the section had.
fn draw_out(
    flow: &DuctFlow,
    along: usize,
    solution: &mut Solution,
    results: &mut Vec<(&'static Quantity, f64)>,
    see: &mut dyn FnMut(usize, f64) -> ControlFlow<()>,
) -> Result<(), Unsolved> {
    let weight = match &flow.contents {
        Contents::Bed(bed) => bed.phi,
        Contents::Bingham { .. } => 0.0,
    };
    let full = Full::new(&solution.divided, along, weight);
    let unknowns = full.program.size();
    let whole = full.solve(&flow.regularisation, &mut |change| see(unknowns, change))?;
    let section = &solution.solved.x;
    let largest = section.iter().fold(0.0_f64, |m, u| m.max(*u)).max(f64::MIN_POSITIVE);
    let apart = section.iter().zip(&whole.section.x).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    results.push((&q::SECTION_DEVIATION, apart / largest));
    results.push((&q::CROSS_FLOW, whole.across));
    results.push((&q::UNEVEN_FLOW, whole.uneven));
    if weight > 0.0 {
        results.push((&q::PRESSURE_DEVIATION, whole.pressure));
    }
    results.push((&q::UNKNOWNS_WHOLE, unknowns as f64));
    solution.iterations += whole.section.history.len();
    solution.solved = whole.section;
    Ok(())
}

/// What the regularisation changed, against the exact yield `x` on the same mesh.
fn changed(solution: &Solution, x: &[f64], numbers: &Numbers, results: &mut Results) {
    let divided = &solution.divided;
    let norm = |of: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt();
    let size = norm(&|i| x[i]);
    if size > 0.0 {
        results.set(&q::REGULARISATION_VELOCITY, norm(&|i| solution.solved.x[i] - x[i]) / size);
    } else {
        results.undefined(
            &q::REGULARISATION_VELOCITY,
            "with the exact yield nothing moves: what is reported is the creep of the regularisation",
        );
    }
    let exact = divided.integral(&divided.grains(x), 0..divided.mesh.bed_rows);
    if divided.mesh.bed_rows > 0 && exact > 0.0 {
        results.set(&q::REGULARISATION_RATE, numbers.grains / exact - 1.0);
    }
}

/// Levels and velocities of the same flow between two planes, as the same elements have it.
fn plane(duct: &Duct, cells: usize, flow: &DuctFlow) -> Option<Vec<(f64, f64)>> {
    let plane = Duct { shape: Outline::Planes, ..*duct };
    let rows = (4 * cells).min(512);
    let solution = plane.solve(rows, &flow.regularisation, &flow.solver, &mut |_, _| ControlFlow::Continue(())).ok()?;
    let u = solution.divided.velocity(&solution.solved.x);
    let mesh = &solution.divided.mesh;
    Some((0..=2 * rows).map(|j| mesh.node(0, j)).map(|node| (mesh.position(node).1, u[node])).collect())
}

fn profile(flow: &DuctFlow, solution: &Solution, plane: Option<Vec<(f64, f64)>>) -> Result<Profile, TableError> {
    let divided = &solution.divided;
    let mesh = &divided.mesh;
    let (scale, x) = (flow.shear_scale() * flow.h, &solution.solved.x);
    let nodes: Vec<usize> = (0..mesh.lines().1).map(|j| mesh.node(0, j)).collect();
    let z: Vec<f64> = nodes.iter().map(|node| mesh.position(*node).1).collect();
    let (u, w) = (divided.velocity(x), divided.grains(x));
    let u: Vec<f64> = nodes.iter().map(|node| u[*node] * scale).collect();
    let mut profile = Profile::new(z.iter().map(|z| z * flow.h).collect())?;
    if let Contents::Bed(bed) = &flow.contents {
        let inside = |j: usize| j <= 2 * mesh.bed_rows;
        let phi = |j: usize| if inside(j) { bed.phi } else { 0.0 };
        let w: Vec<Option<f64>> = (0..z.len()).map(|j| inside(j).then(|| w[nodes[j]] * scale)).collect();
        profile.push(&q::PHI, (0..z.len()).map(|j| Some(phi(j))).collect())?;
        if bed.drag.is_some() {
            let fluid = |j: usize| w[j].map_or(u[j], |w| (u[j] - bed.phi * w) / (1.0 - bed.phi));
            profile.push(&q::U_FLUID, (0..z.len()).map(|j| Some(fluid(j))).collect())?;
        }
        profile.push(&q::U_PARTICLE, w.clone())?;
        profile.push(&q::U_MIXTURE, u.iter().map(|u| Some(*u)).collect())?;
        profile.push(&q::FLUX, w.iter().map(|w| Some(w.map_or(0.0, |w| bed.phi * w))).collect())?;
        let pressure = |j: usize| flow.stress_scale() * phi(j) * (bed.h_p / bed.h - z[j]).max(0.0);
        profile.push(&q::P_PARTICLE, (0..z.len()).map(|j| Some(pressure(j))).collect())?;
    } else {
        profile.push(&q::U_MIXTURE, u.iter().map(|u| Some(*u)).collect())?;
    }
    let rate = super::numbers::shear_rates(divided, x);
    profile.push(&q::SHEAR_RATE, rate.into_iter().map(|r| r.map(|r| r * flow.shear_scale())).collect())?;
    if let Some(plane) = plane {
        let at = |z: f64| {
            let above = plane.partition_point(|p| p.0 < z).clamp(1, plane.len() - 1);
            let ((a, ua), (b, ub)) = (plane[above - 1], plane[above]);
            (ua + (ub - ua) * ((z - a) / (b - a)).clamp(0.0, 1.0)) * scale
        };
        profile.push(&q::U_PLANES, z.iter().map(|z| Some(at(*z))).collect())?;
    }
    Ok(profile)
}

fn field(flow: &DuctFlow, solution: &Solution, numbers: &Numbers) -> Field {
    let divided = &solution.divided;
    let (across, up) = divided.mesh.lines();
    let (scale, x) = (flow.shear_scale() * flow.h, &solution.solved.x);
    let si = |values: Vec<f64>| values.into_iter().map(|u| u * scale).collect();
    let place = |node: usize| {
        let (y, z) = divided.mesh.position(node);
        (y * flow.h, z * flow.h)
    };
    let mut columns =
        vec![(q::U_MIXTURE.name.into(), si(divided.velocity(x))), ("unyielded".into(), numbers.unyielded.clone())];
    columns.extend(numbers.stress.clone().map(|stress| ("stress_over_yield".into(), stress)));
    if matches!(&flow.contents, Contents::Bed(bed) if bed.drag.is_some()) {
        columns.push((q::U_PARTICLE.name.into(), si(divided.grains(x))));
    }
    Field { across, up, places: (0..divided.mesh.nodes()).map(place).collect(), columns }
}

/// Laws used outside their range.
fn validity(flow: &DuctFlow) -> Vec<Validity> {
    let Contents::Bed(bed) = &flow.contents else { return Vec::new() };
    // Einstein's law is for dilute suspensions, which no bed is: docs/theory.md says so once.
    if bed.viscosity == MixtureViscosity::Einstein {
        return Vec::new();
    }
    let info = bed.viscosity.info();
    let name = || format!("{}/{}", info.family, info.law);
    info.ranges.iter().filter_map(|range| outside(name(), range, bed.phi)).collect()
}

/// Reynolds number of the gap: over the bed, and between the side walls where those are nearer.
fn reynolds_gap(flow: &DuctFlow, numbers: &Numbers) -> f64 {
    let (rho, height) = match &flow.contents {
        Contents::Bingham { rho, .. } => (*rho, 1.0),
        Contents::Bed(bed) => (bed.rho_f, 1.0 - bed.h_p / bed.h),
    };
    let gap = match flow.outline {
        Outline::Rectangle { width } => height.min(width),
        Outline::Circle | Outline::Planes => height,
    };
    rho * numbers.clear * flow.shear_scale() * flow.h * gap * flow.h / flow.viscosity()
}
