//! A mesh that follows the yield surface of a bed, where the velocity has a corner in its second derivative.
//!
//! On any mesh whose elements the yield surface crosses, quadratic elements converge erratically. Between a static bed and the
//! mobile grains above it the surface is one line `z(y)` from the symmetry plane to the wall, so a row of elements can end on
//! it: solve, look where the velocity of the mobile grains falls to zero, divide again.

use super::duct::{Divided, Filling};
use crate::numerics::root::brent;

/// Velocity of the grains over that of the flow which counts as none: well above what the smallest smoothing leaves.
const CREEP: f64 = 1e-7;

impl Divided {
    /// Height of the yield surface in each node column, from the velocity `w` of the grains at the nodes: the zero of the cubic
    /// through four levels of the mobile layer; of the square root of `w` with one velocity, where both `w` and its slope
    /// vanish at the surface. `None`: the grains are at rest, up to the creep of the smoothing, under the flow `u`.
    #[must_use]
    pub fn yield_line(&self, u: &[f64], w: &[f64]) -> Option<Vec<f64>> {
        let Filling::Bed { level, k, .. } = self.duct.filling else { return None };
        let (across, _) = self.mesh.lines();
        let top = 2 * self.mesh.bed_rows;
        let size = |of: &[f64]| of.iter().fold(0.0_f64, |m, w| m.max(*w));
        let largest = size(w);
        if largest <= CREEP * size(u) {
            return None;
        }
        let mut line: Vec<f64> = (0..across - 1)
            .map(|i| {
                let at = |j: usize| (self.mesh.position(self.mesh.node(i, j)).1, w[self.mesh.node(i, j)]);
                if at(top).1 <= 1e-9 * largest {
                    return None;
                }
                let moving = (0..top).rev().find(|j| at(*j).1 <= 1e-3 * at(top).1)? + 1;
                let (span, first) = (top - moving, at(moving).0);
                if span < 5 {
                    return Some(at(moving - 1).0);
                }
                let picks = [moving + span / 10 + 1, moving + span / 4 + 1, moving + span / 2, moving + 3 * span / 4];
                let values = picks.map(|j| {
                    let (z, w) = at(j);
                    (z, if k.is_some() { w } else { w.max(0.0).sqrt() })
                });
                let lowest = 2.0 * first - values[1].0;
                Some(zero(&values, lowest.max(0.0), values[0].0).unwrap_or(at(moving - 1).0))
            })
            .collect::<Option<_>>()?;
        let wall = |a: f64, b: f64, c: f64| 3.0 * a - 3.0 * b + c;
        let n = line.len();
        let last = if n > 2 { wall(line[n - 1], line[n - 2], line[n - 3]) } else { line[n - 1] };
        line.push(last.clamp(line[n - 1], 0.5 * (level + line[n - 1])));
        Some(line)
    }
}

/// Zero of the cubic through four points, between `a` and `b`.
fn zero(points: &[(f64, f64); 4], a: f64, b: f64) -> Option<f64> {
    let cubic = |z: f64| -> f64 {
        (0..4)
            .map(|i| {
                let others = (0..4).filter(|j| *j != i);
                points[i].1 * others.map(|j| (z - points[j].0) / (points[i].0 - points[j].0)).product::<f64>()
            })
            .sum()
    };
    let mut low = b;
    while cubic(low) > 0.0 && low > a {
        low -= 0.02 * (b - a);
    }
    if cubic(low) > 0.0 { None } else { brent(cubic, low, b, |_| {}).ok() }
}

/// Values at the node columns `to` of a line given at the node columns `from`, by cubics.
#[must_use]
pub fn along(from: &[f64], line: &[f64], to: &[f64]) -> Vec<f64> {
    to.iter()
        .map(|x| {
            let picked = from.len().min(4);
            let first = from.partition_point(|f| f < x).saturating_sub(2).min(from.len() - picked);
            let picks = first..first + picked;
            picks
                .clone()
                .map(|i| {
                    let others = picks.clone().filter(|j| *j != i);
                    line[i] * others.map(|j| (x - from[j]) / (from[i] - from[j])).product::<f64>()
                })
                .sum()
        })
        .collect()
}
