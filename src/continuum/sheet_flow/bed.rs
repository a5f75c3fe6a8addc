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
//! Nodes and cells lie at fixed shares of a solid volume m: with the exact yield that of the moving grains, itself an unknown,
//! so that the corner of the solid fraction lies on node n; with creep that of the whole bed. The momentum of a node is that
//! of the volume between the middles of the cells beside it; what leaves one volume enters the next, so the momentum of the
//! whole bed closes to round-off. Unknowns are ordered `u w D r S` from the top: the Jacobian has 5 lower and 7 upper
//! diagonals.

use super::flow::{Cell, Flow, Unknowns};
use super::mesh::Mesh;
use crate::numerics::banded::Banded;
use crate::numerics::dual::{Dual, Real};

/// Unknowns of a node and the cell below it.
pub const STRIDE: usize = 5;
/// Diagonals below and above the main one.
const BAND: (usize, usize) = (5, 7);

/// Unknowns of a cell that the rows of its nodes need: `w D` (means of its nodes), `r S`, and the globals `m sine rest`.
pub const LOCAL: usize = 7;

/// A cell with its derivatives by its unknowns.
pub type LocalCell = Cell<Dual<LOCAL>>;

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
pub fn cell(flow: &Flow, mesh: &Mesh, state: &State, c: usize) -> Cell<f64> {
    flow.cell(mesh.middles[c], mesh.size(c), &state.unknowns(c))
}

/// The laws in cell `c`, with their derivatives.
#[must_use]
pub fn local_cell(flow: &Flow, mesh: &Mesh, state: &State, c: usize) -> LocalCell {
    let v = |x: f64, i: usize| Dual::<LOCAL>::variable(x, i);
    let x = state.unknowns(c);
    let x = Unknowns {
        w: v(x.w, 0),
        d: v(x.d, 1),
        r: v(x.r, 2),
        s: v(x.s, 3),
        m: v(x.m, 4),
        sine: v(x.sine, 5),
        rest: v(x.rest, 6),
    };
    flow.cell(mesh.middles[c], mesh.size(c), &x)
}

