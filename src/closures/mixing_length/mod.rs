//! Turbulence by a mixing length: `R_xz = rho_f l_m^2 |du/dz| du/dz`.

pub mod li_sawamoto;
pub mod none;
pub mod prandtl;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use li_sawamoto::{BelowPacked, LiSawamoto};
pub use prandtl::Prandtl;

/// Law of the mixing length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MixingLength {
    /// No turbulence.
    #[default]
    None,
    /// Proportional to the distance from the wall.
    Prandtl(Prandtl),
    /// Grains below damp the turbulence above.
    LiSawamoto(LiSawamoto),
}

impl MixingLength {
    /// Mixing lengths [m] at the `faces` [m], ascending from the wall, for the solid fractions `phi` of the cells between
    /// them. `lengths` has one entry per face, `phi` one fewer.
    pub fn fill(&self, faces: &[f64], phi: &[f64], lengths: &mut [f64]) {
        match self {
            Self::None => lengths.fill(0.0),
            Self::Prandtl(law) => {
                let wall = faces.first().copied().unwrap_or_default();
                faces.iter().zip(lengths).for_each(|(z, length)| *length = law.length(z - wall));
            }
            Self::LiSawamoto(law) => law.fill(faces, phi, lengths),
        }
    }

    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &none::INFO,
            Self::Prandtl(_) => &prandtl::INFO,
            Self::LiSawamoto(_) => &li_sawamoto::INFO,
        }
    }
}

fn karman() -> f64 {
    0.41
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_laws_agree_where_they_must() {
        let faces = [1.0, 1.5, 3.0];
        let fill = |law: MixingLength| {
            let mut lengths = [f64::NAN; 3];
            law.fill(&faces, &[0.0, 0.0], &mut lengths);
            lengths
        };
        let clear = LiSawamoto { kappa: 0.4, phi_max: 0.6, below_packed: BelowPacked::Published };
        assert_eq!(fill(MixingLength::None), [0.0; 3]);
        assert_eq!(fill(MixingLength::Prandtl(Prandtl { kappa: 0.4 })), [0.0, 0.2, 0.8]);
        assert_eq!(fill(MixingLength::LiSawamoto(clear)), [0.0, 0.2, 0.8]);
    }
}
