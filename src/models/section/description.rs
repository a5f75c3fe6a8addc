//! The equations of a duct in words, with their numbers.

use super::duct::{Duct, Filling};
use crate::closures::drag::carman_kozeny;
use crate::closures::friction::coulomb;
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::models::exact::ouriemi::viscosity_text;
use crate::models::section::{Contents, DuctFlow, Outline};
use crate::units::{significant, stated};

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &DuctFlow) -> String {
    let n = |x: f64| significant(x, 5);
    let duct = Duct::scaled(flow);
    let outline = match flow.outline {
        Outline::Rectangle { width } => format!("rectangle {} H wide", n(width)),
        Outline::Circle => "circle of diameter H".into(),
        Outline::Planes => "two planes".into(),
    };
    let mut text = format!(
        "Developed flow along a duct, {outline}.\n\n\
         units      H = {} m,  S = {} = {} Pa,  S H/η = {} m/s\n\
         drive      f = -dp/dx H/S = {}\n",
        n(flow.h),
        if duct.bed().is_some() { "(ρ_p - ρ_f) g H" } else { "-dp/dx H" },
        n(flow.stress_scale()),
        n(flow.shear_scale() * flow.h),
        n(duct.f),
    );
    text += &match duct.filling {
        Filling::Bingham(y) => format!(
            "material   viscosity 1, yield stress y = τ_0/S = {}\n\
             minimum    ∫ |∇u|²/2 + y |∇u| - f u  over the section,  u = 0 on the wall\n",
            n(y)
        ),
        Filling::Bed { level, e, resistance, k } => {
            let bed = format!(
                "bed        z < h_p = {} H,  viscosity e = η_e/η = {},  yield stress y = μ_s φ (h_p - z),  μ_s φ = {}\n",
                n(level),
                n(e),
                n(resistance)
            );
            bed + match k {
                None => "minimum    ∫ e |∇u|²/2 + y |∇u| - f u  over the section,  u = 0 on the wall\n",
                Some(_) => {
                    "minimum    ∫ e |∇U|²/2 - f U  over the section  +  ∫ (U - u_p)²/(2 K) + y |∇u_p|  over the bed\n\
                     \x20          U = 0 and u_p = 0 on the wall\n"
                }
            }
        }
    };
    if let Contents::Bed(bed) = &flow.contents {
        text += &format!("viscosity  {}\nfriction   {}\n", viscosity_text(bed), coulomb::INFO.equation);
        text.extend(bed.drag.map(|law| {
            let k = law.permeability(bed.phi, bed.d / bed.h);
            format!(
                "drag       {},  ε = 1 - φ,  in these units K = {},  Brinkman length sqrt(K e) = {} H\n",
                stated(carman_kozeny::INFO.equation, &[("k_CK", law.k_ck, "")]),
                n(k),
                n((k * bed.viscosity.relative(bed.phi)).sqrt())
            )
        }));
    }
    let Regularisation { law, lambda } = flow.regularisation;
    let lead = if law == Smoothing::Simple { "|γ| y replaced so that the stress is" } else { "stress" };
    let yielding = law
        .equation()
        .map_or("exact".into(), |law| format!("{lead} y {},  λ = {}", law.trim_start_matches("sign(γ) "), n(lambda)));
    format!("{text}yield      {yielding}\n")
}
