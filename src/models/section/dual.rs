//! The first-order method: accelerated ascent of the dual, one factorisation, few digits.
//!
//! For a given stress `q` in the unit balls the forces are balanced by `x = K^-1 (b - sum B t q)`, and the dual rises along the
//! rate of strain of that `x`: each stress takes a step along it and is scaled back to the ball, with the momentum of Nesterov
//! and a restart where the momentum points downhill. The step is one over the largest eigenvalue of `B K^-1 B`, found by power
//! iteration. The duality gap says when to stop.
//!
//! Sources: Beck & Teboulle (2009), SIAM J. Imaging Sci. 2, 183-202; O'Donoghue & Candes (2015), Found. Comput. Math. 15,
//! 715-732; for Bingham flow Treskatis, Moyers-Gonzalez & Price (2016), J. Non-Newtonian Fluid Mech. 238, 115-130.

use std::ops::ControlFlow;

use super::newton::{Solved, Unsolved};
use super::program::{Program, length};
use crate::numerics::sparse::Cholesky;

/// Iterations of the power method, and what its eigenvalue may be short of.
const POWER: (usize, f64) = (30, 1.05);

/// Solves a program until the duality gap is below `tolerance` of the work of the drive; `see` receives it.
///
/// # Errors
/// [`Unsolved`] after `most` iterations.
pub fn solve<const D: usize, const N: usize>(
    program: &Program<D, N>,
    tolerance: f64,
    most: usize,
    see: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Solved<D>, Unsolved> {
    let mut cholesky = Cholesky::new(&program.pattern, program.order.as_deref())?;
    cholesky.factorise(&program.base)?;
    let points = program.points.len();
    let mut g = vec![[0.0; D]; points];
    let step = POWER.1.recip() / largest(program, &mut cholesky, &mut g);
    let mut q = vec![[0.0; D]; points];
    let mut ahead = q.clone();
    let (mut x, mut momentum, mut history) = (Vec::new(), 1.0_f64, Vec::new());
    for _ in 0..most {
        x.clone_from(&program.load);
        program.forces(&ahead, -1.0, &mut x);
        cholesky.solve(&mut x);
        program.strains(&x, &mut g);
        let work: f64 = x.iter().zip(&program.load).map(|(x, b)| x * b).sum::<f64>().abs();
        let gap = program.gap(&g, &ahead) / work.max(f64::MIN_POSITIVE);
        history.push(gap);
        if see(gap).is_break() {
            return Err(Unsolved::Stopped);
        }
        if !gap.is_finite() {
            break;
        }
        if gap <= tolerance {
            let size = |forces: &[f64]| forces.iter().map(|r| r.abs()).sum::<f64>();
            let imbalance = size(&program.imbalance(&program.load, &x, &ahead)) / size(&program.load);
            return Ok(Solved { x, g, q: ahead, history, gap, imbalance, lambda: 0.0 });
        }
        let next = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
        let (mut uphill, share) = (0.0, (momentum - 1.0) / next);
        for (((point, g), q), ahead) in program.points.iter().zip(&g).zip(&mut q).zip(&mut ahead) {
            let local_step = step * point.weight / point.carried;
            let tried: [f64; D] = std::array::from_fn(|d| ahead[d] + local_step * g[d]);
            let size = length(&tried).max(1.0);
            let new = tried.map(|a| a / size);
            // (ahead - new) (new - q): the momentum against the gradient
            uphill += (0..D).map(|d| point.carried / local_step * (new[d] - ahead[d]) * (new[d] - q[d])).sum::<f64>();
            *ahead = std::array::from_fn(|d| new[d] + share * (new[d] - q[d]));
            let size = length(ahead).max(1.0);
            *ahead = ahead.map(|a| a / size);
            *q = new;
        }
        momentum = next;
        if uphill < 0.0 {
            ahead.clone_from(&q);
            momentum = 1.0;
        }
    }
    let gap = history.last().copied().unwrap_or(f64::INFINITY);
    Err(Unsolved::NotConverged { change: gap, iterations: history.len(), lambda: 0.0 })
}

/// Largest eigenvalue of `B K^-1 B` with the areas of the points, by power iteration; leaves its vector in `s`.
fn largest<const D: usize, const N: usize>(
    program: &Program<D, N>,
    cholesky: &mut Cholesky,
    s: &mut [[f64; D]],
) -> f64 {
    // A start without symmetry, the same in every run.
    let mut seed = 0.5_f64;
    for value in s.iter_mut().flatten() {
        seed = (seed * 997.0 + 0.1234).fract();
        *value = seed - 0.5;
    }
    let mut eigenvalue = 1.0;
    for _ in 0..POWER.0 {
        let norm = s.iter().zip(&program.points).map(|(s, p)| p.weight * length(s).powi(2)).sum::<f64>().sqrt();
        // Forces carry t: the area alone is t over the yield stress.
        for (s, p) in s.iter_mut().zip(&program.points) {
            *s = s.map(|a| a / norm * p.weight / p.carried);
        }
        let mut x = vec![0.0; program.size()];
        program.forces(s, 1.0, &mut x);
        cholesky.solve(&mut x);
        program.strains(&x, s);
        for (s, p) in s.iter_mut().zip(&program.points) {
            *s = std::array::from_fn(|d| s[d] - p.offset[d]);
        }
        eigenvalue = s.iter().zip(&program.points).map(|(s, p)| p.weight * length(s).powi(2)).sum::<f64>().sqrt();
    }
    eigenvalue
}
