//! A Coulomb or mu(I_v) bed under a viscous fluid: mesh, pressure, yield level, and the solver that the form asks for.

use super::element::{Element, Rise};
use super::mesh::{Layer, Mesh};
use super::{single, two_fluid};
use crate::closures::friction::MuIv;
use crate::continuum::exact::ouriemi::Scaled;
use crate::numerics::root::brent;
use crate::problem::Regularisation;
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
}

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
        let hold = self.mu_s * self.phi;
        let k = if self.rise.is_some() { Some(0.0) } else { self.k };
        Scaled { f: self.f, hold, e: self.e, h_p: self.h_p, k }.largest_drive()
    }

    /// Particle pressure at `z`.
    #[must_use]
    pub fn pressure(&self, z: f64) -> f64 {
        self.phi * (self.h_p - z).max(0.0)
    }

    /// The mesh for the yield level `h_c`.
    fn mesh(&self, nodes: Nodes, h_c: f64) -> Mesh {
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

    fn elements(&self, mesh: &Mesh) -> Vec<Element> {
        let rise = |p: f64| self.rise.map(|law| Rise { p, law });
        let element = |k: usize| {
            let z = mesh.middle(k);
            if z < self.h_p {
                let p = self.pressure(z);
                Element { e: self.e, y: self.mu_s * p, rise: rise(p) }
            } else {
                Element { e: 1.0, y: 0.0, rise: None }
            }
        };
        (0..mesh.elements()).map(element).collect()
    }

    /// Solves the bed with the given regularisation.
    ///
    /// # Errors
    /// [`SolveError::NoStaticBed`] and [`SolveError::WholeBedMoves`] where the grains yield down to the lower wall,
    /// [`SolveError::NotConverged`] if round-off is not reached.
    pub fn solve(&self, nodes: Nodes, regularisation: &Regularisation) -> Result<Solution, SolveError> {
        let hold = self.mu_s * self.phi;
        if self.f >= hold {
            return Err(SolveError::NoStaticBed { drive: self.f, limit: hold });
        }
        match self.k {
            None => self.mixed(nodes, regularisation),
            Some(k) => self.slipping(nodes, k, regularisation),
        }
    }

    /// Where the stress `t_0 - f z` crosses the yield stress.
    fn crossing(&self, t_0: f64) -> f64 {
        let hold = self.mu_s * self.phi;
        (hold * self.h_p - t_0) / (hold - self.f)
    }

    fn mixed(&self, nodes: Nodes, regularisation: &Regularisation) -> Result<Solution, SolveError> {
        let mut h_c = 0.75 * self.h_p;
        // With a node on the yield level the stress is exact, so the level converges as fast as its own error squared.
        let mut solved = None;
        for _ in 0..if nodes.on_yield { 60 } else { 1 } {
            let mesh = self.mesh(nodes, h_c);
            let rigid =
                single::solve(&mesh, &self.elements(&mesh), self.f, &Regularisation::EXACT).map_err(not_converged)?;
            let level = self.crossing(rigid.t_0);
            if level <= 0.0 {
                return Err(self.whole_bed(level));
            }
            let moved = (level - h_c).abs();
            h_c = level.min(self.h_p);
            solved = Some((mesh, rigid));
            if moved <= 4.0 * f64::EPSILON {
                break;
            }
        }
        let Some((mesh, mut solved)) = solved else { return Err(self.whole_bed(0.0)) };
        let elements = self.elements(&mesh);
        if !regularisation.is_exact() {
            solved = single::solve(&mesh, &elements, self.f, regularisation).map_err(not_converged)?;
        }
        let bed = mesh.below(self.h_p);
        let total = |k: usize| solved.t_0 - self.f * mesh.middle(k);
        let tau_f: Vec<f64> = elements.iter().zip(&solved.gamma).map(|(element, gamma)| element.e * gamma).collect();
        let tau_p = (0..bed).map(|k| total(k) - tau_f[k]).collect();
        Ok(Solution {
            bed,
            h_c,
            w: solved.u[..=bed].to_vec(),
            tau_f,
            tau_p,
            slip: 0.0,
            u: solved.u,
            mesh,
            history: solved.history,
        })
    }

    fn slipping(&self, nodes: Nodes, k: f64, regularisation: &Regularisation) -> Result<Solution, SolveError> {
        let on_yield = Nodes { on_yield: true, ..nodes };
        // Excess of the seepage just above the level over the slip of moving grains: their velocity there.
        let moving = |h_c: f64| {
            let mesh = self.mesh(on_yield, h_c);
            self.with(&mesh, h_c, k, |coupled| {
                let still = mesh.below(h_c);
                coupled.rigid(still).u[still] / (k * self.mu_s * self.phi) - 1.0
            })
        };
        let mut history = Vec::new();
        let h_c = if moving(self.h_p) <= 0.0 {
            self.h_p
        } else {
            let low = 1e-3 * (k * self.e).sqrt().min(self.h_p);
            brent(moving, low, self.h_p, |r| history.push(r.abs())).map_err(|_| self.whole_bed(0.0))?
        };
        let mesh = self.mesh(on_yield, h_c);
        let still = mesh.below(h_c);
        let start = self.with(&mesh, h_c, k, |coupled| coupled.rigid(still));
        if regularisation.is_exact() && self.rise.is_none() {
            let solved = two_fluid::Solved { history, ..start };
            return Ok(self.collect(mesh, h_c, k, solved));
        }
        let mesh = if nodes.on_yield { mesh } else { self.mesh(nodes, h_c) };
        let start = self.with(&mesh, h_c, k, |coupled| coupled.rigid(mesh.below(h_c)));
        let solved = self.with(&mesh, h_c, k, |coupled| coupled.creeping(&start, regularisation));
        let solved = solved.map_err(|e| SolveError::NotConverged { residual: e.residual, iterations: e.iterations })?;
        Ok(self.collect(mesh, h_c, k, solved))
    }

    /// Calls `run` with the coupled problem on `mesh`.
    fn with<T>(&self, mesh: &Mesh, h_c: f64, k: f64, run: impl FnOnce(&two_fluid::Coupled<'_>) -> T) -> T {
        let elements = self.elements(mesh);
        let bed = mesh.below(self.h_p);
        let yields: Vec<f64> = mesh.nodes()[..=bed].iter().map(|&z| self.mu_s * self.pressure(z)).collect();
        let k = vec![k; bed];
        let fitted = (0..bed).take_while(|&i| mesh.nodes()[i + 1] <= h_c * (1.0 + 1e-12)).count();
        run(&two_fluid::Coupled { mesh, elements: &elements, bed, f: self.f, fitted, k: &k, yields: &yields })
    }

    fn collect(&self, mesh: Mesh, h_c: f64, k: f64, solved: two_fluid::Solved) -> Solution {
        let (tau_f, slip) = self.with(&mesh, h_c, k, |coupled| {
            (coupled.fluid_stress(&solved.u, &solved.w), coupled.slip_integral(&solved.u, &solved.w))
        });
        let bed = mesh.below(self.h_p);
        Solution { bed, h_c, tau_f, u: solved.u, w: solved.w, tau_p: solved.tau_p, slip, history: solved.history, mesh }
    }

    fn whole_bed(&self, level: f64) -> SolveError {
        SolveError::WholeBedMoves {
            mobile_depth_m: self.h_p - level.min(0.0),
            bed_m: self.h_p,
            limit_pa_m: self.largest_drive(),
        }
    }
}

fn not_converged(error: single::NotConverged) -> SolveError {
    SolveError::NotConverged { residual: error.residual, iterations: error.iterations }
}

impl Solution {
    /// Fluid stress at the bed level, from above.
    #[must_use]
    pub fn tau_interface(&self, f: f64) -> f64 {
        let z = self.mesh.nodes()[self.bed];
        self.tau_f[self.bed] + f * (self.mesh.middle(self.bed) - z)
    }

    /// Solid flux per phi: integral of the grain velocity over the bed. Exact where the shear rate is linear on each side of
    /// the yield level: the trapezoidal rule with the change of the shear rate along the element.
    #[must_use]
    pub fn flux(&self) -> f64 {
        (0..self.bed).map(|k| self.integral(k)).sum()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Smoothing;
    use approx::assert_relative_eq;

    fn bed(k: Option<f64>) -> Bed {
        Bed { f: 0.1, h_p: 0.5, phi: 0.55, mu_s: 0.43, rise: None, e: 2.375, k }
    }

    const K: f64 = 1.8595e-6;

    fn exact(bed: &Bed) -> crate::continuum::exact::ouriemi::Solution {
        Scaled { f: bed.f, hold: bed.mu_s * bed.phi, e: bed.e, h_p: bed.h_p, k: bed.k }.solve(|_| {}).unwrap()
    }

    fn error(bed: &Bed, solution: &Solution) -> f64 {
        let exact = exact(bed);
        let norm = |f: &dyn Fn(usize) -> f64| (0..solution.u.len()).map(|j| f(j).powi(2)).sum::<f64>().sqrt();
        let z = solution.mesh.nodes();
        norm(&|j| solution.u[j] - exact.mixture(z[j])) / norm(&|j| exact.mixture(z[j]))
    }

    #[test]
    fn exact_yield_is_the_closed_form() {
        for k in [None, Some(K)] {
            let bed = bed(k);
            let solution = bed.solve(Nodes { elements: 200, on_yield: true }, &Regularisation::EXACT).unwrap();
            println!(
                "{k:?} error {:e} h_c {:e} history {:?}",
                error(&bed, &solution),
                solution.h_c - exact(&bed).h_c,
                solution.history.len()
            );
            assert_relative_eq!(solution.h_c, exact(&bed).h_c, max_relative = 1e-13);
            assert!(error(&bed, &solution) < 1e-12);
        }
    }

    #[test]
    fn regularised_table() {
        for k in [None, Some(K)] {
            let bed = bed(k);
            for law in [Smoothing::Simple, Smoothing::BercovierEngelman, Smoothing::Papanastasiou] {
                for p in 1..=12 {
                    let r = Regularisation { law, lambda: 10f64.powi(-p) };
                    match bed.solve(Nodes { elements: 400, on_yield: true }, &r) {
                        Ok(s) => println!(
                            "{} {law:?} 1e-{p}: error {:.3e} flux {:.3e} its {} res {:.1e}",
                            k.is_some(),
                            error(&bed, &s),
                            s.flux() / exact(&bed).flux() - 1.0,
                            s.history.len(),
                            s.history.last().unwrap()
                        ),
                        Err(e) => println!("{} {law:?} 1e-{p}: {e}", k.is_some()),
                    }
                }
            }
        }
    }
}
