//! What the drag takes from the velocity fluctuations of the grains: `J = -phi (1 - phi) K m T`.
//!
//! ```text
//! linear        m = 3                              a drag linear in the slip
//! quadratic     m = 3 + 2 C_inf/C_D                the drag of a grain in turbulent flow, u'^2 = 2 T along the flow
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `K` | drag coefficient: the drag on the grains is phi (1 - phi) K (u_f - u_p) | kg/(m3 s) |
//! | `C_D`, `C_inf` | drag coefficient of a grain, and that of a fast one | 1 |
//!
//! The fluid gives no fluctuations to the grains: none are computed. Source: Ding & Gidaspow (1990); Chassagne et al. (2023),
//! eq. (2.25), (3.13) and Appendix D.

use crate::closures::role::role;
use crate::numerics::dual::Real;

role! {
    /// Work of the drag on the velocity fluctuations.
    pub enum DragWork as word {
        linear::Linear,
        quadratic::Quadratic,
    }

    /// What the laws of the drag work answer.
    pub trait Damping {
        /// The factor m, for the share `C_inf/C_D` of the quadratic drag in the whole.
        #[must_use]
        fn factor<T: Real>(&self, share: T) -> T;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_agree_in_slow_flow_and_fast_grains_lose_five_thirds_of_it() {
        assert_eq!(DragWork::Linear.factor(1.0), 3.0);
        assert_eq!(DragWork::Quadratic.factor(0.0), 3.0);
        assert_eq!(DragWork::Quadratic.factor(1.0), 5.0);
    }
}
