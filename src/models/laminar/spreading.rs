//! One velocity over a bed whose grains spread where they shear.
//!
//! As in [`super::single`] the stress is `T_k = T_0 - f z_k` whatever the material. For a given `T_0` the bed is marched downwards
//! from its level: the pressure on the top of an element is known, and its shear rate, solid fraction and pressure are the root
//! of one scalar equation. What remains is `F(T_0) = sum_k h_k gamma_k = 0`, which increases and changes sign between 0 and f, so
//! that bracketing cannot fail.

use super::bed::Bed;
use super::element::{Element, Rise};
use super::mesh::Mesh;
use super::packing::Packing;
use super::single::{self, NotConverged};
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::closures::regularisation::Regularisation;
use crate::numerics::root::brent;

/// Solves the bed on `mesh`; its packing and its velocity.
///
/// # Errors
/// [`NotConverged`] if no stress at the lower wall gives no slip at the upper one, which the bracket excludes for finite input.
pub fn solve(
    bed: &Bed,
    mesh: &Mesh,
    regularisation: &Regularisation,
) -> Result<(Packing, single::Solved), NotConverged> {
    let mut history = Vec::new();
    let slip = |t_0: f64| {
        let gamma = march(bed, mesh, t_0, regularisation);
        let terms = gamma.iter().enumerate().map(|(k, rate)| mesh.size(k) * rate);
        let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
        if size > 0.0 { sum / size } else { 0.0 }
    };
    let t_0 = brent(slip, 0.0, bed.f, |missed| history.push(missed.abs()))
        .map_err(|error| NotConverged { residual: error.residual, iterations: error.evaluations })?;
    let gamma = march(bed, mesh, t_0, regularisation);
    let packing = Packing::of(bed, mesh, &gamma);
    let best = history.iter().copied().fold(f64::INFINITY, f64::min);
    history.push(best);
    Ok((packing, single::finish(mesh, t_0, gamma, history)))
}

/// The shear rates under the stress `t_0` at the lower wall.
fn march(bed: &Bed, mesh: &Mesh, t_0: f64, regularisation: &Regularisation) -> Vec<f64> {
    let n = mesh.below(bed.h_p);
    let stress = |k: usize| t_0 - bed.f * mesh.middle(k);
    let mut gamma: Vec<f64> = (0..mesh.elements()).map(stress).collect();
    let mut pressure = 0.0;
    for k in (0..n).rev() {
        let (h, t) = (mesh.size(k), stress(k).abs());
        let element = |root: f64| bed.spread(root * root, pressure, h);
        let excess = |root: f64| {
            let (element, rate) = (element(root).0, root * root);
            element.e * rate + element.solid(rate, regularisation).0 - t
        };
        let rigid = regularisation.is_exact() && t <= element(0.0).0.y;
        // The root of the shear rate, on which the solid fraction depends smoothly; the fluid alone would shear more.
        let root = if rigid { 0.0 } else { brent(excess, 0.0, t.sqrt(), |_| {}).unwrap_or(0.0) };
        gamma[k] = (root * root).copysign(stress(k));
        pressure += element(root).1 * h;
    }
    gamma
}

impl Bed {
    /// The element of thickness `h` under the pressure `top` that shears at the rate `gamma`, and its solid fraction.
    fn spread(&self, gamma: f64, top: f64, h: f64) -> (Element, f64) {
        let (phi, p) =
            self.dilation.map_or((self.phi, top + 0.5 * self.phi * h), |d| d.law.under(self.phi, gamma, top, h));
        let e = self.dilation.map_or(self.e, |dilation| dilation.viscosity.relative(phi));
        (Element { e, y: self.mu_s * p, rise: self.rise.map(|law| Rise { p, law }) }, phi)
    }
}
