//! Whether a steady flow is stable: the growth of small disturbances.
//!
//! With the residuals `R(x, dQ/dt)`, A their derivative by x and B that by rates of change, disturbances `x exp(sigma t)` obey
//! `(A + sigma B) x = 0`. Arnoldi's method on `(A + s B)^-1 B`, whose eigenvalues are `1/(s - sigma)`, finds those near the shift
//! s; the largest real part over a few shifts is the growth rate, and the imaginary part the frequency of the oscillation.
//! Source: Saad (2011), Numerical Methods for Large Eigenvalue Problems, chapter 8.
//!
//! Grains in the fluid above the flow, a trace that the floor of the solid fraction leaves there without weight, drift on their
//! own: the equations without them have eigenvalues of their own, those of the trace depend on every cell and act on nothing.
//! The grains there do not change, then; their velocity and temperature do where a theory has grains conduct momentum and heat however
//! few they are, since those are of the flow, and follow it at once. A growth rate is one of the flow and not of its cells only if half the cells have it too.

use nalgebra::DMatrix;

use super::face::{Mobilised, Setting};
use super::levels::NONE;
use super::state::{GRAINS, HEAT, LOGIT, RISE, SIZE, Unknowns, VOLUME, solid};
use super::steady::on_cells;
use super::system::{Column, Linear, Memory, unit};
use crate::closures::kinetic::Moving;

/// Shifts, over the rate at which grains fall.
const SHIFTS: [f64; 2] = [0.03, 0.3];
/// Vectors of Arnoldi's method.
const VECTORS: usize = 60;
/// Residual of an eigenvalue over itself below which it counts.
const KNOWN: f64 = 1e-6;
/// Difference of the growth rates on all and on half the cells over the first, up to which it counts.
const CONVERGED: f64 = 0.1;

/// How a small disturbance goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// growth rate; the disturbance decays where it is negative
    pub rate: f64,
    /// angular frequency of its oscillation
    pub frequency: f64,
}

/// Why there is no growth rate. Rates in the time of the column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unknown {
    /// no eigenvalue was found
    NoEigenvalue,
    /// no steady flow on half the cells
    NoSecondGrid,
    /// the growth rates on all cells and on half of them differ too much
    OfTheCells([f64; 2]),
}

impl Column {
    /// The disturbance of the steady flow `state` that grows fastest, or decays slowest, and the difference of its growth rate
    /// from that on half the cells.
    ///
    /// # Errors
    /// [`Unknown`] where the growth rate is not that of the flow.
    pub fn converged_growth(&self, state: &[Unknowns]) -> Result<(Growth, f64), Unknown> {
        let fine = self.growth(state).ok_or(Unknown::NoEigenvalue)?;
        let (coarse, state) = on_cells(self, state, self.cells() / 2).ok_or(Unknown::NoSecondGrid)?;
        let rough = coarse.growth(&state).ok_or(Unknown::NoEigenvalue)?;
        let difference = (fine.rate - rough.rate).abs();
        if difference <= CONVERGED * fine.rate.abs() {
            Ok((fine, difference))
        } else {
            Err(Unknown::OfTheCells([fine.rate, rough.rate]))
        }
    }

    /// The disturbance of the steady flow `state` that grows fastest, or decays slowest; `None` if no eigenvalue was found.
    #[must_use]
    pub fn growth(&self, state: &[Unknowns]) -> Option<Growth> {
        let found = SHIFTS.into_iter().filter_map(|shift| self.near(state, shift / self.laws.fall()));
        found.reduce(|a, b| if b.rate > a.rate { b } else { a })
    }

    /// Whether grains conduct momentum and heat however few they are, as those of a gas do.
    #[must_use]
    pub fn trace_conducts(&self) -> bool {
        let laws = &self.laws;
        let Moving::Kinetic(law) = laws.moving else { return false };
        let conductivity = |phi: f64| {
            let (k, _) = laws.drag.per_volume(phi, 1.0, laws.drag.viscous(laws.nu, 1.0));
            law.transport(phi, laws.phi_max - phi, 1.0, k / laws.ratio).1
        };
        conductivity(1e-6 * NONE) > 0.5 * conductivity(NONE)
    }

