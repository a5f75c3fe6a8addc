//! The fluid layer above the bed: its discrete equations, one cell after the other from the interface up.
//!
//! The stress is known at every height, so the layer is an initial-value problem in the solid fraction, the mixing length
//! and the velocity: implicit midpoint rule, order 2. Per cell, with the middle values phi, l and the stress S there,
//! `nu G + (1 - phi) l^2 |G| G = S`, `ln phi` falls by `w_s dz/((1 - phi) l^2 |G|)`, `l` grows by `kappa (1 - phi/phi_l) dz`.

use super::flow::Flow;
use super::mesh::Mesh;
use crate::closures::friction::FrictionLaw;
use crate::closures::suspension::rouse;
use crate::numerics::dual::{Dual, Real};

/// What the bed and the drive give.
#[derive(Clone, Copy, Debug)]
pub struct Inflow<T> {
    /// solid fraction under the interface
    pub phi: T,
    /// mixing length at the interface
    pub length: T,
    /// mixture velocity at the interface
    pub u: T,
    /// stress on the interface
    pub tau_b: T,
    /// sine of the slope
    pub sine: T,
}

/// A node, and the cell below it.
#[derive(Clone, Copy, Debug)]
pub struct Level<T> {
    /// height over the interface
    pub z: T,
    /// logarithm of the solid fraction; minus infinity in clear fluid
    pub ln_phi: T,
    /// mixing length
    pub length: T,
    /// velocity
    pub u: T,
    /// middle of the cell below: shear rate, eddy viscosity, stress
    pub cell: (T, T, T),
}

/// Integrals over the layer.
#[derive(Clone, Copy, Debug)]
pub struct Totals<T> {
    /// solid volume per area
    pub volume: T,
    /// solid flux
    pub flux: T,
    /// integral of the velocity
    pub discharge: T,
    /// height of the layer
    pub height: T,
}

/// Meshes of the layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Meshes {
    /// up to where the stress vanishes
    pub below: Mesh,
    /// from there to the lid; `None` under a free surface
    pub above: Option<Mesh>,
}

/// Sweeps within which the middle value of a cell must settle; a few do.
const SWEEPS: usize = 60;

/// Goes up the layer of height `height`; `see` receives each node above the interface.
pub fn march<T: Real, F: FrictionLaw>(
    flow: &Flow<F>,
    meshes: &Meshes,
    inflow: &Inflow<T>,
    height: T,
    mut see: impl FnMut(&Level<T>),
) -> Totals<T> {
    let zero = T::constant(0.0);
    let weight = flow.fluid_weight(inflow.sine);
    let reach = inflow.tau_b / weight;
    let clear = flow.settling.is_none();
    let ln_phi = if clear { T::constant(f64::NEG_INFINITY) } else { inflow.phi.ln() };
    let mut level = Level { z: zero, ln_phi, length: inflow.length, u: inflow.u, cell: (zero, zero, zero) };
    let mut totals = Totals { volume: zero, flux: zero, discharge: zero, height: reach };
    let mut climb = |level: &mut Level<T>, dz: T, stress: T, grains: bool| {
        let phi = if grains { middle_fraction(flow, level, dz, stress) } else { zero };
        let length = level.length + growth(flow, phi) * dz * 0.5;
        let (shear, eddy) = layer_shear(flow, phi, length, stress);
        let u = level.u + shear * dz * 0.5;
        totals.volume = totals.volume + phi * dz;
        totals.flux = totals.flux + phi * u * dz;
        totals.discharge = totals.discharge + u * dz;
        if let (true, Some(w_s)) = (grains, flow.settling) {
            level.ln_phi = level.ln_phi - rouse::decay(w_s, eddy) * dz;
        }
        *level = Level {
            z: level.z + dz,
            length: length * 2.0 - level.length,
            u: u * 2.0 - level.u,
            cell: (shear, eddy, stress),
            ..*level
        };
        see(level);
    };
    for c in 0..meshes.below.cells() {
        let stress = inflow.tau_b * (1.0 - meshes.below.middles[c]);
        climb(&mut level, reach * meshes.below.size(c), stress, !clear);
    }
    if let Some(mesh) = &meshes.above {
        level.ln_phi = T::constant(f64::NEG_INFINITY);
        let rest = height - reach;
        for c in 0..mesh.cells() {
            climb(&mut level, rest * mesh.size(c), -(weight * rest) * mesh.middles[c], false);
        }
        totals.height = height;
    }
    totals
}

/// Slope of the mixing length.
fn growth<T: Real, F: FrictionLaw>(flow: &Flow<F>, phi: T) -> T {
    (-phi / flow.phi_l + 1.0) * flow.kappa
}

/// Shear rate and eddy viscosity.
fn layer_shear<T: Real, F: FrictionLaw>(flow: &Flow<F>, phi: T, length: T, stress: T) -> (T, T) {
    let a = (-phi + 1.0) * length * length;
    let (shear, _) = Flow::<F>::shear(stress, a, T::constant(1.0 / flow.nu));
    (shear, a * shear.abs())
}

/// The solid fraction in the middle of the cell above `level`: a fixed point, whose derivatives are those of the implicit
/// function.
fn middle_fraction<T: Real, F: FrictionLaw>(flow: &Flow<F>, level: &Level<T>, dz: T, stress: T) -> T {
    fn image<T: Real, F: FrictionLaw>(flow: &Flow<F>, (ln_phi, length): (T, T), (dz, stress): (T, T), phi: T) -> T {
        let Some(w_s) = flow.settling else { return T::constant(0.0) };
        let length = length + growth(flow, phi) * dz * 0.5;
        let (_, eddy) = layer_shear(flow, phi, length, stress);
        (ln_phi - rouse::decay(w_s, eddy) * dz * 0.5).exp()
    }
    let values = ((level.ln_phi.value(), level.length.value()), (dz.value(), stress.value()));
    let mut phi = level.ln_phi.value().exp();
    for _ in 0..SWEEPS {
        let next = image(flow, values.0, values.1, phi);
        let converged = (next - phi).abs() <= f64::EPSILON * phi;
        phi = next;
        if converged {
            break;
        }
    }
    let constant = |x: f64| Dual::<1>::constant(x);
    let own = image(
        flow,
        (constant(values.0.0), constant(values.0.1)),
        (constant(values.1.0), constant(values.1.1)),
        Dual::variable(phi, 0),
    );
    let there = image(flow, (level.ln_phi, level.length), (dz, stress), T::constant(phi));
    (there - phi) / (1.0 - own.slope[0]) + phi
}
