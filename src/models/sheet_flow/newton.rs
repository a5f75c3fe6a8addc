//! Newton's method on the whole column: the bed as a banded system, bordered by the stress on the interface, the slope, the
//! amount of grains and that of grains at rest, with exact derivatives and a line search.

use nalgebra::{LU, Matrix4, U4, Vector4};

use super::bed::{self, STRIDE, State};
use super::column::{Closing, Floor, Setting};
use super::flow::Flow;
use super::linear::{Linearised, LocalCell, local_cell};
use super::mesh::Mesh;
use super::suspension::Meshes;
use crate::closures::friction::{FrictionLaw, MuI};

/// The discrete column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<F = MuI> {
    /// laws
    pub flow: Flow<F>,
    /// drive and geometry
    pub setting: Setting,
    /// mesh of the bed
    pub mesh: Mesh,
    /// meshes above it
    pub meshes: Meshes,
    /// what lies under the mesh of the bed
    pub floor: Floor,
}

/// A method that has not converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// smallest residual
    pub residual: f64,
    /// iterations made
    pub iterations: usize,
    /// why there is no solution, where that is known
    pub reason: Option<Reason>,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// the bed reached this level without holding its grains, in grain diameters
    RunsAway(f64),
    /// all grains move, down to the bottom; above this share of the drive, where that is known
    AllMove(Option<f64>),
    /// no layer of grains moves below this multiple of the drive
    NoLayer(f64),
    /// packed grains that are taken for moving ones: they carry this share of the stress where they come to rest
    Jammed(f64),
}

impl NotConverged {
    /// A method that has not converged, for a reason that is not known.
    #[must_use]
    pub fn new(residual: f64, iterations: usize) -> Self {
        Self { residual, iterations, reason: None }
    }
}

/// Iterations before giving up.
const MAX_ITERATIONS: usize = 100;
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

impl<F: FrictionLaw> Column<F> {
    /// The cells of the bed with their derivatives.
    #[must_use]
    pub fn local_cells(&self, state: &State) -> Vec<LocalCell> {
        (0..self.mesh.cells()).map(|c| local_cell(&self.flow, &self.mesh, state, c)).collect()
    }

    /// Solves from `state`; the residuals go to `history`.
    ///
    /// # Errors
    /// [`NotConverged`] if the residual does not reach round-off.
    pub fn newton(&self, state: State, history: &mut Vec<f64>) -> Result<State, NotConverged> {
        self.newton_to(state, TOLERANCE, history)
    }

    /// As [`Column::newton`], to the relative residual `tolerance`.
    ///
    /// # Errors
    /// [`NotConverged`] if the residual does not get there.
    pub fn newton_to(&self, mut state: State, tolerance: f64, history: &mut Vec<f64>) -> Result<State, NotConverged> {
        let mut system = Linearised::new(self.mesh.cells());
        let mut scratch = vec![0.0; STRIDE * self.mesh.cells()];
        let (mut best, mut without) = ((f64::INFINITY, state.clone()), 0);
        for iteration in 0..MAX_ITERATIONS {
            let cells = self.local_cells(&state);
            system.fill(&self.flow, &self.mesh, &state, &cells);
            let closing = self.setting.closing(self, &state, &cells);
            let norm = self.norm(&system.residual, &closing.residual, &state);
            history.push(norm);
            if !norm.is_finite() {
                break;
            }
            let converged = best.0 <= tolerance;
            if norm < best.0 {
                best = (norm, state.clone());
            }
            // One step after convergence gives what round-off allows.
            if converged || norm <= 0.01 * tolerance {
                return Ok(best.1);
            }
            let merit = self.merit(&system.residual, &closing.residual, &state);
            let Some(step) = solve(&mut system, &closing) else { break };
            let (next, decreased) = self.search(&state, &step, merit, &mut scratch);
            state = next;
            without = if decreased { 0 } else { without + 1 };
            if without > PATIENCE {
                return Err(NotConverged::new(best.0, iteration));
            }
        }
        if best.0 <= tolerance { Ok(best.1) } else { Err(NotConverged::new(best.0, history.len())) }
    }

