//! Blasius' law of a smooth wall: `f = 0.3164 Re^(-1/4)`, and laminar flow between two plates, `f = 48/Re`, where that is more.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `f` | Darcy friction factor of the wall, `tau_w = rho_f f u^2/8` | 1 |
//! | `Re` | `U W/nu`, with the local velocity and the width of the channel | 1 |
//!
//! The laminar branch (`tau_w = 6 eta u/W`) begins at Re = 812. Source: Blasius (1913), for pipes, Re 3e3 to 1e5.

use schemars::JsonSchema;

use super::{Friction, WallFriction};
use crate::closures::{Info, Range, Standing};

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "side_wall",
    law: "blasius",
    equation: "f = max(0.3164 Re^(-1/4), 48/Re),  Re = U W/ν",
    source: "Blasius (1913)",
    ranges: &[Range { variable: "wall_reynolds", min: 3e3, max: 1e5 }],
    standing: Standing::Validated,
};

/// Blasius' law, and laminar flow where that is more.
#[derive(JsonSchema)]
pub struct Blasius;

/// `f Re` of laminar flow between plates at the distance W.
const LAMINAR: f64 = 48.0;

impl WallFriction for Blasius {
    fn friction(&self, re: f64) -> Friction {
        let turbulent = 0.3164 * re / re.sqrt().sqrt();
        // Not a number at rest: not (turbulent > 48) catches it.
        if turbulent > LAMINAR {
            Friction { times_reynolds: turbulent, slope: -0.25 }
        } else {
            Friction { times_reynolds: LAMINAR, slope: -1.0 }
        }
    }
}
