//! Friction of the side walls of a channel, level by level: `tau_w = rho_f (f/8) u |u|` on each of two walls at the distance W,
//! so `eps rho_f (2/W) (f/8) u |u|` per volume.
//!
//! Source: the side-wall method of Einstein (1942), as Maurin et al. (2015) apply it at each level.

mod implicit;

use super::role::role;

role! {
    /// Law of the friction factor of the side walls.
    #[derive(Default, Eq)]
    pub enum SideWall {
        #[default]
        none::None,
        graf_altinakar_published::GrafAltinakarPublished,
        graf_altinakar::GrafAltinakar,
        blasius::Blasius,
    }

    /// What the laws of the side walls answer.
    trait WallFriction {
        /// The friction at the Reynolds number `re`.
        fn friction(&self, re: f64) -> Friction;
    }
}

/// What the laws return: finite at rest, where f is not.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Friction {
    /// f Re
    times_reynolds: f64,
    /// d ln f/d ln Re
    slope: f64,
}

/// The stress of one wall and its derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallStress {
    /// tau_w/rho_f [m2/s2], with the sign of the velocity
    pub value: f64,
    /// d(tau_w/rho_f)/du [m/s], not negative
    pub derivative: f64,
}

impl SideWall {
    /// Darcy friction factor f at `re` = |u| W/nu; infinite at rest.
    #[must_use]
    pub fn friction_factor(self, re: f64) -> f64 {
        match self {
            Self::None => 0.0,
            _ => self.friction(re).times_reynolds / re,
        }
    }

    /// The stress of one wall, for the velocity `u` [m/s], the width `width` \[m] and the kinematic viscosity `nu` [m2/s].
    #[must_use]
    pub fn stress(self, u: f64, width: f64, nu: f64) -> WallStress {
        if self == Self::None {
            return WallStress::default();
        }
        let Friction { times_reynolds, slope } = self.friction(u.abs() * width / nu);
        // f |u|/8 = f Re nu/(8 W)
        let rate = times_reynolds * nu / (8.0 * width);
        WallStress { value: rate * u, derivative: rate * (2.0 + slope) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAWS: [SideWall; 3] = [SideWall::GrafAltinakarPublished, SideWall::GrafAltinakar, SideWall::Blasius];

    #[test]
    fn values_in_a_narrow_flume() {
        // Roots found by bisection elsewhere, to the digits given.
        for (law, f) in LAWS.into_iter().zip([0.005_213_972_9, 0.030_200_947_8, 0.030_230_209_9]) {
            assert_relative_eq!(law.friction_factor(1.2e4), f, max_relative = 1e-8);
        }
        assert_eq!(SideWall::None.friction_factor(1.2e4), 0.0);
        assert_eq!(SideWall::None.stress(1.0, f64::INFINITY, 1e-6), WallStress::default());
    }

    #[test]
    fn the_implicit_equations_hold_to_round_off() {
        for re in [10.0, 321.0, 1e4, 1e6, 1e9] {
            let f = SideWall::GrafAltinakarPublished.friction_factor(re);
            assert_relative_eq!(f, (2.0 * (re * f.sqrt()).ln() + 0.32).powi(-2), max_relative = 4e-15);
            let f = SideWall::GrafAltinakar.friction_factor(re);
            assert_relative_eq!(f, (2.0 * (re * f.sqrt() / 4.0).log10() + 0.32).powi(-2), max_relative = 4e-15);
        }
    }

    #[test]
    fn the_derivative_is_the_derivative() {
        let (width, nu) = (6.5e-3, 1e-6);
        for law in LAWS {
            for u in [-0.8, -1e-3, -2e-4, 1e-4, 0.01, 0.3, 2.0] {
                let (h, s) = (1e-6 * u, |u: f64| law.stress(u, width, nu));
                let difference = (s(u + h).value - s(u - h).value) / (2.0 * h);
                assert_relative_eq!(s(u).derivative, difference, max_relative = 1e-8);
                assert_relative_eq!(s(-u).value, -s(u).value);
            }
        }
    }

    #[test]
    fn at_rest_and_where_the_branches_meet() {
        // The stress vanishes at rest, in proportion to the velocity, and neither jumps nor falls.
        for law in LAWS {
            let s = |re: f64| law.stress(re, 1.0, 1.0);
            assert_eq!(s(0.0).value, 0.0);
            assert!(s(0.0).derivative > 0.0);
            assert_relative_eq!(s(1.0).value, s(0.0).derivative, max_relative = 1e-15);
            for i in 0..4000 {
                let re = 1.003_f64.powi(i);
                assert!(s(re * 1.003).value > s(re).value, "{law:?} at {re}");
                assert!(s(re * 1.003).value < s(re).value * 1.01, "{law:?} at {re}");
            }
        }
        // Published and textbook: the slope is continuous too, at Re_l = a s exp(1 - c/a).
        for (law, limit) in [(LAWS[0], 2.0 * 0.84_f64.exp()), (LAWS[1], 6.533_844)] {
            let slope = |re: f64| law.stress(re, 1.0, 1.0).derivative;
            assert_relative_eq!(slope(limit * 1.001), slope(limit * 0.999), max_relative = 2e-3);
        }
        // Laminar flow between plates: tau_w = 6 eta u/W.
        assert_relative_eq!(SideWall::Blasius.stress(3.0, 2.0, 1.0).value, 9.0, max_relative = 1e-15);
    }
}