    /// Scales of the rows of a node and its cell, then of the closing equations.
    fn scales(&self, state: &State) -> ([f64; STRIDE], [f64; 4]) {
        let stress = self.setting.tau_b.unwrap_or(state.tau_b).abs().max(1e-3);
        let velocity = 10.0 * stress.sqrt();
        let bottom = if self.floor == Floor::Yield { stress } else { self.setting.level };
        ([stress, stress, velocity, 0.1 * velocity, 1.0], [stress, stress, self.setting.level, bottom])
    }

    /// Largest residual in its scale.
    #[must_use]
    pub fn norm(&self, residual: &[f64], closing: &[f64; 4], state: &State) -> f64 {
        let (rows, four) = self.scales(state);
        let bed = residual.iter().enumerate().map(|(i, x)| x.abs() / rows[i % STRIDE]);
        let closing = closing.iter().zip(four).map(|(x, scale)| x.abs() / scale);
        bed.chain(closing).fold(0.0, |a: f64, b| if b.is_nan() { f64::NAN } else { a.max(b) })
    }

    fn merit(&self, residual: &[f64], closing: &[f64; 4], state: &State) -> f64 {
        let (rows, four) = self.scales(state);
        let bed: f64 = residual.iter().enumerate().map(|(i, x)| (x / rows[i % STRIDE]).powi(2)).sum();
        bed + closing.iter().zip(four).map(|(x, scale)| (x / scale).powi(2)).sum::<f64>()
    }

    /// The longest of the steps 1, 1/2, 1/4, ... that decreases the residual enough, and whether there was one.
    fn search(&self, from: &State, step: &Step, merit: f64, scratch: &mut [f64]) -> (State, bool) {
        let mut alpha = 1.0;
        let mut state = from.clone();
        for _ in 0..HALVINGS {
            self.advance(from, step, alpha, &mut state);
            bed::residual(&self.flow, &self.mesh, &state, scratch);
            let closing = self.setting.closing_residual(self, &state);
            if self.merit(scratch, &closing, &state) <= (1.0 - ENOUGH * alpha) * merit {
                return (state, true);
            }
            alpha *= 0.5;
        }
        (state, false)
    }

    /// Takes a share of the step, as far as the unknowns keep their meaning.
    fn advance(&self, from: &State, step: &Step, alpha: f64, state: &mut State) {
        let mu_2 = self.flow.friction.most();
        for (i, ((value, old), step)) in state.x.iter_mut().zip(&from.x).zip(&step.0).enumerate() {
            *value = old + alpha * step;
            if i % STRIDE == 3 {
                let most = mu_2 - (1.0 - TOWARDS_MU_2) * (mu_2 - old.abs());
                *value = value.max(-most).min(most);
            }
        }
        let limited = |value: f64, step: f64| {
            let (a, b) = (0.2 * value, 5.0 * value);
            (value + alpha * step).max(a.min(b)).min(a.max(b))
        };
        state.tau_b = limited(from.tau_b, step.1[0]);
        state.sine = limited(from.sine, step.1[1]).min(0.99);
        state.m = limited(from.m, step.1[2]);
        state.rest = from.rest + alpha * step.1[3];
    }
}

/// Of the unknowns, and of tau_b, sine, m, rest.
type Step = (Vec<f64>, Vector4<f64>);

/// The whole system at a state, eliminated.
fn solve(system: &mut Linearised, closing: &Closing) -> Option<Step> {
    system.jacobian.factor().ok()?;
    // J x + B g = -F and C x + E g = -f: x = -y - Y g.
    let sides = system.residual.iter().zip(&system.border);
    let mut columns: Vec<[f64; 5]> = sides.map(|(f, b)| [b[0], b[1], b[2], b[3], *f]).collect();
    system.jacobian.solve_several(&mut columns);
    let dot = |row: usize, column: usize| -> f64 {
        closing.by_unknowns[row].iter().map(|(k, slope)| slope * columns[*k][column]).sum()
    };
    let schur: LU<f64, U4, U4> = Matrix4::from_fn(|i, j| closing.by_globals[i][j] - dot(i, j)).lu();
    let rhs = Vector4::from_fn(|i, _| dot(i, 4) - closing.residual[i]);
    let g = schur.solve(&rhs)?;
    Some((columns.iter().map(|y| -y[4] - y[0] * g[0] - y[1] * g[1] - y[2] * g[2] - y[3] * g[3]).collect(), g))
}
