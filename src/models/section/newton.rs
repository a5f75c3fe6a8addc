//! Newton's method with the stress as an extra unknown: exact yield, and every regularisation.
//!
//! A regularised point carries `q = g/m(|g|)`, that is `m q = g`. Linearised in `g` and `q` (Chan, Golub & Mulet 1999, SIAM J.
//! Sci. Comput. 20, 1964-1977) and eliminated in the point,
//!
//! ```text
//! q + dq = (g + dg)/m - (m'/m) sym(q n) dg,   n = g/|g|,   sym(q n) = (q n + n q)/2
//! (K + sum B t (1 - m' sym(q n))/m B) dx = b - K x - sum B t g/m
//! ```
//!
//! With `|q| <= 1`, to which `q` is scaled back in each point, the matrix is symmetric positive definite, its pattern fixed.
//! Linearised as a function of `g` alone, Newton's method does not converge for small lambda.
//!
//! The **exact yield** is the limit of `m = sqrt(|g|^2 + lambda^2)` for falling lambda: a step at each, until neither the
//! velocity nor the minimum changes any more.

use std::ops::ControlFlow;

use super::program::{Program, length};
use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::numerics::sparse::{Cholesky, NotPositive};

/// A solved program.
#[derive(Clone, Debug)]
pub struct Solved<const D: usize> {
    /// unknowns
    pub x: Vec<f64>,
    /// rate of strain in the points
    pub g: Vec<[f64; D]>,
    /// stress in the points over the yield stress
    pub q: Vec<[f64; D]>,
    /// relative change of the unknowns, one per iteration
    pub history: Vec<f64>,
    /// duality gap over the work of the drive
    pub gap: f64,
    /// sum of the forces that are not balanced over that of the drive
    pub imbalance: f64,
    /// the last lambda
    pub lambda: f64,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unsolved {
    /// not converged
    #[error("the velocity changes by {change:.3e} after {iterations} iterations at lambda = {lambda:.3e}")]
    NotConverged {
        /// relative change
        change: f64,
        /// iterations made
        iterations: usize,
        /// smoothing, in the unit of the shear rate
        lambda: f64,
    },
    /// the user asked to stop
    #[error("stopped")]
    Stopped,
    /// no factor
    #[error(transparent)]
    Matrix(#[from] NotPositive),
}

/// Iterations before giving up.
const MAX_ITERATIONS: usize = 300;
/// Relative change of the unknowns that counts as none.
const CONVERGED: f64 = 1e-11;
/// Last lambda of the exact yield over the largest shear rate of the Newtonian flow.
const RIGID: f64 = 1e-10;
/// Unknowns over those of the Newtonian flow below which nothing moves.
const STILL: f64 = 1e-6;
/// Fall of lambda from one step of the exact yield to the next.
const FALL: f64 = 0.2;

/// State of the iteration.
struct Iterate<'a, const D: usize, const N: usize> {
    program: &'a Program<D, N>,
    load: Vec<f64>,
    cholesky: Cholesky,
    values: Vec<f64>,
    /// size of the unknowns that counts as none
    still: f64,
    x: Vec<f64>,
    g: Vec<[f64; D]>,
    q: Vec<[f64; D]>,
}

/// Solves a program with a law of regularisation, or with the exact yield.
///
/// # Errors
/// [`Unsolved`].
pub fn solve<const D: usize, const N: usize>(
    program: &Program<D, N>,
    law: &Regularisation,
    see: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Solved<D>, Unsolved> {
    solve_corrected(program, law, CONVERGED, &mut |_, _| (), see)
}

/// As [`solve`], with forces that depend on the solution: after each step `correct` receives the unknowns and corrects the load,
/// as the pressure does that holds a flow free of divergence. `none` is the relative change that counts as none.
///
/// # Errors
/// [`Unsolved`].
pub fn solve_corrected<const D: usize, const N: usize>(
    program: &Program<D, N>,
    law: &Regularisation,
    none: f64,
    correct: &mut dyn FnMut(&[f64], &mut [f64]),
    see: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Solved<D>, Unsolved> {
    let mut cholesky = Cholesky::new(&program.pattern, program.order.as_deref())?;
    cholesky.factorise(&program.base)?;
    let mut x = program.load.clone();
    cholesky.solve(&mut x);
    let points = program.points.len();
    let mut g = vec![[0.0; D]; points];
    program.strains(&x, &mut g);
    let scale = g.iter().map(length).fold(0.0, f64::max);
    let values = program.base.clone();
    let still = STILL * x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut load = program.load.clone();
    correct(&x, &mut load);
    let mut iterate = Iterate { program, load, cholesky, values, still, x, g, q: vec![[0.0; D]; points] };
    let mut history = Vec::new();
    let exact = law.is_exact();
    let floor = if exact { RIGID * scale } else { law.lambda };
    let mut lambda = if exact { 0.1 * scale } else { law.lambda.max(scale) };
    let mut lawful = if exact { Regularisation { law: Smoothing::BercovierEngelman, lambda } } else { *law };
    let mut converged = points == 0;
    for _ in 0..MAX_ITERATIONS {
        if converged {
            break;
        }
        lawful.lambda = lambda;
        let change = iterate.step(&lawful)?;
        correct(&iterate.x, &mut iterate.load);
        history.push(change);
        if see(change).is_break() {
            return Err(Unsolved::Stopped);
        }
        if !change.is_finite() {
            break;
        }
        let last = lambda <= floor;
        converged = change < none && last;
        if !last && change < 0.3 {
            lambda = (FALL * lambda).max(floor);
        }
    }
    if !converged {
        let change = history.last().copied().unwrap_or(f64::INFINITY);
        return Err(Unsolved::NotConverged { change, iterations: history.len(), lambda });
    }
    let Iterate { mut x, mut g, q, load, still, .. } = iterate;
    // What smoothing leaves of nothing: the stress balances the drive without flow.
    if exact && x.iter().all(|x| x.abs() < still) {
        x.fill(0.0);
        program.strains(&x, &mut g);
    }
    let work: f64 = x.iter().zip(&program.load).map(|(x, b)| x * b).sum();
    let size = |forces: &[f64]| forces.iter().map(|r| r.abs()).sum::<f64>();
    let imbalance = size(&program.imbalance(&load, &x, &q)) / size(&load);
    let gap = program.gap(&g, &q) / work.abs().max(f64::MIN_POSITIVE);
    Ok(Solved { x, g, q, history, gap, imbalance, lambda })
}

impl<const D: usize, const N: usize> Iterate<'_, D, N> {
    /// One step; the relative change of the unknowns.
    fn step(&mut self, law: &Regularisation) -> Result<f64, Unsolved> {
        let Self { program, load, cholesky, values, still, x, g, q } = self;
        values.copy_from_slice(&program.base);
        let per_block = program.per_block;
        for ((block, points), (g, q)) in program.each().zip(g.chunks(per_block).zip(q.chunks(per_block))) {
            let mut local = [[0.0; N]; N];
            for ((point, g), q) in points.iter().zip(g).zip(q) {
                let stiff = tangent(law, g, q);
                for (left, stiff) in point.strain.iter().zip(&stiff) {
                    // One row of (1 - m' sym(q n))/m B at a time.
                    let row: [f64; N] = std::array::from_fn(|j| {
                        point.carried * stiff.iter().zip(&point.strain).map(|(s, b)| s * b[j]).sum::<f64>()
                    });
                    for (i, left) in left.iter().enumerate() {
                        for j in 0..=i {
                            local[i][j] += left * row[j];
                        }
                    }
                }
            }
            block.add(&local, values);
        }
        cholesky.factorise(values)?;
        let carried: Vec<[f64; D]> = g.iter().map(|g| g.map(|a| a / law.effective(length(g)).0)).collect();
        let mut dx = program.imbalance(load, x, &carried);
        cholesky.solve(&mut dx);
        let size = x.iter().zip(&dx).fold(*still, |m, (x, d)| m.max((x + d).abs()));
        let change = dx.iter().fold(0.0_f64, |m, d| m.max(d.abs())) / size;
        x.iter_mut().zip(&dx).for_each(|(x, d)| *x += d);
        let mut changes = vec![[0.0; D]; g.len()];
        program.changes(&dx, &mut changes);
        for ((g, q), dg) in g.iter_mut().zip(q.iter_mut()).zip(changes) {
            let stiff = tangent(law, g, q);
            let m = law.effective(length(g)).0;
            let next: [f64; D] = std::array::from_fn(|a| g[a] / m + (0..D).map(|b| stiff[a][b] * dg[b]).sum::<f64>());
            let size = length(&next).max(1.0);
            *q = next.map(|a| a / size);
            // A plug moves much faster than it is sheared: the difference of its velocities has no digit left, the sum of the
            // small changes has.
            g.iter_mut().zip(dg).for_each(|(g, dg)| *g += dg);
        }
        Ok(change)
    }
}

/// `(1 - m' sym(q n))/m`.
fn tangent<const D: usize>(law: &Regularisation, g: &[f64; D], q: &[f64; D]) -> [[f64; D]; D] {
    let size = length(g);
    let (m, slope) = law.effective(size);
    let share = if size > 0.0 { 0.5 * slope / (m * size) } else { 0.0 };
    std::array::from_fn(|a| {
        std::array::from_fn(|b| f64::from(u8::from(a == b)) / m - share * (q[a] * g[b] + q[b] * g[a]))
    })
}
