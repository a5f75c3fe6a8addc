//! The mixing length of Li and Sawamoto: grains below damp the turbulence above.
//!
//! `l_m(z) = kappa int_0^z max(0, phi_max - phi)/phi_max dz`
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `l_m` | mixing length | m |
//! | `kappa` | von Karman's constant | 1 |
//! | `phi`, `phi_max` | solid fraction, and the one at which the turbulence dies | 1 |
//!
//! Limits: `kappa z` in clear fluid, `kappa (z - h)` above a packed bed of thickness h, 0 inside it. The law is not local:
//! it is given all faces and the solid fractions between them, and its integral is exact for fractions constant in each cell.
//!
//! As published the integrand is (phi_max - phi)/phi_max (`below_packed = "published"`). In a bed denser than phi_max that
//! integral falls below 0 and leaves no turbulence in the lowest water, whose viscosity alone then carries the stress: its
//! velocity grows out of bounds. So a layer denser than phi_max adds nothing and takes nothing away. Where phi falls
//! upwards the two differ by what the dense bottom takes away; where phi <= phi_max they are the same to the bit.
//! Averages over thin slices of grains scatter about their mean. Where that is near phi_max the clipped integrand adds up the
//! gaps between grains and the published one does not, so that a flume whose phi_max is the packing of its own bed
//! carries a quarter less (docs/coupled.md): its cases state the published integral.
//!
//! Where the published integral falls below 0 the length is 0: the eddy viscosity has its square, which would grow again.
//! The published code instead takes phi_max in all cells below the highest one that reaches it (`below_packed = "zero"`), so
//! that the integral starts at that cell.
//!
//! phi_max is a constant of this law and no other: 0.51 in the quasi-2D, 0.61 in the 3D flows of Maurin et al. (2015).
//! Source: Li & Sawamoto (1995), Coastal Eng. Japan 38, 47-73; Maurin et al. (2015), eq. (5); Revil-Baudard & Chauchat
//! (2013), eq. (18).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Length, above_zero, karman};
use crate::closures::{Constant, Info, Range, Standing};
use crate::numerics::dual::Real;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "mixing_length",
    law: "li-sawamoto",
    equation: "l_m = κ max(0, ∫₀ᶻ (φ_max - φ)/φ_max dz),  the integrand ≥ 0 where clipped",
    source: "Li & Sawamoto (1995); Maurin et al. (2015), eq. (5); Revil-Baudard & Chauchat (2013), eq. (18)",
    ranges: &[Range { variable: "phi", min: 0.0, max: 0.635 }],
    standing: Standing::Validated,
};

/// What a layer denser than phi_max does to the integral.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BelowPacked {
    /// Nothing: the integrand is max(0, phi_max - phi)/phi_max, as Chassagne et al. (2023) read it.
    #[default]
    Clipped,
    /// It takes away from it: the integral of (phi_max - phi)/phi_max from the bottom, as published; the length is 0 where that
    /// is negative. For beds that are not denser than phi_max on the mean.
    Published,
    /// No turbulence below the highest cell that reaches phi_max, as in the published code.
    Zero,
}

/// Grains below damp the turbulence above.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiSawamoto {
    /// Von Karman's constant.
    #[serde(default = "karman")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.2, "maximum" = 0.6))]
    pub kappa: f64,
    /// Solid fraction at which the turbulence dies.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 0.7405))]
    pub phi_max: f64,
    /// What a layer denser than phi_max does to the integral.
    #[serde(default)]
    pub below_packed: BelowPacked,
}

/// Over a bed of spheres: Maurin et al. (2016), Chassagne et al. (2023).
impl Default for LiSawamoto {
    fn default() -> Self {
        Self { kappa: karman(), phi_max: 0.61, below_packed: BelowPacked::Clipped }
    }
}

impl Length for LiSawamoto {
    fn constants(&self) -> Vec<Constant> {
        vec![("κ", self.kappa, ""), ("φ_max", self.phi_max, "")]
    }

    fn clearance<T: Real>(&self, phi: T) -> T {
        let clear = (-phi + self.phi_max) / self.phi_max;
        if self.below_packed == BelowPacked::Clipped && clear.value() < 0.0 { T::constant(0.0) } else { clear }
    }

    fn length<T: Real>(&self, integral: T, _: T) -> T {
        above_zero(integral, self.kappa)
    }

