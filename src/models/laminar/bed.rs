//! A Coulomb or mu(I_v) bed under a viscous fluid: mesh, pressure, yield level, and the solver that the form asks for.

use super::element::{Element, Rise};
use super::mesh::{Layer, Mesh};
use super::packing::Packing;
use super::{single, spreading};
use crate::closures::dilatancy::PhiIv;
use crate::closures::drag::CarmanKozeny;
use crate::closures::friction::MuIv;
use crate::closures::mixture_viscosity::{MixtureViscosity, RelativeViscosity};
use crate::closures::regularisation::Regularisation;
use crate::models::BedError;
use crate::models::exact::ouriemi::Scaled;
use crate::result::SolveError;

/// A bed in the units of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    /// drive
    pub f: f64,
    /// bed level
    pub h_p: f64,
    /// solid fraction
    pub phi: f64,
    /// friction at vanishing shear rate
    pub mu_s: f64,
    /// mu(I_v), if the friction rises with the shear rate
    pub rise: Option<MuIv>,
    /// relative viscosity of the bed
    pub e: f64,
    /// permeability; `None`: one velocity
    pub k: Option<f64>,
    /// how the grains spread where they shear; `None`: `phi`, `e` and `k` hold everywhere, else only at rest
    pub dilation: Option<Dilation>,
}

/// How the grains spread where they shear, and what depends on their solid fraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dilation {
    /// solid fraction
    pub law: PhiIv,
    /// relative viscosity
    pub viscosity: MixtureViscosity,
    /// permeability, with the diameter of the grains
    pub drag: Option<(CarmanKozeny, f64)>,
}

impl Dilation {
    pub(super) fn permeability(&self, phi: f64) -> Option<f64> {
        self.drag.map(|(law, d)| law.permeability(phi, d))
    }
}

/// Rounds of flow and packing, or of flow and yield level.
pub(super) const MAX_ITERATIONS: usize = 200;
/// Change of a solid fraction, or of the yield level in H, that counts as none.
pub(super) const CONVERGED: f64 = 1e-13;

/// Where nodes go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nodes {
    /// number of elements
    pub elements: usize,
    /// whether one lies on the yield level
    pub on_yield: bool,
}

/// A solved bed: nodes with velocities, elements with stresses.
#[derive(Clone, Debug)]
pub struct Solution {
    /// nodes
    pub mesh: Mesh,
    /// elements in the bed
    pub bed: usize,
    /// solid fraction and particle pressure
    pub packing: Packing,
    /// yield level: where the grains carry just mu_s P_p; the bed level where they are at rest
    pub h_c: f64,
    /// mixture velocity at the nodes
    pub u: Vec<f64>,
    /// grain velocity at the nodes of the bed
    pub w: Vec<f64>,
    /// fluid stress of the elements
    pub tau_f: Vec<f64>,
    /// stress of the grains, by element of the bed
    pub tau_p: Vec<f64>,
    /// integral of U - w over the bed
    pub slip: f64,
    /// residuals, one per iteration
    pub history: Vec<f64>,
}

impl Bed {
    /// Largest drive with a static layer: that of the closed form for Coulomb friction with one velocity, mu_s phi otherwise.
    #[must_use]
    pub fn largest_drive(&self) -> f64 {
        let resistance = self.mu_s * self.phi;
        let k = if self.rise.is_some() { Some(0.0) } else { self.k };
        Scaled { f: self.f, resistance, e: self.e, h_p: self.h_p, k }.largest_drive()
    }

    /// The mesh for the yield level `h_c`.
    pub(super) fn mesh(&self, nodes: Nodes, h_c: f64) -> Mesh {
        let n = nodes.elements;
        let equal = |top: f64, elements: usize| Layer {
            top,
            elements,
            finest_below: f64::INFINITY,
            finest_above: f64::INFINITY,
        };
        let clear = equal(1.0, n - n / 2);
        if !nodes.on_yield {
            return Mesh::layered(&[equal(self.h_p, n / 2), clear]);
        }
        let finest = self.k.map_or(f64::INFINITY, |k| 0.5 * (k * self.e).sqrt());
        let quarter = if h_c < self.h_p { n / 4 } else { 0 };
        let still = Layer { top: h_c, elements: n / 2 - quarter, finest_below: finest, finest_above: finest };
        Mesh::layered(&[still, equal(self.h_p, quarter), clear])
    }

    pub(super) fn elements(&self, mesh: &Mesh, packing: &Packing) -> Vec<Element> {
        let element = |k: usize| {
            let Some(&phi) = packing.phi.get(k) else { return Element { e: 1.0, y: 0.0, rise: None } };
            let p = packing.middle[k];
            let e = self.dilation.map_or(self.e, |dilation| dilation.viscosity.relative(phi));
            Element { e, y: self.mu_s * p, rise: self.rise.map(|law| Rise { p, law }) }
        };
        (0..mesh.elements()).map(element).collect()
    }

    /// Solves the bed with the given regularisation.
    ///
    /// # Errors
    /// [`BedError::NoStaticBed`] and [`BedError::WholeBedMoves`] where the grains yield down to the lower wall,
    /// [`NumericalError::NotConverged`](crate::result::NumericalError::NotConverged) if round-off is not reached.
    pub fn solve(&self, nodes: Nodes, regularisation: &Regularisation) -> Result<Solution, SolveError> {
        let resistance = self.mu_s * self.phi;
        if self.f >= resistance {
            return Err(BedError::NoStaticBed { drive: self.f, limit: resistance }.into());
        }
        match self.k {
            None => self.mixed(nodes, regularisation),
            Some(k) => self.slipping(nodes, k, regularisation),
        }
    }

