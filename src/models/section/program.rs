//! Viscoplastic flow as a convex minimum, whatever the geometry and the elements:
//!
//! ```text
//! minimise over x   x K x/2 - b x + sum over points of t |B x + c|
//! ```
//!
//! `x` unknowns (velocity or stream function), `K` viscosity and drag, symmetric positive definite, `b` the drive; in each point
//! the rate of strain `g = B x + c` of `D` components and `t` the yield stress times the area that the point stands for. The
//! stress that the yield stress carries is `t q` with `|q| <= 1`, `q = g/|g|` where the material flows:
//!
//! ```text
//! K x + sum B t q = b,   q in the unit ball,   q g = |g|
//! ```
//!
//! The duality gap `sum t (|g| - q g)`, for `q` in the ball and balanced forces, bounds the error of the minimum, and half the
//! square of the error of `x` in the norm of `K`. Sources: Duvaut & Lions (1976), Inequalities in Mechanics and Physics,
//! chapter VI; Glowinski (1984), Numerical Methods for Nonlinear Variational Problems.

use crate::numerics::sparse::Pattern;

/// No unknown: the node lies on a wall.
pub const FIXED: u32 = u32::MAX;

/// A convex minimum with `D` components of strain, each point of which knows `N` unknowns.
#[derive(Clone, Debug)]
pub struct Program<const D: usize, const N: usize> {
    /// entries of the matrix
    pub pattern: Pattern,
    /// order of elimination
    pub order: Option<Vec<u32>>,
    /// K
    pub base: Vec<f64>,
    /// b
    pub load: Vec<f64>,
    /// points with a yield stress, by block
    pub blocks: Vec<Block<N>>,
    /// points per block
    pub per_block: usize,
    /// points with a yield stress
    pub points: Vec<Point<D, N>>,
}

/// Unknowns that the points of one element share.
#[derive(Clone, Debug)]
pub struct Block<const N: usize> {
    /// unknowns; [`FIXED`]: none
    pub unknowns: [u32; N],
    /// places of the lower triangle of the block in the matrix, by rows; [`FIXED`]: none
    slots: Vec<u32>,
}

/// A point with a yield stress.
#[derive(Clone, Copy, Debug)]
pub struct Point<const D: usize, const N: usize> {
    /// B
    pub strain: [[f64; N]; D],
    /// c
    pub offset: [f64; D],
    /// area that the point stands for
    pub weight: f64,
    /// t: yield stress times area
    pub carried: f64,
}

impl<const N: usize> Block<N> {
    /// A block of these unknowns in a matrix.
    #[must_use]
    pub fn new(unknowns: [u32; N], pattern: &Pattern) -> Self {
        let mut slots = Vec::with_capacity(N * (N + 1) / 2);
        for i in 0..N {
            for j in 0..=i {
                let (a, b) = (unknowns[i], unknowns[j]);
                let inside = a != FIXED && b != FIXED;
                slots.push(if inside { pattern.slot(a, b).map_or(FIXED, |s| s as u32) } else { FIXED });
            }
        }
        Self { unknowns, slots }
    }

    /// Adds a symmetric matrix, of which the lower triangle is given by rows.
    pub fn add(&self, local: &[[f64; N]; N], values: &mut [f64]) {
        let mut at = 0;
        for (i, row) in local.iter().enumerate() {
            for a in &row[..=i] {
                if self.slots[at] != FIXED {
                    values[self.slots[at] as usize] += a;
                }
                at += 1;
            }
        }
    }

    /// Values of `x` at the unknowns, 0 where there is none.
    #[must_use]
    pub fn gather(&self, x: &[f64]) -> [f64; N] {
        self.unknowns.map(|u| if u == FIXED { 0.0 } else { x[u as usize] })
    }

    /// Adds to `x`.
    pub fn scatter(&self, local: &[f64; N], x: &mut [f64]) {
        for (u, a) in self.unknowns.iter().zip(local) {
            if *u != FIXED {
                x[*u as usize] += a;
            }
        }
    }
}

/// Length of a vector.
#[must_use]
pub fn length<const D: usize>(g: &[f64; D]) -> f64 {
    g.iter().map(|a| a * a).sum::<f64>().sqrt()
}

impl<const D: usize, const N: usize> Program<D, N> {
    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.load.len()
    }

    /// Blocks with their points, in order.
    pub fn each(&self) -> impl Iterator<Item = (&Block<N>, &[Point<D, N>])> {
        self.blocks.iter().zip(self.points.chunks(self.per_block))
    }

    /// Rates of strain `B x + c`, into `g`.
    pub fn strains(&self, x: &[f64], g: &mut [[f64; D]]) {
        self.changes(x, g);
        for (g, point) in g.iter_mut().zip(&self.points) {
            g.iter_mut().zip(point.offset).for_each(|(g, c)| *g += c);
        }
    }

    /// Changes `B dx` of the rates of strain, into `dg`.
    pub fn changes(&self, dx: &[f64], dg: &mut [[f64; D]]) {
        for ((block, points), dg) in self.each().zip(dg.chunks_mut(self.per_block)) {
            let local = block.gather(dx);
            for (point, dg) in points.iter().zip(dg) {
                *dg = std::array::from_fn(|d| point.strain[d].iter().zip(&local).map(|(b, x)| b * x).sum::<f64>());
            }
        }
    }

    /// Adds `factor sum B t s` for the stresses `s`.
    pub fn forces(&self, stresses: &[[f64; D]], factor: f64, out: &mut [f64]) {
        for ((block, points), s) in self.each().zip(stresses.chunks(self.per_block)) {
            let mut local = [0.0; N];
            for (point, s) in points.iter().zip(s) {
                for (row, s) in point.strain.iter().zip(s) {
                    let t = factor * point.carried * s;
                    local.iter_mut().zip(row).for_each(|(l, b)| *l += t * b);
                }
            }
            block.scatter(&local, out);
        }
    }

    /// `b - K x - sum B t q` for the load `b`.
    #[must_use]
    pub fn imbalance(&self, load: &[f64], x: &[f64], q: &[[f64; D]]) -> Vec<f64> {
        let mut out = vec![0.0; self.size()];
        self.pattern.multiply(&self.base, x, &mut out);
        out.iter_mut().zip(load).for_each(|(o, b)| *o = b - *o);
        self.forces(q, -1.0, &mut out);
        out
    }

    /// The duality gap `sum t (|g| - q g)`.
    #[must_use]
    pub fn gap(&self, g: &[[f64; D]], q: &[[f64; D]]) -> f64 {
        let dot = |a: &[f64; D], b: &[f64; D]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        self.points.iter().zip(g).zip(q).map(|((p, g), q)| p.carried * (length(g) - dot(q, g))).sum()
    }
}
