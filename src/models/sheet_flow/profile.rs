//! The profile of a sheet flow in SI: the bottom, the middles of the cells of the bed, the interface, the middles above it.
//!
//! At the interface the slip ends: above it the grains move with the fluid. The velocity of the fluid and the flux jump there, and the profile
//! has both values, on two levels that differ by round-off alone.

use super::cold::Solved;
use super::layers::Layers;
use crate::closures::friction::FrictionLaw;
use crate::models::sheet_flow::SheetFlow;
use crate::result::{Profile, Quantity, TableError, quantity as q};

/// One level in the units of the model. `None` is undefined there.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    z: f64,
    phi: f64,
    u_fluid: f64,
    u_particle: Option<f64>,
    u_mixture: f64,
    flux: f64,
    tau_fluid: Option<f64>,
    tau_reynolds: Option<f64>,
    tau_particle: Option<f64>,
    pressure: Option<f64>,
    gamma: Option<f64>,
    inertia: Option<f64>,
    length: f64,
    eddy: Option<f64>,
    stokes: Option<f64>,
    ratio: Option<f64>,
    cumulative: f64,
}

pub(super) fn profile<F: FrictionLaw>(
    sheet: &SheetFlow<F>,
    solved: &Solved<F>,
    layers: &Layers,
) -> Result<Profile, TableError> {
    let rows = rows(solved, layers);
    let (d, velocity, stress) = (sheet.d, sheet.velocity_scale(), sheet.stress_scale());
    let column = |scale: f64, value: &dyn Fn(&Row) -> Option<f64>| -> Vec<Option<f64>> {
        rows.iter().map(|row| value(row).map(|x| x * scale)).collect()
    };
    let mut axis: Vec<f64> = rows.iter().map(|row| row.z * d).collect();
    // Levels are ascending: the upper side of the interface is the next number.
    for row in 1..axis.len() {
        if axis[row] <= axis[row - 1] {
            axis[row] = axis[row - 1].next_up();
        }
    }
    let mut profile = Profile::new(axis)?;
    let table: [(&'static Quantity, Vec<Option<f64>>); 16] = [
        (&q::PHI, column(1.0, &|r| Some(r.phi))),
        (&q::U_FLUID, column(velocity, &|r| Some(r.u_fluid))),
        (&q::U_PARTICLE, column(velocity, &|r| r.u_particle)),
        (&q::U_MIXTURE, column(velocity, &|r| Some(r.u_mixture))),
        (&q::FLUX, column(velocity, &|r| Some(r.flux))),
        (&q::TAU_VISCOUS, column(stress, &|r| r.tau_fluid)),
        (&q::TAU_REYNOLDS, column(stress, &|r| r.tau_reynolds)),
        (&q::TAU_PARTICLE, column(stress, &|r| r.tau_particle)),
        (&q::P_PARTICLE, column(stress, &|r| r.pressure)),
        (&q::SHEAR_RATE, column(velocity / d, &|r| r.gamma)),
        (&q::INERTIAL_NUMBER, column(1.0, &|r| r.inertia)),
        (&q::MIXING_LENGTH, column(d, &|r| Some(r.length))),
        (&q::STOKES, column(1.0, &|r| r.stokes)),
        (&q::RATIO_R, column(1.0, &|r| r.ratio)),
        (&q::CUMULATIVE_FLUX, column(velocity * d, &|r| Some(r.cumulative))),
        (&q::EDDY_VISCOSITY, column(velocity * d, &|r| r.eddy)),
    ];
    for (quantity, values) in table {
        profile.push(quantity, values)?;
    }
    Ok(profile)
}

fn rows<F: FrictionLaw>(solved: &Solved<F>, layers: &Layers) -> Vec<Row> {
    let flow = &solved.column.flow;
    let n = layers.cells.len();
    let mut rows = vec![Row { phi: layers.cells[n - 1].phi, u_particle: Some(0.0), ..Row::default() }];
    let mut cumulative = 0.0;
    for c in (0..n).rev() {
        let cell = &layers.cells[c];
        let (top, bottom) = (layers.nodes[c], layers.nodes[c + 1]);
        let (u, w) = (0.5 * (top.0 + bottom.0), 0.5 * (top.1 + bottom.1));
        let [free, viscous, turbulent] = flow.grain().rates(cell.pressure, w);
        let mixture = u + w;
        // Nothing shears in grains at rest under the exact yield: the fluid carries nothing by turbulence, and by viscosity what infinity times
        // zero is, which nobody can say. What grains and the fluid packed between them carry is the whole.
        let rests = flow.lambda == 0.0 && cell.inertia == 0.0;
        // To the middle of the cell, over which the velocity is linear.
        let half = 0.25 * cell.dm * (u + bottom.0);
        rows.push(Row {
            z: layers.middle(c),
            phi: cell.phi,
            u_fluid: (mixture - cell.phi * u) / (1.0 - cell.phi),
            u_particle: Some(u),
            u_mixture: mixture,
            flux: cell.phi * u,
            tau_fluid: (!rests).then_some(cell.tau_f),
            tau_reynolds: Some(layers.s[c] - cell.tau_f),
            tau_particle: Some(if rests { cell.tau_p + layers.s[c] } else { cell.tau_p }),
            pressure: Some(cell.pressure),
            gamma: Some(cell.gamma.abs()),
            inertia: Some(cell.inertia),
            length: cell.length,
            eddy: Some((1.0 - cell.phi) * cell.length * cell.length * cell.rate.abs()),
            stokes: Some(viscous / free),
            ratio: Some(turbulent / free),
            cumulative: cumulative + half,
        });
        cumulative += cell.dm * u;
    }
    let (u, w) = layers.nodes[0];
    let phi = layers.inflow.phi;
    rows.push(Row {
        z: layers.z[0],
        phi,
        u_fluid: (u + w - phi * u) / (1.0 - phi),
        u_particle: Some(u),
        u_mixture: u + w,
        flux: phi * u,
        tau_particle: Some(0.0),
        pressure: Some(0.0),
        length: layers.inflow.length,
        cumulative,
        ..Row::default()
    });
    // The same level from above.
    rows.push(Row {
        z: layers.z[0],
        phi,
        u_fluid: u + w,
        u_mixture: u + w,
        flux: phi * (u + w),
        length: layers.inflow.length,
        cumulative,
        ..Row::default()
    });
    let mut below = (0.0, phi.ln(), layers.inflow.length, u + w);
    for level in &layers.levels {
        let (shear, eddy, stress) = level.cell;
        let phi = if level.ln_phi.is_finite() { (0.5 * (below.1 + level.ln_phi)).exp() } else { 0.0 };
        let u = 0.5 * (below.3 + level.u);
        let step = phi * u * (level.z - below.0);
        let viscous = flow.nu * shear;
        rows.push(Row {
            z: layers.z[0] + 0.5 * (below.0 + level.z),
            phi,
            u_fluid: u,
            u_mixture: u,
            flux: phi * u,
            tau_fluid: Some(viscous),
            tau_reynolds: Some(stress - viscous),
            length: 0.5 * (below.2 + level.length),
            eddy: Some(eddy),
            cumulative: cumulative + 0.5 * step,
            ..Row::default()
        });
        cumulative += step;
        below = (level.z, level.ln_phi, level.length, level.u);
    }
    rows
}
