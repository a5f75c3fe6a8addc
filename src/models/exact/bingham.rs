//! Bingham fluid between two planes, driven by a pressure gradient.
//!
//! With `G = -dp/dx` and z from the lower plane: `tau = G (H/2 - z)`; the fluid shears where `|tau| > tau_0`,
//! `eta u' = tau - tau_0` below the plug. With `x = tau_0/(G H/2)` the half-plug is `x H/2`, and
//!
//! ```text
//! u_plug = G H^2/(8 eta) (1 - x)^2
//! U_mean = G H^2/(12 eta) (1 - 3 x/2 + x^3/2)
//! Bn     = tau_0 H/(eta U_mean) = 6 x/(1 - 3 x/2 + x^3/2)
//! ```
//!
//! Nothing moves for x >= 1. Source: Guyon, Hulin & Petit (2001), Hydrodynamique physique; Chauchat & Medale (2010), sec. 3.1.

pub(in crate::models) use super::bingham_case::PLANE;
pub(in crate::models) use super::bingham_case::plane;
pub use super::bingham_case::{BinghamDrive, BinghamPlane};
use super::{Column, balance, no_root, outcome, tabulate};

use crate::numerics::levels::{between_walls, graded};
use crate::numerics::quadrature::simpson;
use crate::numerics::root::brent;
use crate::result::{Failure, Outcome, Results, SolveError, Watch, quantity as q};
use crate::units::significant;

/// The closed form with its constants, in SI.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// -dp/dx [Pa/m]
    pub gradient: f64,
    /// 1 - x: share of the half-height that shears, 0 where nothing moves; kept instead of x for its digits at large Bn
    y: f64,
    h: f64,
    eta: f64,
}

impl Solution {
    /// The closed form for a problem. `see` receives the residuals of the search for the gradient.
    ///
    /// # Errors
    /// [`NumericalError::NoRoot`](crate::result::NumericalError::NoRoot) if the gradient for a wanted mean velocity is not found.
    pub fn new(plane: &BinghamPlane, see: impl FnMut(f64)) -> Result<Self, SolveError> {
        let BinghamPlane { eta, tau_0, h, .. } = *plane;
        match plane.drive {
            BinghamDrive::PressureGradient(gradient) => {
                let wall = 0.5 * gradient * h;
                Ok(Self { gradient, y: ((wall - tau_0) / wall).max(0.0), h, eta })
            }
            BinghamDrive::MeanVelocity(mean) => {
                let bn = tau_0 * h / (eta * mean);
                // Bn (1 - 3 x/2 + x^3/2) = 6 x has one root in [0, 1)
                let residual = |y: f64| (bn * y * y * (3.0 - y) / 2.0 - 6.0 * (1.0 - y)) / (6.0 + bn);
                let y = brent(residual, 0.0, 1.0, see).map_err(no_root("the plug for the wanted mean velocity"))?;
                Ok(Self { gradient: 24.0 * eta * mean / (h * h * y * y * (3.0 - y)), y, h, eta })
            }
        }
    }

    /// Elevation \[m] of the lower edge of the plug; 0 where nothing moves.
    #[must_use]
    pub fn edge(&self) -> f64 {
        0.5 * self.y * self.h
    }

    /// Distance \[m] from the centre to the yield surface.
    #[must_use]
    pub fn half_plug(&self) -> f64 {
        0.5 * (1.0 - self.y) * self.h
    }

    /// Velocity [m/s] at z \[m].
    #[must_use]
    pub fn velocity(&self, z: f64) -> f64 {
        let wall = z.min(self.h - z).clamp(0.0, self.edge());
        self.gradient / (2.0 * self.eta) * wall * (2.0 * self.edge() - wall)
    }

    /// Shear stress \[Pa] at z \[m].
    #[must_use]
    pub fn stress(&self, z: f64) -> f64 {
        self.gradient * (0.5 * self.h - z)
    }

    /// Magnitude of the shear rate [1/s] at z \[m].
    #[must_use]
    pub fn shear_rate(&self, z: f64) -> f64 {
        self.gradient / self.eta * (self.edge() - z.min(self.h - z)).max(0.0)
    }

