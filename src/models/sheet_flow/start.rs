//! A first guess of the column, from balances of whole layers.

use super::bed::{STRIDE, State, cell};
use super::column::{Floor, Setting};
use super::flow::Flow;
use super::mesh::Mesh;
use super::newton::Column;
use super::suspension::Meshes;
use crate::closures::friction::FrictionLaw;
use crate::closures::lid::Lid;

/// Solid fraction of the moving layer in the first guess.
const MEAN_PHI: f64 = 0.45;
/// Share of the cells in the bed.
const IN_BED: f64 = 0.55;
/// Scale of the mesh under the interface, in grain diameters of solid volume.
pub(super) const TOP: f64 = 0.002;

/// What a first guess starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// what lies under the cells
    pub floor: Floor,
    /// share of the range of the friction at which the grains shear
    pub friction: f64,
    /// solid volume over the yield level, where it is known
    pub mobile: Option<f64>,
}

impl<F: FrictionLaw> Column<F> {
    /// The mesh of `cells` cells for a flow, and a first guess on it: the grains shear at a share of the range of their
    /// friction wherever the stress is enough for that, and carry all of it elsewhere.
    #[must_use]
    pub fn start(flow: Flow<F>, setting: Setting, cells: usize, from: Guess) -> (Self, State) {
        let room = setting.height - setting.level;
        let (tau_b, sine) = match (setting.tau_b, setting.sine) {
            (Some(tau_b), None) => (tau_b, (tau_b + lid_guess(&setting)) * flow.delta / room),
            (Some(tau_b), Some(sine)) => (tau_b, sine),
            (None, sine) => {
                let sine = sine.unwrap_or_default();
                (drive_guess(&flow, &setting, sine, room), sine)
            }
        };
        let whole = flow.dilatancy.phi_max * setting.level;
        let mobile = from.mobile.unwrap_or_else(|| mobile_volume(&flow, tau_b, sine)).min(0.9 * whole);
        let in_bed = ((IN_BED * cells as f64) as usize).max(8);
        let above = cells.saturating_sub(in_bed).max(4);
        let lid = setting.lid != Lid::FreeSurface;
        let under_lid = if lid { (above / 5).max(2) } else { 0 };
        let reach = (tau_b * flow.delta / sine).min(room);
        let mesh = match from.floor {
            Floor::Yield => Mesh::moving(in_bed, TOP / mobile),
            Floor::Bottom => Mesh::bed(in_bed, TOP / whole, mobile / whole),
        };
        let meshes = Meshes {
            below: Mesh::suspension(above - under_lid, (2.0 / reach).min(0.5)),
            above: lid.then(|| Mesh::under_lid(under_lid)),
        };
        let m = if from.floor == Floor::Yield { mobile } else { whole };
        let column = Self { flow, setting, mesh, meshes, floor: from.floor };
        let state = column.guess((tau_b, sine.min(0.9), m), (mobile, from.friction));
        (column, state)
    }

    fn guess(&self, (tau_b, sine, m): (f64, f64, f64), (mobile, friction): (f64, f64)) -> State {
        let (flow, mesh) = (&self.flow, &self.mesh);
        let n = mesh.cells();
        let mut state = State { x: vec![0.0; STRIDE * n], tau_b, sine, m, rest: 0.0 };
        let law = flow.friction;
        let cosine = (1.0 - sine * sine).sqrt();
        for c in 0..n {
            let depth = m * mesh.middles[c];
            let total = tau_b + sine * depth + flow.fluid_weight(sine) * depth / MEAN_PHI;
            let r = (law.least() + friction * (law.most() - law.least())).min(total / (cosine * depth));
            state.x[STRIDE * c + 3] = r;
            state.x[STRIDE * c + 4] = (total - r * cosine * depth).max(0.0).min(total);
            let node = (1.0 - m * mesh.nodes[c] / mobile).max(0.0);
            // The slip that carries the friction of the grains.
            let push = 0.5 * law.least();
            let linear = 18.3 * flow.nu;
            let drag = (linear * linear + 4.0 * 0.3 * push).sqrt();
            state.x[STRIDE * c + 1] = (drag - linear) / 0.6 * 0.5 * node.powf(1.5) + 1e-6;
        }
        for c in (0..n).rev() {
            let cell = cell(flow, mesh, &state, c);
            state.x[STRIDE * c] = state.u(c + 1) + cell.gamma * cell.dz;
            state.x[STRIDE * c + 2] = state.d(c + 1) + cell.dz - cell.dm / flow.dilatancy.phi_max;
        }
        if self.floor == Floor::Yield {
            state.rest = (self.setting.level - state.d(0)) * flow.dilatancy.phi_max - m;
        }
        state
    }

