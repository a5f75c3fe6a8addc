//! A solved bed in SI: profile at the nodes, numbers, balances, and what the regularisation changed.

use serde_json::{Map, Value, json};

use super::bed::{Bed, Dilation, Nodes, Solution};
use super::mesh::Mesh;
use crate::closures::dilatancy::{self, phi_iv};
use crate::closures::friction::{coulomb, mu_iv};
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::closures::regularisation::Regularisation;
use crate::models::BedError;
use crate::models::bed_error::in_si;
use crate::models::exact::bed::{Drive, LaminarBed};
use crate::models::exact::bed_results::{BedNumbers, Maximum};
use crate::models::exact::ouriemi::{drag_text, viscosity_text};
use crate::models::exact::{balance, no_root, outcome};
use crate::models::laminar::RegularisedBed;
use crate::numerics::root::brent;
use crate::result::{
    Balance, Failure, Outcome, Profile, Quantity, Snapshot, SolveError, TableError, Watch, quantity as q,
};
use crate::units::{significant, stated};

impl Bed {
    /// The bed in the units of the model, driven by `f`.
    #[must_use]
    pub fn scaled(bed: &LaminarBed, f: f64) -> Self {
        Self {
            f,
            h_p: bed.h_p / bed.h,
            phi: bed.phi,
            mu_s: bed.friction.mu_s,
            rise: bed.rise,
            e: bed.viscosity.relative(bed.phi),
            k: bed.drag.map(|law| law.permeability(bed.phi, bed.d / bed.h)),
            dilation: bed.dilatancy.map(|law| Dilation {
                law,
                viscosity: bed.viscosity,
                drag: bed.drag.map(|law| (law, bed.d / bed.h)),
            }),
        }
    }
}

/// Solves the bed on `cells` elements.
///
/// # Errors
/// As [`Bed::solve`], in SI, and [`BedError::OutOfReach`] if no drive gives the wanted Shields number.
pub fn run(problem: &RegularisedBed, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let RegularisedBed { bed, regularisation, yield_node } = problem;
    let nodes = Nodes { elements: cells, on_yield: *yield_node };
    let scaled = Bed::scaled(bed, drive(bed, nodes, regularisation)?);
    let solution = scaled.solve(nodes, regularisation).map_err(|error| in_si(error, bed))?;
    let numbers = numbers(&scaled, &solution);
    let mut results = numbers.results(bed);
    if !regularisation.is_exact() {
        let exact = scaled.solve(nodes, &Regularisation::EXACT).map_err(|error| in_si(error, bed))?;
        let norm = |f: &dyn Fn(usize) -> f64| (0..exact.u.len()).map(|j| f(j).powi(2)).sum::<f64>().sqrt();
        results.set(&q::REGULARISATION_RATE, solution.flux() / exact.flux() - 1.0);
        results.set(&q::REGULARISATION_VELOCITY, norm(&|j| solution.u[j] - exact.u[j]) / norm(&|j| exact.u[j]));
    }
    let profile = look(watch).then(|| profile(&scaled, &solution, bed)).transpose()?;
    let mut outcome =
        outcome(profile, solution.history.clone(), results, balances(&scaled, &solution), numbers.validity(bed))?;
    outcome.regularisation = small_numbers(regularisation, bed.velocity_scale() / bed.h);
    Ok(outcome)
}

/// Shows the watch that the solve is over; false if it asks to stop.
pub(in crate::models) fn look(watch: &mut dyn Watch) -> bool {
    watch.see(&Snapshot { stage: "profile", fraction: 0.5, quantity: None }).is_continue()
}

/// The law and its size in both units.
pub(in crate::models) fn small_numbers(regularisation: &Regularisation, unit: f64) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("law".into(), serde_json::to_value(regularisation.law).unwrap_or_default());
    map.insert("lambda_1_s".into(), json!(regularisation.lambda * unit));
    map.insert("lambda_scaled".into(), json!(regularisation.lambda));
    map
}

/// The dimensionless drive.
fn drive(bed: &LaminarBed, nodes: Nodes, regularisation: &Regularisation) -> Result<f64, SolveError> {
    let (what, wanted) = match bed.drive {
        Drive::PressureGradient(gradient) => return Ok(gradient / ((bed.rho_p - bed.rho_f) * bed.g)),
        Drive::Wanted(what, wanted) => (what, wanted),
    };
    let found = |f: f64| {
        let scaled = Bed::scaled(bed, f);
        let numbers = numbers(&scaled, &scaled.solve(nodes, regularisation).ok()?);
        Some(what.of(bed, [numbers.tau, numbers.discharge, numbers.flux]))
    };
    // Above the largest drive no bed is at rest; bisect down to what can be solved.
    let mut high = (1.0 - 1e-9) * Bed::scaled(bed, 0.0).largest_drive();
    let low = 1e-12 * high;
    let mut largest = found(high);
    let (mut good, mut bad) = (low, high);
    for _ in 0..if largest.is_none() { 50 } else { 0 } {
        let middle = 0.5 * (good + bad);
        match found(middle) {
            Some(value) => (good, largest) = (middle, Some(value)),
            None => bad = middle,
        }
        high = good;
    }
    let largest = largest.unwrap_or(0.0);
    if wanted > largest {
        return Err(BedError::OutOfReach { quantity: what.name(), wanted, largest }.into());
    }
    brent(|f| found(f).map_or(f64::NAN, |value| value / wanted - 1.0), low, high, |_| {})
        .map_err(no_root("the drive that gives what is wanted"))
}

