//! Block-tridiagonal systems by double sweep.
//!
//! ```text
//! | B0 C0          | | x0 |   | d0 |
//! | A1 B1 C1       | | x1 |   | d1 |      blocks N x N, row i: A_i x_(i-1) + B_i x_i + C_i x_(i+1) = d_i
//! |    A2 B2 C2    | | x2 | = | d2 |      A_0 and C_(n-1) are not read
//! |       .  .  .  | | .  |   | .  |
//! ```

use nalgebra::{SMatrix, SVector};

/// One row of the system.
#[derive(Clone, Copy, Debug)]
pub struct Row<const N: usize> {
    /// block on the left of the diagonal
    pub lower: SMatrix<f64, N, N>,
    /// block on the diagonal
    pub diagonal: SMatrix<f64, N, N>,
    /// block on the right of the diagonal
    pub upper: SMatrix<f64, N, N>,
    /// right-hand side; the solution after [`solve`]
    pub rhs: SVector<f64, N>,
}

impl<const N: usize> Row<N> {
    /// A row of zeros.
    #[must_use]
    pub fn zero() -> Self {
        Self { lower: SMatrix::zeros(), diagonal: SMatrix::zeros(), upper: SMatrix::zeros(), rhs: SVector::zeros() }
    }
}

/// A diagonal block that cannot be inverted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the block of row {row} is singular")]
pub struct Singular {
    /// the row, from 0
    pub row: usize,
}

/// Solves in place; the solution is left in `rhs`. No pivoting between blocks: the diagonal blocks must stay regular, as
/// they do for diffusion with drag.
///
/// # Errors
/// [`Singular`] with the row.
pub fn solve<const N: usize>(rows: &mut [Row<N>]) -> Result<(), Singular> {
    for i in 0..rows.len() {
        if i > 0 {
            let (above, here) = rows.split_at_mut(i);
            let (above, here) = (&above[i - 1], &mut here[0]);
            here.diagonal -= here.lower * above.upper;
            here.rhs -= here.lower * above.rhs;
        }
        let row = &mut rows[i];
        let inverse = row.diagonal.try_inverse().ok_or(Singular { row: i })?;
        row.upper = inverse * row.upper;
        row.rhs = inverse * row.rhs;
    }
    for i in (0..rows.len().saturating_sub(1)).rev() {
        let next = rows[i + 1].rhs;
        let row = &mut rows[i];
        row.rhs -= row.upper * next;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

    #[test]
    fn equals_a_dense_solution() {
        let n = 7;
        let entry = |i: usize, j: usize, k: usize| ((i * 31 + j * 17 + k * 7) as f64).sin();
        let mut rows: Vec<Row<2>> = (0..n)
            .map(|i| Row {
                lower: Matrix2::from_fn(|r, c| entry(i, r, c)),
                diagonal: Matrix2::from_fn(|r, c| entry(i, c, r + 5)) + 4.0 * Matrix2::identity(),
                upper: Matrix2::from_fn(|r, c| entry(i, r + 3, c + 2)),
                rhs: Vector2::new(entry(i, 1, 9), entry(i, 2, 9)),
            })
            .collect();
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        let mut rhs = DVector::zeros(2 * n);
        for (i, row) in rows.iter().enumerate() {
            matrix.view_mut((2 * i, 2 * i), (2, 2)).copy_from(&row.diagonal);
            if i > 0 {
                matrix.view_mut((2 * i, 2 * i - 2), (2, 2)).copy_from(&row.lower);
            }
            if i + 1 < n {
                matrix.view_mut((2 * i, 2 * i + 2), (2, 2)).copy_from(&row.upper);
            }
            rhs.rows_mut(2 * i, 2).copy_from(&row.rhs);
        }
        let dense = matrix.lu().solve(&rhs).unwrap();
        solve(&mut rows).unwrap();
        for (i, row) in rows.iter().enumerate() {
            assert!((row.rhs - dense.rows(2 * i, 2)).norm() < 1e-13);
        }
    }

    #[test]
    fn a_singular_block_is_named() {
        let mut rows = vec![Row::<2> { diagonal: Matrix2::identity(), ..Row::zero() }, Row::zero()];
        assert_eq!(solve(&mut rows), Err(Singular { row: 1 }));
    }
}
