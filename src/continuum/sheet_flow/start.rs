//! A first guess of the column, from balances of whole layers.

use super::bed::{STRIDE, State, cell};
use super::column::Setting;
use super::flow::Flow;
use super::mesh::Mesh;
use super::newton::Column;
use super::suspension::Meshes;
use crate::closures::lid::Lid;

/// Solid fraction of the moving layer in the first guess.
const MEAN_PHI: f64 = 0.45;
/// Share of the cells in the bed.
const IN_BED: f64 = 0.72;
/// Scale of the mesh under the interface, in grain diameters of solid volume.
const TOP: f64 = 0.01;

impl Column {
    /// The mesh of `cells` cells for a flow, and a first guess on it: the grains shear at the share `friction` of the range
    /// of their friction wherever the stress is enough for that, and carry all of it elsewhere.
    #[must_use]
    pub fn start(flow: Flow, setting: Setting, cells: usize, friction: f64) -> (Self, State) {
        Self::start_at(flow, setting, cells, (friction, None))
    }

    /// As [`Column::start`], with the solid volume over the yield level where it is known.
    #[must_use]
    pub fn start_at(
        flow: Flow,
        setting: Setting,
        cells: usize,
        (friction, mobile): (f64, Option<f64>),
    ) -> (Self, State) {
        let room = setting.height - setting.level;
        let (tau_b, sine) = match (setting.tau_b, setting.sine) {
            (Some(tau_b), None) => (tau_b, (tau_b + lid_guess(&setting)) * flow.delta / room),
            (Some(tau_b), Some(sine)) => (tau_b, sine),
            (None, sine) => {
                let sine = sine.unwrap_or_default();
                (drive_guess(&flow, &setting, sine, room), sine)
            }
        };
        let m = flow.dilatancy.phi_max * setting.level;
        let mobile = mobile.unwrap_or_else(|| mobile_volume(&flow, tau_b, sine)).min(0.9 * m);
        let in_bed = ((IN_BED * cells as f64) as usize).max(8);
        let above = cells.saturating_sub(in_bed).max(4);
        let lid = setting.lid != Lid::FreeSurface;
        let under_lid = if lid { (above / 5).max(2) } else { 0 };
        let reach = (tau_b * flow.delta / sine).min(room);
        let mesh = Mesh::bed(in_bed, TOP / m, mobile / m);
        let meshes = Meshes {
            below: Mesh::suspension(above - under_lid, (2.0 / reach).min(0.5)),
            above: lid.then(|| Mesh::under_lid(under_lid)),
        };
        let state = guess(&flow, &mesh, (tau_b, sine.min(0.9), m), (mobile, friction));
        (Self { flow, setting, mesh, meshes }, state)
    }
}

/// `from` on the mesh `mesh`: values of nodes and of cells by linear interpolation in the solid volume.
#[must_use]
pub fn transfer(from: &State, old: &Mesh, new: &Mesh) -> State {
    let (n, m) = (old.cells(), new.cells());
    let mut state = State { x: vec![0.0; STRIDE * m], ..from.clone() };
    let between = |x: f64, places: &[f64], value: &dyn Fn(usize) -> f64| {
        let i = places.partition_point(|&p| p < x).clamp(1, places.len() - 1) - 1;
        let share = ((x - places[i]) / (places[i + 1] - places[i])).clamp(0.0, 1.0);
        value(i) + share * (value(i + 1) - value(i))
    };
    for c in 0..m {
        for k in 0..STRIDE {
            let value = |i: usize| from.x.get(STRIDE * i + k).copied().unwrap_or(0.0);
            state.x[STRIDE * c + k] = if k < 3 {
                between(new.nodes[c], &old.nodes[..=n], &value)
            } else {
                between(new.middles[c], &old.middles, &value)
            };
        }
    }
    state
}

fn lid_guess(setting: &Setting) -> f64 {
    match setting.lid {
        Lid::Stress(law) => law.stress,
        _ => 0.0,
    }
}

fn drive_guess(flow: &Flow, setting: &Setting, sine: f64, room: f64) -> f64 {
    let whole = flow.fluid_weight(sine) * room;
    match setting.lid {
        Lid::ColebrookWhite(_) => 0.8 * whole,
        Lid::Stress(law) => (whole - law.stress).max(0.1 * whole),
        _ => whole,
    }
}

/// Solid volume over the yield level, from the balance of the moving layer.
fn mobile_volume(flow: &Flow, tau_b: f64, sine: f64) -> f64 {
    let hold = flow.friction.mu_s * (1.0 - sine * sine).max(0.0).sqrt();
    let net = hold - sine * (1.0 / (flow.delta * MEAN_PHI) + 1.0);
    tau_b / net.max(0.2 * hold)
}

fn guess(flow: &Flow, mesh: &Mesh, (tau_b, sine, m): (f64, f64, f64), (mobile, friction): (f64, f64)) -> State {
    let n = mesh.cells();
    let mut state = State { x: vec![0.0; STRIDE * n], tau_b, sine, m };
    let law = flow.friction;
    let cosine = (1.0 - sine * sine).sqrt();
    for c in 0..n {
        let depth = m * mesh.middles[c];
        let total = tau_b + sine * depth + flow.fluid_weight(sine) * depth / MEAN_PHI;
        let r = (law.mu_s + friction * (law.mu_2 - law.mu_s)).min(total / (cosine * depth));
        state.x[STRIDE * c + 3] = r;
        state.x[STRIDE * c + 4] = (total - r * cosine * depth).clamp(0.0, total);
        let node = (1.0 - m * mesh.nodes[c] / mobile).max(0.0);
        // The slip that carries the friction of the grains.
        let push = 0.5 * law.mu_s;
        let linear = 18.3 * flow.nu;
        let drag = (linear * linear + 4.0 * 0.3 * push).sqrt();
        state.x[STRIDE * c + 1] = (drag - linear) / 0.6 * 0.5 * node.powf(1.5) + 1e-6;
    }
    for c in (0..n).rev() {
        let cell = cell(flow, mesh, &state, c);
        state.x[STRIDE * c] = state.u(c + 1) + cell.gamma * cell.dz;
        state.x[STRIDE * c + 2] = state.d(c + 1) + cell.dz - cell.dm / flow.dilatancy.phi_max;
    }
    state
}
