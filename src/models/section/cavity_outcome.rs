//! A solved cavity in SI: vortex, unyielded area, profile on the centre line, fields.

use std::ops::ControlFlow;

use serde_json::{Map, json};

use super::cavity::Cavity;
use super::newton::{Solved, Unsolved};
use super::outcome::history;
use super::{dual, newton};
use crate::closures::regularisation::Regularisation;
use crate::models::section::{CavityFlow, Method};
use crate::result::Field;
use crate::result::{
    Balance, Failure, Outcome, Profile, Results, Snapshot, SolveError, Status, TableError, Watch, quantity as q,
};
use crate::units::significant;

/// Solves the cavity on `cells` by `cells` cells.
///
/// # Errors
/// [`SectionError::NotConverged`](crate::models::section::SectionError::NotConverged) if the method does not get there, [`NumericalError::NotRepresentable`](crate::result::NumericalError::NotRepresentable) if numbers leave their range.
pub fn run(flow: &CavityFlow, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let cavity = Cavity::new(flow.bingham(), cells, flow.solver.finest);
    let law = &flow.regularisation;
    let mut iterations = 0_usize;
    let mut see = |change: f64| -> ControlFlow<()> {
        iterations += 1;
        let stage = format!("iteration {iterations}, change {change:.1e}");
        watch.see(&Snapshot { stage: &stage, fraction: 1.0 - 1.0 / (1.0 + 0.05 * iterations as f64), quantity: None })
    };
    let solved = match solve(flow, &cavity, &mut see) {
        Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
        solved => solved.map_err(|unsolved| failed(unsolved, flow))?,
    };
    let psi = cavity.stream(&solved.x);
    let stresses = cavity.stresses(&solved);
    let mut results = results(flow, &cavity, &solved, &psi);
    match share(flow, &cavity, &stresses, cells, &mut see) {
        Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
        Err(unsolved) => return Err(failed(unsolved, flow).into()),
        Ok((share, error)) => {
            results.set(&q::UNYIELDED_SHARE, share);
            results.set(&q::UNYIELDED_SHARE_ERROR, error);
        }
    }
    if !law.is_exact() {
        match newton::solve(&cavity.program, &Regularisation::EXACT, &mut see) {
            Err(Unsolved::Stopped) => return Ok(Outcome::stopped()),
            Err(unsolved) => return Err(failed(unsolved, flow).into()),
            Ok(exact) => {
                let norm = |of: &dyn Fn(usize) -> f64| (0..exact.x.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt();
                let change = norm(&|i| solved.x[i] - exact.x[i]) / norm(&|i| exact.x[i]);
                results.set(&q::REGULARISATION_VELOCITY, change);
            }
        }
    }
    let profile = profile(flow, &cavity, &psi)?;
    let field = field(flow, &cavity, &psi, &stresses);
    let series = history(&solved.history)?;
    let how = "sum of the forces that are left on the nodes over that of the drive";
    let mut regularisation = Map::new();
    regularisation.insert("law".into(), serde_json::to_value(law.law).unwrap_or_default());
    let lambda = if law.is_exact() { solved.lambda } else { law.lambda };
    regularisation.insert("lambda_1_s".into(), json!(lambda * flow.lid / flow.h));
    regularisation.insert("lambda_scaled".into(), json!(lambda));
    Ok(Outcome {
        status: Status::Done,
        profile: Some(profile),
        series,
        results,
        balances: vec![Balance { name: "momentum".into(), relative: solved.imbalance, how: how.into() }],
        validity: Vec::new(),
        regularisation,
        field: Some(field),
        ..Outcome::stopped()
    })
}

fn solve(
    flow: &CavityFlow,
    cavity: &Cavity,
    see: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Solved<5>, Unsolved> {
    match flow.solver.method {
        Method::Newton => newton::solve(&cavity.program, &flow.regularisation, see),
        Method::FirstOrder => dual::solve(&cavity.program, flow.solver.tolerance, flow.solver.iterations, see),
    }
}

/// Unyielded share, extrapolated to cells of no size, and its error. Cells either yield or do not, so that the share on a mesh has the
/// order 1, with a scatter: the error is what the extrapolation from all and half the cells adds, and what it differs by from that
/// from half and a quarter of them.
fn share(
    flow: &CavityFlow,
    cavity: &Cavity,
    stresses: &[f64],
    cells: usize,
    see: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(f64, f64), Unsolved> {
    if flow.tau_0 == 0.0 {
        return Ok((0.0, 0.0));
    }
    let size = |cavity: &Cavity| (cavity.lines().0 - 1) as f64;
    let mut on = |cells: usize| -> Result<(f64, f64), Unsolved> {
        let cavity = Cavity::new(flow.bingham(), cells, flow.solver.finest);
        let solved = solve(flow, &cavity, see)?;
        Ok((size(&cavity), cavity.unyielded(&cavity.stresses(&solved))))
    };
    let (all, half, quarter) = ((size(cavity), cavity.unyielded(stresses)), on(cells / 2)?, on(cells / 4)?);
    let added = |(n, fine): (f64, f64), (m, rough): (f64, f64)| (fine - rough) * m / (n - m);
    let (share, before) = (all.1 + added(all, half), half.1 + added(half, quarter));
    Ok((share.clamp(0.0, 1.0), added(all, half).abs() + (share - before).abs()))
}

/// Stress over yield stress beyond which it makes no difference.
const LARGE: f64 = 2.0;

fn failed(unsolved: Unsolved, flow: &CavityFlow) -> SolveError {
    unsolved.into_error(flow.solver.method, flow.lid / flow.h)
}

impl Cavity {
    /// Nodes across and up.
    fn lines(&self) -> (usize, usize) {
        (self.y.len(), self.z.len())
    }

    /// Stress over yield stress of each cell, from the mean of its shear stresses: those of single nodes oscillate.
    fn stresses(&self, solved: &Solved<5>) -> Vec<f64> {
        let points = &self.program.points;
        let part = |k: usize, d: usize| points[k].carried * solved.q[k][d] + points[k].weight * solved.g[k][d];
        let stress = |k: usize| part(k, 0).hypot(0.5 * (1..5).map(|d| part(k, d)).sum::<f64>());
        (0..points.len()).map(|k| stress(k) / points[k].carried).collect()
    }

    /// Area of the cells that do not yield.
    fn unyielded(&self, stresses: &[f64]) -> f64 {
        let cells = self.program.points.iter().zip(stresses);
        cells.filter(|(_, s)| **s < 1.0).map(|(p, _)| p.weight).fold(0.0, |sum, w| sum + w)
    }

    /// Place and size of the largest magnitude of the stream function: top of the parabolas through the largest node and its
    /// neighbours.
    fn vortex(&self, psi: &[f64]) -> (f64, f64, f64) {
        let (across, up) = self.lines();
        let at = |i: usize, j: usize| psi[j * across + i].abs();
        let mut best = (1, 1);
        for j in 1..up - 1 {
            for i in 1..across - 1 {
                if at(i, j) > at(best.0, best.1) {
                    best = (i, j);
                }
            }
        }
        let (i, j) = best;
        let (y, rise) = top(&self.y[i - 1..=i + 1], &[at(i - 1, j), at(i, j), at(i + 1, j)]);
        let (z, more) = top(&self.z[j - 1..=j + 1], &[at(i, j - 1), at(i, j), at(i, j + 1)]);
        (y, z, rise + more - at(i, j))
    }
}

/// Place and height of the top of the parabola through three points.
fn top(x: &[f64], f: &[f64; 3]) -> (f64, f64) {
    let (left, right) = ((f[1] - f[0]) / (x[1] - x[0]), (f[2] - f[1]) / (x[2] - x[1]));
    let curvature = (right - left) / (x[2] - x[0]);
    if curvature >= 0.0 {
        return (x[1], f[1]);
    }
    let place = (0.5 * (x[0] + x[1]) - 0.5 * left / curvature).clamp(x[0], x[2]);
    (place, f[0] + (place - x[0]) * (left + curvature * (place - x[1])))
}

fn results(flow: &CavityFlow, cavity: &Cavity, solved: &Solved<5>, psi: &[f64]) -> Results {
    let (y, z, strength) = cavity.vortex(psi);
    let mut results = Results::default();
    results.set(&q::STREAM_MAX, strength);
    results.set(&q::VORTEX_Y, y * flow.h);
    results.set(&q::VORTEX_Z, z * flow.h);
    results.set(&q::BINGHAM, flow.bingham());
    results.set(&q::FLOW_HEIGHT, flow.h);
    results.set(&q::REYNOLDS, flow.rho * flow.lid * flow.h / flow.eta);
    results.set(&q::UNKNOWNS, solved.x.len() as f64);
    results.set(&q::ITERATIONS, solved.history.len() as f64);
    results.set(&q::DUALITY_GAP, solved.gap);
    results
}

/// Velocity across the middle: at the bottom, the middles of the cells, the lid.
fn profile(flow: &CavityFlow, cavity: &Cavity, psi: &[f64]) -> Result<Profile, TableError> {
    let (across, up) = cavity.lines();
    let middle = across / 2;
    let (mut z, mut u) = (vec![0.0], vec![Some(0.0)]);
    for j in 0..up - 1 {
        let h = cavity.z[j + 1] - cavity.z[j];
        z.push(0.5 * (cavity.z[j] + cavity.z[j + 1]) * flow.h);
        u.push(Some((psi[(j + 1) * across + middle] - psi[j * across + middle]) / h * flow.lid));
    }
    z.push(flow.h);
    u.push(Some(flow.lid));
    let rate = |k: usize| {
        let (a, b) = (k.saturating_sub(1), (k + 1).min(z.len() - 1));
        Some((u[b]? - u[a]?).abs() / (z[b] - z[a]))
    };
    let rates = (0..z.len()).map(rate).collect();
    let mut profile = Profile::new(z.clone())?;
    profile.push(&q::U_MIXTURE, u.clone())?;
    profile.push(&q::SHEAR_RATE, rates)?;
    Ok(profile)
}

fn field(flow: &CavityFlow, cavity: &Cavity, psi: &[f64], stresses: &[f64]) -> Field {
    let (across, up) = cavity.lines();
    let (y, z) = (&cavity.y, &cavity.z);
    // Derivatives at the nodes: of the parabola inside, of the walls on the walls.
    let slope = |x: &[f64], k: usize, f: &dyn Fn(usize) -> f64| {
        let (a, b) = (x[k] - x[k - 1], x[k + 1] - x[k]);
        ((f(k + 1) - f(k)) / b * a + (f(k) - f(k - 1)) / a * b) / (a + b)
    };
    let inner = |node: usize| {
        let (i, j) = (node % across, node / across);
        i > 0 && j > 0 && i < across - 1 && j < up - 1
    };
    let velocity = |node: usize| {
        let (i, j) = (node % across, node / across);
        if inner(node) {
            (slope(z, j, &|j| psi[j * across + i]), -slope(y, i, &|i| psi[j * across + i]))
        } else {
            (f64::from(u8::from(j == up - 1)), 0.0)
        }
    };
    // The mean of a function of the stress over the cells around a node; a Newtonian fluid has no stress to compare with.
    let around = |node: usize, of: &dyn Fn(f64) -> f64| {
        let (i, j) = (node % across, node / across);
        let cells = [(i.wrapping_sub(1), j.wrapping_sub(1)), (i, j.wrapping_sub(1)), (i.wrapping_sub(1), j), (i, j)];
        let around = cells.into_iter().filter(|(i, j)| *i < across - 1 && *j < up - 1);
        let of = around.map(|(i, j)| of(stresses.get(j * (across - 1) + i).copied().unwrap_or(LARGE)));
        let (sum, count) = of.fold((0.0, 0.0), |(sum, count), s| (sum + s, count + 1.0));
        sum / count
    };
    let nodes = 0..across * up;
    Field {
        across,
        up,
        places: nodes.clone().map(|n| (y[n % across] * flow.h, z[n / across] * flow.h)).collect(),
        columns: vec![
            ("speed_m_s".into(), nodes.clone().map(velocity).map(|(u, w)| u.hypot(w) * flow.lid).collect()),
            ("u_m_s".into(), nodes.clone().map(|n| velocity(n).0 * flow.lid).collect()),
            ("w_m_s".into(), nodes.clone().map(|n| velocity(n).1 * flow.lid).collect()),
            ("unyielded".into(), nodes.clone().map(|n| around(n, &|s| f64::from(u8::from(s < 1.0)))).collect()),
            ("stress_over_yield".into(), nodes.map(|n| around(n, &|s| s.min(LARGE))).collect()),
            ("stream_function_m2_s".into(), psi.iter().map(|p| p * flow.lid * flow.h).collect()),
        ],
    }
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &CavityFlow) -> String {
    let n = |x: f64| significant(x, 5);
    let yielding = flow.regularisation.law.equation().map_or("exact".into(), |law| {
        format!("Bn {},  λ = {}", law.trim_start_matches("sign(γ) "), n(flow.regularisation.lambda))
    });
    format!(
        "Slow flow of a Bingham fluid in a square cavity under a sliding lid, without inertia.\n\n\
         units      H = {} m,  U = {} m/s (lid),  η U/H = {} Pa\n\
         numbers    Bn = τ_0 H/(η U) = {}\n\
         velocity   u = ∂ψ/∂z,  v = -∂ψ/∂y,  ψ = 0 on the walls,  u = U on the lid\n\
         minimum    ∫ |γ|²/2 + Bn |γ|,  |γ|² = 4 (∂u/∂y)² + (∂u/∂z + ∂v/∂y)²\n\
         yield      {yielding}\n",
        n(flow.h),
        n(flow.lid),
        n(flow.eta * flow.lid / flow.h),
        n(flow.bingham()),
    )
}
