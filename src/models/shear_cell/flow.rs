//! Grains that collide between two walls, without fluid or gravity: kinetic theory by itself.
//!
//! ```text
//! pressure   p = rho_p F1(phi) T            the same at every height
//! stress     tau = rho_p d F2(phi) T^(1/2) v'   the same at every height
//! heat       q' = tau v' - (rho_p/d) F4(phi) T^(3/2),   q = -rho_p d F3(phi) T^(1/2) T'
//! given      v and T of the grains at both walls, and the mean of phi
//! ```
//!
//! The unknowns are phi at nodes, p and tau: T follows from p and phi. Finite volumes around the nodes, fluxes in the middle
//! between them; Newton's method with exact derivatives, whose two columns and rows of p and tau border a tridiagonal matrix.
//! Second order. Units: d, rho_p, and the square root of the larger granular temperature of the walls.
//! Source: Vescovi, Berzi, Richard & Brodu (2014), Phys. Fluids 26, 053305, for the flow; Chassagne et al. (2023), Table 1,
//! for the theory.

use crate::closures::kinetic::Kinetic;
use crate::models::shear_cell::ShearCell;
use crate::numerics::banded::Banded;
use crate::numerics::dual::{Dual, Real};
use crate::result::SolveError;

/// A step changes the logit of the solid fraction and the logarithm of the pressure by this much at most.
const LONGEST: f64 = 1.0;
/// Change after which no step follows, and most iterations.
const TOLERANCE: f64 = 1e-11;
const MAX_ITERATIONS: usize = 200;

/// The flow between the nodes k and k + 1, or in one node: derivatives by phi below, phi above, p, tau.
type D = Dual<4>;

/// A solved flow, scaled.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// theory
    pub kinetic: Kinetic,
    /// solid fraction at which the grains jam
    pub phi_max: f64,
    /// distance of two nodes
    pub h: f64,
    /// difference of velocity of the grains between the walls
    pub difference: f64,
    /// mean solid fraction
    pub mean: f64,
    /// granular temperature of the walls
    pub walls: [f64; 2],
    /// logit of phi/phi_max at the nodes
    pub logit: Vec<f64>,
    /// logarithm of the pressure
    pub ln_p: f64,
    /// shear stress
    pub tau: f64,
    /// largest change of each iteration
    pub history: Vec<f64>,
}

/// What lies at a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<T> {
    /// solid fraction
    pub(super) phi: T,
    /// its distance to phi_max
    pub(super) gap: T,
    /// granular temperature
    pub(super) t: T,
}

/// What lies between two nodes.
pub(super) struct Between<T> {
    /// flux of fluctuation energy upward
    flux: T,
    /// shear rate
    pub(super) shear: T,
}

impl Flow {
    /// The node of a solid fraction under a pressure.
    fn node<T: Real>(&self, logit: T, ln_p: T) -> Node<T> {
        let y = logit.value();
        let (full, empty) = (1.0 / (1.0 + (-y).exp()), 1.0 / (1.0 + y.exp()));
        let slope = self.phi_max * full * empty;
        let (phi, gap) = (logit.chain(self.phi_max * full, slope), logit.chain(self.phi_max * empty, -slope));
        let t = ln_p.exp() / (phi * self.kinetic.pressure_per_grain(phi, gap));
        Node { phi, gap, t }
    }

    /// What lies between two nodes under the stress `tau`.
    pub(super) fn between<T: Real>(&self, lower: &Node<T>, upper: &Node<T>, tau: T) -> Between<T> {
        let mean = |a: T, b: T| (a + b) * 0.5;
        let root = mean(lower.t, upper.t).sqrt();
        let (phi, gap) = (mean(lower.phi, upper.phi), mean(lower.gap, upper.gap));
        let (viscosity, conductivity) = self.kinetic.transport(phi, gap, root, T::constant(0.0));
        Between { flux: conductivity * root * (lower.t - upper.t) / self.h, shear: tau / (viscosity * root) }
    }

    /// What contacts dissipate per volume.
    fn loss<T: Real>(&self, node: &Node<T>) -> T {
        self.kinetic.dissipation_per_grain(node.phi, node.gap) * node.phi * node.t * node.t.sqrt()
    }

    /// All nodes.
    pub(super) fn states(&self) -> Vec<Node<f64>> {
        self.logit.iter().map(|y| self.node(*y, self.ln_p)).collect()
    }

