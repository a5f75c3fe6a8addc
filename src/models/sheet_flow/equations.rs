//! The equations that are solved, with their numbers.

use crate::closures::dilatancy::phi_i;
use crate::closures::friction::FrictionLaw;
use crate::closures::lid::Lid;
use crate::models::sheet_flow::{BedReading, SheetFlow, SheetMethod};
use crate::units::significant;

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations<F: FrictionLaw>(sheet: &SheetFlow<F>) -> String {
    let n = |x: f64| significant(x, 5);
    let (mu, phi) = (sheet.friction, sheet.dilatancy);
    let constants: Vec<String> = mu.constants().iter().map(|(symbol, x)| format!("{symbol} = {}", n(*x))).collect();
    let drive = match (sheet.tau_b, sheet.sine) {
        (Some(tau), Some(sine)) => format!("τ_b = {} Pa and sin β = {}: τ_top follows", n(tau), n(sine)),
        (Some(tau), None) => format!("τ_b = {} Pa: sin β follows", n(tau)),
        (None, sine) => format!("sin β = {}: τ_b follows", n(sine.unwrap_or_default())),
    };
    let lid = match sheet.lid {
        Lid::FreeSurface => "τ_top = 0, a free surface".into(),
        Lid::Solved => "τ_top follows from the drive".into(),
        Lid::Stress(law) => format!("τ_top = {} Pa", n(law.stress)),
        Lid::ColebrookWhite(law) => format!("τ_top = f/8 ρ_f U_m², f by Colebrook-White, k_s = {} m", n(law.roughness)),
    };
    let level = match sheet.reading {
        BedReading::Final => format!("h_p = {} m; the amount of grains follows", n(sheet.level)),
        BedReading::Initial => {
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
         Above h_p     0 = (τ_f + R)' + ρ_f g sin β,  τ_f = η U',  R = ρ_f (1 - φ) l² |U'| U'\n\
         suspension    {suspension}\n\
         mixing length l = κ ∫ (φ_m - φ)/φ_m dz from the bottom,  κ = {kappa}, φ_m = {phi_l}\n\n\
         Below h_p     0 = R' + (1 - φ) τ_f' - C_D (U - u_p) + (1 - φ) ρ_f g sin β\n\
                       0 = τ_p' + φ τ_f' + C_D (U - u_p) + φ ρ_p g sin β    (no φ τ_f' in the top {cut} m of grains)\n\
         pressure      P_p = (ρ_p - ρ_f) g cos β m,  m = ∫ φ dz from z to h_p\n\
         drag          C_D = ρ_f φ/(d (1 - φ)^{exponent}) (0.3 |U - u_p| + 18.3 η/(ρ_f d))\n\
         viscosity     τ_f = η_e U',  η_e by {viscosity}\n\
         friction      {yielding},  {law},  {constants}\n\
         dilatancy     {spread},  φ_max = {phi_max}, b = {b}\n\
         inertia       I = t γ,  {time}\n\
         {posed}\n\
         bottom        U = u_p = 0;  at h_p the stress, the velocity, φ and l are continuous, P_p = 0\n\
         method        {method}\n",
        h = n(sheet.height),
        d = n(sheet.d),
        ratio = n(sheet.rho_p / sheet.rho_f),
        suspension = sheet.suspension.info().equation,
        kappa = n(sheet.mixing_length.kappa),
        phi_l = n(sheet.mixing_length.phi_max),
        cut = n(sheet.cut),
        exponent = n(sheet.drag.exponent),
        viscosity = sheet.viscosity.info().equation,
        law = F::INFO.equation,
        constants = constants.join(", "),
        posed = posed,
        phi_max = n(phi.phi_max),
        b = n(phi.b),
        spread = phi_i::INFO.equation,
        time = sheet.rearrangement.info().equation,
    )
}
