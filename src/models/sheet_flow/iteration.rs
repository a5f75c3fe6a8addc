//! The iteration of Revil-Baudard & Chauchat (2013), Appendix B, on the discrete equations of the Newton method.
//!
//! Each iteration: the fluid layer for the stress, slope and interface of the iteration before (steps 1 and 2), the amount of grains
//! that it leaves in the bed (step 3), the particle pressure (step 4), one implicit step of pseudo-time for both velocities
//! with the coefficients of the iteration before (step 5), the solid fraction by the dilatancy law (step 6) and cells that keep
//! their grains (step 7). Two things differ: the fluid layer is taken at its steady state in every iteration, which is never slower
//! than relaxing it, and the grains that the suspension takes come from all cells in proportion, since equal parts would
//! empty the thin cells at the interface.

use nalgebra::{Matrix2, Vector2};

use super::bed::{self, STRIDE, State, Weights};
use super::column::interface_weights;
use super::newton::{Column, NotConverged};
use super::suspension::march;
use crate::closures::friction::FrictionLaw;
use crate::closures::lid::Lid;
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::closures::rearrangement::Clock;
use crate::models::sheet_flow::BedLevel;
use crate::numerics::block_thomas::{self, Row};

/// How the iteration goes on, and when it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// step of pseudo-time, scaled
    pub dt: f64,
    /// relative residual at which it has converged
    pub tolerance: f64,
    /// iterations before giving up
    pub max_iterations: usize,
}

/// Iterations between two looks at the residual.
const LOOK: usize = 20;
/// Largest change of the amount of grains and of the stress in one iteration, relative to them.
const CHANGE: f64 = 0.1;

/// Coefficients of a cell, those of the iteration before.
#[derive(Clone, Copy)]
struct Lagged {
    dz: f64,
    dm: f64,
    phi: f64,
    /// viscosities of the grains, of the mixture, and with the eddies, over the height of the cell
    grains: f64,
    mixture: f64,
    whole: f64,
}

impl<F: FrictionLaw> Column<F> {
    /// Iterates from rest, or from `state`; the residuals go to `history`, and `stop` may end it.
    ///
    /// # Errors
    /// [`NotConverged`] if it diverges, or does not converge in time.
    pub fn iterate(
        &self,
        mut state: State,
        control: &StepControl,
        history: &mut Vec<f64>,
        mut stop: impl FnMut(usize, f64) -> bool,
    ) -> Result<State, NotConverged> {
        let mut cells = self.lagged(&mut state);
        let mut residual = vec![0.0; STRIDE * self.mesh.cells()];
        let mut smallest = f64::INFINITY;
        for iteration in 0..control.max_iterations {
            if self.step(&mut state, &mut cells, control.dt).is_none() {
                return Err(NotConverged::new(smallest, iteration));
            }
            if iteration % LOOK == 0 {
                bed::residual(&self.flow, &self.mesh, &state, &mut residual);
                let closing = self.setting.closing_residual(self, &state);
                let norm = self.norm(&residual, &closing, &state);
                history.push(norm);
                smallest = smallest.min(norm);
                if norm <= control.tolerance {
                    return Ok(state);
                }
                if !norm.is_finite() || stop(iteration, norm) {
                    return Err(NotConverged::new(smallest, iteration));
                }
            }
        }
        Err(NotConverged::new(smallest, control.max_iterations))
    }

    /// The state after the most iterations that `control` allows; `None` if a system is singular.
    #[must_use]
    pub fn iterate_for(&self, mut state: State, control: &StepControl) -> Option<State> {
        let mut cells = self.lagged(&mut state);
        (0..control.max_iterations).try_for_each(|_| self.step(&mut state, &mut cells, control.dt))?;
        Some(state)
    }

    fn lagged(&self, state: &mut State) -> Vec<Lagged> {
        (0..self.mesh.cells()).map(|c| self.lag(state, c)).collect()
    }

    /// One iteration.
    fn step(&self, state: &mut State, cells: &mut [Lagged], dt: f64) -> Option<()> {
        self.exchange(state);
        self.velocities(state, cells, dt)?;
        for c in (0..cells.len()).rev() {
            cells[c] = self.lag(state, c);
        }
        Some(())
    }

    /// Laws in cell `c` from the velocities: sets its friction, stress and dilation, and gives its coefficients.
    fn lag(&self, state: &mut State, c: usize) -> Lagged {
        let flow = &self.flow;
        let old = bed::cell(flow, &self.mesh, state, c);
        let k = STRIDE * c;
        let strain = state.u(c) - state.u(c + 1);
        let shear = strain + state.w(c) - state.w(c + 1);
        let rate = flow.rearrangement.rate(&flow.grain(), old.pressure, 0.5 * (state.w(c) + state.w(c + 1)));
        // The height follows from the solid fraction, which follows from the shear rate over that height: one sweep an iteration.
        let speed = strain.abs() / old.dz;
        let inertia = if rate > 0.0 { speed / rate } else { 0.0 };
        let phi = flow.dilatancy.solid_fraction(inertia);
        let dz = old.dm / phi;
        let friction = flow.friction.mu(inertia) / (speed + flow.lambda);
        state.x[k + 3] = friction * strain / old.dz;
        state.x[k + 2] = state.d(c + 1) + dz - old.dm / flow.dilatancy.phi_max;
        let length = flow.mixing_length(0.5 * (state.d(c) + state.d(c + 1)), state.m * (1.0 - self.mesh.middles[c]));
        let mixture = flow.nu / flow.viscosity.fluidity(phi);
        let eddy = (1.0 - phi) * length * length * (shear / dz).abs();
        state.x[k + 4] = (mixture + eddy) * shear / dz;
        Lagged {
            dz,
            dm: old.dm,
            phi,
            grains: friction * old.pressure / dz,
            mixture: mixture / dz,
            whole: (mixture + eddy) / dz,
        }
    }

