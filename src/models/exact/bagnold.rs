//! Bagnold's film: dry grains with the mu(I) rheology down a slope.
//!
//! Momentum gives `tau_p/P_p = tan(beta)` at every depth, so the inertial number is uniform, `mu(I) = tan(beta)`, and with
//! `P_p = phi rho_p g cos(beta) (H - z)` and `u' = I sqrt(P_p/rho_p)/d`
//!
//! ```text
//! I = I_0/((mu_2 - mu_s)/(tan(beta) - mu_s) - 1)
//! u = (2/3) (I/d) sqrt(phi g cos(beta)) (H^1.5 - (H - z)^1.5)
//! q = phi (2/5) (I/d) sqrt(phi g cos(beta)) H^2.5
//! ```
//!
//! At rest for tan(beta) <= mu_s; no steady flow for tan(beta) >= mu_2.
//! Sources: Bagnold (1954), Proc. R. Soc. A 225, 49-63; GDR MiDi (2004), Eur. Phys. J. E 14, 341-365.

pub use super::bagnold_case::GranularFilm;
use super::{Column, balance, closure_name, outcome, outside, tabulate};
use crate::closures::friction::{FrictionLaw, INERTIAL_RANGE, mu_i};
use crate::models::exact::ExactError;
use crate::numerics::levels::{between_walls, graded};
use crate::numerics::quadrature::simpson;
use crate::result::{Failure, Outcome, Results, Validity, Watch, quantity as q};
use crate::units::significant;

/// The closed form with its constants, in SI.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// inertial number, uniform over the film
    pub inertial_number: f64,
    /// (I/d) sqrt(phi g cos(beta)) [m^-1/2 s^-1]
    rate: f64,
    h: f64,
}

impl Solution {
    /// The closed form for a film.
    ///
    /// # Errors
    /// [`ExactError::NoSteadyFilm`] on a slope that accelerates the grains without end.
    pub fn new(film: &GranularFilm) -> Result<Self, ExactError> {
        let tangent = film.beta.tan();
        let inertial_number = film
            .friction
            .inertial_number(tangent)
            .ok_or(ExactError::NoSteadyFilm { tangent, mu_2: film.friction.mu_2 })?;
        let rate = inertial_number / film.d * (film.phi * film.g * film.beta.cos()).sqrt();
        Ok(Self { inertial_number, rate, h: film.h })
    }

    /// Velocity [m/s] at z \[m].
    #[must_use]
    pub fn velocity(&self, z: f64) -> f64 {
        2.0 / 3.0 * self.rate * (self.h.powf(1.5) - (self.h - z).max(0.0).powf(1.5))
    }

    /// Shear rate [1/s] at z \[m].
    #[must_use]
    pub fn shear_rate(&self, z: f64) -> f64 {
        self.rate * (self.h - z).max(0.0).sqrt()
    }

    /// Volume of moving material with its pores per unit width and time [m2/s].
    #[must_use]
    pub fn discharge(&self) -> f64 {
        0.4 * self.rate * self.h.powf(2.5)
    }
}

/// Evaluates the closed form on `cells` levels.
///
/// # Errors
/// As [`Solution::new`].
pub fn run(film: &GranularFilm, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let solution = Solution::new(film)?;
    let weight = film.phi * film.rho_p * film.g;
    let pressure = |z: f64| weight * film.beta.cos() * (film.h - z);
    let columns: Vec<Column<'_>> = vec![
        (&q::PHI, Box::new(|_| Some(film.phi))),
        (&q::U_PARTICLE, Box::new(|z| Some(solution.velocity(z)))),
        (&q::FLUX, Box::new(|z| Some(film.phi * solution.velocity(z)))),
        (&q::TAU_PARTICLE, Box::new(|z| Some(weight * film.beta.sin() * (film.h - z)))),
        (&q::P_PARTICLE, Box::new(move |z| Some(pressure(z)))),
        (&q::SHEAR_RATE, Box::new(|z| Some(solution.shear_rate(z)))),
        (&q::INERTIAL_NUMBER, Box::new(|_| Some(solution.inertial_number))),
    ];
    let profile = tabulate(between_walls(&graded(0.0, film.h, cells, f64::INFINITY)), &columns, watch)?;
    let mut balances = Vec::new();
    if solution.discharge() > 0.0 {
        let friction = film.friction.mu(solution.inertial_number) / film.beta.tan() - 1.0;
        balances.push(balance(
            "momentum",
            friction,
            "friction at the inertial number against the tangent of the slope",
        ));
        // In x = sqrt(H - z) the integrand is a quartic.
        let top = film.h.sqrt();
        let integral = simpson(|x| 2.0 * x * solution.velocity(film.h - x * x), 0.0, top, 2000);
        let how = "Simpson integral of the velocity against the closed form";
        balances.push(balance("transport_rate", integral / solution.discharge() - 1.0, how));
    }
    outcome(profile, Vec::new(), results(film, &solution), balances, validity(film, &solution))
}

fn results(film: &GranularFilm, solution: &Solution) -> Results {
    let discharge = solution.discharge();
    let mut results = Results::default();
    results.set(&q::TRANSPORT_RATE, film.phi * discharge);
    results.set(&q::TRANSPORT_RATE_MASS, film.phi * discharge * film.rho_p);
    results.set(&q::TRANSPORT_RATE_BULK, discharge);
    results.undefined(&q::TRANSPORT_RATE_DIMENSIONLESS, "no fluid: the density ratio is not defined");
    results.set(&q::INERTIAL_NUMBER_FILM, solution.inertial_number);
    results.set(&q::WELL_POSEDNESS, film.friction.well_posedness(solution.inertial_number));
    results.set(&q::SURFACE_VELOCITY, solution.velocity(film.h));
    results.set(&q::MEAN_VELOCITY, discharge / film.h);
    results.set(&q::FLOW_HEIGHT, film.h);
    results.set(&q::PHI_INTERFACE, film.phi);
    results
}

