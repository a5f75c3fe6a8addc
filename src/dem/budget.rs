//! What becomes of the velocity fluctuations of grains: the budget of their energy, and what kinetic theory reads from it.
//!
//! ```text
//! 0 = τ_p du_p/dz - dq/dz - (contacts) - (drag)          g₀ = (p/(ρ_p φ T) - 1)/(2 φ (1 + e))
//! ```
//!
//! Slopes are taken over one diameter. The loss by contacts is what the others leave of the budget, as in the source, and beside
//! it the power that contacts take from the motion of the centres. Source: Chassagne et al. (2023), eq. (2.16), (2.27)-(2.30), (3.1).

use super::average::{Averaged, Averages, mean};
use crate::dem::GrainBed;
use crate::result::{Estimate, Quantity, quantity as q};

/// A column and its standard error.
pub type Column = (&'static Quantity, Option<&'static Quantity>, Vec<Option<Estimate>>);

/// Terms of the budget.
const TERMS: usize = 7;

/// The columns of the budget, mean and standard error over the blocks of `averages`.
#[must_use]
pub fn columns(bed: &GrainBed, averages: &Averages) -> Vec<Column> {
    let blocks: Vec<Vec<[Option<f64>; TERMS]>> =
        averages.each().iter().map(|block| (0..block.z.len()).map(|s| terms(bed, block, s)).collect()).collect();
    let slices = blocks.first().map_or(0, Vec::len);
    let names: [(&'static Quantity, Option<&'static Quantity>); TERMS] = [
        (&q::PRODUCTION, Some(&q::PRODUCTION_STDERR)),
        (&q::FLUCTUATION_FLUX, Some(&q::FLUCTUATION_FLUX_STDERR)),
        (&q::DIFFUSION, None),
        (&q::DRAG_LOSS, Some(&q::DRAG_LOSS_STDERR)),
        (&q::CONTACT_LOSS, Some(&q::CONTACT_LOSS_STDERR)),
        (&q::CONTACT_LOSS_DIRECT, None),
        (&q::RADIAL, Some(&q::RADIAL_STDERR)),
    ];
    let over = |k: usize| (0..slices).map(|s| mean(blocks.iter().filter_map(|block| block[s][k]))).collect();
    names.into_iter().enumerate().map(|(k, (value, error))| (value, error, over(k))).collect()
}

/// The terms at slice `s` of one block.
fn terms(bed: &GrainBed, block: &Averaged, s: usize) -> [Option<f64>; TERMS] {
    let half = ((0.5 / bed.discrete.slice).round() as usize).max(1);
    let at = |means: &[Option<Estimate>], s: usize| means.get(s).copied().flatten().map(|x| x.mean);
    let slope = |means: &[Option<Estimate>]| {
        let (below, above) = (s.checked_sub(half)?, s + half);
        Some((at(means, above)? - at(means, below)?) / (block.z.get(above)? - block.z[below]))
    };
    let product = |a: Option<f64>, b: Option<f64>| Some(a? * b?);
    let production = product(at(&block.shear, s), slope(&block.velocity));
    let diffusion = slope(&block.flux).map(|slope| -slope);
    let drag = at(&block.drag_loss, s);
    let contacts = production.zip(diffusion).zip(drag).map(|((made, brought), drag)| made + brought - drag);
    let radial = || {
        let (phi, t, p) = (at(&block.phi, s)?, at(&block.temperature, s)?, at(&block.pressure, s)?);
        (t > 0.0).then(|| (p / (bed.rho_p * phi * t) - 1.0) / (2.0 * phi * (1.0 + bed.contact.e_n)))
    };
    [production, at(&block.flux, s), diffusion, drag, contacts, at(&block.contact_loss, s), radial()]
        .map(|x| x.filter(|x| x.is_finite()))
}
