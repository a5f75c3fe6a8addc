//! The two-fluid bed: yield level, packing and the coupled velocities in turn.
//!
//! Coulomb's bed with the exact yield is linear for a given yield level, which is the root of one function. Where the friction
//! rises with the shear rate the grains start from rest without a kink; the yield level is where their shear rate, which falls
//! to 0 in proportion, gets there.

use super::bed::{Bed, CONVERGED, MAX_ITERATIONS, Nodes, Solution};
use super::mesh::Mesh;
use super::packing::{Packing, Relaxation};
use super::{single, two_fluid};
use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::numerics::root::brent;
use crate::result::SolveError;

/// Rounds that place the yield level of grains whose friction rises with the shear rate.
const PASSES: usize = 3;
/// The exact yield for two velocities and a friction that rises with the shear rate: what creeps is below the round-off of
/// what moves.
const ALMOST_EXACT: Regularisation = Regularisation { law: Smoothing::BercovierEngelman, lambda: 1e-13 };

impl Bed {
    pub(super) fn slipping(
        &self,
        nodes: Nodes,
        k: f64,
        regularisation: &Regularisation,
    ) -> Result<Solution, SolveError> {
        let on_yield = Nodes { on_yield: true, ..nodes };
        // Coulomb's bed: excess of the seepage just above the level over the slip of moving grains, their velocity there.
        let rigid = |mesh: &Mesh, h_c: f64| {
            let packing = Packing::of(self, mesh, &[]);
            self.with(mesh, &packing, h_c, |coupled| coupled.rigid(mesh.below(h_c)))
        };
        let moving = |h_c: f64| {
            let mesh = self.mesh(on_yield, h_c);
            rigid(&mesh, h_c).u[mesh.below(h_c)] / (k * self.mu_s * self.phi) - 1.0
        };
        let mut history = Vec::new();
        let mut coulomb = || -> Result<f64, SolveError> {
            let low = 1e-3 * (k * self.e).sqrt().min(self.h_p);
            brent(moving, low, self.h_p, |r| history.push(r.abs())).map_err(|_| self.whole_bed(0.0))
        };
        let moves = moving(self.h_p) > 0.0;
        let mut h_c = if moves && self.rise.is_none() { coulomb()? } else { self.h_p };
        let mut mesh = self.mesh(on_yield, h_c);
        let mut solved = rigid(&mesh, h_c);
        if !nodes.on_yield && !moves {
            mesh = self.mesh(nodes, h_c);
            solved = rigid(&mesh, h_c);
        }
        if regularisation.is_exact() && (!moves || nodes.on_yield && self.rise.is_none()) {
            let packing = Packing::of(self, &mesh, &[]);
            return Ok(self.collect(mesh, packing, h_c, two_fluid::Solved { history, ..solved }));
        }
        let mut gamma = Vec::new();
        if self.rise.is_some() && moves {
            // One velocity is close: the slip is small.
            let one;
            (mesh, _, one) = self.sheared(on_yield, &mut h_c, &mut gamma, None)?;
            solved = self.slip_free(&mesh, &one, &gamma);
            // Where it is not close enough, a smooth friction leads on to a sharp one.
            if self.creeping(&mesh, h_c, &solved, &mut gamma.clone(), &ALMOST_EXACT, 1e-2).is_err() {
                for power in [-2, -4, -6, -8, -10] {
                    let smooth = Regularisation { lambda: 10_f64.powi(power), ..ALMOST_EXACT };
                    (_, solved) = self.creeping(&mesh, h_c, &solved, &mut gamma, &smooth, 1e-2)?;
                }
            }
            for _ in 0..PASSES {
                (_, solved) = self.creeping(&mesh, h_c, &solved, &mut gamma, &ALMOST_EXACT, 1e-5)?;
                h_c = onset(&mesh, &gamma);
                mesh = self.mesh(on_yield, h_c);
            }
        }
        if !nodes.on_yield {
            mesh = self.mesh(nodes, h_c);
            solved = rigid(&mesh, h_c);
            gamma.clear();
            if self.rise.is_some() && moves {
                let (_, _, one) = self.sheared(nodes, &mut h_c.clone(), &mut gamma, None)?;
                solved = self.slip_free(&mesh, &one, &gamma);
            }
        }
        let regularisation = if regularisation.is_exact() { &ALMOST_EXACT } else { regularisation };
        let (packing, solved) = self.creeping(&mesh, h_c, &solved, &mut gamma, regularisation, 1e2 * CONVERGED)?;
        Ok(self.collect(mesh, packing, h_c, solved))
    }

