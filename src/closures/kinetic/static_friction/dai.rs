//! A fit to data collected by Dai, Yang & Zhou (2016): Chassagne et al. (2023), eq. (B1).

use schemars::JsonSchema;

use super::Threshold;
use crate::closures::{Info, Range, Standing};

const SHAPE: f64 = 0.146;
const ROUGH: f64 = 0.228;
const SATURATION: f64 = 0.232;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "static_friction",
    law: "dai",
    equation: "τ_el = μ_s p_el,  μ_s = 0.146 + 0.228 tanh(μ_p/0.232)",
    source: "Chassagne et al. (2023), eq. (B1), to data of Dai, Yang & Zhou (2016)",
    ranges: &[Range { variable: "friction", min: 0.0, max: 1.5 }],
    standing: Standing::Validated,
};

/// By the friction between two grains.
#[derive(JsonSchema)]
pub struct Dai;

impl Threshold for Dai {
    fn mu_s(&self, mu_p: f64) -> f64 {
        SHAPE + ROUGH * (mu_p / SATURATION).tanh()
    }
}
