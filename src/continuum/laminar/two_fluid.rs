//! Two velocities: the mixture U and the grains w, coupled by Darcy drag. Linear elements, drag lumped to the nodes.
//!
//! With `tau_f = e U'` everywhere, `tau_p` in the bed only, `b_j` the thickness of bed that node j stands for:
//!
//! ```text
//! mixture  [tau_f + tau_p]_j - [tau_f + tau_p]_(j-1) + f (h_(j-1) + h_j)/2 = 0
//! grains   [tau_p]_j - [tau_p]_(j-1) + b_j (U_j - w_j)/K = 0                        (tau_p = 0 above the bed)
//! walls    U = 0, w = 0 below; U = 0 above
//! ```
//!
//! **Exact yield** ([`rigid`]): below a given level the grains stand, and the seepage `e U'' + f = U/K` is solved by
//! exponentially fitted elements, which are exact at the nodes for any size; above it the grains carry `mu_s p`, and the slip
//! follows. The yield level is where the grain velocity that results just above it vanishes.
//!
//! **Regularised** ([`creeping`]): Newton on U, w and the carried ratio `r = R(gamma)` of each element as a third unknown, with
//! `r m(gamma) = gamma` linearised in all of them and eliminated in the element (after Chan, Golub & Mulet 1999, SIAM J. Sci.
//! Comput. 20, 1964-1977). Without the extra unknown Newton's method stalls for small lambda. It starts from the exact yield.

use nalgebra::{Matrix2, Vector2};

use super::element::Element;
use super::mesh::Mesh;
use crate::numerics::block_thomas::{self, Row};
use crate::problem::Regularisation;

/// A bed under a fluid, in the units of the model.
#[derive(Clone, Debug)]
pub struct Coupled<'a> {
    /// nodes; one lies on the bed level
    pub mesh: &'a Mesh,
    /// materials; above the bed without yield stress
    pub elements: &'a [Element],
    /// elements of the bed, from the bottom
    pub bed: usize,
    /// drive
    pub f: f64,
    /// permeability of each element of the bed
    pub k: &'a [f64],
    /// yield stress at the nodes of the bed
    pub yields: &'a [f64],
}

/// The velocities at the nodes, and the stress of the grains in the elements of the bed.
#[derive(Clone, Debug)]
pub struct Solved {
    /// mixture velocity
    pub u: Vec<f64>,
    /// grain velocity at the nodes of the bed
    pub w: Vec<f64>,
    /// stress of the grains in the elements of the bed
    pub tau_p: Vec<f64>,
    /// largest residual of the momentum relative to the drive, one per iteration
    pub history: Vec<f64>,
}

/// The iteration did not reach round-off.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the momentum is missed by {residual} of the drive after {iterations} iterations")]
pub struct NotConverged {
    /// relative residual
    pub residual: f64,
    /// iterations made
    pub iterations: usize,
}

const MOST: usize = 200;
/// Residual of the momentum, relative to the drive, that round-off allows.
const ROUND_OFF: f64 = 1e-13;

