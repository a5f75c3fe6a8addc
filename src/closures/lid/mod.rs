//! Shear stress on the top of the flow: a free surface or the lid of a duct.
//!
//! The stress `tau_top` is that which the lid takes from the fluid, positive where it slows the flow.

use super::Constant;
use super::role::role;

role! {
    /// What is on top of the flow.
    #[derive(Default)]
    pub enum Lid {
        #[default]
        free_surface::FreeSurface,
        stress::Stress(..),
        solved::Solved,
        colebrook_white::ColebrookWhite(..),
    }

    /// What the laws of the top answer.
    pub trait Top {
        /// Constants of the law.
        #[must_use]
        fn constants(&self) -> Vec<Constant>;
    }
}