    /// The solution `one` for one velocity as a start for two.
    fn slip_free(&self, mesh: &Mesh, one: &single::Solved, gamma: &[f64]) -> two_fluid::Solved {
        let packing = Packing::of(self, mesh, gamma);
        let (elements, bed) = (self.elements(mesh, &packing), packing.phi.len());
        let tau_p = (0..bed).map(|k| one.t_0 - self.f * mesh.middle(k) - elements[k].e * one.gamma[k]).collect();
        two_fluid::Solved { u: one.u.clone(), w: one.u[..=bed].to_vec(), tau_p, history: Vec::new() }
    }

    /// Two velocities, with the packing that the shear rates `gamma` of the grains leave, up to a change of `converged`.
    fn creeping(
        &self,
        mesh: &Mesh,
        h_c: f64,
        from: &two_fluid::Solved,
        gamma: &mut Vec<f64>,
        regularisation: &Regularisation,
        converged: f64,
    ) -> Result<(Packing, two_fluid::Solved), SolveError> {
        let mut from = from.clone();
        let (mut missed, mut relaxation) = (1.0, Relaxation::default());
        for _ in 0..MAX_ITERATIONS {
            let packing = Packing::of(self, mesh, gamma);
            // No better than the packing is known.
            let tolerance = if self.dilation.is_some() && missed > converged { 1e-3 * missed } else { 0.0 };
            let solved = self
                .with(mesh, &packing, h_c, |coupled| coupled.creeping(&from, regularisation, tolerance))
                .map_err(|e| SolveError::not_converged(e.residual, e.iterations))?;
            let rates: Vec<f64> =
                (0..packing.phi.len()).map(|k| (solved.w[k + 1] - solved.w[k]) / mesh.size(k)).collect();
            missed = Packing::of(self, mesh, &rates).change(&packing);
            if self.dilation.is_none() || tolerance == 0.0 {
                *gamma = rates;
                return Ok((packing, solved));
            }
            relaxation.step(gamma, rates);
            from = solved;
        }
        Err(SolveError::not_converged(missed, MAX_ITERATIONS))
    }

    /// Calls `run` with the coupled problem on `mesh`.
    fn with<T>(&self, mesh: &Mesh, packing: &Packing, h_c: f64, run: impl FnOnce(&two_fluid::Coupled<'_>) -> T) -> T {
        let elements = self.elements(mesh, packing);
        let bed = packing.phi.len();
        let yields: Vec<f64> = packing.pressure.iter().map(|p| self.mu_s * p).collect();
        let rest = self.k.unwrap_or(0.0);
        let permeability = |phi: &f64| self.dilation.and_then(|dilation| dilation.permeability(*phi)).unwrap_or(rest);
        let k: Vec<f64> = packing.phi.iter().map(permeability).collect();
        let fitted = (0..bed).take_while(|&i| mesh.nodes()[i + 1] <= h_c * (1.0 + 1e-12)).count();
        let seepages = two_fluid::Coupled::seepages(mesh, &elements, &k, fitted);
        let f = self.f;
        run(&two_fluid::Coupled { mesh, elements: &elements, bed, f, seepages: &seepages, k: &k, yields: &yields })
    }

    fn collect(&self, mesh: Mesh, packing: Packing, h_c: f64, solved: two_fluid::Solved) -> Solution {
        let (tau_f, slip) = self.with(&mesh, &packing, h_c, |coupled| {
            (coupled.fluid_stress(&solved.u, &solved.w), coupled.slip_integral(&solved.u, &solved.w))
        });
        Solution {
            bed: packing.phi.len(),
            packing,
            h_c,
            tau_f,
            u: solved.u,
            w: solved.w,
            tau_p: solved.tau_p,
            slip,
            history: solved.history,
            mesh,
        }
    }
}

/// Yield level of grains whose friction rises with the shear rate: the shear rates `gamma` fall to 0 there, in proportion.
fn onset(mesh: &Mesh, gamma: &[f64]) -> f64 {
    let moving = |rate: &f64| *rate > 1e3 * ALMOST_EXACT.lambda;
    let first = gamma.iter().position(moving).unwrap_or(gamma.len());
    let (Some(&low), Some(&high)) = (gamma.get(first + 1), gamma.get(first + 2)) else {
        return mesh.nodes()[gamma.len().min(first)];
    };
    let (a, b) = (mesh.middle(first + 1), mesh.middle(first + 2));
    (a - low * (b - a) / (high - low)).clamp(mesh.nodes()[first.saturating_sub(1)], a)
}