    fn fill(&self, faces: &[f64], phi: &[f64], lengths: &mut [f64]) {
        let packed = match self.below_packed {
            BelowPacked::Published | BelowPacked::Clipped => 0,
            // The highest packed cell itself counts as it is: a fraction of exactly phi_max adds nothing.
            BelowPacked::Zero => phi.iter().rposition(|&phi| phi >= self.phi_max).unwrap_or(0),
        };
        let mut integral = 0.0;
        if let Some(bottom) = lengths.first_mut() {
            *bottom = 0.0;
        }
        for (i, ((pair, &phi), length)) in faces.windows(2).zip(phi).zip(lengths.iter_mut().skip(1)).enumerate() {
            if i >= packed {
                integral += self.clearance(phi) * (pair[1] - pair[0]);
            }
            *length = self.kappa * f64::max(integral, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::{levels::graded, quadrature::simpson};
    use approx::assert_relative_eq;

    const LAW: LiSawamoto = LiSawamoto { kappa: 0.41, phi_max: 0.6, below_packed: BelowPacked::Published };

    const CLIPPED: LiSawamoto = LiSawamoto { below_packed: BelowPacked::Clipped, ..LAW };

    fn lengths(law: LiSawamoto, faces: &[f64], phi: &[f64]) -> Vec<f64> {
        let mut lengths = vec![f64::NAN; faces.len()];
        law.fill(faces, phi, &mut lengths);
        lengths
    }

    #[test]
    fn clear_fluid_packed_bed_and_half_packed_bed() {
        let faces = [0.0, 1.0, 3.0, 4.0];
        for (phi, expect) in [
            ([0.0, 0.0, 0.0], [0.0, 0.41, 3.0 * 0.41, 4.0 * 0.41]),
            ([0.6, 0.6, 0.0], [0.0, 0.0, 0.0, 0.41]),
            ([0.3, 0.3, 0.3], [0.0, 0.5 * 0.41, 1.5 * 0.41, 2.0 * 0.41]),
        ] {
            for (length, expect) in lengths(LAW, &faces, &phi).into_iter().zip(expect) {
                assert_relative_eq!(length, expect, max_relative = 1e-15);
            }
        }
        // The distance counts from the lowest face, wherever that is.
        assert_relative_eq!(lengths(LAW, &[5.0, 7.0], &[0.0])[1], 0.82, max_relative = 1e-15);
    }

    #[test]
    fn a_smooth_profile_by_quadrature_at_order_two() {
        let phi = |z: f64| 0.55 / (1.0 + (10.0 * (z - 0.5)).exp());
        let exact = 0.41 * simpson(|z| 1.0 - phi(z) / 0.6, 0.0, 1.0, 2000);
        let error = |n: usize| {
            let faces = graded(0.0, 1.0, n, 0.5 / n as f64);
            let cells: Vec<f64> = faces.windows(2).map(|f| phi(0.5 * (f[0] + f[1]))).collect();
            (lengths(LAW, &faces, &cells)[n] - exact).abs()
        };
        assert_relative_eq!((error(50) / error(100)).log2(), 2.0, epsilon = 0.1);
    }

    #[test]
    fn fractions_above_the_maximum() {
        let (faces, phi) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.3, 0.66, 0.6, 0.0]);
        // Clipped: the overfull cell counts as nothing. Published: it takes a tenth of a cell away.
        for (law, expect) in [(CLIPPED, [0.0, 0.5, 0.5, 0.5, 1.5]), (LAW, [0.0, 0.5, 0.4, 0.4, 1.4])] {
            for (length, expect) in lengths(law, &faces, &phi).into_iter().zip(expect) {
                assert_relative_eq!(length, 0.41 * expect, max_relative = 1e-14);
            }
        }
        // Zero: the integral starts at the highest packed cell.
        let zero = lengths(LiSawamoto { below_packed: BelowPacked::Zero, ..LAW }, &faces, &phi);
        assert_eq!(zero[..4], [0.0; 4]);
        assert_relative_eq!(zero[4], 0.41, max_relative = 1e-15);
        let loose = LiSawamoto { below_packed: BelowPacked::Zero, ..LAW };
        assert_eq!(lengths(loose, &faces[..2], &[0.3]), lengths(LAW, &faces[..2], &[0.3]));
    }

    #[test]
    fn above_a_bed_denser_than_the_maximum_the_length_grows_from_its_top() {
        // Three layers of 0.66 owe 0.3 of clear water: as published, none of the first 0.3 above them is turbulent.
        let faces = [0.0, 1.0, 2.0, 3.0, 3.25, 3.5, 4.0];
        let phi = [0.66, 0.66, 0.66, 0.0, 0.3, 0.0];
        let clipped = lengths(CLIPPED, &faces, &phi);
        assert_eq!(clipped[..4], [0.0; 4]);
        for (length, expect) in clipped[4..].iter().zip([0.25, 0.375, 0.875]) {
            assert_relative_eq!(*length, 0.41 * expect, max_relative = 1e-14);
        }
        // Never negative.
        let published = lengths(LAW, &faces, &phi);
        assert_eq!(published[..5], [0.0; 5]);
        assert_relative_eq!(published[6], 0.41 * 0.575, max_relative = 1e-13);
        assert_eq!(lengths(LAW, &[0.0, 1.0, 1.1], &[0.63, 0.0])[1], 0.0);
    }

    #[test]
    fn where_nothing_is_denser_than_the_maximum_the_two_integrals_are_the_same_to_the_bit() {
        let faces = graded(0.0, 1.0, 200, 1e-3);
        let phi: Vec<f64> = faces[1..].iter().map(|z| 0.6 / (1.0 + (20.0 * (z - 0.5)).exp())).collect();
        assert_eq!(lengths(CLIPPED, &faces, &phi), lengths(LAW, &faces, &phi));
    }

    #[test]
    fn the_option_reads_as_documented() {
        let law: LiSawamoto = toml::from_str("phi_max = 0.51\nbelow_packed = \"zero\"").unwrap();
        assert_eq!(law, LiSawamoto { kappa: 0.41, phi_max: 0.51, below_packed: BelowPacked::Zero });
        assert_eq!(toml::from_str::<LiSawamoto>("phi_max = 0.51").unwrap().below_packed, BelowPacked::Clipped);
    }
}
