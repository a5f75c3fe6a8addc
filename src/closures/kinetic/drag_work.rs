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

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::closures::{Info, Standing};
use crate::numerics::dual::Real;

/// Catalogue entries.
pub static LINEAR: Info = Info {
    family: "granular.drag_work",
    law: "linear",
    equation: "J = -3 φ (1 - φ) K T",
    source: "Ding & Gidaspow (1990); Chassagne et al. (2023), eq. (2.25)",
    ranges: &[],
    standing: Standing::Validated,
};
/// See [`LINEAR`].
pub static QUADRATIC: Info = Info {
    family: "granular.drag_work",
    law: "quadratic",
    equation: "J = -φ (1 - φ) K (3 + 2 C_∞/C_D) T",
    source: "Chassagne et al. (2023), eq. (3.13)",
    ranges: &[],
    standing: Standing::Validated,
};

/// Work of the drag on the velocity fluctuations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DragWork {
    /// As if the drag were linear in the slip.
    Linear,
    /// With the quadratic part of the drag.
    Quadratic,
}

impl DragWork {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(self) -> &'static Info {
        match self {
            Self::Linear => &LINEAR,
            Self::Quadratic => &QUADRATIC,
        }
    }

    /// The factor m, for the share `C_inf/C_D` of the quadratic drag in the whole.
    #[must_use]
    pub fn factor<T: Real>(self, share: T) -> T {
        match self {
            Self::Linear => T::constant(3.0),
            Self::Quadratic => share * 2.0 + 3.0,
        }
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