    /// Newton's method from grains of one solid fraction.
    ///
    /// # Errors
    /// [`NumericalError::NotConverged`](crate::result::NumericalError::NotConverged).
    pub fn solve(mut self) -> Result<Self, SolveError> {
        let mut least = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let Some(change) = self.step() else { break };
            self.history.push(change);
            least = least.min(change);
            if change <= TOLERANCE {
                return Ok(self);
            }
        }
        Err(SolveError::not_converged(least, self.history.len()))
    }

    /// One step of Newton's method; its largest change. `None` where the matrix is singular.
    fn step(&mut self) -> Option<f64> {
        let n = self.logit.len();
        let half = 0.5 * self.h;
        let mut matrix = Banded::zeros(n, 1, 1);
        // Right-hand side, column of ln p, column of tau.
        let mut sides = vec![[0.0; 3]; n];
        // Rows of the two conditions: by the nodes, by ln p and tau, and what they miss.
        let mut rows = [vec![0.0; n], vec![0.0; n]];
        let mut corner = [[0.0; 2]; 2];
        let mut missed = [-self.mean * self.h * (n - 1) as f64, -self.difference];
        let (ln_p, tau) = (D::variable(self.ln_p, 2), D::variable(self.tau, 3));
        let mut add = |row: usize, below: usize, value: D| {
            sides[row][0] -= value.value;
            sides[row][1] += value.slope[2];
            sides[row][2] += value.slope[3];
            for (side, slope) in value.slope.iter().take(2).enumerate() {
                if *slope != 0.0 {
                    matrix.add(row, below + side, *slope);
                }
            }
        };
        for k in 0..n - 1 {
            let lower = self.node(D::variable(self.logit[k], 0), ln_p);
            let upper = self.node(D::variable(self.logit[k + 1], 1), ln_p);
            let Between { flux, shear } = self.between(&lower, &upper, tau);
            let work = tau * shear * half;
            if k == 0 {
                add(0, 0, lower.t.ln() - self.walls[0].ln());
            } else {
                add(k, k, flux - work + self.loss(&lower) * half);
            }
            if k + 2 == n {
                add(n - 1, n - 2, upper.t.ln() - self.walls[1].ln());
            } else {
                add(k + 1, k, self.loss(&upper) * half - flux - work);
            }
            for (i, part) in [(lower.phi + upper.phi) * half, shear * self.h].into_iter().enumerate() {
                missed[i] += part.value;
                rows[i][k] += part.slope[0];
                rows[i][k + 1] += part.slope[1];
                corner[i][0] += part.slope[2];
                corner[i][1] += part.slope[3];
            }
        }
        matrix.factor().ok()?;
        matrix.solve_several(&mut sides);
        // The two conditions by ln p and tau alone.
        let along = |i: usize, side: usize| rows[i].iter().zip(&sides).map(|(a, x)| a * x[side]).sum::<f64>();
        let a = [0, 1].map(|i| [0, 1].map(|j| corner[i][j] - along(i, j + 1)));
        let b = [0, 1].map(|i| -missed[i] - along(i, 0));
        let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
        let by_p = (b[0] * a[1][1] - b[1] * a[0][1]) / determinant;
        let by_tau = (b[1] * a[0][0] - b[0] * a[1][0]) / determinant;
        let scale = self.tau.abs().max(f64::MIN_POSITIVE.sqrt());
        let steps = || sides.iter().map(|x| x[0] - by_p * x[1] - by_tau * x[2]);
        let farthest = steps().fold(by_p.abs(), |most, x| most.max(x.abs()));
        let change = if self.difference == 0.0 { farthest } else { farthest.max((by_tau / scale).abs()) };
        if !change.is_finite() {
            return None;
        }
        // All by one factor: the conditions are linear in the step.
        let factor = (LONGEST / farthest).min(1.0);
        let moved: Vec<f64> = self.logit.iter().zip(steps()).map(|(y, step)| y + factor * step).collect();
        self.logit = moved;
        self.ln_p += factor * by_p;
        self.tau += factor * by_tau;
        Some(change)
    }

    /// Work of the shear stress, fluctuation energy that enters through the walls, and what contacts dissipate, per area.
    pub(super) fn energies(&self) -> [f64; 3] {
        let nodes = self.states();
        let between: Vec<_> = nodes.windows(2).map(|pair| self.between(&pair[0], &pair[1], self.tau)).collect();
        let work = between.iter().map(|b| self.tau * b.shear * self.h).sum();
        let lost = nodes.windows(2).map(|pair| (self.loss(&pair[0]) + self.loss(&pair[1])) * 0.5 * self.h).sum();
        // What the half cells at the walls miss enters through them.
        let missed = |b: &Between<f64>, node: &Node<f64>, sign: f64| {
            sign * b.flux + (self.loss(node) - self.tau * b.shear) * 0.5 * self.h
        };
        let entering = match (between.first(), between.last(), nodes.first(), nodes.last()) {
            (Some(low), Some(high), Some(first), Some(last)) => missed(low, first, 1.0) + missed(high, last, -1.0),
            _ => 0.0,
        };
        [work, entering, lost]
    }
}

