//! Solid fraction and particle pressure of a bed whose grains make room where they shear.
//!
//! `phi = phi(I_v)`, `I_v = gamma/P_p`, and `P_p' = -phi` from `P_p = 0` at the bed level: marched downwards element by element
//! ([`crate::closures::dilatancy::PhiIv::under`]). The shear rates are given; flow and packing are
//! iterated in turn.

use std::ops::RangeInclusive;

use super::bed::Bed;
use super::mesh::Mesh;

/// What the grains are, from the bottom of the bed.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    /// solid fraction of each element of the bed
    pub phi: Vec<f64>,
    /// particle pressure at the nodes of the bed
    pub pressure: Vec<f64>,
    /// particle pressure in the middle of each element of the bed
    pub middle: Vec<f64>,
}

impl Packing {
    /// The packing of `bed` on `mesh` under the shear rates `gamma` of the elements, at rest where there are none.
    #[must_use]
    pub fn of(bed: &Bed, mesh: &Mesh, gamma: &[f64]) -> Self {
        let n = mesh.below(bed.h_p);
        let Some(dilation) = bed.dilation.filter(|_| !gamma.is_empty()) else {
            let at = |z: f64| bed.phi * (bed.h_p - z).max(0.0);
            let pressure = mesh.nodes()[..=n].iter().map(|&z| at(z)).collect();
            return Self { phi: vec![bed.phi; n], pressure, middle: (0..n).map(|k| at(mesh.middle(k))).collect() };
        };
        let (mut phi, mut pressure, mut middle) = (vec![0.0; n], vec![0.0; n + 1], vec![0.0; n]);
        for k in (0..n).rev() {
            let h = mesh.size(k);
            (phi[k], middle[k]) = dilation.law.under(bed.phi, gamma[k], pressure[k + 1], h);
            pressure[k] = pressure[k + 1] + phi[k] * h;
        }
        Self { phi, pressure, middle }
    }

    /// Largest difference of the solid fractions from those of `other`; infinite if it has another number of elements.
    #[must_use]
    pub fn change(&self, other: &Self) -> f64 {
        if self.phi.len() != other.phi.len() {
            return f64::INFINITY;
        }
        self.phi.iter().zip(&other.phi).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

/// A fixed point `x = g(x)` found faster than by repetition: steps relaxed as by Aitken, after Irons & Tuck (1969), Int. J.
/// Numer. Methods Eng. 1, 275-277.
#[derive(Clone, Debug, Default)]
pub struct Relaxation {
    missed: Vec<f64>,
    omega: f64,
}

impl Relaxation {
    /// The next guess after `x`, from `image` = g(x); into `x`.
    pub fn step(&mut self, x: &mut Vec<f64>, image: Vec<f64>) {
        if x.len() != image.len() {
            (*x, *self) = (image, Self::default());
            return;
        }
        let missed: Vec<f64> = image.iter().zip(&*x).map(|(new, old)| new - old).collect();
        if self.missed.len() == missed.len() {
            let changes = missed.iter().zip(&self.missed).map(|(new, old)| (old * (new - old), (new - old).powi(2)));
            let (along, size) = changes.fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
            let omega = -self.omega * along / size;
            self.omega = if RELAXATION.contains(&omega) { omega } else { 1.0 };
        } else {
            self.omega = 1.0;
        }
        x.iter_mut().zip(&missed).for_each(|(x, missed)| *x += self.omega * missed);
        self.missed = missed;
    }
}

/// Smallest and largest relaxation factor that are used; for one beyond them 1 is.
const RELAXATION: RangeInclusive<f64> = 0.1..=2.0;
