//! The whole three-dimensional duct, to prove that its cross-section is enough: one velocity, three components and a pressure.
//!
//! The element of Chauchat & Medale (2010), section 2.4: 27 nodes for the velocity, a linear pressure that jumps from element
//! to element, on the elements of the section drawn out along x over one height H and repeated there. Units of [`super::duct`].
//!
//! ```text
//! minimise   integral e/2 |g|^2 + y |g| - f u + phi w,   div (u, v, w) = 0,   g = grad + its transpose, |g|^2 = tr(g^2)/2
//! on walls   u = v = w = 0,   on the plane of symmetry v = 0
//! ```
//!
//! The weight of the grains `phi w` acts downwards, so that the pressure has to find the one from which the yield stress is
//! taken. It is eliminated in each element: with the penalty `r` the matrix stays symmetric positive definite,
//!
//! ```text
//! (K + r D D) x = b + D p,   p <- p - r D x   after each step of Newton's method
//! ```
//!
//! with `D x` the divergence projected on the four pressures of an element, made orthonormal (method of multipliers: Fortin &
//! Glowinski 1983, Augmented Lagrangian Methods, chapter II).

use std::ops::ControlFlow;

use nalgebra::{Cholesky as Dense, SMatrix, SVector};

use super::duct::Divided;
use super::element::{self, GAUSS, points, quadratic};
use super::newton::{self, Solved, Unsolved};
use super::program::{Block, FIXED, Point, Program};
use crate::closures::regularisation::Regularisation;
use crate::numerics::sparse::Pattern;

/// Nodes of an element, and its unknowns.
const NODES: usize = 27;
const KNOWN: usize = 3 * NODES;
/// Components of the strain, each as often in the sum of squares as in tr(g^2)/2.
const PARTS: usize = 6;
/// Pressures of an element.
const PRESSURES: usize = 4;
/// Penalty over the viscosity of the fluid.
const PENALTY: f64 = 1e6;
/// Relative change of the velocity that counts as none: the penalty times round-off, and some more.
const CONVERGED: f64 = 1e-9;

/// The whole duct on its elements.
#[derive(Clone, Debug)]
pub struct Full<'a> {
    section: &'a Divided,
    /// weight of the grains in the bed
    weight: f64,
    /// elements along the flow
    along: usize,
    /// unknown of each component at each node: nodes of the section, in each of them planes along x
    at: Vec<u32>,
    /// the minimum, with the penalty
    pub program: Program<PARTS, KNOWN>,
    /// what the pressures of the elements of the section see, the same all along x
    pressures: Vec<Pressures>,
}

/// Orthonormal pressures of an element.
#[derive(Clone, Debug)]
struct Pressures {
    /// integral of each with the divergence of the velocity of each unknown
    divergence: [[f64; KNOWN]; PRESSURES],
    /// middle of the element along y and z
    middle: (f64, f64),
    /// values of the four from 1, x, y, z about the middle
    from_linear: SMatrix<f64, PRESSURES, PRESSURES>,
}

/// A solved duct.
#[derive(Clone, Debug)]
pub struct Whole {
    /// unknowns, strains, stresses as the section has them: means along x
    pub section: Solved<2>,
    /// largest difference of the velocity along x between two planes across the flow, over the largest velocity
    pub uneven: f64,
    /// largest velocity across the flow, over the largest along it
    pub across: f64,
    /// largest deviation of the pressure from the weight of the grains above, but for a constant, over the largest
    pub pressure: f64,
}

