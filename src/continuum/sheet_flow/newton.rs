//! Newton's method on the whole column: the bed as a banded system, bordered by the stress on the interface, the slope and
//! the amount of grains, with exact derivatives and a line search.

use nalgebra::{LU, Matrix3, U3, Vector3};

use super::bed::{self, Linearised, LocalCell, STRIDE, State};
use super::column::{Closing, Setting};
use super::flow::Flow;
use super::mesh::Mesh;
use super::suspension::Meshes;
use crate::numerics::banded::Banded;

/// The discrete column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// laws
    pub flow: Flow,
    /// drive and geometry
    pub setting: Setting,
    /// mesh of the bed
    pub mesh: Mesh,
    /// meshes above it
    pub meshes: Meshes,
}

/// A Newton iteration that went nowhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stalled {
    /// smallest residual
    pub residual: f64,
    /// iterations made
    pub iterations: usize,
    /// level that the bed reached without holding its grains, in grain diameters, where that is the reason
    pub level: Option<f64>,
}

impl Stalled {
    /// A method that went nowhere.
    #[must_use]
    pub fn new(residual: f64, iterations: usize) -> Self {
        Self { residual, iterations, level: None }
    }
}

/// Iterations before giving up.
const MOST: usize = 100;
/// Relative residual below which a step more is one of round-off.
pub const TOLERANCE: f64 = 1e-12;
/// Halvings of a step.
const HALVINGS: usize = 12;
/// Share of the decrease that the slope of the merit promises, for a step to be taken.
const ENOUGH: f64 = 1e-4;
/// A step may use up this share of the distance of the mobilised friction to mu_2.
const TOWARDS_MU_2: f64 = 0.9;
/// Steps without a decrease before giving up.
const PATIENCE: usize = 6;

impl Column {
    /// The cells of the bed with their derivatives.
    #[must_use]
    pub fn local_cells(&self, state: &State) -> Vec<LocalCell> {
        (0..self.mesh.cells()).map(|c| bed::local_cell(&self.flow, &self.mesh, state, c)).collect()
    }

    /// Solves from `state`; the residuals go to `history`.
    ///
    /// # Errors
    /// [`Stalled`] if the residual does not reach round-off.
    pub fn newton(&self, mut state: State, history: &mut Vec<f64>) -> Result<State, Stalled> {
        let mut system = Linearised::new(self.mesh.cells());
        let mut scratch = vec![0.0; STRIDE * self.mesh.cells()];
        let (mut best, mut without) = ((f64::INFINITY, state.clone()), 0);
        for iteration in 0..MOST {
            let cells = self.local_cells(&state);
            system.fill(&self.flow, &self.mesh, &state, &cells);
            let closing = self.setting.closing(&self.flow, &self.meshes, &self.mesh.middles, &state, &cells);
            let norm = self.norm(&system.residual, &closing.residual, &state);
            history.push(norm);
            if !norm.is_finite() {
                break;
            }
            let converged = best.0 <= TOLERANCE;
            if norm < best.0 {
                best = (norm, state.clone());
            }
            // One step after convergence gives what round-off allows.
            if converged || norm <= 0.01 * TOLERANCE {
                return Ok(best.1);
            }
            let residual = system.residual.clone();
            let Some(factored) = Factored::new(&mut system, &closing) else { break };
            let step = factored.solve(&residual, &closing.residual);
            let merit = self.merit(&residual, &closing.residual, &state);
            let (next, decreased) = self.search(&state, &step, merit, &mut scratch);
            state = next;
            without = if decreased { 0 } else { without + 1 };
            if without > PATIENCE {
                return Err(Stalled::new(best.0, iteration));
            }
        }
        if best.0 <= TOLERANCE { Ok(best.1) } else { Err(Stalled::new(best.0, history.len())) }
    }

    /// Scales of the rows of a node and its cell, then of the closing equations.
    fn scales(&self, state: &State) -> ([f64; STRIDE], [f64; 3]) {
        let stress = self.setting.tau_b.unwrap_or(state.tau_b).abs().max(1e-3);
        let velocity = 10.0 * stress.sqrt();
        ([stress, stress, velocity, 0.1 * velocity, 1.0], [stress, stress, self.setting.level])
    }

