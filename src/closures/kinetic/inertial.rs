//! Dense granular flow in the same model: mu(I) and phi(I), the second solved for the pressure that spreads the grains.
//!
//! ```text
//! tau = mu(I) p,  mu(I) = mu_s + (mu_2 - mu_s)/(I_0/I + 1),  I = d |du_p/dz| (rho_p/p)^(1/2)
//! phi = phi_max/(1 + b I)   solved for p:   p = rho_p (b phi/(phi_max - phi))^2 (d du_p/dz)^2
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `p`, `tau` | particle pressure and shear stress | Pa |
//! | `mu_s`, `mu_2`, `I_0` | friction at rest and at large I, and the I half-way | 1 |
//! | `phi_max`, `b` | solid fraction at rest, slope of its fall | 1 |
//!
//! The square of d du_p/dz stands where kinetic theory has the granular temperature, and `(b phi/(phi_max - phi))^2` where it
//! has F1. Source: Maurin, Chauchat & Frey (2016); Chassagne et al. (2023), eq. (1.1)-(1.2).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Moving, Stresses};
use crate::closures::friction::{INERTIAL_RANGE, MuI};
use crate::closures::{Constant, Info, Standing};
use crate::numerics::dual::Real;

/// Solid fraction at rest of phi(I): Maurin, Chauchat & Frey (2016).
pub const PHI_C: f64 = 0.61;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular",
    law: "mu-i",
    equation: "τ_p = μ(I) p,  μ(I) = μ_s + (μ_2 - μ_s)/(I_0/I + 1),  p = p_el + ρ_p (b φ/(φ_max - φ))² (d du_p/dz)²",
    source: "Maurin, Chauchat & Frey (2016); Chassagne et al. (2023), eq. (1.1)-(1.2)",
    ranges: &[INERTIAL_RANGE],
    standing: Standing::Experimental,
};

/// Dense granular flow: mu(I) and phi(I).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Inertial {
    /// Friction coefficient at vanishing inertial number.
    #[serde(default = "mu_s")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
    /// Friction coefficient at large inertial number; more than mu_s.
    #[serde(default = "mu_2")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 3.0))]
    pub mu_2: f64,
    /// Inertial number at which the friction is half-way between mu_s and mu_2.
    #[serde(default = "i_0")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub i_0: f64,
    /// Slope b of the fall of the solid fraction with the inertial number.
    #[serde(default = "slope")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub b: f64,
}

fn mu_s() -> f64 {
    0.35
}

fn mu_2() -> f64 {
    0.97
}

fn i_0() -> f64 {
    0.69
}

fn slope() -> f64 {
    0.31
}

impl Default for Inertial {
    /// As published for bedload.
    fn default() -> Self {
        Self { mu_s: mu_s(), mu_2: mu_2(), i_0: i_0(), b: slope() }
    }
}

impl Stresses for Inertial {
    fn moving(&self, _: f64, _: f64) -> Moving {
        Moving::Inertial(*self)
    }

    fn parts(&self) -> Vec<&'static Info> {
        Vec::new()
    }
}

impl Inertial {
    /// Constants of the law.
    #[must_use]
    pub fn constants(&self) -> Vec<Constant> {
        vec![("μ_s", self.mu_s, ""), ("μ_2", self.mu_2, ""), ("I_0", self.i_0, ""), ("b", self.b, "")]
    }

    /// `(b phi/(phi_max - phi))^2/phi`, at the distance `gap` > 0 of `phi` to phi_max.
    #[must_use]
    pub fn pressure_per_grain<T: Real>(&self, phi: T, gap: T) -> T {
        phi / (gap * gap) * (self.b * self.b)
    }

    /// Friction coefficient at the inertial number `i`.
    #[must_use]
    pub fn mu<T: Real>(&self, i: T) -> T {
        i / (i + self.i_0) * (self.mu_2 - self.mu_s) + self.mu_s
    }

    /// The friction law alone.
    #[must_use]
    pub fn friction(&self) -> MuI {
        MuI { mu_s: self.mu_s, mu_2: self.mu_2, i_0: self.i_0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::friction::FrictionLaw;
    use approx::assert_relative_eq;

    const LAW: Inertial = Inertial { mu_s: 0.35, mu_2: 0.97, i_0: 0.69, b: 0.31 };

    #[test]
    fn the_pressure_gives_back_the_solid_fraction() {
        let (rho_p, rate, phi_max) = (2500.0, 3.0, 0.61);
        for phi in [0.2, 0.5, 0.6] {
            let p: f64 = rho_p * phi * LAW.pressure_per_grain(phi, phi_max - phi) * rate * rate;
            let i = rate * (rho_p / p).sqrt();
            assert_relative_eq!(phi_max / (1.0 + LAW.b * i), phi, max_relative = 1e-14);
        }
    }

    #[test]
    fn the_friction_is_that_of_its_family() {
        for i in [0.0, 0.1, 0.69, 20.0] {
            assert_relative_eq!(LAW.mu(i), LAW.friction().mu(i), max_relative = 1e-15);
        }
        assert_relative_eq!(LAW.mu(0.69), 0.66, max_relative = 1e-14);
        assert_eq!(toml::from_str::<Inertial>("").unwrap(), LAW);
    }
}