impl<'a> Full<'a> {
    /// Draws the elements of a section out along x, `along` of them over one height; `weight` is that of the grains in the bed.
    #[must_use]
    pub fn new(section: &'a Divided, along: usize, weight: f64) -> Self {
        let mesh = &section.mesh;
        let planes = 2 * along;
        let (across, _) = mesh.lines();
        let mut at = vec![FIXED; mesh.nodes() * planes * 3];
        let mut n = 0;
        // All planes of a node of the section at once: the dissection of the section serves the whole.
        for node in mesh.dissection().into_iter().filter(|node| !mesh.on_wall(*node)) {
            for plane in 0..planes {
                for part in 0..3 {
                    if part != 1 || node % across != 0 {
                        at[(node * planes + plane) * 3 + part] = n;
                        n += 1;
                    }
                }
            }
        }
        let known = |element: usize, slice: usize| -> [u32; KNOWN] {
            let nodes = mesh.element(element);
            std::array::from_fn(|k| {
                let (part, node) = (k / NODES, k % NODES);
                let plane = (2 * slice + node / 9) % planes;
                at[(nodes[node % 9] * planes + plane) * 3 + part]
            })
        };
        let all: Vec<[u32; KNOWN]> = (0..mesh.elements())
            .flat_map(|element| (0..along).map(move |slice| (element, slice)))
            .map(|(e, s)| known(e, s))
            .collect();
        let pattern = Pattern::of_blocks(n as usize, all.iter().map(<[u32; KNOWN]>::as_slice));
        let mut program = Program {
            base: vec![0.0; pattern.entries()],
            load: vec![0.0; n as usize],
            blocks: Vec::new(),
            per_block: NODES,
            points: Vec::new(),
            order: Some((0..n).collect()),
            pattern,
        };
        let mut pressures = Vec::new();
        for element in 0..mesh.elements() {
            let one = Assembled::new(section, element, along, weight);
            for known in &all[element * along..(element + 1) * along] {
                let block = Block::new(*known, &program.pattern);
                block.add(&one.local, &mut program.base);
                block.scatter(&one.load, &mut program.load);
                if !one.yielding.is_empty() {
                    program.blocks.push(block);
                    program.points.extend(&one.yielding);
                }
            }
            pressures.push(one.pressures);
        }
        Self { section, weight, along, at, program, pressures }
    }

    /// Solves; `see` receives the relative change of each iteration.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn solve(&self, law: &Regularisation, see: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Whole, Unsolved> {
        let mut pressure = vec![[0.0; PRESSURES]; self.section.mesh.elements() * self.along];
        let mut correct = |x: &[f64], load: &mut [f64]| {
            for (k, p) in pressure.iter_mut().enumerate() {
                let known = self.known(k);
                for (row, p) in self.pressures[k / self.along].divergence.iter().zip(p) {
                    let here = row.iter().zip(&known).filter(|(_, u)| **u != FIXED);
                    let flux: f64 = here.clone().map(|(d, u)| d * x[*u as usize]).sum();
                    *p -= PENALTY * flux;
                    here.for_each(|(d, u)| load[*u as usize] -= PENALTY * flux * d);
                }
            }
        };
        let solved = newton::solve_corrected(&self.program, law, CONVERGED, &mut correct, see)?;
        Ok(self.whole(&solved, &pressure))
    }

    /// Unknowns of block `k`: elements of the section, in each of them slices along x.
    fn known(&self, k: usize) -> [u32; KNOWN] {
        let planes = 2 * self.along;
        let nodes = self.section.mesh.element(k / self.along);
        std::array::from_fn(|i| {
            let plane = (2 * (k % self.along) + (i % NODES) / 9) % planes;
            self.at[(nodes[i % 9] * planes + plane) * 3 + i / NODES]
        })
    }

    fn whole(&self, solved: &Solved<PARTS>, pressure: &[[f64; PRESSURES]]) -> Whole {
        let planes = 2 * self.along;
        let value = |node: usize, plane: usize, part: usize| {
            let unknown = self.at[(node * planes + plane) * 3 + part];
            if unknown == FIXED { 0.0 } else { solved.x[unknown as usize] }
        };
        let (mut largest, mut uneven, mut across) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut x = vec![0.0; self.section.program.size()];
        for node in 0..self.section.mesh.nodes() {
            let mean = (0..planes).map(|plane| value(node, plane, 0)).sum::<f64>() / planes as f64;
            for plane in 0..planes {
                uneven = uneven.max((value(node, plane, 0) - mean).abs());
                across = across.max(value(node, plane, 1).hypot(value(node, plane, 2)));
            }
            largest = largest.max(mean.abs());
            let unknown = self.section.u_at[node];
            if unknown != FIXED {
                x[unknown as usize] = mean;
            }
        }
        // The shears along the flow of the points of one slice, mean over the three planes of points and over the slices.
        let share = 1.0 / (3 * self.along) as f64;
        let mean = |of: &[[f64; PARTS]]| -> Vec<[f64; 2]> {
            of.chunks(NODES * self.along)
                .flat_map(|blocks| {
                    (0..9).map(move |p| {
                        let same = blocks.iter().skip(p).step_by(9);
                        same.fold([0.0; 2], |sum, s| [sum[0] + share * s[3], sum[1] + share * s[4]])
                    })
                })
                .collect()
        };
        Whole {
            section: Solved {
                x,
                g: mean(&solved.g),
                q: mean(&solved.q),
                history: solved.history.clone(),
                gap: solved.gap,
                imbalance: solved.imbalance,
                lambda: solved.lambda,
            },
            uneven: uneven / largest,
            across: across / largest,
            pressure: self.pressure(pressure),
        }
    }

    /// Largest deviation of the pressure from the weight of the grains above, but for a constant, over the largest weight.
    fn pressure(&self, pressure: &[[f64; PRESSURES]]) -> f64 {
        let Some(level) = self.section.duct.bed() else { return 0.0 };
        let length = 1.0 / self.along as f64;
        let mesh = &self.section.mesh;
        let mut deviations = Vec::new();
        for (k, p) in pressure.iter().enumerate() {
            let Pressures { middle, from_linear, .. } = &self.pressures[k / self.along];
            for point in points(mesh, k / self.along) {
                let y: f64 = point
                    .shape
                    .iter()
                    .zip(mesh.element(k / self.along))
                    .map(|(n, node)| n * mesh.position(node).0)
                    .sum();
                for (x, _) in GAUSS {
                    let linear = SVector::from([1.0, 0.5 * length * x, y - middle.0, point.z - middle.1]);
                    let found = (from_linear * linear).dot(&SVector::from(*p));
                    deviations.push(found - self.weight * (level - point.z).max(0.0));
                }
            }
        }
        let mean = deviations.iter().sum::<f64>() / deviations.len() as f64;
        deviations.iter().fold(0.0_f64, |m, d| m.max((d - mean).abs())) / (self.weight * level)
    }
}