/// The flow before it is solved, from grains of one solid fraction, on `cells` intervals.
pub(super) fn guess(cell: &ShearCell, cells: usize) -> Flow {
    let unit = cell.temperature[0].max(cell.temperature[1]);
    let walls = cell.temperature.map(|t| t / unit);
    let h = cell.h / cell.d / cells as f64;
    let difference = (cell.velocity[1] - cell.velocity[0]) / unit.sqrt();
    let y = (cell.phi / (cell.phi_max - cell.phi)).ln();
    let logit = vec![y; cells + 1];
    let (kinetic, phi_max) = (cell.kinetic, cell.phi_max);
    let mut flow = Flow {
        kinetic,
        phi_max,
        h,
        difference,
        mean: cell.phi,
        walls,
        logit,
        ln_p: 0.0,
        tau: 1.0,
        history: Vec::new(),
    };
    // The pressure and the stress of that solid fraction at the mean granular temperature of the walls.
    let t = 0.5 * (walls[0] + walls[1]);
    let node = flow.node(y, 0.0);
    flow.ln_p = (t / node.t).ln();
    let node = Node { t, ..node };
    flow.tau = difference / (h * cells as f64) / flow.between(&node, &node, 1.0).shear;
    flow
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closures::kinetic::{GarzoDufty, Granular};
    use approx::assert_relative_eq;

    fn cell() -> ShearCell {
        let granular = GarzoDufty::default();
        ShearCell {
            rho_p: 2500.0,
            d: 1e-3,
            h: 18e-3,
            phi: 0.45,
            phi_max: 0.635,
            velocity: [0.17, 0.86],
            temperature: [0.004, 0.005],
            granular: Granular::GarzoDufty(granular),
            kinetic: granular.kinetic(0.8, 0.0),
        }
    }

    #[test]
    fn where_collisions_take_what_the_shear_gives_everything_is_uniform() {
        // tau gamma = F4 T^(3/2) with gamma = dv/h: T = gamma^2 F2/F4.
        let base = cell();
        let (phi, gap) = (0.45, 0.185);
        let (f2, _) = base.kinetic.transport(phi, gap, 1.0, 0.0);
        let f4 = phi * base.kinetic.dissipation_per_grain(phi, gap);
        let gamma: f64 = 0.69 / 18.0;
        let t = gamma * gamma * f2 / f4;
        let flow = guess(&ShearCell { temperature: [t, t], ..base }, 40).solve().unwrap();
        for node in flow.states() {
            assert_relative_eq!(node.phi, phi, max_relative = 1e-9);
        }
        // In units of the granular temperature of the walls.
        assert_relative_eq!(flow.tau, f2 * gamma / t.sqrt(), max_relative = 1e-9);
        assert_relative_eq!(flow.ln_p.exp(), phi * base.kinetic.pressure_per_grain(phi, gap), max_relative = 1e-9);
    }

    #[test]
    fn without_shear_and_loss_heat_is_conducted_at_one_rate() {
        let base = cell();
        let elastic = ShearCell {
            velocity: [0.0, 0.0],
            temperature: [0.004, 0.001],
            kinetic: GarzoDufty::default().kinetic(1.0, 0.0),
            ..base
        };
        let flow = guess(&elastic, 80).solve().unwrap();
        let nodes = flow.states();
        let flux: Vec<f64> = nodes.windows(2).map(|pair| flow.between(&pair[0], &pair[1], 0.0).flux).collect();
        assert!(flux[0] > 0.0);
        for q in &flux {
            assert_relative_eq!(*q, flux[0], max_relative = 1e-8);
        }
        // Hot grains are thin.
        assert!(nodes[0].phi < 0.40 && nodes[80].phi > 0.50, "{} {}", nodes[0].phi, nodes[80].phi);
    }

    #[test]
    fn the_order_is_two() {
        let stress = |cells: usize| {
            let flow = guess(&cell(), cells).solve().unwrap();
            (flow.ln_p.exp(), flow.tau)
        };
        let [a, b, c] = [40, 80, 160].map(stress);
        let order = |a: f64, b: f64, c: f64| ((a - b) / (b - c)).abs().log2();
        let (p, tau) = (order(a.0, b.0, c.0), order(a.1, b.1, c.1));
        assert!((p - 2.0).abs() < 0.2 && (tau - 2.0).abs() < 0.2, "{p} {tau}");
    }

    #[test]
    fn what_enters_and_what_is_made_is_lost() {
        let flow = guess(&cell(), 100).solve().unwrap();
        let [work, entering, lost] = flow.energies();
        assert!(work > 0.0 && entering > 0.0);
        assert_relative_eq!(work + entering, lost, max_relative = 1e-10);
        // Cold and dense in the middle, as in a gas that cools by collisions.
        let nodes = flow.states();
        assert!(nodes[50].phi > 0.5 && nodes[0].phi < 0.35 && nodes[50].t < 0.3 * nodes[0].t);
    }
}
