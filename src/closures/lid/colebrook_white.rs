//! Friction of the lid of a wide duct by Colebrook and White.
//!
//! `1/sqrt(f) = -2 log10(k_s/(3.7 D) + 2.51/(Re sqrt(f)))`, `tau_top = (f/8) rho_f U_m^2`, `Re = U_m D/nu`, `D = 2 h` or `4 h`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `f` | Darcy's friction factor | 1 |
//! | `k_s` | sand roughness of the lid; 0 is smooth | m |
//! | `U_m`, `h` | mean velocity and height of the clear flow, from the bed level to the lid | m/s, m |
//! | `D` | hydraulic diameter, four times the area over the wetted perimeter: `2 h` between lid and bed, `4 h` where one of them is wetted | m |
//!
//! The source names the law and not its lengths: those of the clear flow are taken here.
//! Source: Colebrook (1939), J. Inst. Civ. Eng. 11, 133-156; Revil-Baudard & Chauchat (2013), sec. 2.3.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Top;
use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// Turbulent flow.
pub const RANGE: Range = Range { variable: "lid_reynolds", min: 4e3, max: 1e8 };

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "lid",
    law: "colebrook-white",
    equation: "f^-½ = -2 log₁₀(k_s/(3.7 D) + 2.51/(Re f^½)),  τ_top = f/8 ρ_f U_m²",
    source: "Colebrook (1939); Revil-Baudard & Chauchat (2013), sec. 2.3",
    ranges: &[RANGE],
    standing: Standing::Validated,
};

/// A lid with the friction law of Colebrook and White.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ColebrookWhite {
    /// Sand roughness of the lid; 0 is smooth.
    #[serde(default)]
    #[schemars(extend("x-unit" = "m", "minimum" = 0.0, "maximum" = 1.0))]
    pub roughness: f64,
    /// Hydraulic diameter over the height of the clear flow: that of a duct, 2, or that of a channel whose lid alone is its perimeter, 4.
    #[serde(default)]
    pub diameter: HydraulicDiameter,
}

/// Hydraulic diameter of the clear flow of the height h.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum HydraulicDiameter {
    /// Lid and bed are wetted.
    #[default]
    #[serde(rename = "2h")]
    TwoHeights,
    /// The lid alone is, as for the depth of an open channel.
    #[serde(rename = "4h")]
    FourHeights,
}

impl HydraulicDiameter {
    /// The diameter over the height.
    #[must_use]
    pub fn heights(self) -> f64 {
        match self {
            Self::TwoHeights => 2.0,
            Self::FourHeights => 4.0,
        }
    }
}

/// Sweeps of the contraction x -> -2 log10(a + b x), whose slope is below 0.3 in turbulent flow: to round-off.
const SWEEPS: usize = 40;

impl ColebrookWhite {
    /// Darcy's friction factor for the Reynolds number `re` and the hydraulic diameter `diameter` \[m].
    #[must_use]
    pub fn factor<T: Real>(&self, re: T, diameter: T) -> T {
        let relative = T::constant(self.roughness) / (diameter * 3.7);
        let x = (0..SWEEPS)
            .fold(T::constant(7.0), |x, _| (relative + x.abs() * 2.51 / re).ln() * (-2.0 / std::f64::consts::LN_10));
        T::constant(1.0) / (x * x)
    }
}

impl Top for ColebrookWhite {
    fn constants(&self) -> Vec<Constant> {
        vec![("k_s", self.roughness, "m"), ("D/h", self.diameter.heights(), "1")]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn values_of_moodys_chart() {
        // Moody's chart: smooth 1e5: 0.0180, 1e6: 0.0116; k_s/D = 1e-3 at 1e6: 0.0199
        let smooth = ColebrookWhite::default();
        assert_relative_eq!(smooth.factor(1e5, 1.0), 0.0180, max_relative = 5e-3);
        assert_relative_eq!(smooth.factor(1e6, 1.0), 0.0116, max_relative = 5e-3);
        assert_relative_eq!(
            ColebrookWhite { roughness: 1e-3, ..ColebrookWhite::default() }.factor(1e6, 1.0),
            0.0199,
            max_relative = 5e-3
        );
    }

    #[test]
    fn it_solves_its_own_equation() {
        let (re, d): (f64, f64) = (5e4, 0.2);
        let f = ColebrookWhite { roughness: 1e-4, ..ColebrookWhite::default() }.factor(re, d);
        let right = -2.0 * (1e-4 / (3.7 * d) + 2.51 / (re * f.sqrt())).log10();
        assert_relative_eq!(1.0 / f.sqrt(), right, max_relative = 1e-14);
    }
}