    /// Largest residual in its scale.
    #[must_use]
    pub fn norm(&self, residual: &[f64], closing: &[f64; 3], state: &State) -> f64 {
        let (rows, three) = self.scales(state);
        let bed = residual.iter().enumerate().map(|(i, x)| x.abs() / rows[i % STRIDE]);
        let closing = closing.iter().zip(three).map(|(x, scale)| x.abs() / scale);
        bed.chain(closing).fold(0.0, |a: f64, b| if b.is_nan() { f64::NAN } else { a.max(b) })
    }

    fn merit(&self, residual: &[f64], closing: &[f64; 3], state: &State) -> f64 {
        let (rows, three) = self.scales(state);
        let bed: f64 = residual.iter().enumerate().map(|(i, x)| (x / rows[i % STRIDE]).powi(2)).sum();
        bed + closing.iter().zip(three).map(|(x, scale)| (x / scale).powi(2)).sum::<f64>()
    }

    /// The longest of the steps 1, 1/2, 1/4, ... that decreases the residual enough, and whether there was one.
    fn search(&self, from: &State, step: &Step, merit: f64, scratch: &mut [f64]) -> (State, bool) {
        let mut alpha = 1.0;
        let mut state = from.clone();
        for _ in 0..HALVINGS {
            self.advance(from, step, alpha, &mut state);
            bed::residual(&self.flow, &self.mesh, &state, scratch);
            let closing = self.setting.closing_residual(&self.flow, &self.meshes, &self.mesh, &state);
            if self.merit(scratch, &closing, &state) <= (1.0 - ENOUGH * alpha) * merit {
                return (state, true);
            }
            alpha *= 0.5;
        }
        (state, false)
    }

    /// Takes a share of the step, as far as the unknowns keep their meaning.
    fn advance(&self, from: &State, step: &Step, alpha: f64, state: &mut State) {
        let mu_2 = self.flow.friction.mu_2;
        for (i, ((value, old), step)) in state.x.iter_mut().zip(&from.x).zip(&step.0).enumerate() {
            *value = old + alpha * step;
            if i % STRIDE == 3 {
                let most = mu_2 - (1.0 - TOWARDS_MU_2) * (mu_2 - old.abs());
                *value = value.clamp(-most, most);
            }
        }
        let limited = |value: f64, step: f64| {
            let (a, b) = (0.2 * value, 5.0 * value);
            (value + alpha * step).clamp(a.min(b), a.max(b))
        };
        state.tau_b = limited(from.tau_b, step.1[0]);
        state.sine = limited(from.sine, step.1[1]).min(0.99);
        state.m = limited(from.m, step.1[2]);
    }
}

/// Of the unknowns, and of tau_b, sine, m.
type Step = (Vec<f64>, Vector3<f64>);

/// The factored Jacobian with its border.
struct Factored<'a> {
    jacobian: &'a Banded,
    columns: [Vec<f64>; 3],
    closing: &'a Closing,
    schur: LU<f64, U3, U3>,
}

impl<'a> Factored<'a> {
    /// Factors the Jacobian of `system` in place; `None` if it is singular.
    fn new(system: &'a mut Linearised, closing: &'a Closing) -> Option<Self> {
        system.jacobian.factor().ok()?;
        let columns = system.border.clone().map(|mut column| {
            system.jacobian.solve(&mut column);
            column
        });
        let schur = Matrix3::from_fn(|i, j| closing.by_globals[i][j] - closing.dot(i, &columns[j])).lu();
        schur.is_invertible().then_some(Self { jacobian: &system.jacobian, columns, closing, schur })
    }

    /// Minus the inverse of the whole Jacobian times the residuals of the bed and of the closing equations.
    fn solve(&self, residual: &[f64], closing: &[f64; 3]) -> Step {
        // J x + B g = -F and C x + E g = -f: x = -y - Y g.
        let mut y = residual.to_vec();
        self.jacobian.solve(&mut y);
        let rhs = Vector3::from_fn(|i, _| self.closing.dot(i, &y) - closing[i]);
        let g = self.schur.solve(&rhs).unwrap_or_default();
        let [a, b, c] = &self.columns;
        (y.iter().enumerate().map(|(k, y)| -y - a[k] * g[0] - b[k] * g[1] - c[k] * g[2]).collect(), g)
    }
}
