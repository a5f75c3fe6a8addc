//! A solved column, cell by cell, and what it comes down to. Units of the model.

use super::bed;
use super::bed::State;
use super::column::{Floor, Setting, interface_weights};
use super::flow::{Cell, Flow};
use super::newton::Column;
use super::suspension::{Inflow, Level, Totals, march};
use crate::closures::friction::FrictionLaw;
use crate::closures::rearrangement::{Clock, Regime};

/// Solid fraction of the bottom of the sheet, relative to that at rest.
const STILL: f64 = 0.999;
/// Cells of the grains at rest under the exact yield, where all is known in closed form.
const RESTING: usize = 24;

/// A solved column.
#[derive(Clone, Debug)]
pub struct Layers {
    /// the bed, from the interface down to the bottom
    pub cells: Vec<Cell<f64>>,
    /// fluid stress of the cells
    pub s: Vec<f64>,
    /// velocity of the grains and slip at the nodes
    pub nodes: Vec<(f64, f64)>,
    /// heights of the nodes of the bed over the bottom, from the interface down
    pub z: Vec<f64>,
    /// nodes above the interface, upwards
    pub levels: Vec<Level<f64>>,
    /// what the bed gives to the layer above
    pub inflow: Inflow<f64>,
    /// integrals above the interface
    pub totals: Totals<f64>,
    /// solid flux of the bed
    pub flux: f64,
    /// stress that the lid takes
    pub lid: f64,
}

/// The moving layer of the bed.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    /// level of its bottom
    pub bottom: f64,
    /// solid volume
    pub volume: f64,
    /// level at which grains and fluid carry equal stresses
    pub crossover: Option<f64>,
    /// largest viscous share of the stress in its upper half
    pub viscous_share: f64,
    /// part of its solid volume in free fall
    pub free_fall: f64,
    /// part of its solid volume in turbulent fall
    pub turbulent_fall: f64,
}

impl Layers {
    /// All that follows from `state`.
    #[must_use]
    pub fn new<F: FrictionLaw>(column: &Column<F>, state: &State) -> Self {
        let Column { flow, setting, mesh, meshes, .. } = column;
        let n = mesh.cells();
        let mut cells: Vec<Cell<f64>> = (0..n).map(|c| bed::cell(flow, mesh, state, c)).collect();
        let mut s: Vec<f64> = (0..n).map(|c| state.s(c)).collect();
        let mut nodes: Vec<(f64, f64)> = (0..=n).map(|j| (state.u(j), state.w(j))).collect();
        if column.floor == Floor::Yield {
            for (cell, stress) in resting(column, state, &cells[n - 1]) {
                cells.push(cell);
                s.push(stress);
                nodes.push((0.0, 0.0));
            }
        }
        let mut z = vec![0.0; cells.len() + 1];
        for c in (0..cells.len()).rev() {
            z[c] = z[c + 1] + cells[c].dz;
        }
        let weights = interface_weights(&mesh.middles);
        let phi = weights.0 * cells[0].phi + weights.1 * cells[1].phi;
        let globals = (state.tau_b, state.sine, state.m + state.rest);
        let inflow = Setting::inflow(flow, phi, state.d(0), state.u(0) + state.w(0), globals);
        let mut levels = Vec::new();
        let totals = march(flow, meshes, &inflow, setting.height - z[0], |level| levels.push(*level));
        // The velocity is linear in a cell of the bed.
        let flux = (0..n).map(|c| 0.5 * cells[c].dm * (state.u(c) + state.u(c + 1))).sum();
        let lid = setting.lid_stress(flow, &Totals { height: setting.height - z[0], ..totals }, &inflow);
        Self { cells, s, nodes, z, levels, inflow, totals, flux, lid }
    }

    /// Dimensionless transport rate.
    #[must_use]
    pub fn psi(&self) -> f64 {
        self.flux + self.totals.flux
    }

    /// Level of the middle of cell `c`.
    #[must_use]
    pub fn middle(&self, c: usize) -> f64 {
        0.5 * (self.z[c] + self.z[c + 1])
    }