    fn mixed(&self, nodes: Nodes, regularisation: &Regularisation) -> Result<Solution, SolveError> {
        let (mut h_c, mut gamma) = (0.75 * self.h_p, Vec::new());
        let (mut mesh, mut packing, mut solved) = self.sheared(nodes, &mut h_c, &mut gamma, None)?;
        if !regularisation.is_exact() {
            (mesh, packing, solved) = self.sheared(nodes, &mut h_c, &mut gamma, Some(regularisation))?;
        }
        let bed = packing.phi.len();
        let total = |k: usize| solved.t_0 - self.f * mesh.middle(k);
        let elements = self.elements(&mesh, &packing);
        let tau_f: Vec<f64> = elements.iter().zip(&solved.gamma).map(|(element, gamma)| element.e * gamma).collect();
        let tau_p = (0..bed).map(|k| total(k) - tau_f[k]).collect();
        let w = solved.u[..=bed].to_vec();
        Ok(Solution { mesh, bed, packing, h_c, w, tau_f, tau_p, slip: 0.0, u: solved.u, history: solved.history })
    }

    /// One velocity, with the packing that its shear rates `gamma` leave. With the exact yield, where `regularisation` is
    /// `None`, the yield level `h_c` follows.
    pub(super) fn sheared(
        &self,
        nodes: Nodes,
        h_c: &mut f64,
        gamma: &mut Vec<f64>,
        regularisation: Option<&Regularisation>,
    ) -> Result<(Mesh, Packing, single::Solved), SolveError> {
        let law = regularisation.unwrap_or(&Regularisation::EXACT);
        let mut moved = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let mesh = self.mesh(nodes, *h_c);
            let (packing, solved) = if self.dilation.is_some() {
                spreading::solve(self, &mesh, law)
            } else {
                let packing = Packing::of(self, &mesh, &[]);
                single::solve(&mesh, &self.elements(&mesh, &packing), self.f, law).map(|solved| (packing, solved))
            }
            .map_err(not_converged)?;
            gamma.clone_from(&solved.gamma);
            if regularisation.is_some() {
                return Ok((mesh, packing, solved));
            }
            // Where the stress t_0 - f z crosses the yield stress; the bed below is packed as at rest. With a node there the
            // stress is exact, so the level converges as fast as its own error squared.
            let level = (self.mu_s * packing.pressure[0] - solved.t_0) / (self.mu_s * self.phi - self.f);
            if level <= 0.0 {
                return Err(self.whole_bed(level));
            }
            let level = level.min(self.h_p);
            moved = (level - *h_c).abs();
            *h_c = level;
            if !nodes.on_yield || moved <= CONVERGED {
                return Ok((mesh, packing, solved));
            }
        }
        Err(SolveError::not_converged(moved, MAX_ITERATIONS))
    }

    pub(super) fn whole_bed(&self, level: f64) -> SolveError {
        BedError::WholeBedMoves {
            mobile_depth_m: self.h_p - level.min(0.0),
            bed_m: self.h_p,
            limit_pa_m: self.largest_drive(),
        }
        .into()
    }
}

fn not_converged(error: single::NotConverged) -> SolveError {
    SolveError::not_converged(error.residual, error.iterations)
}

impl Solution {
    /// Fluid stress at the bed level, from above.
    #[must_use]
    pub fn tau_interface(&self, f: f64) -> f64 {
        let z = self.mesh.nodes()[self.bed];
        self.tau_f[self.bed] + f * (self.mesh.middle(self.bed) - z)
    }

    /// Solid flux: integral of phi times the grain velocity over the bed. Exact where the shear rate is linear on each side
    /// of the yield level: the trapezoidal rule with the change of the shear rate along the element.
    #[must_use]
    pub fn flux(&self) -> f64 {
        (0..self.bed).map(|k| self.packing.phi[k] * self.integral(k)).sum()
    }

    /// Integral of the mixture velocity over the bed.
    #[must_use]
    pub fn discharge(&self) -> f64 {
        self.slip + (0..self.bed).map(|k| self.integral(k)).sum::<f64>()
    }

    /// Integral of the grain velocity over element `k` of the bed.
    fn integral(&self, k: usize) -> f64 {
        let h = self.mesh.size(k);
        let rate = |i: usize| (self.w[i + 1] - self.w[i]) / self.mesh.size(i);
        let side = |i: usize| self.mesh.middle(i) > self.h_c;
        let slope = |i: usize| (rate(i) - rate(k)) / (self.mesh.middle(i) - self.mesh.middle(k));
        let neighbours = [k.checked_sub(1), Some(k + 1).filter(|i| *i < self.bed)];
        let slopes: Vec<f64> = neighbours.into_iter().flatten().filter(|i| side(*i) == side(k)).map(slope).collect();
        let curvature = if slopes.is_empty() { 0.0 } else { slopes.iter().sum::<f64>() / slopes.len() as f64 };
        0.5 * h * (self.w[k] + self.w[k + 1]) - curvature * h.powi(3) / 12.0
    }
}
