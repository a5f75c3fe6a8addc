//! The mixing length of a shallow flow, whose eddies are as large as the gaps between its grains:
//! `l_m = max(s (phi_max - phi)^3, l_0)`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `l_m` | mixing length | m |
//! | `s` | 3 d in the source, d the grain diameter | m |
//! | `l_0` | least length, 0.2 d in the source | m |
//! | `phi`, `phi_max` | solid fraction, and that of a packed bed | 1 |
//!
//! It is local: at a face it takes the mean of the two solid fractions beside it.
//! Source: Berzi & Fraccarollo (2015), Phys. Rev. Lett. 115, 194501; Chassagne et al. (2023), eq. (4.2).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Length;
use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixing_length",
    law: "low-submergence",
    equation: "l_m = max(s (φ_max - φ)³, l₀)",
    source: "Berzi & Fraccarollo (2015); Chassagne et al. (2023), eq. (4.2)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.635 }],
    standing: Standing::Experimental,
};

/// Eddies between the grains of a shallow flow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LowSubmergence {
    /// Length s; 3 grain diameters in the source.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e2))]
    pub scale: f64,
    /// Least mixing length; 0.2 grain diameters in the source.
    #[schemars(extend("x-unit" = "m", "minimum" = 0.0, "maximum" = 1e2))]
    pub least: f64,
    /// Solid fraction of a packed bed.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_max: f64,
}

impl Length for LowSubmergence {
    fn constants(&self) -> Vec<Constant> {
        vec![("s", self.scale, "m"), ("l₀", self.least, "m"), ("φ_max", self.phi_max, "")]
    }

    fn clearance<T: Real>(&self, _: T) -> T {
        T::constant(0.0)
    }

    fn length<T: Real>(&self, _: T, phi: T) -> T {
        let gap = -phi + self.phi_max;
        let length = gap * gap * gap * self.scale;
        if length.value() > self.least { length } else { T::constant(self.least) }
    }

    fn fill(&self, _: &[f64], phi: &[f64], lengths: &mut [f64]) {
        for (f, length) in lengths.iter_mut().enumerate() {
            let (below, above) = (phi.get(f.wrapping_sub(1)), phi.get(f));
            *length = match (below, above) {
                (Some(a), Some(b)) => self.length(0.0, 0.5 * (a + b)),
                (Some(a), None) | (None, Some(a)) => self.length(0.0, *a),
                (None, None) => self.least,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn clear_fluid_and_packed_bed() {
        let d = 7e-3;
        let law = LowSubmergence { scale: 3.0 * d, least: 0.2 * d, phi_max: 0.635 };
        // 3 0.635^3 = 0.768.
        assert_relative_eq!(law.length(0.0, 0.0) / d, 0.768_143, max_relative = 1e-6);
        assert_eq!(law.length(0.0, 0.6), 0.2 * d);
        // They meet where (phi_max - phi)^3 = 1/15.
        let meet = 0.635 - (1.0_f64 / 15.0).cbrt();
        assert_relative_eq!(law.length(0.0, meet - 1e-9), 0.2 * d, max_relative = 1e-6);
        let mut lengths = [0.0; 3];
        law.fill(&[], &[0.6, 0.0], &mut lengths);
        assert_eq!(lengths, [law.length(0.0, 0.6), law.length(0.0, 0.3), law.length(0.0, 0.0)]);
    }
}
