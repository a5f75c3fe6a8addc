//! Sparse symmetric positive definite systems: one pattern, many matrices. The only place that knows faer.
//!
//! The lower triangle is kept by columns, rows ascending, the diagonal first. The order of elimination and the pattern of the
//! factor are computed once, the numbers of the factor for every matrix.

use faer::Conj;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::Perm;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{MatMut, Par, Side};

/// Where the lower triangle of a symmetric matrix has entries.
#[derive(Clone, Debug)]
pub struct Pattern {
    starts: Vec<u32>,
    rows: Vec<u32>,
}

/// No Cholesky factor: the matrix is not positive definite, or too large for the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a matrix that should be positive definite is not")]
pub struct NotPositive;

impl Pattern {
    /// The pattern of a sum of dense blocks: `blocks` has the unknowns of each.
    #[must_use]
    pub fn of_blocks<'a>(n: usize, blocks: impl Iterator<Item = &'a [u32]> + Clone) -> Self {
        let mut count = vec![0_usize; n + 1];
        let below = |block: &'a [u32]| block.iter().flat_map(move |j| block.iter().map(move |i| (*i, *j)));
        let inside = |(i, j): &(u32, u32)| i >= j && (*i as usize) < n;
        for (_, j) in blocks.clone().flat_map(below).filter(inside) {
            count[j as usize + 1] += 1;
        }
        for j in 0..n {
            count[j + 1] += count[j];
        }
        let mut place = count.clone();
        let mut all = vec![0_u32; count[n]];
        for (i, j) in blocks.flat_map(below).filter(inside) {
            all[place[j as usize]] = i;
            place[j as usize] += 1;
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for j in 0..n {
            let column = &mut all[count[j]..count[j + 1]];
            column.sort_unstable();
            let first = rows.len();
            for i in column.iter() {
                if rows.len() == first || rows.last() != Some(i) {
                    rows.push(*i);
                }
            }
            starts.push(rows.len() as u32);
        }
        Self { starts, rows }
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of entries of the lower triangle.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// Row and column of each entry, in the order of the values.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.size()).flat_map(|j| {
            let (from, to) = (self.starts[j] as usize, self.starts[j + 1] as usize);
            self.rows[from..to].iter().map(move |i| (*i as usize, j))
        })
    }

    /// Place of the entry of row `i` and column `j`, or of `j` and `i`, among the values.
    #[must_use]
    pub fn slot(&self, i: u32, j: u32) -> Option<usize> {
        let (i, j) = (i.max(j), i.min(j) as usize);
        let (from, to) = (self.starts[j] as usize, self.starts[j + 1] as usize);
        self.rows[from..to].binary_search(&i).ok().map(|at| from + at)
    }

    /// `y = A x` for the matrix with these values.
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for j in 0..self.size() {
            let (from, to) = (self.starts[j] as usize, self.starts[j + 1] as usize);
            let mut sum = 0.0;
            for (a, i) in values[from..to].iter().zip(&self.rows[from..to]) {
                let i = *i as usize;
                if i == j {
                    sum += a * x[j];
                } else {
                    sum += a * x[i];
                    y[i] += a * x[j];
                }
            }
            y[j] += sum;
        }
    }
}

/// A Cholesky factor whose numbers can be computed again.
#[allow(missing_debug_implementations)]
pub struct Cholesky {
    pattern: Pattern,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

impl Cholesky {
    /// Analyses a pattern. `order` lists the unknowns in the order of their elimination; `None`: approximate minimum degree.
    ///
    /// # Errors
    /// [`NotPositive`] if the factor is too large for the machine.
    pub fn new(pattern: &Pattern, order: Option<&[u32]>) -> Result<Self, NotPositive> {
        let n = pattern.size();
        let matrix = SymbolicSparseColMatRef::new_checked(n, n, &pattern.starts, None, &pattern.rows);
        let permutation = order.map(|order| {
            let mut place = vec![0_u32; n];
            for (k, i) in order.iter().enumerate() {
                place[*i as usize] = k as u32;
            }
            Perm::new_checked(order.into(), place.into_boxed_slice(), n)
        });
        let ordering = permutation.as_ref().map_or(SymmetricOrdering::Amd, |p| SymmetricOrdering::Custom(p.as_ref()));
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(matrix, Side::Lower, ordering, params).map_err(|_| NotPositive)?;
        let need = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let memory = MemBuffer::try_new(need).map_err(|_| NotPositive)?;
        let factor = vec![0.0; symbolic.len_val()];
        Ok(Self { pattern: pattern.clone(), symbolic, factor, memory })
    }

    /// Computes the factor of the matrix with these values.
    ///
    /// # Errors
    /// [`NotPositive`].
    pub fn factorise(&mut self, values: &[f64]) -> Result<(), NotPositive> {
        let n = self.pattern.size();
        let symbolic = SymbolicSparseColMatRef::new_checked(n, n, &self.pattern.starts, None, &self.pattern.rows);
        let matrix = SparseColMatRef::new(symbolic, values);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|_| NotPositive)
    }

    /// Solves with the last factor, in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let n = x.len();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, n, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    /// Entries of the factor.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.factor.len()
    }
}
