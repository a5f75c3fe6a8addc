//! Developed flow along a duct, in half of its cross-section: the streamwise velocity as a convex minimum.
//!
//! Units: height H, stress S and velocity S H/eta; `f` the drive over S/H, `e` the viscosity of a place over that of the fluid,
//! `y` its yield stress. One velocity, a Bingham fluid or fluid and grains of the mixed form:
//!
//! ```text
//! minimise   integral e/2 |grad u|^2 + y |grad u| - f u,   u = 0 on the wall
//! ```
//!
//! Two velocities, the mixture `u` and the grains `w` in the bed, with the permeability `k`:
//!
//! ```text
//! minimise   integral e/2 |grad u|^2 - f u  +  integral over the bed (u - w)^2/(2 k) + y |grad w|
//! ```
//!
//! In the bed `y = resistance (h_p - z)`, the friction under the weight of the grains above. Source: Chauchat & Medale (2010),
//! Comput. Methods Appl. Mech. Engrg. 199, 439-449, eq. (12)-(13), developed and along x.

use super::element::{self, points};
use super::mesh::{Division, Mesh};
use super::program::{Block, FIXED, Point, Program};
use crate::models::section::Outline;
use crate::numerics::sparse::Pattern;

/// What fills the duct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filling {
    /// one material with this yield stress; 0: a Newtonian fluid
    Bingham(f64),
    /// a fluid over a bed of grains
    Bed {
        /// bed level
        level: f64,
        /// relative viscosity of the bed
        e: f64,
        /// mu_s phi: yield stress per depth below the bed level
        resistance: f64,
        /// permeability; `None`: one velocity
        k: Option<f64>,
    },
}

/// A duct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duct {
    /// outline
    pub shape: Outline,
    /// what fills it
    pub filling: Filling,
    /// drive
    pub f: f64,
}

/// A duct divided into elements, ready to be solved.
#[derive(Clone, Debug)]
pub struct Divided {
    /// the duct
    pub duct: Duct,
    /// nodes and elements
    pub mesh: Mesh,
    /// unknown of the velocity at each node
    pub u_at: Vec<u32>,
    /// unknown of the velocity of the grains, where they have their own
    pub w_at: Vec<u32>,
    /// the minimum
    pub program: Program<2, 9>,
}

impl Duct {
    /// Bed level.
    #[must_use]
    pub fn bed(&self) -> Option<f64> {
        match self.filling {
            Filling::Bingham(_) => None,
            Filling::Bed { level, .. } => Some(level),
        }
    }

    /// Relative viscosity, yield stress and permeability at height `z`, in the bed or above.
    pub(super) fn material(&self, z: f64, in_bed: bool) -> (f64, f64, Option<f64>) {
        match self.filling {
            Filling::Bingham(y) => (1.0, y, None),
            Filling::Bed { level, e, resistance, k } if in_bed => (e, resistance * (level - z), k),
            Filling::Bed { .. } => (1.0, 0.0, None),
        }
    }

    /// Divides the duct into elements, `columns` of them across its half and `rows` from the bottom to the top.
    #[must_use]
    pub fn divide(&self, columns: usize, rows: usize, finest: f64, line: Option<&[f64]>) -> Divided {
        // Below the yield surface the fluid that seeps comes to rest over the length of Brinkman, and the velocity of the grains
        // has a kink on it.
        let layer = match self.filling {
            Filling::Bed { k: Some(k), e, .. } => (12.0 / rows as f64 * (k * e).sqrt(), 0.1),
            _ => (f64::INFINITY, 1.0),
        };
        let mesh = Mesh::new(self.shape, &Division { columns, rows, bed: self.bed(), line, layer, finest });
        let slips = matches!(self.filling, Filling::Bed { k: Some(_), .. });
        let grains = |node: usize| slips && node / (2 * columns + 1) <= 2 * mesh.bed_rows;
        let (mut u_at, mut w_at) = (vec![FIXED; mesh.nodes()], vec![FIXED; mesh.nodes()]);
        // Unknowns are numbered in the order of their elimination, which is also the order in which memory is walked.
        let mut n = 0;
        for node in mesh.dissection().into_iter().filter(|node| !mesh.on_wall(*node)) {
            u_at[node] = n;
            n += 1;
            if grains(node) {
                w_at[node] = n;
                n += 1;
            }
        }
        let bed_elements = mesh.bed_rows * columns;
        let unknowns = |element: usize| -> [u32; 18] {
            let nodes = mesh.element(element);
            let inside = slips && element < bed_elements;
            std::array::from_fn(|k| match k {
                0..9 => u_at[nodes[k]],
                _ if inside => w_at[nodes[k - 9]],
                _ => FIXED,
            })
        };
        let all: Vec<[u32; 18]> = (0..mesh.elements()).map(unknowns).collect();
        let pattern = Pattern::of_blocks(n as usize, all.iter().map(<[u32; 18]>::as_slice));
        let mut program = Program {
            base: vec![0.0; pattern.entries()],
            load: vec![0.0; n as usize],
            blocks: Vec::new(),
            per_block: 9,
            points: Vec::new(),
            order: Some((0..n).collect()),
            pattern,
        };
        for (element, unknowns) in all.iter().enumerate() {
            self.assemble(&mesh, element, unknowns, &mut program);
        }
        Divided { duct: *self, mesh, u_at, w_at, program }
    }

