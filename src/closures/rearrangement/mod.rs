//! Time that a grain needs to fall into the gap below it: the clock of the inertial number, `I = t_micro |du_p/dz|`.
//!
//! | regime | t_micro |
//! |---|---|
//! | free fall | `d sqrt(rho_p/P_p)` |
//! | viscous | `eta/P_p` |
//! | turbulent | `d sqrt(rho_f C/P_p)`, `C = (4/3)(0.3 + 18.3/Re)`, `Re = rho_f \|U - u_p\| d/eta` |
//!
//! The largest of the three counts. The source writes the dimensional drag coefficient under the last root; only a pure
//! number gives a time, and C is that of the same drag law for a single grain at the local slip. `St` is the ratio of the
//! free-fall to the viscous time, `r` that of the free-fall to the turbulent one. All times grow without bound where the
//! pressure vanishes, and the turbulent one where the slip does: the functions give rates, 1/t, which vanish there.
//! Source: Courrech du Pont et al. (2003), Phys. Rev. Lett. 90, 044301; Cassar, Nicolas & Pouliquen (2005), Phys. Fluids 17,
//! 103301; Revil-Baudard & Chauchat (2013), sec. 2.1.3.

use super::drag::dallavalle;
use super::role::role;
use crate::numerics::dual::Real;

role! {
    /// Which times count.
    #[derive(Default)]
    pub enum Rearrangement {
        #[default]
        largest::Largest,
        free_fall::FreeFall,
    }

    /// What the laws of the rearrangement time answer.
    pub trait Clock {
        /// The inverse of the time that counts [1/s], under the pressure `p` \[Pa] at the slip `w` [m/s].
        #[must_use]
        fn rate<T: Real>(&self, grain: &Grain, p: T, w: T) -> T;
        /// Which time counts there.
        #[must_use]
        fn regime(&self, grain: &Grain, p: f64, w: f64) -> Regime;
    }
}

/// Which time is the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// the inertia of the grain
    FreeFall,
    /// the viscosity of the fluid
    Viscous,
    /// the inertia of the fluid
    Turbulent,
}

/// What the times need to know. Any consistent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// diameter \[m]
    pub d: f64,
    /// density [kg/m3]
    pub rho_p: f64,
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
}

impl Grain {
    /// Inverse times [1/s] of free, viscous and turbulent fall under the pressure `p` \[Pa] at the slip `w` [m/s].
    #[must_use]
    pub fn rates<T: Real>(&self, p: T, w: T) -> [T; 3] {
        let inverse = dallavalle::inverse_number(w, (self.rho_f, self.eta), self.d);
        let turbulent = (p * inverse / self.rho_f).sqrt() / self.d;
        [(p / self.rho_p).sqrt() / self.d, p / self.eta, turbulent]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const BEAD: Grain = Grain { d: 1e-3, rho_p: 2500.0, rho_f: 1000.0, eta: 1e-3 };

    #[test]
    fn times_by_hand() {
        let [free, viscous, turbulent] = BEAD.rates(10.0, 0.1);
        assert_relative_eq!(1.0 / free, 0.015_811_388, max_relative = 1e-7);
        assert_relative_eq!(1.0 / viscous, 1e-4, max_relative = 1e-14);
        // C = 4/3 (0.3 + 18.3/100) = 0.644: 1e-3 sqrt(64.4)
        assert_relative_eq!(1.0 / turbulent, 0.008_024_961, max_relative = 1e-6);
        assert_relative_eq!(Rearrangement::Largest.rate(&BEAD, 10.0, 0.1), free);
    }

    #[test]
    fn each_regime_has_its_place() {
        let regime = |grain: &Grain, w| Rearrangement::Largest.regime(grain, 10.0, w);
        assert_eq!(regime(&BEAD, 0.1), Regime::FreeFall);
        assert_eq!(regime(&BEAD, 1e-3), Regime::Turbulent);
        assert_eq!(regime(&Grain { eta: 10.0, ..BEAD }, 10.0), Regime::Viscous);
        assert_eq!(Rearrangement::FreeFall.regime(&BEAD, 10.0, 1e-3), Regime::FreeFall);
        assert_eq!(Rearrangement::Largest.rate(&BEAD, 10.0, 0.0), 0.0);
    }
}
