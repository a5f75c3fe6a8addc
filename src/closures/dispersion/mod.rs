//! Grains that the turbulence carries from where they are many to where they are few: a drift velocity in the drag.

use super::role::role;

role! {
    /// Dispersion of the grains by turbulence.
    #[derive(Default)]
    pub enum Dispersion {
        #[default]
        none::None,
        gradient::Gradient(..),
    }

    /// What the laws of dispersion answer.
    pub trait Spread {
        /// Diffusivity of the grains over the eddy viscosity.
        #[must_use]
        fn strength(&self) -> f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_published() {
        let law: Dispersion = toml::from_str("law = \"gradient\"").unwrap();
        assert!((law.strength() - 3.0).abs() < 1e-15);
        assert_eq!(Dispersion::None.strength(), 0.0);
    }
}
