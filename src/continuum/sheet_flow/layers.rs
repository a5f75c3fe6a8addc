//! A solved column, cell by cell, and what it comes down to. Units of the model.

use super::bed;
use super::bed::State;
use super::column::{Setting, interface_weights};
use super::flow::Cell;
use super::newton::Column;
use super::solve::Solved;
use super::suspension::{Inflow, Level, Totals, march};
use crate::closures::rearrangement::Regime;

/// Solid fraction of the bottom of the sheet, relative to that at rest.
const STILL: f64 = 0.999;

/// A solved column.
#[derive(Clone, Debug)]
pub struct Layers {
    /// the bed, from the interface down
    pub cells: Vec<Cell<f64>>,
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
    /// parts of its solid volume in free and in turbulent fall
    pub falls: (f64, f64),
}

impl Layers {
    /// All that follows from `state`.
    #[must_use]
    pub fn new(column: &Column, state: &State) -> Self {
        let Column { flow, setting, mesh, meshes } = column;
        let n = mesh.cells();
        let cells: Vec<Cell<f64>> = (0..n).map(|c| bed::cell(flow, mesh, state, c)).collect();
        let mut z = vec![0.0; n + 1];
        for c in (0..n).rev() {
            z[c] = z[c + 1] + cells[c].dz;
        }
        let weights = interface_weights(&mesh.middles);
        let phi = weights.0 * cells[0].phi + weights.1 * cells[1].phi;
        let globals = (state.tau_b, state.sine, state.m);
        let inflow = Setting::inflow(flow, phi, state.d(0), state.u(0) + state.w(0), globals);
        let mut levels = Vec::new();
        let totals = march(flow, meshes, &inflow, setting.height - z[0], |level| levels.push(*level));
        // The velocity is linear in a cell of the bed.
        let flux = (0..n).map(|c| 0.5 * cells[c].dm * (state.u(c) + state.u(c + 1))).sum();
        let lid = setting.lid_stress(flow, &Totals { height: setting.height - z[0], ..totals }, &inflow);
        Self { cells, z, levels, inflow, totals, flux, lid }
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
    pub fn sheet(&self, solved: &Solved) -> Option<Sheet> {
        let (flow, state) = (&solved.column.flow, &solved.state);
        let limit = flow.dilatancy.inertial_number(STILL * flow.dilatancy.phi_max);
        let n = self.cells.len();
        let last = (0..n).rev().find(|&c| self.cells[c].inertia > limit)?;
        if last + 1 == n {
            return None;
        }
        let (a, b) = (&self.cells[last], &self.cells[last + 1]);
        // Under the exact yield the friction is smooth there, in creeping grains the logarithm of the inertial number is.
        let share = if b.inertia > 0.0 {
            (a.inertia / limit).ln() / (a.inertia / b.inertia).ln()
        } else {
            let (r_a, r_b) = (a.tau_p / a.pressure, b.tau_p / b.pressure);
            (r_a - flow.friction.mu(limit)) / (r_a - r_b)
        };
        let bottom = self.middle(last) + share * (self.middle(last + 1) - self.middle(last));
        let moving = |c: &usize| self.middle(*c) > bottom;
        let mass = |regime: Regime| {
            let here = |c: &usize| {
                let slip = 0.5 * (state.w(*c) + state.w(c + 1));
                flow.rearrangement.regime(&flow.grain(), self.cells[*c].pressure, slip) == regime
            };
            (0..n).filter(moving).filter(here).map(|c| self.cells[c].dm).sum::<f64>()
        };
        let volume: f64 = (0..n).map(|c| self.cells[c].phi * self.above(c, bottom)).sum();
        let of_moving: f64 = (0..n).filter(moving).map(|c| self.cells[c].dm).sum();
        let excess = |c: usize| self.cells[c].tau_p - state.s(c);
        let crossing = (0..last).find(|&c| excess(c) < 0.0 && excess(c + 1) >= 0.0);
        let crossover = crossing.map(|c| {
            let share = excess(c) / (excess(c) - excess(c + 1));
            self.middle(c) + share * (self.middle(c + 1) - self.middle(c))
        });
        let half = 0.5 * (bottom + self.z[0]);
        let viscous = |c: usize| self.cells[c].tau_f / (self.cells[c].tau_p + state.s(c));
        let viscous_share = (0..n).filter(|&c| self.middle(c) > half).map(viscous).fold(0.0, f64::max);
        let falls = (0.0 + mass(Regime::FreeFall) / of_moving, 0.0 + mass(Regime::Turbulent) / of_moving);
        Some(Sheet { bottom, volume, crossover, viscous_share, falls })
    }

    /// Height of the part of cell `c` that is above `z`.
    fn above(&self, c: usize, z: f64) -> f64 {
        (self.z[c] - self.z[c + 1].max(z)).max(0.0)
    }
}
