//! Turbulence by a mixing length: `R_xz = rho_f l_m^2 |du/dz| du/dz`.

use super::Constant;
use super::role::role;
use crate::numerics::dual::Real;
pub use li_sawamoto::BelowPacked;

role! {
    /// Law of the mixing length.
    #[derive(Default)]
    pub enum MixingLength {
        #[default]
        none::None,
        prandtl::Prandtl(..),
        li_sawamoto::LiSawamoto(..),
        low_submergence::LowSubmergence(..),
    }

    /// What the laws of the mixing length answer.
    pub trait Length {
        /// Constants of the law.
        #[must_use]
        fn constants(&self) -> Vec<Constant>;
        /// Mixing lengths \[m] at the `faces` \[m], ascending from the wall, for the solid fractions `phi` of the cells between
        /// them. `lengths` has one entry per face, `phi` one fewer.
        fn fill(&self, faces: &[f64], phi: &[f64], lengths: &mut [f64]);
        /// What a layer of the solid fraction `phi` adds to the integral behind the mixing length, per height; 0 for a local law.
        #[must_use]
        fn clearance<T: Real>(&self, phi: T) -> T;
        /// Mixing length \[m] for the integral of [`Self::clearance`] from the wall \[m] and the solid fraction `phi` there.
        #[must_use]
        fn length<T: Real>(&self, integral: T, phi: T) -> T;
    }
}

fn karman() -> f64 {
    0.41
}

/// `kappa` times the integral, where that is more than nothing.
fn above_zero<T: Real>(integral: T, kappa: f64) -> T {
    if integral.value() > 0.0 { integral * kappa } else { T::constant(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_laws_agree_where_they_must() {
        let faces = [1.0, 1.5, 3.0];
        let fill = |law: MixingLength| {
            let mut lengths = [f64::NAN; 3];
            law.fill(&faces, &[0.0, 0.0], &mut lengths);
            lengths
        };
        let clear = LiSawamoto { kappa: 0.4, phi_max: 0.6, below_packed: BelowPacked::Published };
        assert_eq!(fill(MixingLength::None), [0.0; 3]);
        assert_eq!(fill(MixingLength::Prandtl(Prandtl { kappa: 0.4 })), [0.0, 0.2, 0.8]);
        assert_eq!(fill(MixingLength::LiSawamoto(clear)), [0.0, 0.2, 0.8]);
    }

    #[test]
    fn cell_by_cell_is_the_same_as_all_at_once() {
        let (faces, phi) = ([0.0, 1.0, 2.0, 4.0, 5.0], [0.63, 0.615, 0.3, 0.0]);
        let published = LiSawamoto { kappa: 0.41, phi_max: 0.61, below_packed: BelowPacked::Published };
        for law in [
            MixingLength::None,
            MixingLength::Prandtl(Prandtl { kappa: 0.41 }),
            MixingLength::LiSawamoto(published),
            MixingLength::LiSawamoto(LiSawamoto { below_packed: BelowPacked::Clipped, ..published }),
            MixingLength::LowSubmergence(LowSubmergence { scale: 3.0, least: 0.2, phi_max: 0.635 }),
        ] {
            let mut lengths = [f64::NAN; 5];
            law.fill(&faces, &phi, &mut lengths);
            let mut integral = 0.0;
            for f in 1..4 {
                integral += law.clearance(phi[f - 1]) * (faces[f] - faces[f - 1]);
                let found = law.length(integral, 0.5 * (phi[f - 1] + phi[f]));
                assert!((found - lengths[f]).abs() < 1e-15, "{law:?} {found} {}", lengths[f]);
            }
        }
    }
}
