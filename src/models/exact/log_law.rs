//! The logarithmic law: a turbulent layer of constant stress over a rough wall.
//!
//! With `l_m = kappa z` and `R_xz = rho_f l_m^2 u'^2 = rho_f u_*^2`: `u = (u_*/kappa) ln(z/z_0)` from `z_0 = k_s/30` up.
//! Viscosity is left out, which a fully rough wall (u_* k_s/nu above about 70) allows.
//! Sources: Prandtl (1925), Nikuradse (1933).

pub use super::log_law_case::RoughWall;
use super::{Column, balance, closure_name, outcome, outside, tabulate};
use crate::closures::mixing_length::{Length, prandtl};
use crate::closures::wall::rough;
use crate::numerics::quadrature::simpson;
use crate::result::{Failure, Outcome, Results, Watch, quantity as q};
use crate::units::{significant, stated};

/// The closed form with its constants, in SI.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// roughness length \[m]
    pub z_0: f64,
    scale: f64,
    h: f64,
}

impl Solution {
    /// The closed form for a wall.
    #[must_use]
    pub fn new(wall: &RoughWall) -> Self {
        Self { z_0: wall.wall.roughness_length(), scale: wall.u_star / wall.mixing_length.kappa, h: wall.h }
    }

    /// Velocity [m/s] at z \[m]; 0 below the roughness length.
    #[must_use]
    pub fn velocity(&self, z: f64) -> f64 {
        self.scale * (z / self.z_0).ln().max(0.0)
    }

    /// Velocity gradient [1/s] at z \[m].
    #[must_use]
    pub fn shear_rate(&self, z: f64) -> f64 {
        self.scale / z
    }

    /// Integral of the velocity from the roughness length to the flow height [m2/s].
    #[must_use]
    pub fn discharge(&self) -> f64 {
        self.scale * (self.h * (self.h / self.z_0).ln() - self.h + self.z_0)
    }
}

/// Evaluates the closed form from the roughness length to the flow height, on levels evenly spaced in the logarithm of z.
///
/// # Errors
/// [`Failure`] if a value is not finite.
pub fn run(wall: &RoughWall, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let solution = Solution::new(wall);
    let span = (wall.h / solution.z_0).ln();
    let levels = (0..=cells)
        .map(|i| if i == cells { wall.h } else { solution.z_0 * (span * i as f64 / cells as f64).exp() })
        .collect();
    let tau = wall.rho_f * wall.u_star * wall.u_star;
    let length = |z: f64| wall.mixing_length.length(z, 0.0);
    let columns: Vec<Column<'_>> = vec![
        (&q::U_FLUID, Box::new(|z| Some(solution.velocity(z)))),
        (&q::TAU_REYNOLDS, Box::new(move |_| Some(tau))),
        (&q::MIXING_LENGTH, Box::new(move |z| Some(length(z)))),
        (&q::EDDY_VISCOSITY, Box::new(|z| Some(length(z) * length(z) * solution.shear_rate(z)))),
    ];
    let profile = tabulate(levels, &columns, watch)?;
    let middle = (solution.z_0 * wall.h).sqrt();
    let stress = wall.rho_f * (length(middle) * solution.shear_rate(middle)).powi(2);
    // dz = z d(ln z)
    let integral = simpson(|x| x.exp() * solution.velocity(x.exp()), solution.z_0.ln(), wall.h.ln(), 400);
    let balances = vec![
        balance(
            "momentum",
            stress / tau - 1.0,
            "Reynolds stress of the velocity gradient against the stress at the wall",
        ),
        balance(
            "discharge",
            integral / solution.discharge() - 1.0,
            "Simpson integral of the velocity against the closed form",
        ),
    ];
    let mut results = Results::default();
    results.set(&q::U_STAR, wall.u_star);
    results.set(&q::SURFACE_VELOCITY, solution.velocity(wall.h));
    results.set(&q::MEAN_VELOCITY, solution.discharge() / wall.h);
    results.set(&q::DISCHARGE, solution.discharge());
    results.set(&q::ROUGHNESS, wall.wall.k_s);
    results.set(&q::ROUGHNESS_LENGTH, solution.z_0);
    let roughness_reynolds = wall.u_star * wall.wall.k_s * wall.rho_f / wall.eta;
    results.set(&q::REYNOLDS_ROUGHNESS, roughness_reynolds);
    results.set(&q::REYNOLDS, wall.rho_f * solution.discharge() / wall.eta);
    results.set(&q::FLOW_HEIGHT, wall.h);
    let validity = outside(closure_name(&rough::INFO), &rough::ROUGH_RANGE, roughness_reynolds);
    outcome(profile, Vec::new(), results, balances, validity.into_iter().collect())
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(wall: &RoughWall) -> String {
    let n = |x: f64| significant(x, 5);
    format!(
        "Turbulent layer of constant stress over a rough wall, H = {h} m.\n\n\
         stress         R_xz = ρ_f l_m² u'² = ρ_f u_*²,  u_* = {u_star} m/s,  ρ_f = {rho} kg/m³\n\
         mixing length  {mixing}\n\
         wall           {rough},  z_0 = {z_0} m\n\
         velocity       u = (u_*/κ) ln(z/z_0)\n",
        h = n(wall.h),
        u_star = n(wall.u_star),
        rho = n(wall.rho_f),
        mixing = stated(prandtl::INFO.equation, &wall.mixing_length.constants()),
        rough = rough::INFO.equation,
        z_0 = n(wall.wall.roughness_length()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::mixing_length::Prandtl;
    use crate::closures::wall::Rough;
    use approx::assert_relative_eq;

    const WALL: RoughWall = RoughWall {
        rho_f: 1000.0,
        eta: 1e-3,
        h: 0.1,
        u_star: 0.05,
        mixing_length: Prandtl { kappa: 0.41 },
        wall: Rough { k_s: 6e-3 },
    };

    #[test]
    fn velocity_by_integrating_the_stress() {
        // u' = u_*/l_m, from the stress and the mixing length alone.
        let solution = Solution::new(&WALL);
        let slope = |z: f64| WALL.u_star / WALL.mixing_length.length(z, 0.0);
        for z in [1e-3, 1e-2, 0.1] {
            let u = simpson(|x| x.exp() * slope(x.exp()), solution.z_0.ln(), f64::ln(z), 10);
            assert_relative_eq!(u, solution.velocity(z), max_relative = 1e-13);
        }
    }

    #[test]
    fn slope_against_the_logarithm_is_one_over_kappa() {
        let solution = Solution::new(&WALL);
        let slope = (solution.velocity(0.08) - solution.velocity(0.02)) / (0.08_f64 / 0.02).ln() / WALL.u_star;
        assert_relative_eq!(slope, 1.0 / 0.41, max_relative = 1e-13);
        assert_eq!(solution.velocity(1e-5), 0.0);
    }

    #[test]
    fn discharge_by_quadrature() {
        let solution = Solution::new(&WALL);
        let integral = simpson(|x| x.exp() * solution.velocity(x.exp()), solution.z_0.ln(), WALL.h.ln(), 1000);
        assert_relative_eq!(integral, solution.discharge(), max_relative = 1e-10);
    }
}
