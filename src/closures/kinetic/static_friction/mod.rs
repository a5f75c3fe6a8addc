//! Friction of enduring contacts: `tau_el = mu_s p_el`.
//!
//! `mu_s = 0.146 + 0.228 tanh(mu_p/0.232)` from the friction mu_p between two grains, or a given number.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `mu_s` | stress ratio below which grains do not move | 1 |
//! | `mu_p` | friction coefficient between two grains | 1 |
//!
//! Limits: 0.146 for frictionless grains, whose shape alone holds them, and 0.374 for rough ones.
//! Source: fit of Chassagne et al. (2023), eq. (2.15) and (B1), to data collected by Dai, Yang & Zhou (2016).

use crate::closures::role::role;

role! {
    /// Friction of enduring contacts.
    #[derive(Default)]
    pub enum StaticFriction {
        #[default]
        dai::Dai,
        given::Given(..),
    }

    /// What the laws of this friction answer.
    pub trait Threshold {
        /// `mu_s` for the friction `mu_p` between two grains.
        #[must_use]
        fn mu_s(&self, mu_p: f64) -> f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_source_says() {
        let law = StaticFriction::Dai;
        assert_eq!(law.mu_s(0.0), 0.146);
        assert!((law.mu_s(0.4) - 0.36).abs() < 0.002, "{}", law.mu_s(0.4));
        assert!((law.mu_s(50.0) - 0.374).abs() < 1e-12);
        assert_eq!(StaticFriction::Given(Given { mu_s: 0.3 }).mu_s(0.4), 0.3);
    }
}