/// One element of the section drawn out over one slice.
struct Assembled {
    local: [[f64; KNOWN]; KNOWN],
    load: [f64; KNOWN],
    yielding: Vec<Point<PARTS, KNOWN>>,
    pressures: Pressures,
}

impl Assembled {
    fn new(section: &Divided, element: usize, along: usize, bed_weight: f64) -> Self {
        let (mesh, duct) = (&section.mesh, &section.duct);
        let length = 1.0 / along as f64;
        let in_bed = element / mesh.columns < mesh.bed_rows;
        let nodes = mesh.element(element).map(|node| mesh.position(node));
        // Node 4 is the middle one.
        let middle = nodes[4];
        let mut one = Self {
            local: [[0.0; KNOWN]; KNOWN],
            load: [0.0; KNOWN],
            yielding: Vec::new(),
            pressures: Pressures { divergence: [[0.0; KNOWN]; PRESSURES], middle, from_linear: SMatrix::identity() },
        };
        let mut products = SMatrix::<f64, PRESSURES, PRESSURES>::zeros();
        let mut divergence = SMatrix::<f64, PRESSURES, KNOWN>::zeros();
        for (x, share) in GAUSS {
            for point in points(mesh, element) {
                let (e, y, _) = duct.material(point.z, in_bed);
                let weight = point.weight * share * 0.5 * length;
                let (shape, gradient) = drawn(&point, x, length);
                let strain = strains(&gradient);
                for row in &strain {
                    for i in 0..KNOWN {
                        for j in 0..=i {
                            one.local[i][j] += weight * e * row[i] * row[j];
                        }
                    }
                }
                let sinks = if in_bed { bed_weight } else { 0.0 };
                for (k, shape) in shape.iter().enumerate() {
                    one.load[k] += weight * duct.f * shape;
                    one.load[2 * NODES + k] -= weight * sinks * shape;
                }
                let across: f64 = point.shape.iter().zip(&nodes).map(|(n, node)| n * node.0).sum();
                let linear = SVector::from([1.0, 0.5 * length * x, across - middle.0, point.z - middle.1]);
                products += weight * linear * linear.transpose();
                for k in 0..KNOWN {
                    let mut column = divergence.column_mut(k);
                    column += weight * gradient[k / NODES][k % NODES] * linear;
                }
                if y > 0.0 {
                    one.yielding.push(Point { strain, offset: [0.0; PARTS], weight, carried: weight * y });
                }
            }
        }
        // Products of independent functions are positive definite.
        if let Some(root) = Dense::new(products).and_then(|root| root.l().try_inverse()) {
            one.pressures.from_linear = root;
        }
        let orthonormal = one.pressures.from_linear * divergence;
        for (m, row) in one.pressures.divergence.iter_mut().enumerate() {
            *row = std::array::from_fn(|k| orthonormal[(m, k)]);
            for i in 0..KNOWN {
                for j in 0..=i {
                    one.local[i][j] += PENALTY * row[i] * row[j];
                }
            }
        }
        one
    }
}

