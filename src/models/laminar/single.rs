//! One velocity: a material between two planes under a uniform drive.
//!
//! Linear elements with the stress in their middle (P1 finite elements with one quadrature point). Momentum at the nodes makes
//! the stress linear whatever the material, `T_k = T_0 - f z_k`, so that the whole problem is one scalar equation for the stress
//! `T_0` at the lower wall: the shear rates `gamma(T_k)` must add up to no slip at the upper wall,
//!
//! ```text
//! F(T_0) = sum_k h_k gamma_k(T_0 - f z_k) = 0,      F' = sum_k h_k / T_k'(gamma_k) >= 0
//! ```
//!
//! F increases, and changes sign between 0 and f: Newton's method with exact derivatives, safeguarded by that bracket, cannot
//! fail, for any regularisation down to the exact yield. For layers of constant viscosity with nodes on their ends the
//! nodal velocities are exact.

use super::element::Element;
use super::mesh::Mesh;
use crate::closures::regularisation::Regularisation;

/// The solution at the nodes and in the elements.
#[derive(Clone, Debug)]
pub struct Solved {
    /// stress at the lower wall
    pub t_0: f64,
    /// velocity at the nodes
    pub u: Vec<f64>,
    /// shear rate of the elements
    pub gamma: Vec<f64>,
    /// |F| relative to the sum of its terms, one per iteration
    pub history: Vec<f64>,
}

/// The iteration did not reach round-off.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no slip at the upper wall is missed by {residual} after {iterations} iterations")]
pub struct NotConverged {
    /// relative residual
    pub residual: f64,
    /// iterations made
    pub iterations: usize,
}

const MAX_ITERATIONS: usize = 100;

/// Solves for the velocity under the drive `f`, no slip at both walls.
///
/// # Errors
/// [`NotConverged`] if round-off is not reached, which the bracket excludes for finite input.
pub fn solve(
    mesh: &Mesh,
    elements: &[Element],
    f: f64,
    regularisation: &Regularisation,
) -> Result<Solved, NotConverged> {
    let n = elements.len();
    let mut gamma = vec![0.0; n];
    let (mut low, mut high) = (0.0, f);
    let mut t_0 = 0.5 * f;
    let mut history = Vec::new();
    for _ in 0..MAX_ITERATIONS {
        let (mut sum, mut size, mut slope) = (0.0, 0.0, 0.0);
        for (k, element) in elements.iter().enumerate() {
            let (rate, inverse) = element.shear_rate(t_0 - f * mesh.middle(k), regularisation);
            gamma[k] = rate;
            sum += mesh.size(k) * rate;
            size += mesh.size(k) * rate.abs();
            slope += mesh.size(k) * inverse;
        }
        history.push(if size > 0.0 { sum.abs() / size } else { 0.0 });
        if sum > 0.0 {
            high = t_0
        } else {
            low = t_0
        }
        let mut next = t_0 - sum / slope;
        // Where nothing moves there is no slope, and any stress below yield is in balance.
        if size == 0.0 {
            return Ok(finish(mesh, t_0, gamma, history));
        }
        if !(next >= low && next <= high) {
            next = 0.5 * (low + high);
        }
        let change = (next - t_0).abs();
        t_0 = next;
        if change <= 2.0 * f64::EPSILON * f {
            for (k, element) in elements.iter().enumerate() {
                gamma[k] = element.shear_rate(t_0 - f * mesh.middle(k), regularisation).0;
            }
            return Ok(finish(mesh, t_0, gamma, history));
        }
    }
    Err(NotConverged { residual: history.last().copied().unwrap_or(f64::NAN), iterations: MAX_ITERATIONS })
}

/// Velocities from both walls to the largest one, so that round-off does not pile up at the upper wall.
pub(super) fn finish(mesh: &Mesh, t_0: f64, gamma: Vec<f64>, history: Vec<f64>) -> Solved {
    let n = gamma.len();
    let turn = gamma.iter().position(|g| *g < 0.0).unwrap_or(n);
    let mut u = vec![0.0; n + 1];
    for k in 0..turn {
        u[k + 1] = u[k] + mesh.size(k) * gamma[k];
    }
    for k in (turn + 1..n).rev() {
        u[k] = u[k + 1] - mesh.size(k) * gamma[k];
    }
    Solved { t_0, u, gamma, history }
}
