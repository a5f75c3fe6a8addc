//! The side-wall law as the published implementation of the coupled model solves it: `f = (2 ln(Re sqrt(f)) + 0.32)^-2`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `f` | Darcy friction factor of the wall, `tau_w = rho_f f u^2/8` | 1 |
//! | `Re` | `U W/nu`, with the local velocity and the width of the channel | 1 |
//!
//! The natural logarithm and the whole width stand where the textbook (`graf-altinakar`) has the decimal logarithm and Re/4:
//! f is six times smaller, about 0.005 at Re = 1.2e4, and the transport rate of a narrow flume twice as large. The results of
//! Maurin et al. (2015) belong to this law. Below Re = 4.6 the wall stress is taken proportional to the velocity.
//!
//! Source: implementation of Maurin et al. (2015), after Graf & Altinakar (1998), Fluvial Hydraulics.

use schemars::JsonSchema;

use super::{Friction, WallFriction, implicit::Implicit};
use crate::closures::{Info, Range, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "side_wall",
    law: "graf-altinakar-published",
    equation: "f = (2 ln(Re √f) + 0.32)⁻²,  Re = U W/ν",
    source: "implementation of Maurin et al. (2015), after Graf & Altinakar (1998)",
    ranges: &[Range { variable: "wall_reynolds", min: 4e3, max: f64::INFINITY }],
    standing: Standing::Experimental,
};

/// As the published implementation of the coupled model: natural logarithm, Re = U W/nu.
#[derive(JsonSchema)]
pub struct GrafAltinakarPublished;

const LAW: Implicit = Implicit { a: 2.0, scale: 1.0, c: 0.32 };

impl WallFriction for GrafAltinakarPublished {
    fn friction(&self, re: f64) -> Friction {
        LAW.friction(re)
    }
}