    fn assemble(&self, mesh: &Mesh, element: usize, unknowns: &[u32; 18], program: &mut Program<2, 9>) {
        let in_bed = element / mesh.columns < mesh.bed_rows;
        let (mut local, mut load) = ([[0.0; 18]; 18], [0.0; 18]);
        let mut yielding = Vec::new();
        let mut slips = false;
        for point in points(mesh, element) {
            let element::Point { weight, z, shape, gradient } = point;
            let (e, y, k) = self.material(z, in_bed);
            for i in 0..9 {
                load[i] += weight * self.f * shape[i];
                for j in 0..9 {
                    let stiff = gradient[0][i] * gradient[0][j] + gradient[1][i] * gradient[1][j];
                    local[i][j] += weight * e * stiff;
                    if let Some(k) = k {
                        let drag = weight * shape[i] * shape[j] / k;
                        local[i][j] += drag;
                        local[9 + i][9 + j] += drag;
                        local[9 + i][j] -= drag;
                        local[i][9 + j] -= drag;
                    }
                }
            }
            slips |= k.is_some();
            if y > 0.0 {
                yielding.push(Point { strain: gradient, offset: [0.0; 2], weight, carried: weight * y });
            }
        }
        let whole = Block::new(*unknowns, &program.pattern);
        whole.add(&local, &mut program.base);
        whole.scatter(&load, &mut program.load);
        if yielding.len() == 9 {
            let from = if slips { 9 } else { 0 };
            let block = std::array::from_fn(|k| unknowns[from + k]);
            program.blocks.push(Block::new(block, &program.pattern));
            program.points.extend(yielding);
        }
    }
}

impl Divided {
    /// Velocity at the nodes, 0 on the wall.
    #[must_use]
    pub fn velocity(&self, x: &[f64]) -> Vec<f64> {
        self.u_at.iter().map(|u| if *u == FIXED { 0.0 } else { x[*u as usize] }).collect()
    }

    /// Velocity of the grains at the nodes: their own, or that of the mixture.
    #[must_use]
    pub fn grains(&self, x: &[f64]) -> Vec<f64> {
        if matches!(self.duct.filling, Filling::Bed { k: Some(_), .. }) {
            return self.w_at.iter().map(|w| if *w == FIXED { 0.0 } else { x[*w as usize] }).collect();
        }
        self.velocity(x)
    }

    /// Largest difference of the velocities of mixture and grains in the bed.
    #[must_use]
    pub fn largest_slip(&self, x: &[f64]) -> f64 {
        let inside = (2 * self.mesh.columns + 1) * (2 * self.mesh.bed_rows + 1);
        let both = self.velocity(x).into_iter().zip(self.grains(x)).take(inside);
        both.map(|(u, w)| (u - w).abs()).fold(0.0, f64::max)
    }

    /// Integral of a velocity at the nodes over the elements of some rows, both halves of the section.
    #[must_use]
    pub fn integral(&self, velocity: &[f64], rows: std::ops::Range<usize>) -> f64 {
        let columns = self.mesh.columns;
        let of = |element: usize| -> f64 {
            let nodes = self.mesh.element(element);
            let at = |p: &element::Point| p.shape.iter().zip(nodes).map(|(n, k)| n * velocity[k]).sum::<f64>();
            points(&self.mesh, element).iter().map(|p| p.weight * at(p)).sum()
        };
        2.0 * (rows.start * columns..rows.end * columns).map(of).sum::<f64>()
    }
}
