//! The sediment bed layer: residual and Jacobian of its discrete equations.
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
//! Nodes and cells lie at fixed shares of the solid volume m of the bed. The momentum of a node is that of the volume
//! between the middles of the cells beside it; what leaves one volume enters the next, so the momentum of the whole bed
//! closes to round-off. Unknowns are ordered `u w D r S` from the top: the Jacobian has 5 lower and 7 upper diagonals.

use super::flow::{Cell, Flow, Unknowns};
use super::mesh::Mesh;
use crate::numerics::banded::Banded;
use crate::numerics::dual::{Dual, Real};

/// Unknowns of a node and the cell below it.
pub const STRIDE: usize = 5;
/// Diagonals below and above the main one.
const BAND: (usize, usize) = (5, 7);

/// A cell with its derivatives by `w D r S w D` of its nodes and itself, `m`, `sine`.
pub type LocalCell = Cell<Dual<8>>;

/// The state of the bed.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// `u w D r S` from the top; the last node is at rest
    pub x: Vec<f64>,
    /// stress of the fluid on the interface
    pub tau_b: f64,
    /// sine of the slope
    pub sine: f64,
    /// solid volume of the bed per area
    pub m: f64,
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

    /// Decompaction: height of what lies below node `j` beyond that of the same grains at rest.
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
            w: (self.w(c), self.w(c + 1)),
            d: (self.d(c), self.d(c + 1)),
            m: self.m,
            sine: self.sine,
        }
    }
}

/// The laws in cell `c`.
#[must_use]
pub fn cell(flow: &Flow, mesh: &Mesh, state: &State, c: usize) -> Cell<f64> {
    flow.cell(mesh.middles[c], mesh.size(c), &state.unknowns(c))
}

/// The laws in cell `c`, with their derivatives.
#[must_use]
pub fn local_cell(flow: &Flow, mesh: &Mesh, state: &State, c: usize) -> LocalCell {
    let v = |x: f64, i: usize| Dual::<8>::variable(x, i);
    let x = state.unknowns(c);
    let x = Unknowns {
        w: (v(x.w.0, 0), v(x.w.1, 4)),
        d: (v(x.d.0, 1), v(x.d.1, 5)),
        r: v(x.r, 2),
        s: v(x.s, 3),
        m: v(x.m, 6),
        sine: v(x.sine, 7),
    };
    flow.cell(mesh.middles[c], mesh.size(c), &x)
}

/// Index of the unknown behind direction `i` of a cell `c`; `None` beyond the last node.
#[must_use]
pub fn index(c: usize, i: usize, cells: usize) -> Option<usize> {
    let k = STRIDE * c + [1, 2, 3, 4, STRIDE + 1, STRIDE + 2][i];
    (k < STRIDE * cells).then_some(k)
}

/// The volume of node 0 is the upper half of a cell: its middle lies a quarter of the cell below the interface, and the slip
/// there is this share of that of node 0, the rest of node 1. With the slip of node 0 the limit at the interface would
/// converge at order 1.
const FIRST: f64 = 0.75;

/// Near the interface `d(m r)/dm = F(r)`, F the drag per solid volume, which falls steeply with r as the grains spread:
/// `m dr/dm = F - r` relaxes at the rate `1 - dF/dr`, about this many times 1/m.
const RELAXATION: f64 = 16.0;

/// Weight of the cell below node `j` in the drag there: 1/2, and more where the relaxation is faster than the mesh, so that
/// it does not oscillate (exponential fitting: exact for a linear relaxation, order 2).
fn weight_below(mesh: &Mesh, j: usize) -> f64 {
    if j == 0 {
        return 1.0;
    }
    let z = RELAXATION * (mesh.middles[j] - mesh.middles[j - 1]) / mesh.nodes[j];
    if z < 1e-3 { 0.5 + z / 12.0 } else { 1.0 - 1.0 / z + 1.0 / z.exp_m1() }
}

/// Share of the volume of node `j` that lies below the cut.
fn below_cut(flow: &Flow, mesh: &Mesh, m: f64, j: usize) -> f64 {
    if j == 0 {
        return 0.0;
    }
    let (above, below) = (m * mesh.middles[j - 1], m * mesh.middles[j]);
    ((below - flow.cut) / (below - above)).clamp(0.0, 1.0)
}

/// What a cell gives to the volumes of its nodes: the fluid stress, and those of its laws.
#[derive(Clone, Copy)]
struct Side<T> {
    phi: T,
    s: T,
    tau_p: T,
    tau_f: T,
    dz: T,
    dm: T,
}

impl<T: Real> Side<T> {
    fn of(cell: &Cell<T>, s: T) -> Self {
        Self { phi: cell.phi, s, tau_p: cell.tau_p, tau_f: cell.tau_f, dz: cell.dz, dm: cell.dm }
    }