    /// Mean velocity [m/s].
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.gradient * self.h * self.h / (24.0 * self.eta) * self.y * self.y * (3.0 - self.y)
    }
}

/// Evaluates the closed form on `cells` levels.
///
/// # Errors
/// As [`Solution::new`].
pub fn run(plane: &BinghamPlane, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let mut history = Vec::new();
    let solution = Solution::new(plane, |r| history.push(r))?;
    let (edge, upper) = (solution.edge(), plane.h - solution.edge());
    let sheared = match (edge > 0.0, solution.half_plug() > 0.0) {
        (true, true) => cells / 3,
        (true, false) => cells / 2,
        (false, _) => 0,
    };
    let mut faces = vec![0.0];
    for (a, b, n) in [(0.0, edge, sheared), (edge, upper, cells - 2 * sheared), (upper, plane.h, sheared)] {
        if b > a && n > 0 {
            faces.extend(graded(a, b, n, f64::INFINITY).into_iter().skip(1));
        }
    }
    let yielded = |z: f64| solution.stress(z).signum() * plane.tau_0;
    let columns: Vec<Column<'_>> = vec![
        (&q::U_MIXTURE, Box::new(|z| Some(solution.velocity(z)))),
        (
            &q::TAU_VISCOUS,
            Box::new(|z| Some(if solution.shear_rate(z) > 0.0 { solution.stress(z) - yielded(z) } else { 0.0 })),
        ),
        (
            &q::TAU_PARTICLE,
            Box::new(|z| Some(if solution.shear_rate(z) > 0.0 { yielded(z) } else { solution.stress(z) })),
        ),
        (&q::SHEAR_RATE, Box::new(|z| Some(solution.shear_rate(z)))),
    ];
    let profile = tabulate(between_walls(&faces), &columns, watch)?;
    let mut balances = vec![];
    if edge > 0.0 {
        let integral = 2.0 * simpson(|z| solution.velocity(z), 0.0, edge, 8)
            + 2.0 * solution.half_plug() * solution.velocity(edge);
        let how = "Simpson integral of the velocity against the closed form of the mean";
        balances.push(balance("discharge", integral / (solution.mean() * plane.h) - 1.0, how));
    }
    let results = results(plane, &solution);
    outcome(profile, history, results, balances, Vec::new())
}

