//! The sediment bed layer: its discrete equations.
//!
//! ```text
//!   interface  o  node 0      u, w, D   momentum of the mixture, momentum of the grains
//!              |  cell 0      r, S      u' = gamma, U' = G, D' = phi/phi_max - 1
//!              o  node 1      u, w, D
//!              |  cell 1      r, S
//!              .
//!              |  cell n-1
//!   bottom     o  node n      u = w = D = 0
//! ```
//!
//! Nodes and cells lie at fixed shares of a solid volume m: with the exact yield that of the moving grains, itself an unknown,
//! so that the corner of the solid fraction lies on node n; with creep that of the whole bed. The momentum of a node is that
//! of the volume between the middles of the cells beside it; what leaves one volume enters the next, so the momentum of the
//! whole bed closes to round-off. Unknowns are ordered `u w D r S` from the top.

use super::flow::{Cell, Flow, Unknowns};
use super::mesh::Mesh;
use crate::closures::friction::FrictionLaw;
use crate::numerics::dual::Real;

/// Unknowns of a node and the cell below it.
pub const STRIDE: usize = 5;
/// The state of the bed.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// `u w D r S` from the top; the last node is at rest
    pub x: Vec<f64>,
    /// stress of the fluid on the interface
    pub tau_b: f64,
    /// sine of the slope
    pub sine: f64,
    /// solid volume per area of the cells
    pub m: f64,
    /// solid volume per area of the grains at rest below them
    pub rest: f64,
}

impl State {
    /// Velocity of the grains at node `j`.
    #[must_use]
    pub fn u(&self, j: usize) -> f64 {
        self.x.get(STRIDE * j).copied().unwrap_or(0.0)
    }

    /// Slip U - u_p at node `j`.
    #[must_use]
    pub fn w(&self, j: usize) -> f64 {
        self.x.get(STRIDE * j + 1).copied().unwrap_or(0.0)
    }

    /// Dilation: height of what lies below node `j` beyond that of the same grains at rest.
    #[must_use]
    pub fn d(&self, j: usize) -> f64 {
        self.x.get(STRIDE * j + 2).copied().unwrap_or(0.0)
    }

    /// Mobilised friction of cell `c`.
    #[must_use]
    pub fn r(&self, c: usize) -> f64 {
        self.x[STRIDE * c + 3]
    }

    /// Fluid stress of cell `c`.
    #[must_use]
    pub fn s(&self, c: usize) -> f64 {
        self.x[STRIDE * c + 4]
    }

    /// The unknowns of cell `c`.
    #[must_use]
    pub fn unknowns(&self, c: usize) -> Unknowns<f64> {
        Unknowns {
            r: self.r(c),
            s: self.s(c),
            w: 0.5 * (self.w(c) + self.w(c + 1)),
            d: 0.5 * (self.d(c) + self.d(c + 1)),
            m: self.m,
            sine: self.sine,
            rest: self.rest,
        }
    }
}

/// The laws in cell `c`.
#[must_use]
pub fn cell<F: FrictionLaw>(flow: &Flow<F>, mesh: &Mesh, state: &State, c: usize) -> Cell<f64> {
    flow.cell(mesh.middles[c], mesh.size(c), &state.unknowns(c))
}

/// The volume of node 0 is the upper half of a cell: its middle lies a quarter of the cell below the interface, and the slip
/// there is this share of that of node 0, the rest of node 1. With the slip of node 0 the limit at the interface would
/// converge at order 1.
const FIRST: f64 = 0.75;

/// Near the interface `d(m r)/dm = F(r)`, F the drag per solid volume, which falls steeply with r as the grains spread:
/// `m dr/dm = F - r` relaxes at the rate `1 - dF/dr`, about this many times 1/m.
const RELAXATION: f64 = 20.0;

/// Weight of the cell below node `j` in the drag there: 1/2, and more where the relaxation is faster than the mesh, just as
/// much as keeps it from oscillating.
fn weight_below(mesh: &Mesh, j: usize) -> f64 {
    if j == 0 {
        return 1.0;
    }
    let z = RELAXATION * (mesh.middles[j] - mesh.middles[j - 1]) / mesh.nodes[j];
    (1.0 - 1.0 / z).max(0.5)
}

/// Share of the solid volume from `above` to `below`, shares of m, that lies below the cut, and its derivative by m.
fn below_cut<F: FrictionLaw>(flow: &Flow<F>, m: f64, (above, below): (f64, f64)) -> (f64, f64) {
    let share = (below - flow.cut / m) / (below - above);
    let inside = share > 0.0 && share < 1.0;
    (share.clamp(0.0, 1.0), if inside { flow.cut / (m * m * (below - above)) } else { 0.0 })
}

/// What a cell gives to the volumes of its nodes: the fluid stress, and those of its laws.
#[derive(Clone, Copy)]
pub(super) struct Side<T> {
    pub phi: T,
    pub s: T,
    pub tau_p: T,
    pub tau_f: T,
    pub dz: T,
    pub dm: T,
}

impl<T: Real> Side<T> {
    pub(super) fn of(cell: &Cell<T>, s: T) -> Self {
        Self { phi: cell.phi, s, tau_p: cell.tau_p, tau_f: cell.tau_f, dz: cell.dz, dm: cell.dm }
    }

    /// Above the interface: the flow pushes, and there are no grains.
    pub(super) fn top(tau_b: T) -> Self {
        let zero = T::constant(0.0);
        Self { phi: T::constant(0.5), s: tau_b, tau_p: zero, tau_f: zero, dz: zero, dm: zero }
    }
}

