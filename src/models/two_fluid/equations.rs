//! The equations that are solved, with their numbers.

use crate::closures::kinetic::elastic::{johnson_jackson, none};
use crate::closures::kinetic::static_friction::Threshold;
use crate::closures::kinetic::{Elastic, Granular, Stresses};
use crate::models::two_fluid::{FluidStress, State, TwoFluid};
use crate::units::significant;

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &TwoFluid) -> String {
    let n = |x: f64| significant(x, 5);
    let share = match flow.fluid_stress {
        FluidStress::Share => "ρ_f (1 - φ)",
        FluidStress::Whole => "ρ_f",
    };
    let elastic = match flow.elastic {
        Elastic::None => none::INFO.equation.to_owned(),
        Elastic::JohnsonJackson(law) => format!(
            "{},  P₀ = {} Pa, φ_rlp = {}, φ_max = {}",
            johnson_jackson::INFO.equation,
            n(law.p_0),
            n(law.phi_rlp),
            n(flow.phi_max)
        ),
    };
    let mu_s = n(flow.static_friction.mu_s(flow.mu_p));
    let stresses = match flow.granular {
        Granular::Inertial(law) => format!(
            "stresses      τ_p = μ(I) p,  p = p_el + ρ_p (b φ/(φ_max - φ))² (d u_p')²,  μ_s = {}, μ_2 = {}, I_0 = {}, b = {}\n",
            n(law.mu_s),
            n(law.mu_2),
            n(law.i_0),
            n(law.b)
        ),
        Granular::GarzoDufty(_) => kinetic(flow, flow.e, 3.0.to_string().as_str(), &mu_s),
        Granular::FrictionalCollisional(law) => {
            kinetic(flow, law.kinetic(flow.e, flow.mu_p).e_eff, "(3 + 2 C_∞/C_D)", &mu_s)
        }
    };
    let parts: Vec<String> =
        flow.granular.parts().iter().map(|info| format!("              {}\n", info.equation)).collect();
    let method = match flow.state {
        State::Steady => "steady: d/dt = 0, w = 0, by Newton's method",
        State::Transient => "in time, implicit",
    };
    format!(
        "Grains and fluid as two fluids. Grains of {thickness} m at φ = {phi} at rest, {depth} m of fluid above, sin β = {sine}, d = {d} m, ρ_p/ρ_f = {ratio}.\n\n\
         fluid         d(ρ_f (1 - φ) u_f)/dt + ... = (1 - φ) ρ_f g sin β + τ_f' - φ (1 - φ) K (u_f - u_p)\n\
         grains        d(ρ_p φ u_p)/dt + ... = φ ρ_p g sin β + τ_p' + φ (1 - φ) K (u_f - u_p)\n\
         vertical      dφ/dt + (φ w)' = 0,  ρ_p φ dw/dt + ... = -φ (ρ_p - ρ_f) g cos β - p' - φ K w/(1 - φ)\n\
         drag          K = (3/4)(ρ_f/d)(C_∞ |w| + 24.4 ν/d)(1 - φ)^(-{exponent} - 1),  C_∞ = {constant}\n\
         turbulence    τ_f = {share} (ν + l² |u_f'|) u_f',  {mixing}\n\
         {stresses}{parts}\
         contacts      {elastic}\n\
         bottom        u_f = u_p = 0, no flux;  at the free surface no stress, no flux\n\
         method        {method}\n",
        thickness = n(flow.thickness),
        phi = n(flow.phi),
        depth = n(flow.depth),
        sine = n(flow.beta.sin()),
        d = n(flow.d),
        ratio = n(flow.rho_p / flow.rho_f),
        exponent = n(flow.drag.exponent),
        constant = n(flow.drag.constant),
        mixing = flow.mixing_length.info().equation,
        parts = parts.concat(),
    )
}

fn kinetic(flow: &TwoFluid, e_eff: f64, work: &str, mu_s: &str) -> String {
    let n = |x: f64| significant(x, 5);
    format!(
        "heat          (3/2) d(ρ_p φ T)/dt + ... = τ_kin u_p' - p_kin w' + (κ T')' - (ρ_p/d) F₄(e_eff) T^(3/2) - φ (1 - φ) K {work} T\n\
         stresses      τ_p = τ_kin + μ_s p_el,  τ_kin = ρ_p d F₂ T^½ u_p',  p = ρ_p F₁ T + p_el,  κ = ρ_p d F₃ T^½\n              \
         e = {}, e_eff = {}, μ_p = {}, μ_s = {mu_s}\n",
        n(flow.e),
        n(e_eff),
        n(flow.mu_p)
    )
}
