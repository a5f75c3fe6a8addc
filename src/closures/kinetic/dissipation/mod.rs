//! The restitution coefficient in the dissipation by contacts: what friction takes from the velocity fluctuations, or hands to
//! the rotations, counts as lost in the impact.

use crate::closures::role::role;

role! {
    /// Restitution in the dissipation by contacts.
    pub enum Dissipation as word {
        plain::Plain,
        jenkins_zhang::JenkinsZhang,
    }

    /// What the laws of the dissipation answer.
    pub trait EffectiveRestitution {
        /// Effective restitution for the restitution `e`, the friction `mu_p` and the tangential restitution `e_t`.
        #[must_use]
        fn restitution(&self, e: f64, mu_p: f64, e_t: f64) -> f64;
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn without_friction_nothing_is_lost() {
        let law = Dissipation::JenkinsZhang;
        assert_eq!(law.restitution(0.7, 0.0, 0.0), 0.7);
        assert_eq!(Dissipation::Plain.restitution(0.7, 0.4, 0.0), 0.7);
        // To first order in mu_p the loss is a1/2 = pi mu_p/2.
        assert_relative_eq!(0.7 - law.restitution(0.7, 1e-6, 0.0), FRAC_PI_2 * 1e-6, max_relative = 1e-4);
    }

    #[test]
    fn the_loss_saturates() {
        let law = Dissipation::JenkinsZhang;
        let loss = |mu_p: f64| 0.7 - law.restitution(0.7, mu_p, 0.0);
        assert!(loss(0.1) < loss(0.2) && loss(0.2) < loss(0.4));
        assert!((loss(1.5) - loss(0.6)).abs() < 0.15 * loss(0.6), "{} {}", loss(0.6), loss(1.5));
        // mu_0 -> infinity: a1 -> ratio (2 + 2 (1 - 2 ratio)), a2 b1/b2 -> 0: the bracket of a2 vanishes.
        let ratio = 1.0 / 5.95;
        assert_relative_eq!(loss(1e7), ratio * (2.0 - 2.0 * ratio), max_relative = 1e-5);
    }

    #[test]
    fn for_the_grains_of_the_source() {
        // e = 0.7, mu_p = 0.4, by hand: mu_0 = 2.38, A = 0.253229, a1 = 0.507881, a2 = 0.147822,
        // b1 = 0.0240082, b2 = 0.150978.
        let found = Dissipation::JenkinsZhang.restitution(0.7, 0.4, 0.0);
        assert_relative_eq!(found, 0.457_813, max_relative = 1e-5);
    }
}