fn numbers(bed: &Bed, solution: &Solution) -> BedNumbers {
    let (d, u, tau) = (1.0 - bed.h_p, solution.u[solution.bed], solution.tau_interface(bed.f));
    let x = (tau / bed.f).clamp(0.0, d);
    let top = solution.bed - 1;
    let rate = (solution.w[top + 1] - solution.w[top]) / solution.mesh.size(top);
    BedNumbers {
        f: bed.f,
        flux: solution.flux(),
        phi_interface: if bed.dilation.is_some() && solution.h_c < bed.h_p { 0.0 } else { bed.phi },
        // The clear fluid is a parabola through both walls of its layer.
        discharge: solution.discharge() + 0.5 * u * d + bed.f * d.powi(3) / 12.0,
        tau,
        h_c: solution.h_c,
        largest: Maximum { level: bed.h_p + x, value: u + tau * x - 0.5 * bed.f * x * x },
        slip: u - solution.w[solution.bed],
        shear: rate,
    }
}

fn balances(bed: &Bed, solution: &Solution) -> Vec<Balance> {
    let n = solution.mesh.elements();
    let half = |k: usize| 0.5 * solution.mesh.size(k);
    let bottom = solution.tau_f[0] + solution.tau_p[0] + bed.f * half(0);
    let top = solution.tau_f[n - 1] - bed.f * half(n - 1);
    let how = "stress at the two walls against the drive over the height";
    let mut balances = vec![balance("momentum", (bottom - top) / bed.f - 1.0, how)];
    if let Some(last) = solution.history.last() {
        balances.push(balance("solver", *last, "last residual of the iteration"));
    }
    balances
}

/// Values of elements `from..to` at the nodes of that range, by linear interpolation between middles and extrapolation to the
/// ends; into `nodes`.
pub(in crate::models) fn spread(
    mesh: &Mesh,
    values: &dyn Fn(usize) -> f64,
    from: usize,
    to: usize,
    nodes: &mut [Option<f64>],
) {
    for (j, node) in nodes.iter_mut().enumerate().take(to + 1).skip(from) {
        if to - from < 2 {
            *node = (to > from).then(|| values(from)).or(*node);
            continue;
        }
        let a = j.saturating_sub(1).clamp(from, to - 2);
        let (za, zb) = (mesh.middle(a), mesh.middle(a + 1));
        let share = (mesh.nodes()[j] - za) / (zb - za);
        *node = Some(values(a) + share * (values(a + 1) - values(a)));
    }
}

