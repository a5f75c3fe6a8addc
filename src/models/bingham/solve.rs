//! A Bingham fluid between two planes, regularised or with the exact yield, on the mesh of [`crate::models::laminar::single`].
//!
//! Units: H and the shear rate [`BinghamPlane::shear_scale`]; the stress of eta times that shear rate.

use super::RegularisedPlane;
use crate::closures::regularisation::Regularisation;
use crate::models::exact::bingham::{BinghamDrive, BinghamPlane};
use crate::models::exact::{balance, no_root, outcome};
use crate::models::laminar::element::Element;
use crate::models::laminar::mesh::{Layer, Mesh};
use crate::models::laminar::outcome::{look, small_numbers, spread, yield_text};
use crate::models::laminar::single::{self, Solved};

use crate::numerics::root::brent;
use crate::result::{Failure, NumericalError, Outcome, Profile, Results, TableError, Watch, quantity as q};
use crate::units::significant;

/// A solved plane flow in scaled units.
#[derive(Clone, Debug)]
pub struct Solution {
    /// nodes
    pub mesh: Mesh,
    /// drive
    pub f: f64,
    /// lower edge of the plug, where the stress falls to the yield stress; 0 where nothing moves
    pub edge: f64,
    /// velocities and shear rates
    pub solved: Solved,
}

impl Solution {
    /// Mean velocity: the integral of a velocity that is quadratic in each element away from the corners.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let Self { mesh, solved, .. } = self;
        let n = mesh.elements();
        let mut slopes = vec![None; n + 1];
        for (a, b) in self.layers() {
            spread(mesh, &|k| solved.gamma[k], a, b, &mut slopes);
        }
        let ends = |k: usize| {
            let (a, b) = self.layers().into_iter().find(|(a, b)| (*a..*b).contains(&k)).unwrap_or((0, n));
            if b - a < 2 {
                return 0.0;
            }
            let i = k.clamp(a, b - 2);
            (solved.gamma[i + 1] - solved.gamma[i]) / (mesh.middle(i + 1) - mesh.middle(i))
        };
        let element = |k: usize| {
            let h = mesh.size(k);
            0.5 * h * (solved.u[k] + solved.u[k + 1]) - ends(k) * h.powi(3) / 12.0
        };
        (0..n).map(element).sum()
    }

    /// Ranges of elements between the corners.
    fn layers(&self) -> Vec<(usize, usize)> {
        let (a, b, n) = (self.mesh.below(self.edge), self.mesh.below(1.0 - self.edge), self.mesh.elements());
        [(0, a), (a, b), (b, n)].into_iter().filter(|(a, b)| b > a).collect()
    }
}

/// Solves under the drive `f` with the yield stress `y`.
///
/// # Errors
/// [`NumericalError::NotConverged`], which finite input excludes.
pub fn solve(
    y: f64,
    f: f64,
    cells: usize,
    yield_node: bool,
    regularisation: &Regularisation,
) -> Result<Solution, NumericalError> {
    // The stress is symmetric: f (1/2 - z), so the edges of the plug are known.
    let edge = (0.5 - y / f).max(0.0);
    let equal =
        |top: f64, elements: usize| Layer { top, elements, finest_below: f64::INFINITY, finest_above: f64::INFINITY };
    let sheared = if edge > 0.0 && y > 0.0 && yield_node { cells / 3 } else { 0 };
    let mesh = Mesh::layered(&[
        equal(edge, sheared),
        equal(1.0 - edge, if sheared > 0 { cells - 2 * sheared } else { 0 }),
        equal(1.0, if sheared > 0 { sheared } else { cells }),
    ]);
    let elements = vec![Element { e: 1.0, y, rise: None }; mesh.elements()];
    let solved = single::solve(&mesh, &elements, f, regularisation)
        .map_err(|e| NumericalError::NotConverged { residual: e.residual, iterations: e.iterations })?;
    Ok(Solution { mesh, f, edge, solved })
}