impl Coupled<'_> {
    /// Thickness of bed that node `j` stands for, over the permeability: the drag coefficient of the node.
    fn drag(&self, j: usize) -> f64 {
        let half = |k: usize| 0.5 * self.mesh.size(k) / self.k[k];
        let below = if j > 0 && j <= self.bed { half(j - 1) } else { 0.0 };
        below + if j < self.bed { half(j) } else { 0.0 }
    }

    /// Velocities if the lowest `still` elements of the bed stand and the others carry their yield stress. Any friction that
    /// rises with the shear rate is left out: this is Coulomb's bed.
    #[must_use]
    pub fn rigid(&self, still: usize) -> Solved {
        let n = self.elements.len();
        // Stress at the ends of an element: its own node, the other one, the load.
        let ends = |k: usize| {
            let (e, h) = (self.elements[k].e, self.mesh.size(k));
            if k < still {
                let l = (self.k[k] * e).sqrt();
                let (own, other) = (e / (l * (h / l).tanh()), e / (l * (h / l).sinh()));
                (own, other, e / l * (0.5 * h / l).tanh() * self.k[k] * self.f)
            } else {
                (e / h, e / h, 0.5 * (self.f - self.pull(k)) * h)
            }
        };
        let rows: Vec<(f64, f64, f64)> = (0..n).map(ends).collect();
        let mut u = vec![0.0; n + 1];
        let (mut upper, mut rhs) = (vec![0.0; n + 1], vec![0.0; n + 1]);
        for j in 1..n {
            let ((own0, other0, load0), (own1, other1, load1)) = (rows[j - 1], rows[j]);
            let pivot = own0 + own1 - other0 * upper[j - 1];
            upper[j] = other1 / pivot;
            rhs[j] = (load0 + load1 + other0 * rhs[j - 1]) / pivot;
        }
        for j in (1..n).rev() {
            u[j] = rhs[j] + upper[j] * u[j + 1];
        }
        let w = (0..=self.bed).map(|j| if j <= still { 0.0 } else { u[j] - self.slip(j) }).collect();
        // The fluid stress in the middle of each element; the grains below the yield level carry the rest of the total.
        let fluid = |k: usize| {
            let (e, h) = (self.elements[k].e, self.mesh.size(k));
            let l = if k < still { (self.k[k] * e).sqrt() } else { f64::INFINITY };
            let width = if k < still { 2.0 * l * (0.5 * h / l).sinh() } else { h };
            e * (u[k + 1] - u[k]) / width
        };
        let top = fluid(self.bed) + self.f * self.mesh.middle(self.bed);
        let rest = |k: usize| top - self.f * self.mesh.middle(k) - fluid(k);
        let tau_p = (0..self.bed).map(|k| if k < still { rest(k) } else { self.elements[k].y }).collect();
        Solved { u, w, tau_p, history: Vec::new() }
    }

    /// Fall of the yield stress with elevation in element `k`: the force per volume that moving grains take from the fluid.
    #[must_use]
    pub fn pull(&self, k: usize) -> f64 {
        if k < self.bed { (self.yields[k] - self.yields[k + 1]) / self.mesh.size(k) } else { 0.0 }
    }

    /// Slip U - w at node `j` of grains that carry their yield stress on both sides.
    fn slip(&self, j: usize) -> f64 {
        let above = if j < self.bed { self.elements[j].y } else { 0.0 };
        (self.elements[j - 1].y - above) / self.drag(j)
    }

    /// Velocities with the regularised yield stress, from the start `from`.
    ///
    /// # Errors
    /// [`NotConverged`] if the residual of the momentum does not reach round-off.
    pub fn creeping(&self, from: &Solved, regularisation: &Regularisation) -> Result<Solved, NotConverged> {
        let n = self.elements.len();
        let (mut u, mut w) = (from.u.clone(), from.w.clone());
        let mut ratio: Vec<f64> = (0..self.bed)
            .map(|k| {
                let y = self.elements[k].y;
                if y > 0.0 { (from.tau_p[k] / y).clamp(-1.0, 1.0) } else { 0.0 }
            })
            .collect();
        let mut history = Vec::new();
        let mut rows = vec![Row::<2>::zero(); n - 1];
        let mut best = f64::INFINITY;
        for iteration in 0..MOST {
            let tau_p: Vec<f64> = (0..self.bed)
                .map(|k| self.elements[k].solid((w[k + 1] - w[k]) / self.mesh.size(k), regularisation).0)
                .collect();
            let residual = self.residual(&u, &w, &tau_p);
            history.push(residual);
            let stalled = iteration > 3 && residual <= 100.0 * ROUND_OFF && residual >= 0.5 * best;
            if residual <= ROUND_OFF || stalled {
                return Ok(Solved { u, w, tau_p, history });
            }
            best = best.min(residual);
            self.assemble(&mut rows, &u, &w, &ratio, regularisation);
            let failed = NotConverged { residual, iterations: iteration + 1 };
            block_thomas::solve(&mut rows).map_err(|_| failed)?;
            let before: Vec<f64> = (0..self.bed).map(|k| (w[k + 1] - w[k]) / self.mesh.size(k)).collect();
            for (j, row) in (1..n).zip(&rows) {
                u[j] += row.rhs[0];
                if j <= self.bed {
                    w[j] += row.rhs[1];
                }
            }
            for k in 0..self.bed {
                let gamma = before[k];
                let change = (w[k + 1] - w[k]) / self.mesh.size(k) - gamma;
                let (m, dm) = regularisation.effective(gamma);
                let r = ratio[k] + (gamma - ratio[k] * m + (1.0 - ratio[k] * dm) * change) / m;
                ratio[k] = r.clamp(-1.0, 1.0);
            }
        }
        Err(NotConverged { residual: history.last().copied().unwrap_or(f64::NAN), iterations: MOST })
    }

    /// Largest residual of both momentum equations, relative to the drive over the height.
    fn residual(&self, u: &[f64], w: &[f64], tau_p: &[f64]) -> f64 {
        let solid = |k: usize| if k < self.bed { tau_p[k] } else { 0.0 };
        let fluid = |k: usize| self.elements[k].e * (u[k + 1] - u[k]) / self.mesh.size(k);
        let at = |j: usize| {
            let drive = 0.5 * self.f * (self.mesh.size(j - 1) + self.mesh.size(j));
            let mixture = fluid(j) + solid(j) - fluid(j - 1) - solid(j - 1) + drive;
            let grains = if j <= self.bed { solid(j) - solid(j - 1) + self.drag(j) * (u[j] - w[j]) } else { 0.0 };
            mixture.abs().max(grains.abs())
        };
        (1..self.elements.len()).map(at).fold(0.0, f64::max) / self.f
    }

    /// The linear system of one Newton step for (U, w) at the inner nodes.
    fn assemble(&self, rows: &mut [Row<2>], u: &[f64], w: &[f64], ratio: &[f64], regularisation: &Regularisation) {
        let n = self.elements.len();
        // Stress of the grains with the ratio as an unknown, eliminated: value and tangent per element.
        let solid: Vec<(f64, f64)> = (0..n)
            .map(|k| {
                if k >= self.bed {
                    return (0.0, 0.0);
                }
                let element = &self.elements[k];
                let gamma = (w[k + 1] - w[k]) / self.mesh.size(k);
                let (m, dm) = regularisation.effective(gamma);
                let (rise, slope) = element.rise.map_or((0.0, 0.0), |rise| rise.stress(gamma));
                (element.y * gamma / m + rise, element.y * (1.0 - ratio[k] * dm) / m + slope)
            })
            .collect();
        for j in 1..n {
            let (h0, h1) = (self.mesh.size(j - 1), self.mesh.size(j));
            let (f0, f1) = (self.elements[j - 1].e / h0, self.elements[j].e / h1);
            let ((s0, t0), (s1, t1)) = (solid[j - 1], solid[j]);
            let (t0, t1) = (t0 / h0, t1 / h1);
            let in_bed = j <= self.bed;
            let drag = self.drag(j);
            let mixture = f1 * (u[j + 1] - u[j]) - f0 * (u[j] - u[j - 1]) + s1 - s0 + 0.5 * self.f * (h0 + h1);
            let row = &mut rows[j - 1];
            if in_bed {
                let grains = s1 - s0 + drag * (u[j] - w[j]);
                row.lower = Matrix2::new(f0, t0, 0.0, t0);
                row.diagonal = Matrix2::new(-f0 - f1, -t0 - t1, drag, -t0 - t1 - drag);
                row.upper = Matrix2::new(f1, t1, 0.0, t1);
                row.rhs = -Vector2::new(mixture, grains);
            } else {
                row.lower = Matrix2::new(f0, 0.0, 0.0, 0.0);
                row.diagonal = Matrix2::new(-f0 - f1, 0.0, 0.0, 1.0);
                row.upper = Matrix2::new(f1, 0.0, 0.0, 0.0);
                row.rhs = -Vector2::new(mixture, 0.0);
            }
        }
    }
}