fn profile(bed: &Bed, solution: &Solution, si: &LaminarBed) -> Result<Profile, TableError> {
    let (mesh, n, top) = (&solution.mesh, solution.mesh.elements(), solution.bed);
    let packing = &solution.packing;
    let still = mesh.below(solution.h_c).min(top);
    let (velocity, stress) = (si.velocity_scale(), si.stress_scale());
    // Each layer by itself: the corners at the yield level and at the bed level stay corners.
    let by_layer = |values: &dyn Fn(usize) -> f64, clear: bool| {
        let mut nodes = vec![None; n + 1];
        if clear {
            spread(mesh, values, top, n, &mut nodes);
        }
        spread(mesh, values, 0, still, &mut nodes);
        spread(mesh, values, still, top, &mut nodes);
        nodes
    };
    let tau_f = by_layer(&|k| stress * solution.tau_f[k], true);
    let tau_p = by_layer(&|k| stress * solution.tau_p[k], false);
    let rate = |k: usize| (solution.w[k + 1] - solution.w[k]) / mesh.size(k) * velocity / si.h;
    let shear = by_layer(&rate, false);
    let grains: Vec<Option<f64>> = (0..=n).map(|j| solution.w.get(j).map(|w| w * velocity)).collect();
    let mixture: Vec<Option<f64>> = solution.u.iter().map(|u| Some(u * velocity)).collect();
    let phi: Vec<f64> = match bed.dilation {
        None => (0..=n).map(|j| if j <= top { bed.phi } else { 0.0 }).collect(),
        Some(_) => by_layer(&|k| packing.phi[k], false).into_iter().map(|phi| phi.unwrap_or(0.0).max(0.0)).collect(),
    };
    let flux = (0..=n).map(|j| Some(grains[j].map_or(0.0, |w| phi[j] * w))).collect();
    let pressure = (0..=n).map(|j| Some(stress * packing.pressure.get(j).copied().unwrap_or(0.0))).collect();
    let fluid = (0..=n)
        .map(|j| {
            let u = mixture[j]?;
            Some(grains[j].map_or(u, |w| (u - phi[j] * w) / (1.0 - phi[j])))
        })
        .collect();
    let phi = phi.into_iter().map(Some).collect();
    let tau_p = tau_p.into_iter().map(|t| t.or(Some(0.0))).collect();
    let mut table: Vec<(&'static Quantity, Vec<Option<f64>>)> = vec![
        (&q::PHI, phi),
        (&q::U_FLUID, fluid),
        (&q::U_PARTICLE, grains),
        (&q::U_MIXTURE, mixture),
        (&q::FLUX, flux),
        (&q::TAU_VISCOUS, tau_f),
        (&q::TAU_PARTICLE, tau_p),
        (&q::P_PARTICLE, pressure),
        (&q::SHEAR_RATE, shear),
    ];
    if si.drag.is_none() {
        table.remove(1);
    }
    let mut profile = Profile::new(mesh.nodes().iter().map(|z| z * si.h).collect())?;
    for (quantity, values) in table {
        profile.push(quantity, values)?;
    }
    Ok(profile)
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(problem: &RegularisedBed) -> String {
    let n = |x: f64| significant(x, 5);
    let RegularisedBed { bed, regularisation, .. } = problem;
    let drive = match bed.drive {
        Drive::PressureGradient(p) => {
            format!("f = -dp/dx/((ρ_p - ρ_f) g) = {}", n(p / ((bed.rho_p - bed.rho_f) * bed.g)))
        }
        Drive::Wanted(what, value) => what.equation(value),
    };
    let mut text = format!(
        "Viscous fluid over a bed of grains between two planes, {form} form.\n\n\
         units              H = {h} m,  (ρ_p - ρ_f) g H = {stress} Pa,  (ρ_p - ρ_f) g H²/η = {velocity} m/s\n\
         drive              {drive}\n\
         particle pressure  P_p = {pressure},  φ = {phi},  h_p = {h_p}\n\
         viscosity          {viscosity},  e = η_e/η = {e} in the bed, 1 above\n\
         friction           {friction}\n\
         packing            {packing}\n\
         yield              {yielding}\n\n\
         mixture            (e U')' + τ_p' + f = 0,  U(0) = U(1) = 0\n",
        form = bed.form_name(),
        h = n(bed.h),
        stress = n(bed.stress_scale()),
        velocity = n(bed.velocity_scale()),
        pressure = if bed.dilatancy.is_some() { "integral of φ from z to h_p" } else { "φ (h_p - z)" },
        phi = n(bed.phi),
        h_p = n(bed.h_p / bed.h),
        viscosity = viscosity_text(bed),
        e = n(bed.viscosity.relative(bed.phi)),
        friction = friction_text(bed),
        packing = match bed.dilatancy {
            None => format!("{} at every shear rate", dilatancy::none::INFO.equation),
            Some(law) => format!(
                "{},  changes P_p{}",
                stated(phi_iv::INFO.equation, &[("φ_bed", bed.phi, ""), ("a", law.a, "")]),
                if bed.drag.is_some() { ", e and K" } else { " and e" }
            ),
        },
        yielding = yield_text(regularisation, bed.velocity_scale() / bed.h),
    );
    if let Some(law) = bed.drag {
        text += &format!(
            "grains             τ_p' + (U - u_p)/K = 0,  u_p(0) = 0\n\
             drag               {}\n",
            drag_text(bed, law)
        );
    } else {
        text += "grains             u_p = U\n";
    }
    text
}

fn friction_text(bed: &LaminarBed) -> String {
    let law = match bed.rise {
        None => stated(coulomb::INFO.equation, &[("μ_s", bed.friction.mu_s, "")]),
        Some(law) => {
            let constants = [("μ_s", law.mu_s, ""), ("μ_2", law.mu_2, ""), ("I_0", law.i_0, "")];
            format!("τ_p = μ(I_v) P_p,  {}", stated(mu_iv::INFO.equation, &constants))
        }
    };
    format!("{law},  with μ_s R(γ) for μ_s,  γ = u_p'")
}

/// The law of the regularisation, with its size.
pub(in crate::models) fn yield_text(regularisation: &Regularisation, unit: f64) -> String {
    let Some(law) = regularisation.law.equation() else { return "exact: R = γ/|γ|, rigid below".into() };
    let lambda = regularisation.lambda;
    format!("R = {law},  λ = {} ({} 1/s)", significant(lambda, 3), significant(lambda * unit, 3))
}
