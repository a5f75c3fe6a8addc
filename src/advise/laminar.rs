//! The numbers of a laminar flow over a bed, and what each of them says.

use super::{Number, share};
use crate::model::LaminarScene;
use crate::result::{Results, quantity as q};

/// Carman-Kozeny constant where the case has no drag.
const K_CK: f64 = 180.0;

/// Those of the scene, and of the solved flow where it has a solution.
pub(super) fn numbers(scene: &LaminarScene, solved: Option<&Results>) -> Vec<Number> {
    let result = |name: &str| solved.and_then(|results| results.get(name));
    let stress = (scene.rho_p - scene.rho_f) * scene.g * scene.h;
    let (mu_s, e) = (scene.mu_s, scene.viscosity);
    let mut numbers = Vec::new();
    if let Some(theta) = result(q::SHIELDS.name) {
        let says = if theta < 0.09 {
            "below the onset of motion in laminar flow, about 0.12 ± 0.03"
        } else {
            "the bed moves"
        };
        numbers.push(Number { name: "Shields number θ", value: theta, says: says.into() });
    }
    if let Some(u) = result(q::MEAN_VELOCITY.name).or(result(q::U_MAX.name)) {
        let re = scene.rho_f * u * scene.h / scene.eta;
        let says = if re < 1000.0 { "laminar" } else { "not laminar: take sheet-flow or grains" };
        numbers.push(Number { name: "Reynolds number ρ_f U H/η", value: re, says: says.into() });
    }
    if let Some(fall) = scene.drive.or(result(q::DRIVE.name)) {
        let f = fall * scene.h / stress;
        let b = (mu_s * scene.phi - f) / e;
        let depth = 1.0 - scene.h_p / scene.h;
        let y = depth * (-e + (e * e + f / b).sqrt());
        let k_ck = scene.k_ck.unwrap_or(K_CK);
        let k = (1.0 - scene.phi).powi(3) * (scene.d / scene.h).powi(2) / (k_ck * scene.phi * scene.phi);
        let slip = 2.0 * k * mu_s * scene.phi / (b * y * y);
        if b > 0.0 && y > 0.0 && slip.is_finite() {
            let says = format!("slip over the velocity of the bed: {}", share(slip));
            numbers.push(Number { name: "slip number 2 K μ_s φ/(B Y²)", value: slip, says });
            let layers = y * scene.h / scene.d;
            let says = if layers > 3.0 { "a continuum of many layers" } else { "hardly a continuum: few layers move" };
            numbers.push(Number { name: "mobile layers Y H/d", value: layers, says: says.into() });
        }
    }
    if let Some(mu_2) = scene.mu_2 {
        let value = (mu_2 - mu_s) / mu_s;
        numbers.push(Number { name: "friction rises by (μ_2 - μ_s)/μ_s", value, says: "at most".into() });
    }
    numbers
}
