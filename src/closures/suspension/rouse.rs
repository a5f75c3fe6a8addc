//! Settling against turbulent diffusion: `w_s phi + nu_t dphi/dz = 0`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `w_s` | settling velocity | m/s |
//! | `nu_t` | eddy viscosity eta_t/rho_f | m2/s |
//! | `phi` | solid fraction | 1 |
//!
//! With `nu_t = kappa u_* z (1 - z/h)` it is Rouse's power law of exponent `w_s/(kappa u_*)`. Where the
//! settling velocity is not given it is that of a sphere; no drag law of spheres gives that of cylinders (0.072 m/s for those
//! of Sumer et al.).
//! Source: Rouse (1937), Trans. ASCE 102, 463-505; Revil-Baudard & Chauchat (2013), eq. (26)-(27).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Settling;
use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// The highest reference that fitted measured profiles.
pub const RANGE: Range = Range { variable: "phi_interface", min: 0.0, max: 0.25 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "suspension",
    law: "rouse",
    equation: "w_s φ + ν_t dφ/dz = 0",
    source: "Rouse (1937); Revil-Baudard & Chauchat (2013), eq. (26)-(27)",
    ranges: &[RANGE],
    standing: Standing::Validated,
};

/// Settling against turbulent diffusion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rouse {
    /// Settling velocity of the grains [m/s], of the scene.
    #[serde(skip)]
    pub settling_velocity: Option<f64>,
}

impl Settling for Rouse {
    fn settling_velocity(&self) -> Option<f64> {
        self.settling_velocity
    }
}

/// Fall of ln(phi) per height [1/m] of grains that settle at `w_s` [m/s], for the eddy viscosity `nu_t` [m2/s].
#[must_use]
pub fn decay<T: Real>(w_s: f64, nu_t: T) -> T {
    T::constant(w_s) / nu_t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::quadrature::simpson;
    use approx::assert_relative_eq;

    #[test]
    fn the_power_law_of_rouse() {
        // nu_t = kappa u_* z (1 - z/h) from a to z: phi/phi_a = ((h - z)/z a/(h - a))^(w_s/(kappa u_*))
        let (kappa, u_star, h, a, z) = (0.4, 0.1, 1.0, 0.05, 0.6);
        let exponent = -simpson(|z| decay(0.03, kappa * u_star * z * (1.0 - z / h)), a, z, 4000);
        let expect = ((h - z) / z * a / (h - a)).powf(0.03 / (kappa * u_star));
        assert_relative_eq!(exponent.exp(), expect, max_relative = 1e-9);
    }
}