    /// Steps 1 to 4: stress on the interface, slope and amount of grains from the interface of the iteration before.
    fn exchange(&self, state: &mut State) {
        let (flow, setting) = (&self.flow, &self.setting);
        let h_p = state.m / flow.dilatancy.phi_max + state.d(0);
        let height = setting.height - h_p;
        let weights = interface_weights(&self.mesh.middles);
        let phi = |c: usize| bed::cell(flow, &self.mesh, state, c).phi;
        let phi_0 = weights.0 * phi(0) + weights.1 * phi(1);
        let globals = (state.tau_b, state.sine, state.m);
        let inflow = super::column::Setting::inflow(flow, phi_0, state.d(0), state.u(0) + state.w(0), globals);
        let totals = march(flow, &self.meshes, &inflow, height, |_| {});
        let lid = setting.lid_stress(flow, &totals, &inflow);
        let near = |old: f64, new: f64| new.max((1.0 - CHANGE) * old).min((1.0 + CHANGE) * old);
        let weight = (state.tau_b + lid) / height;
        match (setting.tau_b, setting.sine, setting.lid) {
            (Some(_), Some(_), Lid::Solved) => {}
            (Some(_), ..) => state.sine = near(state.sine, weight * flow.delta),
            (None, ..) => state.tau_b = near(state.tau_b, flow.fluid_weight(state.sine) * height - lid),
        }
        let m = match setting.bed_level {
            BedLevel::InFlow => (setting.level - state.d(0)) * flow.dilatancy.phi_max,
            BedLevel::AtRest => flow.dilatancy.phi_max * setting.level - totals.volume,
        };
        state.m = near(state.m, m);
    }

    /// Step 5: both velocities after a step of pseudo-time, with lagged coefficients; `None` if the system is singular.
    fn velocities(&self, state: &mut State, cells: &[Lagged], dt: f64) -> Option<()> {
        let flow = &self.flow;
        let mut rows: Vec<Row<2>> = vec![Row::zero(); cells.len()];
        for (j, row) in rows.iter_mut().enumerate() {
            let here = &cells[j];
            let above = j.checked_sub(1).map(|c| &cells[c]);
            let (dz, dm) = above.map_or((0.0, 0.0), |c| (c.dz, c.dm));
            let (dz, dm) = (0.5 * (dz + here.dz), 0.5 * (dm + here.dm));
            let weights = Weights::of(&self.mesh, flow, state.m, j);
            let phi = dm / dz;
            // Stresses of a cell by the jump of (u, w) across it: rows of mixture and grains.
            let stress = |c: &Lagged| {
                let viscous = weights.under_cut * phi * c.mixture;
                Matrix2::new(c.whole + c.grains, c.whole, c.grains + viscous, viscous)
            };
            let lower = stress(here);
            row.diagonal = -lower;
            row.upper = lower;
            if let Some(above) = above {
                row.lower = stress(above);
                row.diagonal -= row.lower;
            }
            let slip = weights.own * state.w(j) + (1.0 - weights.own) * state.w(j + 1);
            let force = |c: &Lagged| flow.drag.coefficient(c.phi, slip, (1.0, flow.nu), 1.0) / c.phi;
            let drag = dm * (weights.below * force(here) + above.map_or(0.0, |c| (1.0 - weights.below) * force(c)));
            row.diagonal[(1, 1)] += drag * weights.own;
            row.upper[(1, 1)] += drag * (1.0 - weights.own);
            let grains = (1.0 + flow.delta) * dm / dt;
            let inertia = Matrix2::new(grains + (dz - dm) / dt, (dz - dm) / dt, grains, 0.0);
            row.diagonal -= inertia;
            let top = if j == 0 { state.tau_b } else { 0.0 };
            let weight = Vector2::new(
                flow.fluid_weight(state.sine) * dz + state.sine * dm + top,
                flow.grain_weight(state.sine) * dm,
            );
            row.rhs = -weight - inertia * Vector2::new(state.u(j), state.w(j));
        }
        block_thomas::solve(&mut rows).ok()?;
        for (j, row) in rows.iter().enumerate() {
            state.x[STRIDE * j] = row.rhs[0];
            state.x[STRIDE * j + 1] = row.rhs[1];
        }
        Some(())
    }
}
