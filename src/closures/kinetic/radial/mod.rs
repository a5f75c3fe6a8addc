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

use crate::closures::Range;
use crate::closures::role::role;
use crate::numerics::dual::Real;

/// Frictionless coefficient of the divergence: eq. (2.23).
const A_0: f64 = 0.58;
/// Solid fraction at which hard spheres freeze.
const FREEZING: f64 = 0.49;

/// Solid fraction at which `g_0` diverges, of spheres packed at random.
pub const PHI_MAX: f64 = 0.635;
const DENSE: Range = Range { variable: "phi", min: 0.0, max: PHI_MAX };

role! {
    /// Radial distribution function at contact.
    pub enum Radial as word {
        carnahan_starling::CarnahanStarling,
        torquato::Torquato,
        chialvo_sundaresan::ChialvoSundaresan,
        frictional::Frictional,
    }

    /// What the laws of the radial distribution function answer.
    pub trait AtContact {
        /// Coefficient a of the divergence, for the friction `mu_p` between two grains; 0 for the laws that have none.
        #[must_use]
        fn coefficient(&self, mu_p: f64) -> f64;
        /// `g_0` at the solid fraction `phi`, whose distance to `phi_max` is `gap` > 0; `a` of [`Self::coefficient`].
        #[must_use]
        fn contact<T: Real>(&self, phi: T, gap: T, a: f64) -> T;
    }
}

/// `g_0` of hard spheres below freezing.
fn hard_spheres<T: Real>(phi: T) -> T {
    let eps = -phi + 1.0;
    (-phi + 2.0) / (eps * eps * eps * 2.0)
}

/// The same with a term that diverges at phi_max.
#[inline]
fn diverging<T: Real>(phi: T, gap: T, a: f64) -> T {
    hard_spheres(phi) + phi * phi * a / (gap * gap.sqrt())
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