fn validity(film: &GranularFilm, solution: &Solution) -> Vec<Validity> {
    let (name, i) = (closure_name(&mu_i::INFO), solution.inertial_number);
    let far = outside(name.clone(), &INERTIAL_RANGE, i);
    let ill = i > 0.0 && film.friction.well_posedness(i) > 0.0;
    let interval =
        film.friction.well_posed().map(|(low, high)| format!("{} to {}", significant(low, 3), significant(high, 3)));
    let range = format!("well-posed in two and three dimensions for {}", interval.unwrap_or_else(|| "no value".into()));
    let posed = ill.then(|| Validity { closure: name, variable: "inertial_number".into(), value: i, range, z_m: None });
    far.into_iter().chain(posed).collect()
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(film: &GranularFilm) -> String {
    let n = |x: f64| significant(x, 5);
    let law = film.friction;
    format!(
        "Dry grains down a slope, film thickness H = {h} m, d = {d} m, φ = {phi}.\n\n\
         pressure     P_p = φ ρ_p g cos β (H - z),  ρ_p = {rho} kg/m³\n\
         momentum     τ_p = P_p tan β,  tan β = {tangent}\n\
         friction     {law},  μ_s = {mu_s}, μ_2 = {mu_2}, I_0 = {i_0}\n\
         inertia      I = d u' sqrt(ρ_p/P_p) = I_0/((μ_2 - μ_s)/(tan β - μ_s) - 1), the same at every depth\n\
         velocity     u = (2/3) (I/d) sqrt(φ g cos β) (H^1.5 - (H - z)^1.5)\n\
         rest         for tan β <= μ_s; no steady flow for tan β >= μ_2\n",
        h = n(film.h),
        d = n(film.d),
        phi = n(film.phi),
        rho = n(film.rho_p),
        tangent = n(film.beta.tan()),
        mu_s = n(law.mu_s),
        mu_2 = n(law.mu_2),
        i_0 = n(law.i_0),
        law = mu_i::INFO.equation,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::friction::MuI;
    use crate::numerics::root::brent;
    use approx::assert_relative_eq;

    fn film(degrees: f64) -> GranularFilm {
        GranularFilm {
            rho_p: 2500.0,
            d: 5e-4,
            phi: 0.6,
            h: 0.02,
            beta: degrees.to_radians(),
            g: 9.81,
            friction: MuI { mu_s: 0.38, mu_2: 0.64, i_0: 0.279 },
        }
    }

    #[test]
    fn velocity_by_inverting_the_rheology_at_every_depth() {
        let film = film(24.0);
        let solution = Solution::new(&film).unwrap();
        let shear = |z: f64| {
            let p = film.phi * film.rho_p * film.g * film.beta.cos() * (film.h - z);
            let tau = film.phi * film.rho_p * film.g * film.beta.sin() * (film.h - z);
            let root = |rate: f64| film.friction.mu(film.d * rate * (film.rho_p / p).sqrt()) * p - tau;
            brent(root, 0.0, 1e5, |_| {}).unwrap()
        };
        for z in [0.005, 0.01, 0.018] {
            let integral = simpson(shear, 0.0, z, 50);
            assert_relative_eq!(integral, solution.velocity(z), max_relative = 1e-7);
        }
        let discharge = simpson(|x| 2.0 * x * solution.velocity(film.h - x * x), 0.0, film.h.sqrt(), 200);
        assert_relative_eq!(discharge, solution.discharge(), max_relative = 1e-9);
    }

    #[test]
    fn in_units_of_the_grain() {
        // u = (2/3) I sqrt(phi cos b) (H^1.5 - (H - z)^1.5) in sqrt(g d), d
        let film = film(24.0);
        let solution = Solution::new(&film).unwrap();
        let (h, z) = (40.0_f64, 25.0);
        let scaled =
            2.0 / 3.0 * solution.inertial_number * (0.6 * film.beta.cos()).sqrt() * (h.powf(1.5) - (h - z).powf(1.5));
        assert_relative_eq!(solution.velocity(z * film.d), scaled * (9.81 * film.d).sqrt(), max_relative = 1e-13);
    }

    #[test]
    fn the_profile_is_in_equilibrium() {
        let film = film(24.0);
        let profile = run(&film, 50, &mut crate::result::Quiet).unwrap().profile.unwrap();
        let column = |quantity| profile.get(quantity).unwrap().iter().map(|x| x.unwrap()).collect::<Vec<_>>();
        let (stress, pressure) = (column(&q::TAU_PARTICLE), column(&q::P_PARTICLE));
        for (i, z) in profile.axis().into_iter().enumerate() {
            let weight = film.phi * film.rho_p * film.g * (film.h - z);
            assert_relative_eq!(stress[i].hypot(pressure[i]), weight, max_relative = 1e-12);
            assert!((stress[i] - film.beta.tan() * pressure[i]).abs() < 1e-12 * weight.max(1e-3));
        }
    }

    #[test]
    fn rest_and_runaway() {
        assert_eq!(Solution::new(&film(20.0)).unwrap().discharge(), 0.0);
        assert!(matches!(Solution::new(&film(33.0)), Err(ExactError::NoSteadyFilm { .. })));
        assert!(Solution::new(&film(32.6)).unwrap().inertial_number > 50.0);
    }
}
