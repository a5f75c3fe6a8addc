//! The numbers of a turbulent flow over a bed, and what each of them says.

use super::{Number, share};
use crate::model::{COLLISIONS, PACKED, TurbulentScene};

/// Shields number at which the first grains move: intercept of Q*^(2/3), with eddies (docs/coupled.md).
const ONSET: f64 = 0.045;
/// From here on the bed moves as a sheet.
const SHEET: f64 = 0.5;
/// Layers of a dense continuum.
const MANY: f64 = 6.0;

pub(super) fn numbers(scene: &TurbulentScene) -> Vec<Number> {
    let number = |name, value: f64, says: String| Number { name, value, says };
    let ratio = scene.fall() / scene.u_star();
    let mut numbers = vec![
        number("Shields number θ", scene.theta, regime(scene.theta).into()),
        number("fall over friction velocity w_s/u_*", ratio, {
            let says = if ratio > 1.0 {
                "no suspension"
            } else if ratio < 0.8 {
                "suspension"
            } else {
                "suspension begins"
            };
            says.into()
        }),
        number("grain Reynolds number u_* d/ν", scene.u_star() * scene.d / scene.nu, {
            let rough = scene.u_star() * scene.d / scene.nu > 70.0;
            if rough { "rough: the viscous stress hardly matters" } else { "viscous stress matters" }.into()
        }),
        number("moving layers δ_s/d", scene.layers(), {
            if scene.layers() > MANY { "a dense continuum" } else { "few layers: no dense continuum" }.into()
        }),
        number("submergence h/d", scene.depth / scene.d, {
            let low = scene.depth < 5.0 * scene.d;
            if low { "low: the mixing length is that of a wake, not of a wall" } else { "deep over the grains" }.into()
        }),
        number("weight along the slope", scene.weight(), {
            if scene.weight() < 1.0 {
                format!("without it the moving layer is thinner by {}", share(scene.weight()))
            } else {
                "no bed rests on this slope".into()
            }
        }),
        number(
            "Stokes number ρ_p w_s d/(9 η)",
            scene.rho_p * scene.fall() * scene.d / (9.0 * scene.nu * scene.rho_f),
            "impacts rebound above about 10".into(),
        ),
    ];
    if let Some((k_n, layers)) = scene.grains {
        let pressure = (scene.rho_p - scene.rho_f) * scene.g * PACKED * layers * scene.d;
        let rigid = k_n / (pressure * scene.d);
        // A number of whole grains weighs not quite what the bed does.
        let says = if rigid >= 0.99e4 { "rigid grains" } else { "below 1e4: contacts are soft" };
        numbers.push(number("stiffness k_n/(P d)", rigid, says.into()));
    }
    numbers
}

/// What a Shields number says.
fn regime(theta: f64) -> &'static str {
    match theta {
        t if t < ONSET => "nothing moves",
        t if t < 0.99 * COLLISIONS => "single grains roll and jump",
        t if t < SHEET => "layers of colliding grains",
        _ => "sheet flow",
    }
}