    fn near(&self, state: &[Unknowns], shift: f64) -> Option<Growth> {
        let n = self.cells();
        let rate = self.laws.floors.rate;
        let trace: Vec<bool> = state.iter().map(|x| solid(&self.laws, x) < NONE).collect();
        let frozen: &[usize] = if self.trace_conducts() { &[LOGIT] } else { &[LOGIT, GRAINS, HEAT] };
        let mobilised: Vec<Mobilised> = self.shear(state).map(|s| Mobilised(s / s.hypot(rate))).collect();
        let linear = |factor: f64| {
            let mut linear = Linear::new(n);
            let memory = Memory { rate: factor, ..Memory::steady(n) };
            let setting = Setting { laws: &self.laws, rate: factor, mobilised: false, both_ways: true };
            self.linearise_as(&setting, state, (&memory, &mobilised), &mut linear);
            for i in (0..n).filter(|i| trace[*i]) {
                frozen.iter().for_each(|row| linear.freeze(i, *row));
                if i > 0 {
                    [VOLUME, RISE].into_iter().for_each(|row| linear.freeze(i - 1, row));
                }
            }
            linear
        };
        let mut shifted = linear(shift);
        if !shifted.norm(state).is_finite() {
            return None;
        }
        shifted.factor(state).ok()?;
        let (with, without) = (linear(1.0), linear(0.0));
        let velocity = self.laws.fall().recip();
        let apply = |x: &[f64]| -> Vec<f64> {
            let of = |i: usize, k: usize| x[SIZE * i + k] * unit(k, &state[i], velocity);
            let mut side = with.times(of);
            side.iter_mut().zip(without.times(of)).for_each(|(a, b)| *a -= b);
            shifted.solve(&mut side);
            side
        };
        let size = VECTORS.min(SIZE * n - 1);
        let start: Vec<f64> = (0..SIZE * n).map(|i| (i as f64 * 1.618).sin()).collect();
        let mut basis = vec![normal(apply(&start)).1];
        let mut hessenberg = DMatrix::<f64>::zeros(size + 1, size);
        for j in 0..size {
            let mut next = apply(&basis[j]);
            // Twice, against round-off.
            for _ in 0..2 {
                for (i, vector) in basis.iter().enumerate() {
                    let share: f64 = vector.iter().zip(&next).map(|(a, b)| a * b).sum();
                    hessenberg[(i, j)] += share;
                    next.iter_mut().zip(vector).for_each(|(x, v)| *x -= share * v);
                }
            }
            let (length, vector) = normal(next);
            hessenberg[(j + 1, j)] = length;
            if !length.is_finite() || length < f64::MIN_POSITIVE {
                return None;
            }
            basis.push(vector);
        }
        let square = hessenberg.rows(0, size).into_owned();
        let last = hessenberg[(size, size - 1)];
        let values = square.complex_eigenvalues();
        let growth = |value: &nalgebra::Complex<f64>| {
            let inverse = 1.0 / value;
            Growth { rate: shift - inverse.re, frequency: inverse.im.abs() }
        };
        let mut candidates: Vec<_> = values.iter().filter(|value| growth(value).rate.is_finite()).collect();
        candidates.sort_by(|a, b| growth(b).rate.total_cmp(&growth(a).rate));
        candidates.into_iter().find(|value| resolved(&square, **value, last)).map(growth)
    }
}

/// Whether an eigenvalue of the small matrix is one of the large one: its vector ends small.
fn resolved(small: &DMatrix<f64>, value: nalgebra::Complex<f64>, last: f64) -> bool {
    let n = small.nrows();
    // Inverse iteration for the vector of a Hessenberg matrix.
    let mut shifted = small.map(|x| nalgebra::Complex::new(x, 0.0));
    let nudge = value * (1.0 + 1e-10);
    for i in 0..n {
        shifted[(i, i)] -= nudge;
    }
    let lu = shifted.lu();
    let mut vector = nalgebra::DVector::from_element(n, nalgebra::Complex::new(1.0, 0.0));
    for _ in 0..2 {
        let Some(next) = lu.solve(&vector) else { return false };
        let length = next.norm();
        vector = next.unscale(length);
    }
    (vector[n - 1].norm() * last) < KNOWN * value.norm()
}

/// Length and direction.
fn normal(x: Vec<f64>) -> (f64, Vec<f64>) {
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length, x.into_iter().map(|x| x / length).collect())
}
