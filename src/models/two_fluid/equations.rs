//! The equations that are solved, with their numbers.

use crate::closures::Info;
use crate::closures::dispersion::Spread;
use crate::closures::drag::dallavalle_grain;
use crate::closures::kinetic::elastic::Enduring;
use crate::closures::kinetic::static_friction::Threshold;
use crate::closures::kinetic::{Kinetic, Moving, Stresses};
use crate::closures::mixing_length::Length;
use crate::models::two_fluid::{FluidStress, State, TwoFluid};
use crate::units::{significant, stated};

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &TwoFluid) -> String {
    let n = |x: f64| significant(x, 5);
    let share = match flow.fluid_stress {
        FluidStress::Share => "ρ_f (1 - φ)",
        FluidStress::Whole => "ρ_f",
    };
    let mut elastic = flow.elastic.constants();
    if !elastic.is_empty() {
        elastic.push(("φ_max", flow.phi_max, ""));
    }
    let stresses = match flow.granular.moving(flow.e, flow.mu_p) {
        Moving::Inertial(law) => {
            format!("stresses      {}\n", stated(flow.granular.info().equation, &law.constants()))
        }
        Moving::Kinetic(law) => kinetic(flow, &law),
    };
    let strength = flow.dispersion.strength();
    let schmidt = if strength > 0.0 { vec![("S_c", 1.0 / strength, "")] } else { Vec::new() };
    let method = match flow.state {
        State::Steady => "steady: d/dt = 0, w = 0, by Newton's method",
        State::Transient => "in time, implicit",
    };
    format!(
        "Grains and fluid as two fluids. Grains of {thickness} m at φ = {phi} at rest, {depth} m of fluid above, sin β = {sine}, d = {d} m, ρ_p/ρ_f = {ratio}.\n\n\
         fluid         d(ρ_f (1 - φ) u_f)/dt + ... = (1 - φ) ρ_f g sin β + τ_f' - φ (1 - φ) K (u_f - u_p)\n\
         grains        d(ρ_p φ u_p)/dt + ... = φ ρ_p g sin β + τ_p' + φ (1 - φ) K (u_f - u_p)\n\
         vertical      dφ/dt + (φ w)' = 0,  ρ_p φ dw/dt + ... = -φ (ρ_p - ρ_f) g cos β - p' - φ K (w/(1 - φ) - u_d)\n\
         drag          (1 - φ) K |w| = |f|/(π d³/6) for the slip w,  {drag}\n\
         dispersion    {dispersion}\n\
         turbulence    τ_f = {share} (ν + l_m² |u_f'|) u_f',  {mixing}\n\
         {stresses}\
         contacts      {elastic}\n\
         bottom        u_f = u_p = 0, no flux;  at the free surface no stress, no flux\n\
         method        {method}\n",
        thickness = n(flow.thickness),
        phi = n(flow.phi),
        depth = n(flow.depth),
        sine = n(flow.beta.sin()),
        d = n(flow.d),
        ratio = n(flow.rho_p / flow.rho_f),
        drag = stated(dallavalle_grain::INFO.equation, &flow.drag.constants()),
        dispersion = stated(flow.dispersion.info().equation, &schmidt),
        mixing = stated(flow.mixing_length.info().equation, &flow.mixing_length.constants()),
        elastic = stated(flow.elastic.info().equation, &elastic),
    )
}

/// The lines of a kinetic theory: its energy, its stresses, and the laws that it is made of.
fn kinetic(flow: &TwoFluid, law: &Kinetic) -> String {
    let mut parts = flow.granular.parts();
    let work = law.drag_work.info();
    if !parts.contains(&work) {
        parts.push(work);
    }
    let part = |info: &&Info| format!("              {}\n", info.equation);
    let grains = [("e", flow.e, ""), ("e_eff", law.e_eff, ""), ("μ_p", flow.mu_p, "")];
    let friction = [("μ_s", flow.static_friction.mu_s(flow.mu_p), "")];
    format!(
        "heat          (3/2) d(ρ_p φ T)/dt + ... = τ_kin u_p' - p_kin w' + (κ T')' + Γ + J\n\
         stresses      τ_p = τ_kin + τ_el,  τ_kin = η u_p',  p = p_kin + p_el\n              \
         {}\n{}              {}\n",
        stated(flow.granular.info().equation, &grains),
        parts.iter().map(part).collect::<String>(),
        stated(flow.static_friction.info().equation, &friction),
    )
}
