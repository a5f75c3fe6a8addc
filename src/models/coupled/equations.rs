//! The equations that are solved, with their numbers.

use crate::closures::drag::dallavalle_grain;
use crate::closures::mixing_length::Length;
use crate::dem::keep::contact_equations;
use crate::models::coupled::{Coupled, Surface};
use crate::units::{significant, stated};

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(flow: &Coupled) -> String {
    let n = |x: f64| significant(x, 5);
    let bed = &flow.bed;
    let surface = match flow.surface {
        Surface::Height(height) => format!("{} m over the mean centre of the fixed grains", n(height)),
        Surface::Depth(depth) => format!("{} m over the bed at rest", n(depth)),
    };
    format!(
        "ε ρ_f du/dt = d(ε τ_f)/dz + dR/dz + ε ρ_f g sin α - Σ f per volume - side walls, ρ_f = {} kg/m³, ν = {} m²/s, g sin α = {} m/s²; \
         no slip at z = 0, free surface {surface}.\nm dv/dt = Σ contacts + m g sin α e_x - (m - ρ_f V) g cos α e_z + f\n\n\
         drag           {},  w = u + u' - v\n\
         eddies         {}\n\
         turbulence     R = ρ_f ε l_m² |du/dz| du/dz,  {}\n\
         viscosity      τ_f = η_e du/dz,  {}\n\
         side walls     ε ρ_f (2/W) (f/8) u |u| with the friction factor {}\n\
         fluid          solved every {} s\n\n\
         {} mobile spheres, d = {} m, ρ_p = {} kg/m³; x periodic over {} m, y {} {} m.\n\n{}",
        n(flow.rho_f),
        n(flow.nu()),
        n(bed.g * bed.beta.sin()),
        stated(dallavalle_grain::INFO.equation, &flow.drag.constants()),
        flow.fluctuation.info().equation,
        stated(flow.mixing_length.info().equation, &flow.mixing_length.constants()),
        stated(flow.viscosity.info().equation, &flow.viscosity.constants()),
        flow.side_wall.info().equation,
        n(flow.coupling_period),
        bed.mobile,
        n(bed.d),
        n(bed.rho_p),
        n(bed.size[0]),
        if bed.side_walls { "between walls at a distance of" } else { "periodic over" },
        n(bed.size[1]),
        contact_equations(&bed.contact)
    )
}
