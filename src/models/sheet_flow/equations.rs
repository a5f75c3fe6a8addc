//! The equations that are solved, with their numbers.

use crate::closures::dilatancy::phi_i;
use crate::closures::drag::dallavalle;
use crate::closures::friction::FrictionLaw;
use crate::closures::lid::Top;
use crate::closures::mixing_length::{Length, li_sawamoto};
use crate::closures::suspension::Settling;
use crate::models::sheet_flow::{BedLevel, SheetFlow, SheetMethod};
use crate::units::{significant, stated};

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations<F: FrictionLaw>(sheet: &SheetFlow<F>) -> String {
    let n = |x: f64| significant(x, 5);
    let (mu, phi) = (sheet.friction, sheet.dilatancy);
    let constants: Vec<_> = mu.constants().into_iter().map(|(symbol, value)| (symbol, value, "")).collect();
    let settling: Vec<_> = sheet.suspension.settling_velocity().map(|w| ("w_s", w, "m/s")).into_iter().collect();
    let drive = match (sheet.tau_b, sheet.sine) {
        (Some(tau), Some(sine)) => format!("τ_b = {} Pa and sin β = {}: τ_top follows", n(tau), n(sine)),
        (Some(tau), None) => format!("τ_b = {} Pa: sin β follows", n(tau)),
        (None, sine) => format!("sin β = {}: τ_b follows", n(sine.unwrap_or_default())),
    };
    let level = match sheet.bed_level {
        BedLevel::InFlow => format!("h_p = {} m; the amount of grains follows", n(sheet.level)),
        BedLevel::AtRest => {
            format!("grains of {} m at φ_max, in the bed or in suspension; h_p follows", n(sheet.level))
        }
    };
    let yielding = if sheet.lambda > 0.0 {
        format!("τ_p = μ(I) P_p γ/(γ + λ),  λ = {} 1/s", n(sheet.lambda))
    } else {
        "τ_p = μ(I) P_p where the grains shear, less where they are at rest".into()
    };
    let method = match sheet.method {
        SheetMethod::Newton => "Newton on the whole column",
        SheetMethod::Iteration => "pseudo-time iteration of the two layers",
    };
    let posed = match mu.well_posed() {
        Some((low, high)) => format!(
            "well-posed    in two and three dimensions for I from {} to {} (Barker et al. 2015)",
            n(low),
            n(high)
        ),
        None => {
            "well-posed    for no I in two and three dimensions (Barker et al. 2015); one dimension hides it".into()
        }
    };
    format!(
        "Sheet flow in two layers: suspension over a bed that shears. H = {h} m, d = {d} m, ρ_p/ρ_f = {ratio}.\n\n\
         drive         {drive}\n\
         top           {lid};  τ_b = ρ_f g (H - h_p) sin β - τ_top\n\
         bed           {level}\n\n\
         Above h_p     0 = (τ_f + R)' + ρ_f g sin β,  τ_f = η U',  R = ρ_f (1 - φ) l_m² |U'| U'\n\
         suspension    {suspension}\n\
         mixing length {mixing}\n\n\
         Below h_p     0 = R' + (1 - φ) τ_f' - C_D (U - u_p) + (1 - φ) ρ_f g sin β\n\
         \x20             0 = τ_p' + φ τ_f' + C_D (U - u_p) + φ ρ_p g sin β    (no φ τ_f' in the top {cut} m of grains)\n\
         pressure      P_p = (ρ_p - ρ_f) g cos β m,  m = ∫ φ dz from z to h_p\n\
         drag          {drag}\n\
         viscosity     τ_f = η_e U',  {viscosity}\n\
         friction      {yielding},  {law}\n\
         dilatancy     {spread}\n\
         inertia       I = t γ,  {time}\n\
         {posed}\n\
         bottom        U = u_p = 0;  at h_p the stress, the velocity U, φ and l_m are continuous, P_p = 0\n\
         interface     the slip U - u_p ends at h_p: u_f and the flux φ u_p jump to U and φ U, and are drawn so\n\
         method        {method}\n",
        h = n(sheet.height),
        d = n(sheet.d),
        ratio = n(sheet.rho_p / sheet.rho_f),
        lid = stated(sheet.lid.info().equation, &sheet.lid.constants()),
        suspension = stated(sheet.suspension.info().equation, &settling),
        mixing = stated(li_sawamoto::INFO.equation, &sheet.mixing_length.constants()),
        cut = n(sheet.cut),
        drag = stated(dallavalle::INFO.equation, &sheet.drag.constants()),
        viscosity = stated(sheet.viscosity.info().equation, &sheet.viscosity.constants()),
        law = stated(F::INFO.equation, &constants),
        posed = posed,
        spread = stated(phi_i::INFO.equation, &[("φ_max", phi.phi_max, ""), ("b", phi.b, "")]),
        time = sheet.rearrangement.info().equation,
    )
}