fn results(plane: &BinghamPlane, solution: &Solution) -> Results {
    let mean = solution.mean();
    let mut results = Results::default();
    results.set(&q::DRIVE, solution.gradient);
    if mean > 0.0 {
        results.set(&q::BINGHAM, plane.tau_0 * plane.h / (plane.eta * mean));
    } else {
        results.undefined(&q::BINGHAM, "nothing moves: the stress at the walls does not exceed the yield stress");
    }
    results.set(&q::HALF_PLUG, solution.half_plug());
    results.set(&q::PLUG_VELOCITY, solution.velocity(0.5 * plane.h));
    results.set(&q::MEAN_VELOCITY, mean);
    results.set(&q::DISCHARGE, mean * plane.h);
    results.set(&q::FLOW_HEIGHT, plane.h);
    results.set(&q::REYNOLDS, plane.rho * mean * plane.h / plane.eta);
    results
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(plane: &BinghamPlane) -> String {
    let n = |x: f64| significant(x, 5);
    let drive = match plane.drive {
        BinghamDrive::PressureGradient(gradient) => format!("G = -dp/dx = {} Pa/m", n(gradient)),
        BinghamDrive::MeanVelocity(mean) => {
            format!(
                "G such that the mean velocity is {} m/s: Bn = τ_0 H/(η U_m) = {}",
                n(mean),
                n(plane.tau_0 * plane.h / (plane.eta * mean))
            )
        }
    };
    format!(
        "Bingham fluid between two planes, H = {h} m.\n\n\
         drive        {drive}\n\
         momentum     τ = G (H/2 - z)\n\
         yield        η |u'| = |τ| - τ_0 where |τ| > τ_0, u' = 0 elsewhere,  η = {eta} Pa s,  τ_0 = {tau} Pa\n\
         walls        u(0) = u(H) = 0\n\
         plug         z_0 = τ_0/G,  x = 2 z_0/H,  u_plug = G H²/(8 η) (1 - x)²\n\
         mean         U_m = G H²/(12 η) (1 - 3 x/2 + x³/2)\n",
        h = n(plane.h),
        eta = n(plane.eta),
        tau = n(plane.tau_0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn plane(tau_0: f64, drive: BinghamDrive) -> BinghamPlane {
        BinghamPlane { rho: 1000.0, eta: 2.0, tau_0, h: 0.5, drive }
    }

    fn solve(plane: &BinghamPlane) -> Solution {
        Solution::new(plane, |_| {}).unwrap()
    }

    #[test]
    fn velocity_by_integrating_the_yield_criterion() {
        let plane = plane(3.0, BinghamDrive::PressureGradient(40.0));
        let solution = solve(&plane);
        let slope = |z: f64| {
            let tau = 40.0 * (0.25 - z);
            tau.signum() * (tau.abs() - 3.0).max(0.0) / 2.0
        };
        let faces: [f64; 4] = [0.0, 0.25 - 3.0 / 40.0, 0.25 + 3.0 / 40.0, 0.5];
        let u = |z: f64| faces.windows(2).map(|p| simpson(slope, p[0].min(z), p[1].min(z), 1)).sum::<f64>();
        for z in [0.05, 0.15, 0.25, 0.4, 0.5] {
            assert_relative_eq!(u(z), solution.velocity(z), epsilon = 1e-14);
        }
        let mean = faces.windows(2).map(|p| simpson(u, p[0], p[1], 4)).sum::<f64>() / 0.5;
        assert_relative_eq!(mean, solution.mean(), max_relative = 1e-13);
        assert_eq!(solution.velocity(0.2), solution.velocity(0.3));
    }

    #[test]
    fn wanted_mean_velocity_from_newtonian_to_almost_rigid() {
        for tau_0 in [0.0, 1e-9, 1.0, 1e3, 1e9] {
            let solution = solve(&plane(tau_0, BinghamDrive::MeanVelocity(0.3)));
            assert_relative_eq!(solution.mean(), 0.3, max_relative = 1e-6);
        }
        let newtonian = solve(&plane(0.0, BinghamDrive::MeanVelocity(0.3)));
        assert_relative_eq!(newtonian.velocity(0.25), 0.45, max_relative = 1e-14);
    }

    #[test]
    fn bingham_number_ten_on_the_mean() {
        let unit = BinghamPlane { rho: 1.0, eta: 1.0, tau_0: 10.0, h: 1.0, drive: BinghamDrive::MeanVelocity(1.0) };
        let solution = solve(&unit);
        assert_relative_eq!(solution.half_plug(), 0.253_635, epsilon = 5e-7);
        assert_relative_eq!(solution.velocity(0.5), 1.196_521, epsilon = 5e-7);
    }

    #[test]
    fn the_stresses_of_the_profile_add_up_and_the_viscous_one_is_viscous() {
        let plane = plane(3.0, BinghamDrive::PressureGradient(40.0));
        let profile = run(&plane, 50, &mut crate::result::Quiet).unwrap().profile.unwrap();
        let column = |quantity| profile.get(quantity).unwrap().iter().map(|x| x.unwrap()).collect::<Vec<_>>();
        let [viscous, plastic, rate] = [&q::TAU_VISCOUS, &q::TAU_PARTICLE, &q::SHEAR_RATE].map(column);
        for (i, z) in profile.axis().into_iter().enumerate() {
            assert!((viscous[i] + plastic[i] - 40.0 * (0.5 * plane.h - z)).abs() < 1e-10);
            assert!((viscous[i].abs() - plane.eta * rate[i]).abs() < 1e-9, "{z}: {} {}", viscous[i], rate[i]);
        }
    }

    #[test]
    fn nothing_moves_below_the_yield_stress() {
        let solution = solve(&plane(3.0, BinghamDrive::PressureGradient(11.9)));
        assert_eq!(solution.mean(), 0.0);
        assert!((0..=10).all(|i| solution.velocity(0.05 * f64::from(i)) == 0.0));
        assert!(solve(&plane(3.0, BinghamDrive::PressureGradient(12.1))).mean() > 0.0);
    }
}
