//! Two velocities: the mixture U and the grains w, coupled by Darcy drag. Elements with stresses in their middle:
//!
//! ```text
//! mixture  [tau_f + tau_p]_j - [tau_f + tau_p]_(j-1) + f (h_(j-1) + h_j)/2 = 0
//! grains   [tau_p]_j - [tau_p]_(j-1) + D_j = 0                                    (tau_p = 0 above the bed)
//! walls    U = 0, w = 0 below; U = 0 above
//! ```
//!
//! `D_j` is the drag between the middles of the two elements at node j. With `V = U - w - K f` it is the integral of
//! `(V + K f)/K`. Where the grains shear, U and w have the same curvature, V is constant, and the drag is lumped to the node.
//! Where they stand or creep, `e V'' = V/K` with w linear in the element: its solutions are exponentials of `z/l`,
//! `l = sqrt(K e)`, and the elements are fitted to them (both exact at the nodes, of any size, in Coulomb's bed).
//!
//! **Exact yield** ([`Coupled::rigid`]): below a given level the grains stand, above it they carry `mu_s p`, and the slip
//! follows. The yield level is where the grain velocity that results just above it vanishes.
//!
//! **Regularised** ([`Coupled::creeping`]): Newton on U, w and the carried ratio `r = R(gamma)` of each element as a third unknown, with
//! `r m(gamma) = gamma` linearised in all of them and eliminated in the element (after Chan, Golub & Mulet 1999, SIAM J. Sci.
//! Comput. 20, 1964-1977). Without the extra unknown Newton's method does not converge for small lambda. It starts from the exact yield.

use nalgebra::{Matrix2, Vector2};

use super::element::Element;
use super::mesh::Mesh;
use crate::closures::regularisation::Regularisation;
use crate::numerics::block_thomas::{self, Row};

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
    /// forces of the elements of the bed on the fluid: [`Coupled::seepages`]
    pub seepages: &'a [Seepage],
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

const MAX_ITERATIONS: usize = 200;
/// Residual of the momentum, relative to the drive, that round-off allows.
const ROUND_OFF: f64 = 1e-13;

/// Forces of one element of the bed on the fluid: stress in its middle `e w' + middle (V_above - V_below)`, drag on the half at a
/// node `f h/2 + own V_node + other V_opposite`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seepage {
    middle: f64,
    own: f64,
    other: f64,
}

