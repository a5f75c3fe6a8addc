//! The radial distribution function at contact `g_0`: how much likelier than in a dilute gas two grains are to touch.
//!
//! ```text
//! Carnahan-Starling     g_0 = (2 - phi)/(2 (1 - phi)^3)
//! Torquato              as Carnahan-Starling up to phi_f = 0.49, then g_0(phi_f) (phi_max - phi_f)/(phi_max - phi)
//! Chialvo-Sundaresan    g_0 = (2 - phi)/(2 (1 - phi)^3) + a phi^2/(phi_max - phi)^(3/2),  a = 0.58
//! frictional            the same with a(mu_p) = 0.58 + 3.12 tanh(mu_p/0.54)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `phi`, `phi_max` | solid fraction, and the one at which grains touch all the time | 1 |
//! | `mu_p` | friction coefficient between two grains | 1 |
//!
//! All are 1 in the dilute limit; all but the first diverge at phi_max.
//! Source: Carnahan & Starling (1969); Torquato (1995), Phys. Rev. E 51, 3170; Chialvo & Sundaresan (2013); Chassagne et al.
//! (2023), eq. (2.23), (3.2)-(3.3).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Range, Standing};
use crate::numerics::dual::Real;

/// Frictionless and frictional coefficient of the divergence, and the friction at which it saturates: eq. (3.3).
const A_0: f64 = 0.58;
const A_MAX: f64 = 3.70;
const DELTA: f64 = 0.54;
/// Solid fraction at which hard spheres freeze.
const FREEZING: f64 = 0.49;

/// Solid fraction at which `g_0` diverges, of spheres packed at random.
pub const PHI_MAX: f64 = 0.635;
const DENSE: Range = Range { variable: "phi", min: 0.0, max: PHI_MAX };

/// Catalogue entries.
pub static CARNAHAN_STARLING: Info = Info {
    family: "granular.radial",
    law: "carnahan-starling",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³)",
    source: "Carnahan & Starling (1969)",
    ranges: &[Range { variable: "phi", min: 0.0, max: FREEZING }],
    standing: Standing::Validated,
};
/// See [`CARNAHAN_STARLING`].
pub static TORQUATO: Info = Info {
    family: "granular.radial",
    law: "torquato",
    equation: "g₀ by Carnahan-Starling up to φ_f = 0.49, then g₀(φ_f) (φ_max - φ_f)/(φ_max - φ)",
    source: "Torquato (1995)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};
/// See [`CARNAHAN_STARLING`].
pub static CHIALVO_SUNDARESAN: Info = Info {
    family: "granular.radial",
    law: "chialvo-sundaresan",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³) + 0.58 φ²/(φ_max - φ)^(3/2)",
    source: "Chialvo & Sundaresan (2013); Chassagne et al. (2023), eq. (2.23)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};
/// See [`CARNAHAN_STARLING`].
pub static FRICTIONAL: Info = Info {
    family: "granular.radial",
    law: "frictional",
    equation: "g₀ = (2 - φ)/(2 (1 - φ)³) + (0.58 + 3.12 tanh(μ_p/0.54)) φ²/(φ_max - φ)^(3/2)",
    source: "Chassagne et al. (2023), eq. (3.2)-(3.3)",
    ranges: &[DENSE],
    standing: Standing::Validated,
};

/// Radial distribution function at contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Radial {
    /// Hard spheres up to freezing.
    CarnahanStarling,
    /// Hard spheres, frozen ones too.
    Torquato,
    /// Smooth grains in simple shear.
    ChialvoSundaresan,
    /// Grains with friction.
    Frictional,
}

impl Radial {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(self) -> &'static Info {
        match self {
            Self::CarnahanStarling => &CARNAHAN_STARLING,
            Self::Torquato => &TORQUATO,
            Self::ChialvoSundaresan => &CHIALVO_SUNDARESAN,
            Self::Frictional => &FRICTIONAL,
        }
    }

    /// Coefficient a of the divergence, for the friction `mu_p` between two grains; 0 for the laws that have none.
    #[must_use]
    pub fn coefficient(self, mu_p: f64) -> f64 {
        match self {
            Self::CarnahanStarling | Self::Torquato => 0.0,
            Self::ChialvoSundaresan => A_0,
            Self::Frictional => A_0 + (A_MAX - A_0) * (mu_p / DELTA).tanh(),
        }
    }

    /// `g_0` at the solid fraction `phi`, whose distance to `phi_max` is `gap` > 0; `a` of [`Self::coefficient`].
    #[must_use]
    pub fn contact<T: Real>(self, phi: T, gap: T, a: f64) -> T {
        match self {
            Self::CarnahanStarling => carnahan_starling(phi),
            Self::Torquato if phi.value() <= FREEZING => carnahan_starling(phi),
            Self::Torquato => {
                let frozen = phi + gap - FREEZING;
                frozen / gap * carnahan_starling(FREEZING)
            }
            Self::ChialvoSundaresan | Self::Frictional => carnahan_starling(phi) + phi * phi * a / (gap * gap.sqrt()),
        }
    }
}

fn carnahan_starling<T: Real>(phi: T) -> T {
    let eps = -phi + 1.0;
    (-phi + 2.0) / (eps * eps * eps * 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const ALL: [Radial; 4] =
        [Radial::CarnahanStarling, Radial::Torquato, Radial::ChialvoSundaresan, Radial::Frictional];

    fn g0(law: Radial, phi: f64, mu_p: f64) -> f64 {
        law.contact(phi, 0.635 - phi, law.coefficient(mu_p))
    }

    #[test]
    fn dilute_and_dense_limits() {
        for law in ALL {
            assert_relative_eq!(g0(law, 1e-12, 0.4), 1.0, max_relative = 1e-11);
            // The second virial coefficient of hard spheres: 1 + 5/2 phi.
            assert!((g0(law, 1e-4, 0.0) - 1.0 - 2.5e-4).abs() < 1e-7);
        }
        for law in &ALL[1..] {
            assert!(g0(*law, 0.635 - 1e-9, 0.4) > 1e7);
        }
        assert!(g0(Radial::CarnahanStarling, 0.635, 0.4) < 15.0);
    }

    #[test]
    fn without_friction_the_laws_of_chialvo_coincide_and_friction_saturates() {
        assert_eq!(g0(Radial::Frictional, 0.55, 0.0), g0(Radial::ChialvoSundaresan, 0.55, 0.7));
        let law = Radial::Frictional;
        assert_relative_eq!(law.coefficient(20.0), 3.70, max_relative = 1e-12);
        // tanh(0.4/0.54) = 0.629592.
        assert_relative_eq!(law.coefficient(0.4), 0.58 + 3.12 * 0.629_592, max_relative = 1e-5);
        // 0.5: 1.5/0.25 = 6 and 0.58 0.25/0.135^1.5 = 2.92330.
        assert_relative_eq!(g0(Radial::ChialvoSundaresan, 0.5, 0.0), 8.923_30, max_relative = 1e-5);
    }

    #[test]
    fn torquato_is_continuous_at_freezing() {
        let (below, above) = (g0(Radial::Torquato, 0.49 - 1e-12, 0.0), g0(Radial::Torquato, 0.49 + 1e-12, 0.0));
        assert_relative_eq!(below, above, max_relative = 1e-10);
        assert_relative_eq!(g0(Radial::Torquato, 0.5625, 0.0), 2.0 * below, max_relative = 1e-10);
    }
}