    /// The moving layer; `None` if all of the bed is looser than at rest.
    #[must_use]
    pub fn sheet<F: FrictionLaw>(&self, flow: &Flow<F>) -> Option<Sheet> {
        let limit = flow.dilatancy.inertial_number(STILL * flow.dilatancy.phi_max);
        let n = self.cells.len();
        let last = (0..n).rev().find(|&c| self.cells[c].inertia > limit)?;
        if last + 1 == n {
            return None;
        }
        let (a, b) = (&self.cells[last], &self.cells[last + 1]);
        // Under the exact yield the friction is smooth there, in creeping grains the logarithm of the inertial number is.
        let (share, below) = if b.inertia > 0.0 {
            ((a.inertia / limit).ln() / (a.inertia / b.inertia).ln(), self.middle(last + 1))
        } else {
            let (r, mu_s) = (a.tau_p / a.pressure, flow.friction.least());
            ((r - flow.friction.mu(limit)) / (r - mu_s), self.z[last + 1])
        };
        let bottom = self.middle(last) + share * (below - self.middle(last));
        let moving = |c: &usize| self.middle(*c) > bottom;
        let mass = |regime: Regime| {
            let here = |c: &usize| {
                let slip = 0.5 * (self.nodes[*c].1 + self.nodes[c + 1].1);
                flow.rearrangement.regime(&flow.grain(), self.cells[*c].pressure, slip) == regime
            };
            (0..n).filter(moving).filter(here).map(|c| self.cells[c].dm).sum::<f64>()
        };
        let volume: f64 = (0..n).map(|c| self.cells[c].phi * self.above(c, bottom)).sum();
        let of_moving: f64 = (0..n).filter(moving).map(|c| self.cells[c].dm).sum();
        let excess = |c: usize| self.cells[c].tau_p - self.s[c];
        let crossing = (0..last).find(|&c| excess(c) < 0.0 && excess(c + 1) >= 0.0);
        let crossover = crossing.map(|c| {
            let share = excess(c) / (excess(c) - excess(c + 1));
            self.middle(c) + share * (self.middle(c + 1) - self.middle(c))
        });
        let half = 0.5 * (bottom + self.z[0]);
        let viscous = |c: usize| self.cells[c].tau_f / (self.cells[c].tau_p + self.s[c]);
        let viscous_share = (0..n).filter(|&c| self.middle(c) > half).map(viscous).fold(0.0, f64::max);
        let [free_fall, turbulent_fall] =
            [Regime::FreeFall, Regime::Turbulent].map(|regime| 0.0 + mass(regime) / of_moving);
        Some(Sheet { bottom, volume, crossover, viscous_share, free_fall, turbulent_fall })
    }

    /// Height of the part of cell `c` that is above `z`.
    fn above(&self, c: usize, z: f64) -> f64 {
        (self.z[c] - self.z[c + 1].max(z)).max(0.0)
    }
}

/// The grains at rest below the yield level, downwards, with the stress of the fluid in them.
fn resting<F: FrictionLaw>(column: &Column<F>, state: &State, last: &Cell<f64>) -> Vec<(Cell<f64>, f64)> {
    let flow = &column.flow;
    let c = column.mesh.cells() - 1;
    let cosine = (1.0 - state.sine * state.sine).sqrt();
    // The stress at the yield level, from the balance of the lower half of the last cell.
    let yielding = flow.friction.least() * cosine * state.m;
    let weight = flow.fluid_weight(state.sine) * last.dz + state.sine * last.dm;
    let s = state.s(c) + last.tau_p - yielding + 0.5 * weight;
    let share = |j: usize| (j as f64 / RESTING as f64).powi(2) * state.rest;
    let phi = flow.dilatancy.phi_max;
    let at = |j: usize| {
        let (dm, m) = (share(j + 1) - share(j), state.m + 0.5 * (share(j) + share(j + 1)));
        let (r, s) = column.at_rest(state, s, m);
        let pressure = cosine * m;
        let length = flow.mixing_length(0.0, state.m + state.rest - m);
        let still = Cell { phi, pressure, tau_p: r * pressure, tau_f: s, length, dm, dz: dm / phi, ..*last };
        (Cell { inertia: 0.0, gamma: 0.0, rate: 0.0, ..still }, s)
    };
    (0..RESTING).map(at).collect()
}
