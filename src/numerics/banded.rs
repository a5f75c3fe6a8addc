//! Banded systems by Gaussian elimination with partial pivoting, factored once for several right-hand sides.
//!
//! ```text
//! row i holds the columns i - lower ..= i + upper, and `lower` more on the right, which row exchanges fill:
//!
//!   | x x x . .     |   lower = 1, upper = 2; a dot is an entry that an exchange may fill
//!   | x x x x . .   |
//!   |   x x x x . . |
//! ```
//!
//! Pivoting makes it safe where no diagonal dominance can be shown, such as saddle points; the growth of errors is that of
//! the dense elimination (Golub & Van Loan 2013, Matrix Computations, section 4.3.5). Cost: 2 n lower (lower + upper) for the
//! factors and 2 n (2 lower + upper) a right-hand side, in products and sums.

/// A square matrix with a band.
#[derive(Clone, Debug, PartialEq)]
pub struct Banded {
    n: usize,
    lower: usize,
    upper: usize,
    width: usize,
    entries: Vec<f64>,
    pivots: Vec<usize>,
}

/// A column without a usable pivot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular or not finite at column {column}")]
pub struct Singular {
    /// the column, from 0
    pub column: usize,
}

impl Banded {
    /// A matrix of zeros with `n` rows and `lower` and `upper` diagonals beside the main one.
    #[must_use]
    pub fn zeros(n: usize, lower: usize, upper: usize) -> Self {
        let width = 2 * lower + upper + 1;
        Self { n, lower, upper, width, entries: vec![0.0; n * width], pivots: Vec::new() }
    }

    /// Sets all entries to 0.
    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds `x` to the entry of row `i` and column `j`, which must lie in the band.
    pub fn add(&mut self, i: usize, j: usize, x: f64) {
        debug_assert!(i < self.n && j < self.n && j + self.lower >= i && j <= i + self.upper, "({i}, {j})");
        self.entries[i * self.width + j + self.lower - i] += x;
    }

    /// The product with the vector `x`.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let row = |i: usize| {
            let (first, last) = (i.saturating_sub(self.lower), (i + self.upper).min(self.n - 1));
            (first..=last).map(|j| self.entries[i * self.width + j + self.lower - i] * x[j]).sum()
        };
        (0..self.n).map(row).collect()
    }

    /// Factors the matrix in place, once and for any number of right-hand sides: [`Banded::solve`] needs it.
    ///
    /// # Errors
    /// [`Singular`] at the first column without a pivot.
    pub fn factor(&mut self) -> Result<(), Singular> {
        let (n, lower, width) = (self.n, self.lower, self.width);
        self.pivots.clear();
        for k in 0..n {
            let last = (k + lower).min(n - 1);
            let at = |i: usize| i * width + k + lower - i;
            let mut p = k;
            for i in k + 1..=last {
                if self.entries[at(i)].abs() > self.entries[at(p)].abs() {
                    p = i;
                }
            }
            let pivot = self.entries[at(p)];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(Singular { column: k });
            }
            self.pivots.push(p);
            let columns = (lower + self.upper).min(n - 1 - k) + 1;
            if p != k {
                for c in 0..columns {
                    self.entries.swap(at(k) + c, at(p) + c);
                }
            }
            for i in k + 1..=last {
                let (above, below) = self.entries.split_at_mut(i * width);
                let start = k + lower - i;
                let row = &mut below[start..start + columns];
                let factor = row[0] / pivot;
                // The multiplier takes the place of the entry that it removes.
                row[0] = factor;
                if factor != 0.0 {
                    let source = &above[k * width + lower + 1..k * width + lower + columns];
                    row[1..].iter_mut().zip(source).for_each(|(x, s)| *x -= factor * s);
                }
            }
        }
        Ok(())
    }

    /// Solves in place with the factors of [`Banded::factor`]: `side` becomes the solution.
    pub fn solve(&self, side: &mut [f64]) {
        let mut sides: Vec<[f64; 1]> = side.iter().map(|x| [*x]).collect();
        self.solve_several(&mut sides);
        side.iter_mut().zip(sides).for_each(|(x, [y])| *x = y);
    }

    /// As [`Banded::solve`], for `K` right-hand sides at once, row by row: the factors are read once.
    pub fn solve_several<const K: usize>(&self, sides: &mut [[f64; K]]) {
        let (n, lower, width) = (self.n, self.lower, self.width);
        for (k, &p) in self.pivots.iter().enumerate() {
            sides.swap(k, p);
            let x = sides[k];
            let last = (k + lower).min(n - 1);
            for (i, values) in sides.iter_mut().enumerate().take(last + 1).skip(k + 1) {
                let factor = self.entries[i * width + k + lower - i];
                for (value, x) in values.iter_mut().zip(&x) {
                    *value -= factor * x;
                }
            }
        }
        for i in (0..n).rev() {
            let columns = (lower + self.upper).min(n - 1 - i) + 1;
            let row = &self.entries[i * width + lower..i * width + lower + columns];
            let mut rest = sides[i];
            for (a, x) in row[1..].iter().zip(&sides[i + 1..]) {
                for (rest, x) in rest.iter_mut().zip(x) {
                    *rest -= a * x;
                }
            }
            sides[i] = rest.map(|x| x / row[0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn as_a_dense_solver(values in prop::collection::vec(-1.0..1.0f64, 40 * 6)) {
            let (n, lower, upper) = (40, 2, 3);
            let mut band = Banded::zeros(n, lower, upper);
            let mut dense = DMatrix::zeros(n, n);
            for i in 0..n {
                for j in i.saturating_sub(lower)..(i + upper + 1).min(n) {
                    let x = values[i * 6 + j + lower - i];
                    band.add(i, j, x);
                    dense[(i, j)] += x;
                }
            }
            let exact = DVector::from_fn(n, |i, _| (i as f64).sin());
            let mut x = (&dense * &exact).as_slice().to_vec();
            prop_assert!((DVector::from_vec(band.times(exact.as_slice())) - &dense * &exact).amax() < 1e-14);
            // A random matrix may be close to singular: what counts is the residual.
            if band.factor().is_ok() {
                band.solve(&mut x);
                let x = DVector::from_vec(x);
                let residual = (&dense * &x - &dense * &exact).amax();
                prop_assert!(residual <= 1e-12 * x.amax().max(1.0), "{residual}");
            }
        }
    }

    #[test]
    fn zeros_on_the_diagonal_are_exchanged_and_a_singular_column_is_named() {
        let mut band = Banded::zeros(2, 1, 1);
        band.add(0, 1, 2.0);
        band.add(1, 0, 4.0);
        let mut x = [2.0, 8.0];
        band.factor().unwrap();
        band.solve(&mut x);
        assert_eq!(x, [2.0, 1.0]);
        let mut band = Banded::zeros(3, 1, 1);
        band.add(0, 0, 1.0);
        band.add(2, 2, 1.0);
        assert_eq!(band.factor(), Err(Singular { column: 1 }));
    }
}