/// Solves the plane flow on `cells` elements.
///
/// # Errors
/// [`NumericalError::NoRoot`] if no gradient gives the wanted mean velocity, [`NumericalError::NotConverged`].
pub fn run(problem: &RegularisedPlane, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let RegularisedPlane { plane, regularisation, yield_node } = problem;
    let y = plane.tau_0 / (plane.eta * plane.shear_scale());
    let at = |f: f64, regularisation: &Regularisation| solve(y, f, cells, *yield_node, regularisation);
    let f = match plane.drive {
        BinghamDrive::PressureGradient(_) => 1.0,
        BinghamDrive::MeanVelocity(_) => {
            let mean = |f: f64| at(f, regularisation).map_or(f64::NAN, |s| s.mean() - 1.0);
            brent(mean, 1e-6, 2.0 * (12.0 + 4.0 * y), |_| {})
                .map_err(no_root("the gradient for the wanted mean velocity"))?
        }
    };
    let solution = at(f, regularisation)?;
    let mut results = results(plane, &solution);
    if !regularisation.is_exact() {
        let exact = at(f, &Regularisation::EXACT)?;
        let norm = |g: &dyn Fn(usize) -> f64| (0..exact.solved.u.len()).map(|j| g(j).powi(2)).sum::<f64>().sqrt();
        let change = norm(&|j| solution.solved.u[j] - exact.solved.u[j]) / norm(&|j| exact.solved.u[j]);
        results.set(&q::REGULARISATION_VELOCITY, change);
    }
    let n = solution.mesh.elements();
    let half = |k: usize| 0.5 * solution.mesh.size(k) * f;
    let walls = solution.solved.t_0 - (solution.solved.t_0 - f * solution.mesh.middle(n - 1) - half(n - 1));
    let mut balances =
        vec![balance("momentum", walls / f - 1.0, "stress at the two walls against the drive over the height")];
    if let Some(last) = solution.solved.history.last() {
        balances.push(balance("solver", *last, "last residual of the iteration"));
    }
    let profile = look(watch).then(|| profile(plane, y, &solution)).transpose()?;
    let mut outcome = outcome(profile, solution.solved.history.clone(), results, balances, Vec::new())?;
    outcome.regularisation = small_numbers(regularisation, plane.shear_scale());
    Ok(outcome)
}

fn profile(plane: &BinghamPlane, y: f64, solution: &Solution) -> Result<Profile, TableError> {
    let Solution { mesh, f, solved, .. } = solution;
    let (rate, stress) = (plane.shear_scale(), plane.eta * plane.shear_scale());
    let total = |z: f64| solved.t_0 - f * z;
    let by_layer = |values: &dyn Fn(usize) -> f64| {
        let mut nodes = vec![None; mesh.elements() + 1];
        for (a, b) in solution.layers() {
            spread(mesh, values, a, b, &mut nodes);
        }
        nodes
    };
    let shear = by_layer(&|k| solved.gamma[k]);
    let viscous: Vec<Option<f64>> = shear.iter().map(|g| g.map(|g| stress * g)).collect();
    let solid = mesh.nodes().iter().zip(&viscous).map(|(z, v)| v.map(|v| stress * total(*z) - v)).collect();
    let mut profile = Profile::new(mesh.nodes().iter().map(|z| z * plane.h).collect())?;
    profile.push(&q::U_MIXTURE, solved.u.iter().map(|u| Some(u * rate * plane.h)).collect())?;
    profile.push(&q::TAU_VISCOUS, viscous)?;
    profile.push(&q::TAU_PARTICLE, if y > 0.0 { solid } else { vec![Some(0.0); mesh.elements() + 1] })?;
    profile.push(&q::SHEAR_RATE, shear.into_iter().map(|g| g.map(|g| rate * g.abs())).collect())?;
    Ok(profile)
}

fn results(plane: &BinghamPlane, solution: &Solution) -> Results {
    let velocity = plane.shear_scale() * plane.h;
    let mean = solution.mean() * velocity;
    let middle = solution.solved.u.iter().copied().fold(0.0, f64::max) * velocity;
    let mut results = Results::default();
    results.set(&q::DRIVE, solution.f * plane.eta * plane.shear_scale() / plane.h);
    if mean > 0.0 {
        results.set(&q::BINGHAM, plane.tau_0 * plane.h / (plane.eta * mean));
    } else {
        results.undefined(&q::BINGHAM, "nothing moves: the stress at the walls does not exceed the yield stress");
    }
    results.set(&q::HALF_PLUG, (0.5 - solution.edge) * plane.h);
    results.set(&q::PLUG_VELOCITY, middle);
    results.set(&q::MEAN_VELOCITY, mean);
    results.set(&q::DISCHARGE, mean * plane.h);
    results.set(&q::FLOW_HEIGHT, plane.h);
    results.set(&q::REYNOLDS, plane.rho * mean * plane.h / plane.eta);
    results
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(problem: &RegularisedPlane) -> String {
    let n = |x: f64| significant(x, 5);
    let RegularisedPlane { plane, regularisation, .. } = problem;
    let drive = match plane.drive {
        BinghamDrive::PressureGradient(gradient) => format!("G = -dp/dx = {} Pa/m", n(gradient)),
        BinghamDrive::MeanVelocity(mean) => format!("G such that the mean velocity is {} m/s", n(mean)),
    };
    format!(
        "Bingham fluid between two planes, H = {h} m.\n\n\
         drive        {drive}\n\
         momentum     (η u' + τ_0 R(u'))' + G = 0,  u(0) = u(H) = 0,  η = {eta} Pa s,  τ_0 = {tau} Pa\n\
         yield        {yielding}\n",
        h = n(plane.h),
        eta = n(plane.eta),
        tau = n(plane.tau_0),
        yielding = yield_text(regularisation, plane.shear_scale()),
    )
}
