//! Slow flow of a Bingham fluid in a square cavity under a moving lid: the discrete stream function on a staggered grid.
//!
//! Units: side H, velocity U of the lid, stress eta U/H; the yield stress is the Bingham number Bn.
//!
//! ```text
//!  psi --- u --- psi      u = d(psi)/dz on vertical sides, v = -d(psi)/dy on horizontal ones: in every cell
//!   |             |       du/dy + dv/dz = 0 to round-off
//!   v     E       v       E = 2 du/dy in the middle of the cell
//!   |             |       S = du/dz + dv/dy at the nodes; at a wall from its velocity over half a cell
//!  psi --- u --- psi      |gamma|^2 = E^2 + (S_1^2 + S_2^2 + S_3^2 + S_4^2)/4 in each cell
//!
//! minimise over psi   sum over cells of area (|gamma|^2/2 + Bn |gamma|),   psi = 0 on the walls
//! ```
//!
//! Scalar and convex, of second order for a Newtonian fluid. At the two upper corners, where the velocity jumps, S is left
//! out. The stencil is that of the staggered scheme: Harlow & Welch (1965), Phys. Fluids 8, 2182-2189.

use super::program::{Block, FIXED, Point, Program};
use crate::numerics::levels::graded;
use crate::numerics::sparse::Pattern;

/// Nodes that one cell knows: four by four.
const KNOWN: usize = 16;
/// Components of the strain of a cell.
const PARTS: usize = 5;

/// A cavity on its grid, ready to be solved.
#[derive(Clone, Debug)]
pub struct Cavity {
    /// faces across, 0 to 1
    pub y: Vec<f64>,
    /// faces from the bottom to the lid, 0 to 1
    pub z: Vec<f64>,
    /// the minimum; unknowns are the stream function at the inner nodes
    pub program: Program<PARTS, KNOWN>,
    /// unknown at each node
    unknowns: Vec<u32>,
}

/// A linear form in the stream function: coefficients by node of the four by four, and a constant.
#[derive(Clone, Copy)]
struct Form {
    by_node: [f64; KNOWN],
    constant: f64,
}

impl Cavity {
    /// The cavity on `cells` by `cells` cells; the smallest at the lid and the walls are `finest` times the mean one.
    #[must_use]
    pub fn new(bn: f64, cells: usize, finest: f64) -> Self {
        let size = |length: f64, n: usize| if finest < 1.0 { finest * length / n as f64 } else { f64::INFINITY };
        let half = graded(0.5, 1.0, cells / 2, size(0.5, cells / 2));
        let mut y: Vec<f64> = half.iter().rev().map(|y| 1.0 - y).collect();
        y.extend(&half[1..]);
        let z = graded(0.0, 1.0, y.len() - 1, size(1.0, y.len() - 1));
        let (across, up) = (y.len(), z.len());
        let inner = |i: usize, j: usize| i > 0 && j > 0 && i < across - 1 && j < up - 1;
        let mut unknowns = vec![FIXED; across * up];
        let mut n = 0;
        dissect((0, across), (0, up), &mut |i, j| {
            if inner(i, j) {
                unknowns[j * across + i] = n;
                n += 1;
            }
        });
        let (y, z) = (y, z);
        let mut cavity = Self {
            program: Program {
                pattern: Pattern::of_blocks(0, std::iter::empty()),
                order: Some((0..n).collect()),
                base: Vec::new(),
                load: vec![0.0; n as usize],
                blocks: Vec::new(),
                per_block: 1,
                points: Vec::new(),
            },
            y,
            z,
            unknowns,
        };
        let cells: Vec<(usize, usize)> = (0..up - 1).flat_map(|j| (0..across - 1).map(move |i| (i, j))).collect();
        let known: Vec<[u32; KNOWN]> = cells.iter().map(|(i, j)| cavity.known(*i, *j)).collect();
        let pattern = Pattern::of_blocks(n as usize, known.iter().map(<[u32; KNOWN]>::as_slice));
        let program = &mut cavity.program;
        program.base = vec![0.0; pattern.entries()];
        program.pattern = pattern;
        for ((i, j), known) in cells.into_iter().zip(known) {
            cavity.assemble(bn, i, j, known);
        }
        cavity
    }

    /// Unknowns of the four by four nodes around cell `(i, j)`.
    fn known(&self, i: usize, j: usize) -> [u32; KNOWN] {
        let (across, up) = (self.y.len(), self.z.len());
        std::array::from_fn(|k| {
            let (a, b) = ((i + k % 4).wrapping_sub(1), (j + k / 4).wrapping_sub(1));
            if a < across && b < up { self.unknowns[b * across + a] } else { FIXED }
        })
    }