/// Adds `factor` times the derivatives `slope` of something in cell `c` of `cells`, by the unknowns of the bed, through `add`.
pub fn spread(c: usize, cells: usize, slope: &[f64; LOCAL], factor: f64, mut add: impl FnMut(usize, f64)) {
    let first = STRIDE * c;
    for (k, i) in [(1, 0), (2, 1)] {
        let half = 0.5 * factor * slope[i];
        add(first + k, half);
        if c + 1 < cells {
            add(first + STRIDE + k, half);
        }
    }
    add(first + 3, factor * slope[2]);
    add(first + 4, factor * slope[3]);
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

/// Momentum of the volume of a node, with its derivatives.
struct Node {
    residual: [f64; 2],
    /// by `w D r S m sine rest` of the cells above and below: mixture, grains
    by_cells: [[[f64; LOCAL]; 2]; 2],
    /// of the grains, by the slip of the node and of the one below it
    by_slip: (f64, f64),
    /// of both, by the slope where it is not that of a cell
    by_sine: [f64; 2],
}

/// Derivatives of a sum of a cell's quantities with these factors.
struct Factors {
    tau_p: f64,
    tau_f: f64,
    dz: f64,
    dm: f64,
    phi: f64,
}

fn sum(cell: &LocalCell, x: &Factors) -> [f64; LOCAL] {
    std::array::from_fn(|i| {
        x.tau_p * cell.tau_p.slope[i]
            + x.tau_f * cell.tau_f.slope[i]
            + x.dz * cell.dz.slope[i]
            + x.dm * cell.dm.slope[i]
            + x.phi * cell.phi.slope[i]
    })
}

fn value(cell: &LocalCell, s: f64) -> Side<f64> {
    let (phi, tau_p, tau_f) = (cell.phi.value, cell.tau_p.value, cell.tau_f.value);
    Side { phi, s, tau_p, tau_f, dz: cell.dz.value, dm: cell.dm.value }
}

/// [`momentum`] with its derivatives by hand: dual numbers in all directions of a node cost three times as much.
fn node(
    flow: &Flow,
    state: &State,
    (above, below): ((Option<&LocalCell>, Side<f64>), (Option<&LocalCell>, Side<f64>)),
    w: (f64, f64),
    node: Weights,
) -> Node {
    let sides = (above.1, below.1);
    let (mixture, grains) = momentum(flow, sides, w, node, state.sine);
    let (a, b) = sides;
    let (dz, dm) = (0.5 * (a.dz + b.dz), 0.5 * (a.dm + b.dm));
    let slip = if node.own < 1.0 { w.0 * node.own + w.1 * (1.0 - node.own) } else { w.0 };
    let force = |side: &Side<f64>| {
        let phi = Dual::<2>::variable(side.phi, 0);
        flow.drag(phi, Dual::variable(slip, 1)) / phi
    };
    let zero = Dual::constant(0.0);
    let low = if node.below > 0.0 { force(&b) * node.below } else { zero };
    let high = if node.below < 1.0 { force(&a) * (1.0 - node.below) } else { zero };
    let (weight, drag) = (flow.fluid_weight(1.0), low + high);
    let buoyancy = node.under_cut * (a.tau_f - b.tau_f) / dz;
    let by_dm = 0.5 * (drag.value + flow.grain_weight(state.sine) + buoyancy);
    let by_dz = -0.5 * buoyancy * dm / dz;
    let share = node.under_cut * dm / dz;
    let rows = |cell: Option<&LocalCell>, sign: f64, by_phi: f64| {
        let Some(cell) = cell else { return [[0.0; LOCAL]; 2] };
        let whole = Factors {
            tau_p: sign,
            tau_f: 0.0,
            dz: 0.5 * flow.fluid_weight(state.sine),
            dm: 0.5 * state.sine,
            phi: 0.0,
        };
        let mut mixture = sum(cell, &whole);
        mixture[3] += sign;
        let part = Factors { tau_p: sign, tau_f: sign * share, dz: by_dz, dm: by_dm, phi: dm * by_phi };
        [mixture, sum(cell, &part)]
    };
    let by_slip = dm * drag.slope[1];
    Node {
        residual: [mixture, grains],
        by_cells: [rows(above.0, 1.0, high.slope[0]), rows(below.0, -1.0, low.slope[0])],
        by_slip: (by_slip * node.own, by_slip * (1.0 - node.own)),
        by_sine: [weight * dz + dm, flow.grain_weight(1.0) * dm],
    }
}

/// The grains at rest under the last cell, which carry just mu_s P_p at their top: there the momentum of the grains over the
/// lower half of the last cell is the equation for the volume of the moving grains.
fn at_yield<T: Real>(flow: &Flow, last: Side<T>, w: T, (sine, m): (T, T), under_cut: f64) -> T {
    let zero = T::constant(0.0);
    let cosine = (-(sine * sine) + 1.0).sqrt();
    let still =
        Side { phi: last.phi, s: zero, tau_p: cosine * m * flow.friction.mu_s, tau_f: zero, dz: zero, dm: zero };
    // The slip vanishes at the yield level; nothing shears there, and the stress of the fluid is all viscous.
    let (w, node) = ((w * 0.25, zero), Weights { own: 1.0, below: 0.0, under_cut });
    let (s, _) = momentum(flow, (last, still), w, node, sine);
    momentum(flow, (last, Side { s, tau_f: s, ..still }), w, node, sine).1
}

/// Share of the lower half of the last cell that is below the cut.
fn last_below_cut(flow: &Flow, mesh: &Mesh, m: f64) -> f64 {
    let above = m * mesh.middles[mesh.cells() - 1];
    ((m - flow.cut) / (m - above)).clamp(0.0, 1.0)
}

/// The residual of the momentum of the grains at the yield level.
#[must_use]
pub fn yield_residual(flow: &Flow, mesh: &Mesh, state: &State) -> f64 {
    let c = mesh.cells() - 1;
    let last = Side::of(&cell(flow, mesh, state, c), state.s(c));
    at_yield(flow, last, state.w(c), (state.sine, state.m), last_below_cut(flow, mesh, state.m))
}

/// The same with its derivatives: by the unknowns of the last cell, and by the slip of its upper node.
#[must_use]
pub fn yield_slopes(flow: &Flow, mesh: &Mesh, state: &State, last: &LocalCell) -> Dual<{ LOCAL + 1 }> {
    let wide = |x: Dual<LOCAL>| {
        let mut slope = [0.0; LOCAL + 1];
        slope[..LOCAL].copy_from_slice(&x.slope);
        Dual { value: x.value, slope }
    };
    let c = mesh.cells() - 1;
    let v = |x: f64, i: usize| Dual::variable(x, i);
    let side = Side {
        phi: wide(last.phi),
        s: v(state.s(c), 3),
        tau_p: wide(last.tau_p),
        tau_f: wide(last.tau_f),
        dz: wide(last.dz),
        dm: wide(last.dm),
    };
    let globals = (v(state.sine, 5), v(state.m, 4));
    at_yield(flow, side, v(state.w(c), LOCAL), globals, last_below_cut(flow, mesh, state.m))
}

/// The discrete equations: residual and Jacobian.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// residual
    pub residual: Vec<f64>,
    /// by the unknowns
    pub jacobian: Banded,
    /// by tau_b, sine, m and the volume at rest, row by row
    pub border: Vec<[f64; 4]>,
}

