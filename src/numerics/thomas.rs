//! Tridiagonal systems by a double sweep.
//!
//! ```text
//! | d0 u0          | | x0 |   | r0 |      row i:  lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = rhs[i]
//! | l1 d1 u1       | | x1 |   | r1 |
//! |    l2 d2 u2    | | x2 | = | r2 |      All four slices have one entry per row; lower[0] and the last upper
//! |       .  .  .  | | .. |   | .. |      lie outside the matrix and are never read. (Others store n - 1 entries
//! |          ln dn | | xn |   | rn |      and shift the lower diagonal by one: not here.)
//! ```
//!
//! Upwards the sweep eliminates the lower diagonal, downwards it substitutes: 2 divisions, 3 products and 3 differences a
//! row. There is no pivoting. It is not needed where the matrix is diagonally dominant, by rows or by columns
//! (`|d_i| >= |l_i| + |u_i|`, strictly in one row): no pivot vanishes then and errors do not grow (Higham 2002, Accuracy
//! and Stability of Numerical Algorithms, section 9.6). Multiplying rows or columns by factors keeps this property,
//! since it multiplies the pivots alike. Source: Thomas (1949); Thomas (1995), Numerical Partial Differential Equations.

use std::ops::{Div, Mul, Sub};

/// A tridiagonal system that was not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsolved {
    /// The elimination met a pivot that is zero or not a number.
    #[error("the pivot of row {row} of {rows} is zero or not a number")]
    ZeroPivot {
        /// the row, from 0
        row: usize,
        /// size of the system
        rows: usize,
    },
    /// The slices are not of one length.
    #[error("{rows} right-hand sides, but {lower}, {diagonal} and {upper} coefficients")]
    Lengths {
        /// entries of the right-hand side
        rows: usize,
        /// entries of the lower diagonal
        lower: usize,
        /// entries of the diagonal
        diagonal: usize,
        /// entries of the upper diagonal
        upper: usize,
    },
}

/// Solves in place: `rhs` becomes the solution, `upper` is used up. Nothing is allocated.
///
/// `T` is a real number or anything that computes like one, such as a dual number.
///
/// # Errors
/// [`Unsolved`] if a pivot is zero or not a number, or the slices are not of one length; `rhs` is no solution then.
pub fn solve<T>(lower: &[T], diagonal: &[T], upper: &mut [T], rhs: &mut [T]) -> Result<(), Unsolved>
where
    T: Copy + Default + PartialEq + Sub<Output = T> + Mul<Output = T> + Div<Output = T>,
{
    let rows = rhs.len();
    if lower.len() != rows || diagonal.len() != rows || upper.len() != rows {
        let (lower, diagonal, upper) = (lower.len(), diagonal.len(), upper.len());
        return Err(Unsolved::Lengths { rows, lower, diagonal, upper });
    }
    let (mut x, mut ratio) = (T::default(), T::default());
    for i in 0..rows {
        // Row 0 has no row below: what lies in lower[0] must not count.
        let (pivot, r) =
            if i == 0 { (diagonal[0], rhs[0]) } else { (diagonal[i] - lower[i] * ratio, rhs[i] - lower[i] * x) };
        #[allow(clippy::eq_op, reason = "only what is not a number differs from itself, for any T")]
        if pivot == T::default() || pivot != pivot {
            return Err(Unsolved::ZeroPivot { row: i, rows });
        }
        ratio = upper[i] / pivot;
        x = r / pivot;
        upper[i] = ratio;
        rhs[i] = x;
    }
    for i in (1..rows).rev() {
        rhs[i - 1] = rhs[i - 1] - upper[i - 1] * rhs[i];
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// Gaussian elimination with partial pivoting on the full matrix.
    fn dense(lower: &[f64], diagonal: &[f64], upper: &[f64], rhs: &[f64]) -> Vec<f64> {
        let n = rhs.len();
        let entry = |i: usize, j: usize| match j as isize - i as isize {
            -1 => lower[i],
            0 => diagonal[i],
            1 => upper[i],
            _ => 0.0,
        };
        // Rows with the right-hand side as their last entry.
        let row = |i: usize| (0..n).map(|j| entry(i, j)).chain([rhs[i]]).collect();
        let mut a: Vec<Vec<f64>> = (0..n).map(row).collect();
        for k in 0..n {
            let p = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
            a.swap(k, p);
            let pivot = a[k].clone();
            for row in &mut a[k + 1..] {
                let m = row[k] / pivot[k];
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= m * p);
            }
        }
        let mut x = vec![0.0; n];
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|j| a[i][j] * x[j]).sum();
            x[i] = (a[i][n] - known) / a[i][i];
        }
        x
    }

    proptest! {
        #[test]
        fn as_a_dense_solver(rows in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, 0.01..1.0f64, -1.0..1.0f64), 1..60)) {
            // Diagonally dominant by rows, the diagonal of either sign; garbage in the corners that must not be read.
            let n = rows.len();
            let mut lower: Vec<f64> = rows.iter().map(|r| r.0).collect();
            let mut upper: Vec<f64> = rows.iter().map(|r| r.1).collect();
            let diagonal: Vec<f64> = rows.iter().map(|r| (r.0.abs() + r.1.abs() + r.2) * r.3.signum()).collect();
            let rhs: Vec<f64> = rows.iter().map(|r| r.3).collect();
            let exact = dense(&lower, &diagonal, &upper, &rhs);
            (lower[0], upper[n - 1]) = (f64::NAN, f64::NAN);
            let mut x = rhs;
            solve(&lower, &diagonal, &mut upper, &mut x).unwrap();
            for (x, exact) in x.iter().zip(&exact) {
                prop_assert!((x - exact).abs() <= 1e-11 * exact.abs().max(1.0), "{x} {exact}");
            }
        }
    }

    #[test]
    fn a_small_system_by_hand() {
        // 2x + y = 4, x + 3y + z = 10, y + 4z = 14
        let mut x = [4.0, 10.0, 14.0];
        solve(&[0.0, 1.0, 1.0], &[2.0, 3.0, 4.0], &mut [1.0, 1.0, 0.0], &mut x).unwrap();
        for (x, exact) in x.into_iter().zip([1.0, 2.0, 3.0]) {
            assert_relative_eq!(x, exact, max_relative = 1e-15);
        }
        let mut x = [4.0_f32];
        solve(&[0.0], &[2.0], &mut [0.0], &mut x).unwrap();
        assert_eq!(x, [2.0]);
    }

    #[test]
    fn what_cannot_be_solved_is_reported() {
        // Two equal rows: singular, seen at the second pivot.
        let singular = solve(&[0.0, 1.0], &[1.0, 1.0], &mut [1.0, 0.0], &mut [1.0, 2.0]);
        assert_eq!(singular, Err(Unsolved::ZeroPivot { row: 1, rows: 2 }));
        let nan = solve(&[0.0, 1.0], &[f64::NAN, 1.0], &mut [1.0, 0.0], &mut [1.0, 2.0]);
        assert_eq!(nan, Err(Unsolved::ZeroPivot { row: 0, rows: 2 }));
        let short = solve(&[0.0], &[1.0, 1.0], &mut [1.0, 0.0], &mut [1.0, 2.0]);
        assert_eq!(short, Err(Unsolved::Lengths { rows: 2, lower: 1, diagonal: 2, upper: 2 }));
        assert_eq!(solve::<f64>(&[], &[], &mut [], &mut []), Ok(()));
    }
}