    fn assemble(&mut self, bn: f64, i: usize, j: usize, known: [u32; KNOWN]) {
        let weight = (self.y[i + 1] - self.y[i]) * (self.z[j + 1] - self.z[j]);
        let stretch = self.stretch(i, j);
        let forms =
            [stretch, self.shear(i, j, 0, 0), self.shear(i, j, 1, 0), self.shear(i, j, 0, 1), self.shear(i, j, 1, 1)];
        let strain = forms.map(|form| form.by_node);
        let offset = forms.map(|form| form.constant);
        let block = Block::new(known, &self.program.pattern);
        let (mut local, mut load) = ([[0.0; KNOWN]; KNOWN], [0.0; KNOWN]);
        for (row, constant) in strain.iter().zip(offset) {
            for a in 0..KNOWN {
                load[a] -= weight * row[a] * constant;
                for b in 0..=a {
                    local[a][b] += weight * row[a] * row[b];
                }
            }
        }
        block.add(&local, &mut self.program.base);
        block.scatter(&load, &mut self.program.load);
        if bn > 0.0 {
            self.program.blocks.push(block);
            self.program.points.push(Point { strain, offset, weight, carried: weight * bn });
        }
    }

    /// `2 du/dy` in the middle of cell `(i, j)`.
    fn stretch(&self, i: usize, j: usize) -> Form {
        let scale = 2.0 / ((self.y[i + 1] - self.y[i]) * (self.z[j + 1] - self.z[j]));
        let mut by_node = [0.0; KNOWN];
        // Corners of the cell are nodes 5, 6, 9, 10 of the four by four.
        by_node[10] = scale;
        by_node[6] = -scale;
        by_node[9] = -scale;
        by_node[5] = scale;
        Form { by_node, constant: 0.0 }
    }

    /// Half of `du/dz + dv/dy` at the node `(i + a, j + b)` of cell `(i, j)`.
    fn shear(&self, i: usize, j: usize, a: usize, b: usize) -> Form {
        let (y, z) = (&self.y, &self.z);
        let (last_i, last_j) = (y.len() - 1, z.len() - 1);
        let (node_i, node_j) = (i + a, j + b);
        let place = |p: usize, q: usize| 4 * q + p;
        let (p, q) = (1 + a, 1 + b);
        let mut form = Form { by_node: [0.0; KNOWN], constant: 0.0 };
        if (node_i == 0 || node_i == last_i) && (node_j == 0 || node_j == last_j) {
            return form;
        }
        if node_i > 0 && node_i < last_i {
            let below = (node_j > 0).then(|| z[node_j] - z[node_j - 1]);
            let above = (node_j < last_j).then(|| z[node_j + 1] - z[node_j]);
            let across = 0.5 * (below.unwrap_or(0.0) + above.unwrap_or(0.0));
            if let Some(h) = above {
                form.by_node[place(p, q + 1)] += 0.5 / (h * across);
                form.by_node[place(p, q)] -= 0.5 / (h * across);
            } else {
                form.constant += 0.5 / across;
            }
            if let Some(h) = below {
                form.by_node[place(p, q)] -= 0.5 / (h * across);
                form.by_node[place(p, q - 1)] += 0.5 / (h * across);
            }
        }
        if node_j > 0 && node_j < last_j {
            let left = (node_i > 0).then(|| y[node_i] - y[node_i - 1]);
            let right = (node_i < last_i).then(|| y[node_i + 1] - y[node_i]);
            let across = 0.5 * (left.unwrap_or(0.0) + right.unwrap_or(0.0));
            // dv/dy with v = -d(psi)/dy
            if let Some(h) = right {
                form.by_node[place(p + 1, q)] -= 0.5 / (h * across);
                form.by_node[place(p, q)] += 0.5 / (h * across);
            }
            if let Some(h) = left {
                form.by_node[place(p, q)] += 0.5 / (h * across);
                form.by_node[place(p - 1, q)] -= 0.5 / (h * across);
            }
        }
        form
    }

    /// Stream function at the nodes, 0 on the walls.
    #[must_use]
    pub fn stream(&self, x: &[f64]) -> Vec<f64> {
        self.unknowns.iter().map(|u| if *u == FIXED { 0.0 } else { x[*u as usize] }).collect()
    }
}

/// Nodes in the order of their elimination: both halves first, then three lines between them, as far as a cell knows.
fn dissect(x: (usize, usize), z: (usize, usize), see: &mut impl FnMut(usize, usize)) {
    let (wide, high) = (x.1 - x.0, z.1 - z.0);
    if wide.max(high) < 10 {
        (z.0..z.1).for_each(|j| (x.0..x.1).for_each(|i| see(i, j)));
    } else if wide >= high {
        let m = (x.0 + x.1) / 2;
        dissect((x.0, m - 1), z, see);
        dissect((m + 2, x.1), z, see);
        (z.0..z.1).for_each(|j| (m - 1..m + 2).for_each(|i| see(i, j)));
    } else {
        let m = (z.0 + z.1) / 2;
        dissect(x, (z.0, m - 1), see);
        dissect(x, (m + 2, z.1), see);
        (m - 1..m + 2).for_each(|j| (x.0..x.1).for_each(|i| see(i, j)));
    }
}
