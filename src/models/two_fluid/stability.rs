//! Whether a steady flow is stable: the growth of small disturbances.
//!
//! With the residuals `R(x, dQ/dt)`, A their derivative by x and B that by rates of change, disturbances `x exp(sigma t)` obey
//! `(A + sigma B) x = 0`. Arnoldi's method on `(A + s B)^-1 B`, whose eigenvalues are `1/(s - sigma)`, finds those near the shift
//! s; the largest real part over a few shifts is the growth rate, and the imaginary part the frequency of the oscillation.
//! Source: Saad (2011), Numerical Methods for Large Eigenvalue Problems, chapter 8.

use nalgebra::DMatrix;

use super::face::Mobilised;
use super::state::{SIZE, Unknowns};
use super::system::{Column, Linear, Memory, unit};

/// Shifts, over the rate at which grains fall.
const SHIFTS: [f64; 2] = [0.03, 0.3];
/// Vectors of Arnoldi's method.
const VECTORS: usize = 60;
/// Residual of an eigenvalue over itself below which it counts.
const KNOWN: f64 = 1e-6;

/// How a small disturbance goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// growth rate; the disturbance decays where it is negative
    pub rate: f64,
    /// angular frequency of its oscillation
    pub frequency: f64,
}

impl Column {
    /// The disturbance of the steady flow `state` that grows fastest, or decays slowest; `None` if no eigenvalue was found.
    #[must_use]
    pub fn growth(&self, state: &[Unknowns]) -> Option<Growth> {
        let found = SHIFTS.into_iter().filter_map(|shift| self.near(state, shift / self.laws.fall()));
        found.reduce(|a, b| if b.rate > a.rate { b } else { a })
    }

    fn near(&self, state: &[Unknowns], shift: f64) -> Option<Growth> {
        let n = self.cells();
        let rate = self.laws.floors.rate;
        let mobilised: Vec<Mobilised> = self.shear(state).map(|s| Mobilised(s / s.hypot(rate))).collect();
        let linear = |factor: f64| {
            let mut linear = Linear::new(n);
            let memory = Memory { rate: factor, ..Memory::steady(n) };
            self.linearise(state, &memory, &mobilised, &mut linear);
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
