//! The unknowns of a cell, and what follows from them at once.
//!
//! ```text
//!   face i + 1/2 ──  m  solid volume above, per area;  w  velocity of the grains upward;  L  mixing length over kappa
//!   cell i           y  logit of phi/phi_max;  u  velocity of the fluid;  v  velocity of the grains;  t  logarithm of T
//!   face i - 1/2 ──
//! ```
//!
//! The logit cannot leave (0, phi_max), nor the logarithm the positive numbers: nothing is clipped.

use super::laws::Laws;
use crate::closures::kinetic::Moving;
use crate::closures::mixing_length::Length;
use crate::numerics::dual::{Dual, Real};

/// Unknowns of a cell and of the face above it.
pub const SIZE: usize = 7;
/// Solid volume above the upper face.
pub const VOLUME: usize = 0;
/// Upward velocity of the grains at the upper face.
pub const RISE: usize = 1;
/// Logit of phi/phi_max.
pub const LOGIT: usize = 2;
/// Velocity of the fluid.
pub const FLUID: usize = 3;
/// Velocity of the grains.
pub const GRAINS: usize = 4;
/// Logarithm of the granular temperature.
pub const HEAT: usize = 5;
/// Mixing length over kappa at the upper face.
pub const LENGTH: usize = 6;

/// The unknowns of one cell.
pub type Unknowns = [f64; SIZE];

/// A cell with what follows from its unknowns.
#[derive(Clone, Copy, Debug)]
pub struct Cell<T> {
    /// solid volume above the upper face
    pub volume: T,
    /// upward velocity of the grains at the upper face
    pub rise: T,
    /// mixing length over kappa at the upper face
    pub length: T,
    /// velocity of the fluid
    pub u: T,
    /// velocity of the grains
    pub v: T,
    /// granular temperature
    pub t: T,
    /// solid fraction
    pub phi: T,
    /// its logarithm
    pub ln_phi: T,
    /// phi_max - phi
    pub gap: T,
    /// elastic pressure
    pub elastic: T,
    /// pressure of motion
    pub kinetic: T,
    /// whole pressure over the solid fraction
    pub per_grain: T,
    /// what the cell adds to the mixing length over kappa, per height
    pub clearance: T,
}

/// `exp(-x)/(1 + exp(-x))` without overflow.
fn logistic(x: f64) -> f64 {
    if x > 0.0 {
        let e = (-x).exp();
        e / (1.0 + e)
    } else {
        1.0 / (1.0 + x.exp())
    }
}

impl<T: Real> Cell<T> {
    /// The cell of the unknowns `x`.
    #[must_use]
    pub fn new(laws: &Laws, x: &[T; SIZE]) -> Self {
        let y = x[LOGIT];
        // 1 - s and s of the logistic function s(y), each without cancellation; both have the slope -+ s (1 - s).
        let (empty, full) = (logistic(y.value()), logistic(-y.value()));
        let gap = y.chain(laws.phi_max * empty, -laws.phi_max * empty * full);
        let phi = y.chain(laws.phi_max * full, laws.phi_max * empty * full);
        let ln_full = if y.value() > 0.0 { -(-y.value()).exp().ln_1p() } else { y.value() - y.value().exp().ln_1p() };
        let ln_phi = y.chain(laws.phi_max.ln() + ln_full, empty);
        let t = x[HEAT].exp();
        let per_grain = match laws.moving {
            Moving::Kinetic(law) => law.pressure_per_grain(phi, gap),
            Moving::Inertial(law) => law.pressure_per_grain(phi, gap),
        } * t
            * laws.ratio;
        let elastic = laws.elastic.pressure(phi, gap);
        Self {
            volume: x[VOLUME],
            rise: x[RISE],
            length: x[LENGTH],
            u: x[FLUID],
            v: x[GRAINS],
            t,
            phi,
            ln_phi,
            gap,
            elastic,
            kinetic: per_grain * phi,
            per_grain: if elastic.value() > 0.0 { per_grain + elastic / phi } else { per_grain },
            clearance: laws.mixing_length.clearance(phi),
        }
    }
}

impl Cell<Dual<SIZE>> {
    /// The cell with derivatives by its own unknowns.
    #[must_use]
    pub fn linearised(laws: &Laws, x: &Unknowns) -> Self {
        Self::new(laws, &std::array::from_fn(|k| Dual::variable(x[k], k)))
    }

    /// The same cell among `N` unknowns, where its own begin at `first`.
    #[must_use]
    pub fn among<const N: usize>(&self, first: usize) -> Cell<Dual<N>> {
        let place = |x: &Dual<SIZE>| {
            let mut slope = [0.0; N];
            slope[first..first + SIZE].copy_from_slice(&x.slope);
            Dual { value: x.value, slope }
        };
        Cell {
            volume: place(&self.volume),
            rise: place(&self.rise),
            length: place(&self.length),
            u: place(&self.u),
            v: place(&self.v),
            t: place(&self.t),
            phi: place(&self.phi),
            ln_phi: place(&self.ln_phi),
            gap: place(&self.gap),
            elastic: place(&self.elastic),
            kinetic: place(&self.kinetic),
            per_grain: place(&self.per_grain),
            clearance: place(&self.clearance),
        }
    }
}

/// Solid fraction of a cell.
#[must_use]
pub fn solid(laws: &Laws, x: &Unknowns) -> f64 {
    laws.phi_max * logistic(-x[LOGIT])
}
