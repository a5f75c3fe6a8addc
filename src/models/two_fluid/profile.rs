//! The profile of a two-fluid flow in SI: the middles of the cells.

use super::levels::{Level, Levels, NONE};
use crate::models::two_fluid::TwoFluid;
use crate::result::{Profile, Quantity, TableError, quantity as q};

pub(super) fn profile(flow: &TwoFluid, levels: &Levels) -> Result<Profile, TableError> {
    let (d, velocity, stress) = (flow.d, flow.velocity_scale(), flow.stress_scale());
    let ratio = flow.rho_p / flow.rho_f;
    let power = stress * velocity / d;
    let column = |scale: f64, of: &dyn Fn(&Level) -> f64| -> Vec<Option<f64>> {
        levels.cells.iter().map(|level| Some(of(level) * scale)).collect()
    };
    // What only grains have is undefined where there are none.
    let grains = |scale: f64, of: &dyn Fn(&Level) -> f64| -> Vec<Option<f64>> {
        levels.cells.iter().map(|level| (level.phi > NONE).then(|| of(level) * scale)).collect()
    };
    let solid = |level: &Level| if level.phi > NONE { level.phi } else { 0.0 };
    let whole = |level: &Level| level.pressure + level.elastic;
    let mut profile = Profile::new(levels.cells.iter().map(|level| level.z * d).collect())?;
    let mut below = 0.0;
    let cumulative = levels.cells.iter().map(|level| {
        let here = level.phi * level.v * level.dz;
        below += here;
        Some((below - 0.5 * here) * velocity * d)
    });
    let cumulative = cumulative.collect();
    let table: [(&'static Quantity, Vec<Option<f64>>); 23] = [
        (&q::PHI, column(1.0, &solid)),
        (&q::U_FLUID, column(velocity, &|level| level.u)),
        (&q::U_PARTICLE, grains(velocity, &|level| level.v)),
        (&q::U_MIXTURE, column(velocity, &|level| (1.0 - solid(level)) * level.u + solid(level) * level.v)),
        (&q::FLUX, column(velocity, &|level| solid(level) * level.v)),
        (&q::TAU_VISCOUS, column(stress, &|level| level.viscous)),
        (&q::TAU_REYNOLDS, column(stress, &|level| level.turbulent)),
        (&q::TAU_PARTICLE, column(stress, &|level| level.kinetic + level.contact)),
        (&q::TAU_CONTACT, column(stress, &|level| level.contact)),
        (&q::P_PARTICLE, column(stress, &whole)),
        (&q::P_CONTACT, column(stress, &|level| level.elastic)),
        (&q::SHEAR_RATE, grains(velocity / d, &|level| level.shear.abs())),
        (&q::INERTIAL_NUMBER, grains(1.0, &|level| level.shear.abs() * (ratio / whole(level)).sqrt())),
        (&q::MIXING_LENGTH, column(d, &|level| level.length)),
        (&q::EDDY_VISCOSITY, column(velocity * d, &|level| level.eddy)),
        (&q::GRANULAR_TEMPERATURE, grains(velocity * velocity, &|level| level.t)),
        (&q::RADIAL, levels.cells.iter().map(|level| level.radial.filter(|_| level.phi > NONE)).collect()),
        (&q::PRODUCTION, grains(power, &|level| level.production)),
        (&q::FLUCTUATION_FLUX, grains(stress * velocity, &|level| level.flux)),
        (&q::DIFFUSION, grains(power, &|level| level.diffusion)),
        (&q::CONTACT_LOSS, grains(power, &|level| level.contacts)),
        (&q::DRAG_LOSS, grains(power, &|level| level.drag_work)),
        (&q::CUMULATIVE_FLUX, cumulative),
    ];
    let kinetic = levels.cells.iter().any(|level| level.radial.is_some());
    let fluctuations = [
        &q::GRANULAR_TEMPERATURE,
        &q::RADIAL,
        &q::PRODUCTION,
        &q::FLUCTUATION_FLUX,
        &q::DIFFUSION,
        &q::CONTACT_LOSS,
        &q::DRAG_LOSS,
    ];
    for (quantity, values) in table {
        if kinetic || !fluctuations.contains(&quantity) {
            profile.push(quantity, values)?;
        }
    }
    Ok(profile)
}