/// Values and derivatives along x, y, z of the 27 functions at a point of the section and at `x` in -1..1 of a slice.
fn drawn(point: &element::Point, x: f64, length: f64) -> ([f64; NODES], [[f64; NODES]; 3]) {
    let (n, d) = quadratic(x);
    let product = |along: &[f64; 3], scale: f64, section: &[f64; 9]| -> [f64; NODES] {
        std::array::from_fn(|k| scale * along[k / 9] * section[k % 9])
    };
    let gradient = [
        product(&d, 2.0 / length, &point.shape),
        product(&n, 1.0, &point.gradient[0]),
        product(&n, 1.0, &point.gradient[1]),
    ];
    (product(&n, 1.0, &point.shape), gradient)
}

/// The strain of each unknown: three stretches times the root of 2, then xy, xz, yz.
fn strains(gradient: &[[f64; NODES]; 3]) -> [[f64; KNOWN]; PARTS] {
    let mut strain = [[0.0; KNOWN]; PARTS];
    let [along, across, up] = gradient;
    for (k, ((x, y), z)) in along.iter().zip(across).zip(up).enumerate() {
        let (x, y, z) = (*x, *y, *z);
        let [u, v, w] = [k, NODES + k, 2 * NODES + k];
        let root = std::f64::consts::SQRT_2;
        (strain[0][u], strain[1][v], strain[2][w]) = (root * x, root * y, root * z);
        (strain[3][u], strain[3][v]) = (y, x);
        (strain[4][u], strain[4][w]) = (z, x);
        (strain[5][v], strain[5][w]) = (z, y);
    }
    strain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::section::Outline;
    use crate::models::section::duct::{Duct, Filling};

    #[test]
    fn a_linear_velocity_has_its_strain_and_its_divergence_in_an_element_of_a_circle() {
        let duct = Duct { shape: Outline::Circle, filling: Filling::Bingham(0.1), f: 1.0 };
        let divided = duct.divide(3, 8, 1.0, None);
        let element = 13;
        let nodes = divided.mesh.element(element).map(|node| divided.mesh.position(node));
        let slopes = [[0.3, -1.1, 0.7], [0.2, 0.5, -0.4], [1.3, 0.9, -0.6]];
        let length = 1.0 / 4.0;
        let field: [f64; KNOWN] = std::array::from_fn(|k| {
            let (y, z) = nodes[k % 9];
            let x = 0.5 * length * ((k % NODES / 9) as f64 - 1.0);
            let slope = slopes[k / NODES];
            slope[0] * x + slope[1] * y + slope[2] * z
        });
        let one = Assembled::new(&divided, element, 4, 0.0);
        let half: f64 = (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| (slopes[i][j] + slopes[j][i]).powi(2) / 2.0)
            .sum();
        let mut volume = 0.0;
        for point in &one.yielding {
            let g = point.strain.map(|row| row.iter().zip(&field).map(|(b, u)| b * u).sum::<f64>());
            assert!((g.iter().map(|g| g * g).sum::<f64>() - half).abs() < 1e-12 * half);
            volume += point.weight;
        }
        // The first pressure is a constant, the others have no mean: orthonormal.
        let flux = one.pressures.divergence.map(|row| row.iter().zip(&field).map(|(d, u)| d * u).sum::<f64>());
        let trace = slopes[0][0] + slopes[1][1] + slopes[2][2];
        assert!((flux[0] - trace * volume.sqrt()).abs() < 1e-13, "{flux:?}");
        assert!(flux[1..].iter().all(|f| f.abs() < 1e-13), "{flux:?}");
    }
}
