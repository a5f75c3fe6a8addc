//! Friction of the grains: the ratio mu = tau_p / P_p at which they shear.

use super::Range;
use super::role::{Law, laws};
use crate::numerics::dual::{Dual, Real};
use crate::numerics::root::brent;

laws! {{
    coulomb::Coulomb(..),
    mu_i::MuI(..),
    mu_iv::MuIv(..),
}}

/// Where a law of dense granular flow holds; below it the flow is quasi-static, above it collisional.
pub const INERTIAL_RANGE: Range = Range { variable: "inertial_number", min: 0.0, max: 2.0 };

/// Inertial numbers between which an inverse is looked for: within e to this power of the one half-way.
const WIDE: f64 = 60.0;

/// A friction mu(I) that rises with the inertial number between two limits. A solver that asks for this takes any such law, from
/// here or from outside; a law states its curve, and may state in closed form what else follows from it.
pub trait FrictionLaw: Law + Default {
    /// Friction coefficient at the inertial number `i`.
    #[must_use]
    fn mu<T: Real>(&self, i: T) -> T;
    /// Friction coefficient at vanishing inertial number: what grains at rest carry at most.
    #[must_use]
    fn least(&self) -> f64;
    /// Friction coefficient at large inertial number, finite and more than the least.
    #[must_use]
    fn most(&self) -> f64;
    /// Inertial number of the rise: the friction is about half-way between its limits there.
    #[must_use]
    fn half_way(&self) -> f64;
    /// The same law with its rise at the inertial number `i`.
    #[must_use]
    fn with_half_way(self, i: f64) -> Self;
    /// Its constants, by their symbols in the equation.
    #[must_use]
    fn constants(&self) -> Vec<(&'static str, f64)>;

    /// The inertial number at which the regularised friction `mu(I) I/(I + creep)` is `r`, below the most; `creep` is the
    /// regularisation lambda times the rearrangement time, and 0 for the exact yield.
    #[must_use]
    fn mobilised<T: Real>(&self, r: T, creep: T) -> T {
        let (wanted, slow) = (r.value(), creep.value());
        if slow == 0.0 && wanted <= self.least() {
            return T::constant(0.0);
        }
        let regularised = |ln_i: f64| self.mu(ln_i.exp()) * ln_i.exp() / (ln_i.exp() + slow);
        let middle = self.half_way().ln();
        let Ok(ln_i) = brent(|ln_i| regularised(ln_i) - wanted, middle - WIDE, middle + WIDE, |_| {}) else {
            // Creep so slow that the friction is its least, or a friction that no shear rate has.
            return if wanted < self.least() { r * creep / self.least() } else { T::constant((middle + WIDE).exp()) };
        };
        // A step of Newton's method from the root: it leaves the value, and gives the derivatives of the inverse.
        let i = ln_i.exp();
        let variable = Dual::<1>::variable(i, 0);
        let Dual { slope: [slope], .. } = self.mu(variable) * variable / (variable + slow);
        let missed = self.mu(T::constant(i)) * i / (creep + i) - r;
        -missed / slope + i
    }

    /// C of Barker et al. (2015): the equations are ill-posed in two and three dimensions where it is positive.
    #[must_use]
    fn well_posedness(&self, i: f64) -> f64 {
        let Dual { value: mu, slope: [slope] } = self.mu(Dual::<1>::variable(i, 0));
        let n = i * slope / mu;
        4.0 * n * (n - 1.0) + (mu * (1.0 - 0.5 * n)).powi(2)
    }

    /// Inertial numbers between which the equations are well-posed in two and three dimensions; `None` if nowhere.
    #[must_use]
    fn well_posed(&self) -> Option<(f64, f64)> {
        // n, and -C with it, is largest where mu' I is: near I_0 and below it.
        let candidate = |k: i32| self.half_way() * (0.02 * f64::from(k)).exp();
        let best =
            (-400..400).map(candidate).min_by(|a, b| self.well_posedness(*a).total_cmp(&self.well_posedness(*b)))?;
        if self.well_posedness(best) > 0.0 {
            return None;
        }
        let edge = |mut outside: f64, mut inside: f64| {
            for _ in 0..100 {
                let middle = (outside * inside).sqrt();
                if self.well_posedness(middle) > 0.0 {
                    outside = middle;
                } else {
                    inside = middle;
                }
            }
            inside
        };
        Some((edge(1e-12 * self.half_way(), best), edge(1e12 * self.half_way(), best)))
    }
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    use super::*;
    use crate::closures::Info;
    use approx::assert_relative_eq;
    use schemars::JsonSchema;

    /// mu(I) by its curve alone: all else is what follows from it.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
    struct Curve(MuI);

    impl Law for Curve {
        const INFO: &'static Info = &mu_i::INFO;
    }

    impl FrictionLaw for Curve {
        fn mu<T: Real>(&self, i: T) -> T {
            self.0.mu(i)
        }

        fn least(&self) -> f64 {
            self.0.least()
        }

        fn most(&self) -> f64 {
            self.0.most()
        }

        fn half_way(&self) -> f64 {
            self.0.half_way()
        }

        fn with_half_way(self, i: f64) -> Self {
            Self(self.0.with_half_way(i))
        }

        fn constants(&self) -> Vec<(&'static str, f64)> {
            self.0.constants()
        }
    }

    #[test]
    fn what_follows_from_the_curve_is_what_the_closed_forms_say() {
        let law = MuI { mu_s: 0.38, mu_2: 0.64, i_0: 0.279 };
        for creep in [0.0, 1e-14, 1e-6, 1.0] {
            for r in [1e-3, 0.2, 0.379, 0.381, 0.5, 0.63] {
                let at = |i| [Dual::<2>::variable(r, 0), Dual::variable(creep, 1)][i];
                let (found, exact) = (Curve(law).mobilised(at(0), at(1)), law.mobilised(at(0), at(1)));
                assert_relative_eq!(found.value, exact.value, max_relative = 1e-9);
                assert_relative_eq!(found.slope[0], exact.slope[0], max_relative = 1e-6);
                if creep > 0.0 {
                    assert_relative_eq!(found.slope[1], exact.slope[1], max_relative = 1e-6);
                }
            }
        }
        for i in [1e-3, 0.279, 3.0] {
            assert_relative_eq!(Curve(law).well_posedness(i), law.well_posedness(i), max_relative = 1e-12);
        }
    }
}
