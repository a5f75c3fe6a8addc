//! Settling velocity of a single sphere in still fluid.
//!
//! `C_D w^2 = (4/3) (rho_p/rho_f - 1) g d`, `C_D = (24/Re) (1 + 0.27 Re)^0.43 + 0.47 (1 - exp(-0.04 Re^0.38))`, `Re = w d/nu`.
//!
//! The drag laws of the models, `0.4 + 24.4/Re`, are too low between the regimes of Stokes and Newton: glass beads of 0.25 mm settle
//! at 0.0326 m/s (Cowen et al. 2010), where this law has 0.0327 and they have 0.0452. At 6 mm both have 0.537.
//!
//! Source: Cheng (2009), Powder Technol. 189, 395-398, fitted to measurements of spheres at Re below 2e5.

use crate::numerics::root::brent;

/// `C_D Re^2` of a sphere.
fn drag(re: f64) -> f64 {
    24.0 * re * (1.0 + 0.27 * re).powf(0.43) + 0.47 * re * re * (1.0 - (-0.04 * re.powf(0.38)).exp())
}

/// Settling velocity [m/s] of a sphere of diameter `d` \[m] under the buoyant gravity `(rho_p/rho_f - 1) g` [m/s2] in a fluid of
/// kinematic viscosity `nu` [m2/s]; 0 for one that does not sink.
#[must_use]
pub fn sphere(buoyant: f64, nu: f64, d: f64) -> f64 {
    let weight = 4.0 / 3.0 * buoyant * d.powi(3) / (nu * nu);
    if weight.is_nan() || weight <= 0.0 {
        return 0.0;
    }
    // The drag of Stokes is less, so its sphere is faster.
    let stokes = weight / 24.0;
    brent(|re| drag(re) - weight, 0.0, stokes, |_| ()).unwrap_or(f64::NAN) * nu / d
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const WATER: f64 = 1e-6;

    #[test]
    fn spheres_settle_as_the_same_law_solved_elsewhere() {
        // Bisection in another language, to five digits.
        for (s, d, w) in [(2.6, 5e-4, 0.07466), (2.6, 2.5e-4, 0.03274), (2.5, 6e-3, 0.537), (1.14, 2.6e-3, 0.07759)] {
            assert_relative_eq!(sphere((s - 1.0) * 9.81, WATER, d), w, max_relative = 2e-4);
        }
    }

    #[test]
    fn the_limits_are_those_of_stokes_and_newton() {
        let buoyant = 1.5 * 9.81;
        let d = 1e-6;
        assert_relative_eq!(sphere(buoyant, WATER, d), buoyant * d * d / (18.0 * WATER), max_relative = 1e-4);
        let fast = sphere(buoyant, 1e-9, 6e-3);
        assert_relative_eq!(fast, (4.0 / 3.0 * buoyant * 6e-3 / 0.47).sqrt(), max_relative = 0.02);
    }

    #[test]
    fn beads_settle_as_measured() {
        // Glass beads of Cowen et al. (2010).
        assert_relative_eq!(sphere(1.6 * 9.81, WATER, 2.5e-4), 0.0326, max_relative = 0.01);
    }

    #[test]
    fn what_floats_does_not_settle() {
        assert_eq!(sphere(-1.0, WATER, 1e-3), 0.0);
        assert_eq!(sphere(0.0, WATER, 1e-3), 0.0);
    }
}
