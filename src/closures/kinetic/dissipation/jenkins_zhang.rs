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

use super::EffectiveRestitution;
use crate::closures::{Info, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "granular.dissipation",
    law: "jenkins-zhang",
    equation: "e_eff = e - (a₁ - a₂ b₁/b₂)/2",
    source: "Jenkins & Zhang (2002); Chassagne et al. (2023), Appendix C",
    ranges: &[],
    standing: Standing::Validated,
};

/// Less, by what friction takes.
#[derive(JsonSchema)]
pub struct JenkinsZhang;

impl EffectiveRestitution for JenkinsZhang {
    fn restitution(&self, e: f64, mu_p: f64, e_t: f64) -> f64 {
        // mu_0 stands below a fraction that is 0/0 without friction.
        if mu_p > 0.0 { frictional(e, mu_p, e_t) } else { e }
    }
}

fn frictional(e: f64, mu_p: f64, e_t: f64) -> f64 {
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