impl Coupled<'_> {
    /// Forces of each element of the bed on the fluid; the lowest `fitted` ones are fitted to exponentials.
    #[must_use]
    pub fn seepages(mesh: &Mesh, elements: &[Element], k: &[f64], fitted: usize) -> Vec<Seepage> {
        let seepage = |(i, permeability): (usize, &f64)| {
            let (e, h) = (elements[i].e, mesh.size(i));
            if i >= fitted {
                return Seepage { middle: e / h, own: 0.5 * h / permeability, other: 0.0 };
            }
            let l = (permeability * e).sqrt();
            let (x, scale) = (h / l, e / l);
            let middle = 0.5 * scale / (0.5 * x).sinh();
            Seepage { middle, own: scale / x.tanh() - middle, other: middle - scale / x.sinh() }
        };
        k.iter().enumerate().map(seepage).collect()
    }

    /// Fluid stress in the middle of each element.
    #[must_use]
    pub fn fluid_stress(&self, u: &[f64], w: &[f64]) -> Vec<f64> {
        let stress = |k: usize| {
            let e = self.elements[k].e / self.mesh.size(k);
            if k >= self.bed {
                return e * (u[k + 1] - u[k]);
            }
            let (middle, shear) = (self.seepages[k].middle, w[k + 1] - w[k]);
            e * shear + middle * (u[k + 1] - u[k] - shear)
        };
        (0..self.elements.len()).map(stress).collect()
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
        let w: Vec<f64> = (0..=self.bed).map(|j| if j <= still { 0.0 } else { u[j] - self.slip(j) }).collect();
        // The grains below the yield level carry what the fluid leaves of the total stress.
        let tau_f = self.fluid_stress(&u, &w);
        let top = tau_f[self.bed] + self.f * self.mesh.middle(self.bed);
        let rest = |k: usize| top - self.f * self.mesh.middle(k) - tau_f[k];
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
        let half = |k: usize| 0.5 * self.mesh.size(k) / self.k[k];
        let (above, drag) = if j < self.bed { (self.elements[j].y, half(j)) } else { (0.0, 0.0) };
        (self.elements[j - 1].y - above) / (half(j - 1) + drag)
    }

    /// Velocities with the regularised yield stress, from the start `from`, until the residual is below `tolerance` or at
    /// round-off.
    ///
    /// # Errors
    /// [`NotConverged`] if the residual of the momentum does not reach round-off.
    pub fn creeping(
        &self,
        from: &Solved,
        regularisation: &Regularisation,
        tolerance: f64,
    ) -> Result<Solved, NotConverged> {
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
        for iteration in 0..MAX_ITERATIONS {
            let tau_p: Vec<f64> = (0..self.bed)
                .map(|k| self.elements[k].solid((w[k + 1] - w[k]) / self.mesh.size(k), regularisation).0)
                .collect();
            let residual = self.residual(&u, &w, &tau_p);
            history.push(residual);
            let at_round_off = iteration > 3 && residual <= 100.0 * ROUND_OFF && residual >= 0.5 * best;
            if residual <= ROUND_OFF.max(tolerance) || at_round_off {
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
        Err(NotConverged { residual: history.last().copied().unwrap_or(f64::NAN), iterations: MAX_ITERATIONS })
    }

    /// Drag on the half of element `k` at its upper or lower node.
    fn drag(&self, k: usize, upper: bool, u: &[f64], w: &[f64]) -> f64 {
        let Seepage { own, other, .. } = self.seepages[k];
        let v = |j: usize| u[j] - w[j] - self.k[k] * self.f;
        let (here, opposite) = if upper { (v(k + 1), v(k)) } else { (v(k), v(k + 1)) };
        0.5 * self.f * self.mesh.size(k) + own * here + other * opposite
    }

    /// Residuals of the momentum of the mixture and of the grains at node `j`.
    fn imbalance(&self, j: usize, u: &[f64], w: &[f64], tau_f: &[f64], tau_p: &[f64]) -> Vector2<f64> {
        let solid = |k: usize| if k < self.bed { tau_p[k] } else { 0.0 };
        let drive = 0.5 * self.f * (self.mesh.size(j - 1) + self.mesh.size(j));
        let mixture = tau_f[j] + solid(j) - tau_f[j - 1] - solid(j - 1) + drive;
        if j > self.bed {
            return Vector2::new(mixture, 0.0);
        }
        let above = if j < self.bed { self.drag(j, false, u, w) } else { 0.0 };
        Vector2::new(mixture, solid(j) - solid(j - 1) + above + self.drag(j - 1, true, u, w))
    }

    /// Integral of U - w over the bed, from the drag.
    #[must_use]
    pub fn slip_integral(&self, u: &[f64], w: &[f64]) -> f64 {
        (0..self.bed).map(|k| self.k[k] * (self.drag(k, true, u, w) + self.drag(k, false, u, w))).sum()
    }

    /// Largest residual of both momentum equations, relative to the drive over the height.
    fn residual(&self, u: &[f64], w: &[f64], tau_p: &[f64]) -> f64 {
        let tau_f = self.fluid_stress(u, w);
        let at = |j: usize| self.imbalance(j, u, w, &tau_f, tau_p).amax();
        (1..self.elements.len()).map(at).fold(0.0, f64::max) / self.f
    }

    /// The linear system of one Newton step for (U, w) at the inner nodes.
    fn assemble(&self, rows: &mut [Row<2>], u: &[f64], w: &[f64], ratio: &[f64], regularisation: &Regularisation) {
        let n = self.elements.len();
        let tau_f = self.fluid_stress(u, w);
        // Stress of the grains with the ratio as an unknown, eliminated: value and tangent per element.
        let (mut tau_p, mut tangent) = (vec![0.0; self.bed], vec![0.0; n]);
        for k in 0..self.bed {
            let (element, h) = (&self.elements[k], self.mesh.size(k));
            let gamma = (w[k + 1] - w[k]) / h;
            let (m, dm) = regularisation.effective(gamma);
            let (rise, slope) = element.rise.map_or((0.0, 0.0), |rise| rise.stress(gamma));
            tau_p[k] = element.y * gamma / m + rise;
            tangent[k] = (element.y * (1.0 - ratio[k] * dm) / m + slope) / h;
        }
        // Derivative of the fluid stress of an element with respect to the steps of U and of w.
        let fluid = |k: usize| {
            let e = self.elements[k].e / self.mesh.size(k);
            let middle = if k < self.bed { self.seepages[k].middle } else { e };
            (middle, e - middle)
        };
        for j in 1..n {
            let ((u0, w0), (u1, w1)) = (fluid(j - 1), fluid(j));
            let (t0, t1) = (tangent[j - 1], tangent[j]);
            let row = &mut rows[j - 1];
            row.rhs = -self.imbalance(j, u, w, &tau_f, &tau_p);
            if j > self.bed {
                // No grains: their velocity does not change. The node below still knows those of the bed.
                row.lower = Matrix2::new(u0, if j == self.bed + 1 { w0 } else { 0.0 }, 0.0, 0.0);
                row.diagonal = Matrix2::new(-u0 - u1, 0.0, 0.0, 1.0);
                row.upper = Matrix2::new(u1, 0.0, 0.0, 0.0);
                continue;
            }
            let below = self.seepages[j - 1];
            let above = if j < self.bed { self.seepages[j] } else { Seepage::default() };
            let own = below.own + above.own;
            row.lower = Matrix2::new(u0, w0 + t0, below.other, t0 - below.other);
            row.diagonal = Matrix2::new(-u0 - u1, -w0 - w1 - t0 - t1, own, -t0 - t1 - own);
            row.upper = Matrix2::new(u1, w1 + t1, above.other, t1 - above.other);
        }
    }
}