    /// Friction and fluid stress of the grains at rest under a moving layer, at the solid volume `m` under the interface, for
    /// the fluid stress `s` at the yield level. The viscous stress of a fluid at rest in grains at rest is what balances its
    /// weight.
    #[must_use]
    pub fn at_rest(&self, state: &State, s: f64, m: f64) -> (f64, f64) {
        let cosine = (1.0 - state.sine * state.sine).sqrt();
        let below = m - state.m;
        let tau_p = self.flow.friction.least() * cosine * state.m + state.sine * below;
        (tau_p / (cosine * m), s + self.flow.fluid_weight(state.sine) * below / self.flow.dilatancy.phi_max)
    }

    /// The state `from` of this column on another mesh of the solid volume `m`, `rest` below it: by linear interpolation in
    /// the solid volume, and grains at rest below the yield level.
    #[must_use]
    pub fn transfer(&self, from: &State, mesh: &Mesh, (m, rest): (f64, f64)) -> State {
        let (n, old) = (self.mesh.cells(), &self.mesh);
        let mut state = State { x: vec![0.0; STRIDE * mesh.cells()], m, rest, ..from.clone() };
        let between = |x: f64, places: &[f64], value: &dyn Fn(usize) -> f64| {
            let i = places.partition_point(|&p| p < x).clamp(1, places.len() - 1) - 1;
            let share = ((x - places[i]) / (places[i + 1] - places[i])).clamp(0.0, 1.0);
            value(i) + share * (value(i + 1) - value(i))
        };
        let ends = self.floor == Floor::Yield;
        for c in 0..mesh.cells() {
            let (node, middle) = (m * mesh.nodes[c] / from.m, m * mesh.middles[c] / from.m);
            for k in 0..3 {
                let value = |i: usize| from.x.get(STRIDE * i + k).copied().unwrap_or(0.0);
                state.x[STRIDE * c + k] = between(node, &old.nodes, &value);
            }
            let k = STRIDE * c + 3;
            let last = old.middles[n - 1];
            if ends && middle > last {
                let (r, s) = (from.r(n - 1), from.s(n - 1));
                let share = ((middle - last) / (1.0 - last)).min(1.0);
                state.x[k] = r + share * (self.flow.friction.least() - r);
                state.x[k + 1] = s;
                if middle > 1.0 {
                    (state.x[k], state.x[k + 1]) = self.at_rest(from, s, m * mesh.middles[c]);
                }
            } else {
                state.x[k] = between(middle, &old.middles, &|i| from.r(i));
                state.x[k + 1] = between(middle, &old.middles, &|i| from.s(i));
            }
        }
        state
    }
}

fn lid_guess(setting: &Setting) -> f64 {
    match setting.lid {
        Lid::Stress(law) => law.stress,
        _ => 0.0,
    }
}

fn drive_guess<F: FrictionLaw>(flow: &Flow<F>, setting: &Setting, sine: f64, room: f64) -> f64 {
    let whole = flow.fluid_weight(sine) * room;
    match setting.lid {
        Lid::ColebrookWhite(_) => 0.8 * whole,
        Lid::Stress(law) => (whole - law.stress).max(0.1 * whole),
        _ => whole,
    }
}

/// Solid volume over the yield level, from the balance of the moving layer.
pub(super) fn mobile_volume<F: FrictionLaw>(flow: &Flow<F>, tau_b: f64, sine: f64) -> f64 {
    let resistance = flow.friction.least() * (1.0 - sine * sine).max(0.0).sqrt();
    let net = resistance - sine * (1.0 / (flow.delta * MEAN_PHI) + 1.0);
    tau_b / net.max(0.2 * resistance)
}
