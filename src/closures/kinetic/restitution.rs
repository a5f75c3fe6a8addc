//! The effective restitution coefficient of grains with friction, after Jenkins and Zhang.
//!
//! ```text
//! e_eff = e - (a1 - a2 b1/b2)/2,                          mu_0 = (7/2) mu_p (1 + e)/(1 + e_t)
//! a1 = (mu_p/mu_0) [pi mu_0 A + (2 mu_0^2/(1 + mu_0^2)) (1 - 2 mu_p/mu_0)],    A = 1 - (2/pi) arctan(mu_0)
//! a2 = (5/2)(mu_p/mu_0) [(pi/2) mu_0 A + (mu_0^2 - mu_0^4)/(1 + mu_0^2)^2]
//! b1 = (mu_p/mu_0)^2 mu_0^2/(1 + mu_0^2)
//! b2 = (1/2)(mu_p/mu_0) [(pi/2) mu_0 A + mu_0^2/(1 + mu_0^2)]
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `e`, `e_t` | normal and tangential restitution coefficient | 1 |
//! | `mu_p` | friction coefficient between two grains | 1 |
//!
//! It stands in the dissipation only: what friction takes from the velocity fluctuations, or hands to the rotations, counts as
//! lost in the impact. Derived for small mu_p; it saturates for large mu_p as the grains do.
//! Source: Jenkins & Zhang (2002), Phys. Fluids 14, 1228; Chassagne et al. (2023), eq. (3.4) and Appendix C, with e_t = 0.

use std::f64::consts::{FRAC_PI_2, PI};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Standing};

/// Catalogue entries.
pub static PLAIN: Info = Info {
    family: "granular.dissipation",
    law: "plain",
    equation: "e_eff = e",
    source: "the neutral law of its family",
    ranges: &[],
    standing: Standing::Validated,
};
/// See [`PLAIN`].
pub static JENKINS_ZHANG: Info = Info {
    family: "granular.dissipation",
    law: "jenkins-zhang",
    equation: "e_eff = e - (a₁ - a₂ b₁/b₂)/2",
    source: "Jenkins & Zhang (2002); Chassagne et al. (2023), Appendix C",
    ranges: &[],
    standing: Standing::Validated,
};

/// Restitution in the dissipation by contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Dissipation {
    /// That of the grains.
    Plain,
    /// Less, by what friction takes.
    JenkinsZhang,
}

impl Dissipation {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(self) -> &'static Info {
        match self {
            Self::Plain => &PLAIN,
            Self::JenkinsZhang => &JENKINS_ZHANG,
        }
    }

    /// Effective restitution for the restitution `e`, the friction `mu_p` and the tangential restitution `e_t`.
    #[must_use]
    pub fn restitution(self, e: f64, mu_p: f64, e_t: f64) -> f64 {
        match self {
            Self::JenkinsZhang if mu_p > 0.0 => jenkins_zhang(e, mu_p, e_t),
            Self::Plain | Self::JenkinsZhang => e,
        }
    }
}

fn jenkins_zhang(e: f64, mu_p: f64, e_t: f64) -> f64 {
    let ratio = (1.0 + e_t) / (3.5 * (1.0 + e));
    let mu_0 = mu_p / ratio;
    let (square, rest) = (mu_0 * mu_0, 1.0 - 2.0 / PI * mu_0.atan());
    let stick = square / (1.0 + square);
    let a1 = ratio * (PI * mu_0 * rest + 2.0 * stick * (1.0 - 2.0 * ratio));
    let a2 = 2.5 * ratio * (FRAC_PI_2 * mu_0 * rest + (square - square * square) / (1.0 + square).powi(2));
    let b1 = ratio * ratio * stick;
    let b2 = 0.5 * ratio * (FRAC_PI_2 * mu_0 * rest + stick);
    e - 0.5 * (a1 - a2 * b1 / b2)
}

#[cfg(test)]
mod tests {
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
