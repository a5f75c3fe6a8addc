//! Where a coupled flow begins: the relief of its bottom, the weight of its grains, and the level of its bed.

use crate::dem::grains::{Grain, Point};
use crate::dem::pack;
use crate::models::coupled::{Coupled, Relief};
use crate::runtime::rng::Stream;

/// Stream of random numbers of the relief.
const RELIEF: u64 = 3;

/// Fixed grains side by side at random elevations in steps; none on another bottom.
pub(super) fn relief(flow: &Coupled) -> Vec<Grain> {
    let Relief { largest, step } = flow.relief;
    let mut fixed = pack::bottom(&flow.bed);
    // Steps on either side of the mean: with an even number of them, none is at the mean.
    let kinds = (2.0 * largest / step).round() + 1.0;
    for (n, grain) in fixed.iter_mut().enumerate() {
        let draw = Stream::new([u64::from(flow.bed.discrete.seed), RELIEF, n as u64]).uniform();
        grain.position[2] = (draw * kinds).floor() * step - 0.5 * (kinds - 1.0) * step;
    }
    fixed
}

/// Weight of a grain in a fluid that flows steadily under a free surface, over its mass: all of it along the flow, the
/// submerged part normal to it.
pub(super) fn gravity(flow: &Coupled) -> Point {
    let bed = &flow.bed;
    [bed.g * bed.beta.sin(), 0.0, -(1.0 - flow.rho_f / bed.rho_p) * bed.g * bed.beta.cos()]
}

/// Highest cell up to which the solid fraction, averaged over a diameter, is half of its largest value; as a level \[m].
pub(super) fn level(phi: &[f64], height: f64, d: f64) -> f64 {
    let half = ((0.5 * d / height).round() as usize).max(1);
    let mean = |i: usize| {
        let part = &phi[i.saturating_sub(half)..(i + half + 1).min(phi.len())];
        part.iter().sum::<f64>() / part.len() as f64
    };
    let means: Vec<f64> = (0..phi.len()).map(mean).collect();
    let largest = means.iter().copied().fold(0.0, f64::max);
    let top = means.iter().rposition(|&phi| largest > 0.0 && phi >= 0.5 * largest);
    top.map_or(0.0, |i| (i + 1) as f64 * height)
}
