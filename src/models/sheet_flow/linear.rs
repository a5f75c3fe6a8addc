//! The sediment bed layer: Jacobian of its discrete equations, with 5 lower and 7 upper diagonals.

use super::bed::{STRIDE, Side, State, Weights, at_yield, last_below_cut, losses, momentum};
use super::flow::{Cell, Flow, Unknowns};
use super::mesh::Mesh;
use crate::closures::friction::FrictionLaw;
use crate::numerics::banded::Banded;
use crate::numerics::dual::{Dual, Real};

/// Diagonals below and above the main one.
const BAND: (usize, usize) = (5, 7);
/// Unknowns of a cell that the rows of its nodes need: `w D` (means of its nodes), `r S`, and the globals `m sine rest`.
pub const LOCAL: usize = 7;

/// A cell with its derivatives by its unknowns.
pub type LocalCell = Cell<Dual<LOCAL>>;

/// The laws in cell `c`, with their derivatives.
#[must_use]
pub fn local_cell<F: FrictionLaw>(flow: &Flow<F>, mesh: &Mesh, state: &State, c: usize) -> LocalCell {
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

/// A side of a node and its cell; above the interface there is none.
type Beside<'a> = (Option<&'a LocalCell>, Side<f64>);

fn value(cell: &LocalCell, s: f64) -> Side<f64> {
    let (phi, tau_p, tau_f) = (cell.phi.value, cell.tau_p.value, cell.tau_f.value);
    Side { phi, s, tau_p, tau_f, dz: cell.dz.value, dm: cell.dm.value }
}

/// Place of the solid volume of the bed among the unknowns of a cell.
const BY_M: usize = 4;

/// [`momentum`] with its derivatives by hand: dual numbers in all directions of a node cost three times as much.
fn node<F: FrictionLaw>(
    flow: &Flow<F>,
    state: &State,
    (above, below): (Beside<'_>, Beside<'_>),
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
        let mut grains = sum(cell, &part);
        if sign < 0.0 {
            grains[BY_M] += node.under_cut_by_m * (a.tau_f - b.tau_f) * dm / dz;
        }
        [mixture, grains]
    };
    let by_slip = dm * drag.slope[1];
    Node {
        residual: [mixture, grains],
        by_cells: [rows(above.0, 1.0, high.slope[0]), rows(below.0, -1.0, low.slope[0])],
        by_slip: (by_slip * node.own, by_slip * (1.0 - node.own)),
        by_sine: [weight * dz + dm, flow.grain_weight(1.0) * dm],
    }
}

/// The same with its derivatives: by the unknowns of the last cell, and by the slip of its upper node.
#[must_use]
pub fn yield_slopes<F: FrictionLaw>(
    flow: &Flow<F>,
    mesh: &Mesh,
    state: &State,
    last: &LocalCell,
) -> Dual<{ LOCAL + 1 }> {
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
    let globals = (v(state.sine, 5), v(state.m, BY_M));
    let (share, by_m) = last_below_cut(flow, mesh, state.m);
    let slip = v(state.w(c), LOCAL);
    let mut slopes = at_yield(flow, side, slip, globals, share);
    if by_m != 0.0 {
        // The momentum is linear in the share.
        let [all, none] = [1.0, 0.0].map(|share| at_yield(flow, side, slip, globals, share).value);
        slopes.slope[BY_M] += by_m * (all - none);
    }
    slopes
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
    pub fn fill<F: FrictionLaw>(&mut self, flow: &Flow<F>, mesh: &Mesh, state: &State, cells: &[LocalCell]) {
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