impl Linearised {
    /// Room for a bed of `cells` cells.
    #[must_use]
    pub fn new(cells: usize) -> Self {
        let n = STRIDE * cells;
        Self { residual: vec![0.0; n], jacobian: Banded::zeros(n, BAND.0, BAND.1), border: vec![[0.0; 4]; n] }
    }

    /// Evaluates the equations at `state`; `cells` are its cells with derivatives.
    pub fn fill(&mut self, flow: &Flow, mesh: &Mesh, state: &State, cells: &[LocalCell]) {
        let n = cells.len();
        self.jacobian.clear();
        self.border.fill([0.0; 4]);
        let mut above = (None, Side::top(state.tau_b));
        for (c, cell) in cells.iter().enumerate() {
            let row = STRIDE * c;
            let below = (Some(cell), value(cell, state.s(c)));
            let w = (state.w(c), state.w(c + 1));
            self.put_node(row, c, n, &node(flow, state, (above, below), w, Weights::of(mesh, flow, state.m, c)));
            above = below;
            let jumps = [state.u(c) - state.u(c + 1), state.w(c) - state.w(c + 1), state.d(c) - state.d(c + 1)];
            for (k, (loss, jump)) in losses(flow, cell).into_iter().zip(jumps).enumerate() {
                self.residual[row + 2 + k] = jump - loss.value;
                self.put(row + 2 + k, c, n, &loss.slope, -1.0);
                self.jacobian.add(row + 2 + k, row + k, 1.0);
                if c + 1 < n {
                    self.jacobian.add(row + 2 + k, row + STRIDE + k, -1.0);
                }
            }
        }
        self.border[0][0] = 1.0;
    }

    /// Adds derivatives of something in cell `c` to a row.
    fn put(&mut self, row: usize, c: usize, n: usize, slope: &[f64; LOCAL], factor: f64) {
        spread(c, n, slope, factor, |k, x| self.jacobian.add(row, k, x));
        for (column, i) in [(1, 5), (2, 4), (3, 6)] {
            self.border[row][column] += factor * slope[i];
        }
    }

    fn put_node(&mut self, row: usize, j: usize, n: usize, node: &Node) {
        for k in 0..2 {
            self.residual[row + k] = node.residual[k];
            if j > 0 {
                self.put(row + k, j - 1, n, &node.by_cells[0][k], 1.0);
            }
            self.put(row + k, j, n, &node.by_cells[1][k], 1.0);
            self.border[row + k][1] += node.by_sine[k];
        }
        self.jacobian.add(row + 1, STRIDE * j + 1, node.by_slip.0);
        if j + 1 < n && node.by_slip.1 != 0.0 {
            self.jacobian.add(row + 1, STRIDE * (j + 1) + 1, node.by_slip.1);
        }
    }
}
