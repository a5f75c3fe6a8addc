//! The textbook law of a smooth wall in an open channel: `f = (2 log10(Re sqrt(f)/4) + 0.32)^-2`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `f` | Darcy friction factor of the wall, `tau_w = rho_f f u^2/8` | 1 |
//! | `Re` | `U W/nu`, with the local velocity and the width of the channel | 1 |
//!
//! About 0.03 at Re = 1.2e4, as Blasius. Below Re = 6.5 the wall stress is taken proportional to the velocity.
//!
//! Source: Graf & Altinakar (1998), Fluvial Hydraulics.

use std::f64::consts::LOG10_E;

use schemars::JsonSchema;

use super::{Friction, WallFriction, implicit::Implicit};
use crate::closures::{Info, Range, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "side_wall",
    law: "graf-altinakar",
    equation: "f = (2 log₁₀(Re √f/4) + 0.32)⁻²,  Re = U W/ν",
    source: "Graf & Altinakar (1998)",
    ranges: &[Range { variable: "wall_reynolds", min: 4e3, max: f64::INFINITY }],
    standing: Standing::Experimental,
};

/// The textbook: decimal logarithm, Re/4.
#[derive(JsonSchema)]
pub struct GrafAltinakar;

const LAW: Implicit = Implicit { a: 2.0 * LOG10_E, scale: 4.0, c: 0.32 };

impl WallFriction for GrafAltinakar {
    fn friction(&self, re: f64) -> Friction {
        LAW.friction(re)
    }
}