/// How the volume of a node is put together.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    /// share of the slip of the node in the drag; the rest is that of the node below
    pub own: f64,
    /// weight of the cell below in the drag; the rest is that of the cell above
    pub below: f64,
    /// share of the volume that is below the cut
    pub under_cut: f64,
    /// its derivative by the solid volume of the bed
    pub under_cut_by_m: f64,
}

impl Weights {
    /// Of node `j` of a bed with the solid volume `m`.
    #[must_use]
    pub fn of<F: FrictionLaw>(mesh: &Mesh, flow: &Flow<F>, m: f64, j: usize) -> Self {
        let own = if j == 0 { FIRST } else { 1.0 };
        let ends = |j: usize| (mesh.middles[j - 1], mesh.middles[j]);
        let (under_cut, under_cut_by_m) = if j == 0 { (0.0, 0.0) } else { below_cut(flow, m, ends(j)) };
        Self { own, below: weight_below(mesh, j), under_cut, under_cut_by_m }
    }
}

/// Momentum of the mixture, and of the grains, in the volume of a node.
pub(super) fn momentum<T: Real, F: FrictionLaw>(
    flow: &Flow<F>,
    (above, below): (Side<T>, Side<T>),
    w: (T, T),
    node: Weights,
    sine: T,
) -> (T, T) {
    let (dz, dm) = ((above.dz + below.dz) * 0.5, (above.dm + below.dm) * 0.5);
    let mixture = above.s - below.s + above.tau_p - below.tau_p + flow.fluid_weight(sine) * dz + sine * dm;
    let w = if node.own < 1.0 { w.0 * node.own + w.1 * (1.0 - node.own) } else { w.0 };
    let force = |side: &Side<T>| flow.drag(side.phi, w) / side.phi;
    let mut drag = force(&below) * node.below;
    if node.below < 1.0 {
        drag = drag + force(&above) * (1.0 - node.below);
    }
    let mut grains = above.tau_p - below.tau_p + (drag + flow.grain_weight(sine)) * dm;
    if node.under_cut > 0.0 {
        grains = grains + dm / dz * (above.tau_f - below.tau_f) * node.under_cut;
    }
    (mixture, grains)
}

/// What the velocities and the dilation lose across a cell: of the grains, the slip, the dilation.
pub(super) fn losses<T: Real, F: FrictionLaw>(flow: &Flow<F>, cell: &Cell<T>) -> [T; 3] {
    let strain = cell.gamma * cell.dz;
    [strain, cell.rate * cell.dz - strain, cell.dz - cell.dm / flow.dilatancy.phi_max]
}

/// The residual of the bed at `state`, by rows: momentum of mixture and grains, then `u w D` across the cell, from the top.
pub fn residual<F: FrictionLaw>(flow: &Flow<F>, mesh: &Mesh, state: &State, out: &mut [f64]) {
    let mut above = Side::top(state.tau_b);
    for (c, rows) in out.chunks_exact_mut(STRIDE).enumerate() {
        let cell = cell(flow, mesh, state, c);
        let below = Side::of(&cell, state.s(c));
        let (w, node) = ((state.w(c), state.w(c + 1)), Weights::of(mesh, flow, state.m, c));
        (rows[0], rows[1]) = momentum(flow, (above, below), w, node, state.sine);
        let loss = losses(flow, &cell);
        rows[2] = state.u(c) - state.u(c + 1) - loss[0];
        rows[3] = state.w(c) - state.w(c + 1) - loss[1];
        rows[4] = state.d(c) - state.d(c + 1) - loss[2];
        above = below;
    }
}

/// The grains at rest under the last cell, which carry just mu_s P_p at their top: there the momentum of the grains over the
/// lower half of the last cell is the equation for the volume of the moving grains.
pub(super) fn at_yield<T: Real, F: FrictionLaw>(
    flow: &Flow<F>,
    last: Side<T>,
    w: T,
    (sine, m): (T, T),
    under_cut: f64,
) -> T {
    let zero = T::constant(0.0);
    let cosine = (-(sine * sine) + 1.0).sqrt();
    let still =
        Side { phi: last.phi, s: zero, tau_p: cosine * m * flow.friction.least(), tau_f: zero, dz: zero, dm: zero };
    // The slip vanishes at the yield level; nothing shears there, and the stress of the fluid is all viscous.
    let (w, node) = ((w * 0.25, zero), Weights { own: 1.0, below: 0.0, under_cut, under_cut_by_m: 0.0 });
    let (s, _) = momentum(flow, (last, still), w, node, sine);
    momentum(flow, (last, Side { s, tau_f: s, ..still }), w, node, sine).1
}

/// Share of the lower half of the last cell that is below the cut, and its derivative by m.
pub(super) fn last_below_cut<F: FrictionLaw>(flow: &Flow<F>, mesh: &Mesh, m: f64) -> (f64, f64) {
    below_cut(flow, m, (mesh.middles[mesh.cells() - 1], 1.0))
}

/// The residual of the momentum of the grains at the yield level.
#[must_use]
pub fn yield_residual<F: FrictionLaw>(flow: &Flow<F>, mesh: &Mesh, state: &State) -> f64 {
    let c = mesh.cells() - 1;
    let last = Side::of(&cell(flow, mesh, state, c), state.s(c));
    at_yield(flow, last, state.w(c), (state.sine, state.m), last_below_cut(flow, mesh, state.m).0)
}