    /// Above the interface: the flow pushes, and there are no grains.
    fn top(tau_b: T) -> Self {
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
}

impl Weights {
    /// Of node `j` of a bed with the solid volume `m`.
    #[must_use]
    pub fn of(mesh: &Mesh, flow: &Flow, m: f64, j: usize) -> Self {
        let own = if j == 0 { FIRST } else { 1.0 };
        Self { own, below: weight_below(mesh, j), under_cut: below_cut(flow, mesh, m, j) }
    }
}

/// Momentum of the mixture, and of the grains, in the volume of a node.
fn momentum<T: Real>(flow: &Flow, (above, below): (Side<T>, Side<T>), w: (T, T), node: Weights, sine: T) -> (T, T) {
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

/// What the velocities and the decompaction lose across a cell: of the grains, the slip, the decompaction.
fn losses<T: Real>(flow: &Flow, cell: &Cell<T>) -> [T; 3] {
    let strain = cell.gamma * cell.dz;
    [strain, cell.rate * cell.dz - strain, cell.dz - cell.dm / flow.dilatancy.phi_max]
}

/// The residual of the bed at `state`, by rows: momentum of mixture and grains, then `u w D` across the cell, from the top.
pub fn residual(flow: &Flow, mesh: &Mesh, state: &State, out: &mut [f64]) {
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

/// Directions of a node: `w D r S` of the cell above, `w D r S` of the cell below, `w D` below that, `m`, `sine`.
const NODE: usize = 12;

fn embed(x: Dual<8>, shift: usize) -> Dual<NODE> {
    let mut out = Dual::constant(x.value);
    out.slope[shift..shift + 6].copy_from_slice(&x.slope[..6]);
    out.slope[10] = x.slope[6];
    out.slope[11] = x.slope[7];
    out
}

fn side(cell: &LocalCell, s: f64, shift: usize) -> Side<Dual<NODE>> {
    let e = |x: Dual<8>| embed(x, shift);
    Side {
        phi: e(cell.phi),
        s: Dual::variable(s, shift + 3),
        tau_p: e(cell.tau_p),
        tau_f: e(cell.tau_f),
        dz: e(cell.dz),
        dm: e(cell.dm),
    }
}

/// The discrete equations: residual and Jacobian.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// residual
    pub residual: Vec<f64>,
    /// by the unknowns
    pub jacobian: Banded,
    /// by tau_b, sine and m
    pub border: [Vec<f64>; 3],
}

impl Linearised {
    /// Room for a bed of `cells` cells.
    #[must_use]
    pub fn new(cells: usize) -> Self {
        let n = STRIDE * cells;
        Self {
            residual: vec![0.0; n],
            jacobian: Banded::zeros(n, BAND.0, BAND.1),
            border: std::array::from_fn(|_| vec![0.0; n]),
        }
    }

    /// Evaluates the equations at `state`; `cells` are its cells with derivatives.
    pub fn fill(&mut self, flow: &Flow, mesh: &Mesh, state: &State, cells: &[LocalCell]) {
        let n = cells.len();
        self.jacobian.clear();
        self.border.iter_mut().for_each(|column| column.fill(0.0));
        self.border[0][0] = 1.0;
        let mut above = Side::top(Dual::constant(state.tau_b));
        for (c, cell) in cells.iter().enumerate() {
            let row = STRIDE * c;
            let sine = Dual::variable(state.sine, 11);
            let w = (Dual::variable(state.w(c), 4), Dual::variable(state.w(c + 1), 8));
            let node = Weights::of(mesh, flow, state.m, c);
            let (mixture, grains) = momentum(flow, (above, side(cell, state.s(c), 4)), w, node, sine);
            self.put_node(row, c, n, &mixture);
            self.put_node(row + 1, c, n, &grains);
            above = side(cell, state.s(c), 0);
            let jumps = [state.u(c) - state.u(c + 1), state.w(c) - state.w(c + 1), state.d(c) - state.d(c + 1)];
            for (k, (loss, jump)) in losses(flow, cell).into_iter().zip(jumps).enumerate() {
                self.put_cell(row + 2 + k, c, n, &-loss, jump);
                self.jacobian.add(row + 2 + k, row + k, 1.0);
                if c + 1 < n {
                    self.jacobian.add(row + 2 + k, row + STRIDE + k, -1.0);
                }
            }
        }
    }

    fn put_cell(&mut self, row: usize, c: usize, n: usize, x: &Dual<8>, linear: f64) {
        self.residual[row] = x.value + linear;
        for i in 0..6 {
            if let Some(k) = index(c, i, n) {
                self.jacobian.add(row, k, x.slope[i]);
            }
        }
        self.border[1][row] = x.slope[7];
        self.border[2][row] = x.slope[6];
    }

    fn put_node(&mut self, row: usize, j: usize, n: usize, x: &Dual<NODE>) {
        self.residual[row] = x.value;
        for (i, &slope) in x.slope[..10].iter().enumerate() {
            let place = if i >= 4 {
                index(j, i - 4, n)
            } else if j > 0 {
                index(j - 1, i, n)
            } else {
                None
            };
            if let Some(k) = place {
                self.jacobian.add(row, k, slope);
            }
        }
        self.border[1][row] = x.slope[11];
        self.border[2][row] = x.slope[10];
    }
}
