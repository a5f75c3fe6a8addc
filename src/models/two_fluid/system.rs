//! The whole column: residuals, their derivatives, and Newton's step.
//!
//! Rows of cell i: how the volume above its upper face changes, the vertical momentum there, what the cell holds, momentum of
//! the fluid, of the grains, fluctuation energy, mixing length. At the top no grains are above and none pass.

use super::cell::{Inside, Past};
use super::face::{Clock, Face, Halves, Mobilised, Setting};
use super::laws::Laws;
use super::state::{Cell, FLUID, GRAINS, RISE, SIZE, Unknowns, VOLUME};
use crate::numerics::banded::{Banded, Singular};
use crate::numerics::dual::{Dual, Real};

/// Unknowns of a cell and of the one below it.
const PAIR: usize = 2 * SIZE;
/// Unknowns of a cell and the vertical velocity below it.
const INNER: usize = SIZE + 1;
/// Solid volume that is none.
const LEAST: f64 = 1e-200;
/// Diagonals on either side.
const BAND: usize = 2 * SIZE - 1;

/// A column in cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// laws
    pub laws: Laws,
    /// heights of the cells
    pub widths: Vec<f64>,
    /// where they are fine, and where the column ends
    pub spacing: Spacing,
    /// solid volume per area
    pub solids: f64,
}

/// How the cells of a column share its height: z = level + fine sinh(s) with s in equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing {
    /// height of the column
    pub height: f64,
    /// level at which the cells are finest
    pub level: f64,
    /// distance from it within which they stay fine; all of the same height without
    pub fine: Option<f64>,
}

impl Spacing {
    /// Heights of `cells` cells.
    #[must_use]
    pub fn widths(&self, cells: usize) -> Vec<f64> {
        let n = cells as f64;
        let Some(fine) = self.fine else { return vec![self.height / n; cells] };
        let (low, high) = ((-self.level / fine).asinh(), ((self.height - self.level) / fine).asinh());
        let half = 0.5 * (high - low) / n;
        // The difference of two hyperbolic sines, without their cancellation.
        let width = |i: usize| 2.0 * fine * half.sinh() * (low + (2 * i + 1) as f64 * half).cosh();
        (0..cells).map(width).collect()
    }
}

/// What is known of the time derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Memory {
    /// factor of the new values; 0 where the flow is steady
    pub rate: f64,
    /// of each cell: volume, rise, fluid, grains, heat
    pub past: Vec<[f64; 5]>,
}

impl Memory {
    /// A steady flow.
    #[must_use]
    pub fn steady(cells: usize) -> Self {
        Self { rate: 0.0, past: vec![[0.0; 5]; cells] }
    }

    fn of(&self, i: usize) -> (Clock, Past) {
        let [volume, rise, fluid, grains, heat] = self.past[i];
        (Clock { volume, rise }, Past { fluid, grains, heat })
    }
}

/// What is carried in the time derivatives: volume above, vertical velocity, momentum of the fluid, of the grains over r,
/// fluctuation energy over 3/2 r.
#[must_use]
pub fn carried(laws: &Laws, x: &Unknowns) -> [f64; 5] {
    let cell = Cell::new(laws, x);
    [cell.volume, cell.rise, (1.0 - cell.phi) * cell.u, cell.phi * cell.v, cell.phi * cell.t]
}

/// Residuals and their derivatives.
#[derive(Clone, Debug)]
pub struct Linear {
    pub(super) residual: Vec<f64>,
    /// derivatives of the rows of each cell by the unknowns of the cell below, its own, those of the cell above
    blocks: Vec<[[[f64; SIZE]; SIZE]; 3]>,
    matrix: Banded,
    /// the part of each row that its largest entry is
    scales: Vec<f64>,
    /// what velocities are measured in
    velocity: f64,
    /// friction of enduring contacts at the end of the last solution
    pub mobilised: Vec<Mobilised>,
}

impl Column {
    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.widths.len()
    }

    fn halves(&self, face: usize) -> Halves {
        Halves { lower: 0.5 * self.widths[face - 1], upper: 0.5 * self.widths[face] }
    }

    /// Faces 0 to n - 1, without the top, through which nothing passes, and the cells.
    #[must_use]
    pub fn evaluate(
        &self,
        state: &[Unknowns],
        memory: &Memory,
        mobilised: &[Mobilised],
    ) -> (Vec<Face<f64>>, Vec<Inside<f64>>) {
        let setting = Setting { laws: &self.laws, rate: memory.rate, mobilised: true, both_ways: false };
        let cells: Vec<Cell<f64>> = state.iter().map(|x| Cell::new(&self.laws, x)).collect();
        let mut faces = vec![setting.wall(0.5 * self.widths[0], &cells[0], self.solids, mobilised[0])];
        let mut inside = Vec::with_capacity(cells.len());
        for (i, cell) in cells.iter().enumerate() {
            if i > 0 {
                faces.push(setting.face(self.halves(i), &cells[i - 1], cell, (memory.of(i - 1).0, mobilised[i])));
            }
            let below = if i > 0 { cells[i - 1].rise } else { 0.0 };
            inside.push(setting.inside(self.widths[i], cell, below, &memory.of(i).1));
        }
        (faces, inside)
    }

    /// What the momenta of fluid and grains miss in each cell, with the friction of enduring contacts that is mobilised.
    #[must_use]
    pub fn missed(&self, state: &[Unknowns], memory: &Memory, mobilised: &[Mobilised]) -> Vec<[f64; 2]> {
        let (faces, inside) = self.evaluate(state, memory, mobilised);
        let of = |rows: &[f64; SIZE]| [rows[FLUID], rows[GRAINS]];
        let sum = |i: usize| {
            let above = faces.get(i + 1).map_or([0.0; 2], |face| of(&face.lower));
            let (below, within) = (of(&faces[i].upper), of(&inside[i].rows));
            [below[0] + within[0] + above[0], below[1] + within[1] + above[1]]
        };
        (0..self.cells()).map(sum).collect()
    }

    /// Shear rates of the grains at the faces 0 to n - 1.
    pub fn shear(&self, state: &[Unknowns]) -> impl Iterator<Item = f64> {
        (0..self.cells()).map(|i| match i.checked_sub(1) {
            None => state[0][GRAINS] / (0.5 * self.widths[0]),
            Some(j) => (state[i][GRAINS] - state[j][GRAINS]) / (0.5 * (self.widths[i] + self.widths[j])),
        })
    }

    /// Residuals and derivatives at `state`.
    pub fn linearise(&self, state: &[Unknowns], memory: &Memory, mobilised: &[Mobilised], linear: &mut Linear) {
        let setting = Setting { laws: &self.laws, rate: memory.rate, mobilised: false, both_ways: false };
        self.linearise_as(&setting, state, (memory, mobilised), linear);
    }

    /// As [`Self::linearise`], of what `setting` says.
    pub(super) fn linearise_as(
        &self,
        setting: &Setting<'_>,
        state: &[Unknowns],
        (memory, mobilised): (&Memory, &[Mobilised]),
        linear: &mut Linear,
    ) {
        let n = self.cells();
        linear.residual.fill(0.0);
        linear.velocity = self.laws.fall().recip();
        linear.blocks.fill([[[0.0; SIZE]; SIZE]; 3]);
        let mut below: Option<Cell<Dual<SIZE>>> = None;
        for i in 0..n {
            let cell = Cell::linearised(&self.laws, &state[i]);
            match &below {
                None => {
                    let wall = setting.wall(0.5 * self.widths[0], &cell, self.solids, mobilised[0]);
                    linear.add(0, 1, 0, &wall.upper);
                    linear.value(0, &wall.upper);
                }
                Some(lower) => {
                    let (lower, upper) = (lower.among::<PAIR>(0), cell.among::<PAIR>(SIZE));
                    let face = setting.face(self.halves(i), &lower, &upper, (memory.of(i - 1).0, mobilised[i]));
                    linear.add(i - 1, 1, 0, &face.lower);
                    linear.add(i - 1, 2, SIZE, &face.lower);
                    linear.add(i, 0, 0, &face.upper);
                    linear.add(i, 1, SIZE, &face.upper);
                    linear.value(i - 1, &face.lower);
                    linear.value(i, &face.upper);
                }
            }
            let rise = if i > 0 { state[i - 1][RISE] } else { 0.0 };
            let falling = if i > 0 { Dual::variable(rise, SIZE) } else { Dual::constant(0.0) };
            let inside = setting.inside(self.widths[i], &cell.among::<INNER>(0), falling, &memory.of(i).1);
            linear.inside(i, &inside);
            below = Some(cell);
        }
        linear.top(n - 1, &state[n - 1]);
    }
}

impl Linear {
    /// For `cells` cells.
    #[must_use]
    pub fn new(cells: usize) -> Self {
        Self {
            residual: vec![0.0; SIZE * cells],
            blocks: vec![[[[0.0; SIZE]; SIZE]; 3]; cells],
            matrix: Banded::zeros(SIZE * cells, BAND, BAND),
            scales: vec![1.0; SIZE * cells],
            velocity: 1.0,
            mobilised: vec![Mobilised::default(); cells],
        }
    }

    /// Replaces the row of an unknown: it does not change.
    pub(super) fn freeze(&mut self, cell: usize, row: usize) {
        self.residual[SIZE * cell + row] = 0.0;
        for block in &mut self.blocks[cell] {
            block[row] = [0.0; SIZE];
        }
        self.blocks[cell][1][row][row] = 1.0;
    }

    /// The derivatives along the direction that `of` gives to each unknown of each cell.
    #[must_use]
    pub fn times(&self, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let n = self.blocks.len();
        let mut product = vec![0.0; SIZE * n];
        for (i, blocks) in self.blocks.iter().enumerate() {
            for (side, block) in blocks.iter().enumerate() {
                let Some(j) = (i + side).checked_sub(1).filter(|j| *j < n) else { continue };
                for (row, slopes) in block.iter().enumerate() {
                    product[SIZE * i + row] +=
                        slopes.iter().enumerate().map(|(k, slope)| slope * of(j, k)).sum::<f64>();
                }
            }
        }
        product
    }

    fn add<const N: usize>(&mut self, cell: usize, block: usize, first: usize, rows: &[Dual<N>; SIZE]) {
        let target = &mut self.blocks[cell][block];
        for (row, dual) in target.iter_mut().zip(rows) {
            for (entry, slope) in row.iter_mut().zip(&dual.slope[first..first + SIZE]) {
                *entry += slope;
            }
        }
    }

    fn value<const N: usize>(&mut self, cell: usize, rows: &[Dual<N>; SIZE]) {
        for (k, dual) in rows.iter().enumerate() {
            self.residual[SIZE * cell + k] += dual.value;
        }
    }

    fn inside(&mut self, i: usize, inside: &Inside<Dual<INNER>>) {
        self.add(i, 1, 0, &inside.rows);
        self.value(i, &inside.rows);
        let [lower, upper] = &inside.falling;
        for (row, dual) in inside.rows.iter().enumerate() {
            if i > 0 {
                self.blocks[i][0][row][RISE] += dual.slope[SIZE];
            }
        }
        self.residual[SIZE * i + RISE] += upper.value;
        for k in 0..SIZE {
            self.blocks[i][1][RISE][k] += upper.slope[k];
        }
        if i > 0 {
            self.blocks[i][0][RISE][RISE] += upper.slope[SIZE];
            self.residual[SIZE * (i - 1) + RISE] += lower.value;
            for k in 0..SIZE {
                self.blocks[i - 1][2][RISE][k] += lower.slope[k];
            }
            self.blocks[i - 1][1][RISE][RISE] += lower.slope[SIZE];
        }
    }

    /// Nothing above the top, and nothing passes.
    fn top(&mut self, i: usize, x: &Unknowns) {
        for row in [VOLUME, RISE] {
            self.residual[SIZE * i + row] = x[row];
            for block in &mut self.blocks[i] {
                block[row] = [0.0; SIZE];
            }
            self.blocks[i][1][row][row] = 1.0;
        }
        // The cell still holds what is above its lower face.
        let row = super::state::LOGIT;
        self.residual[SIZE * i + row] -= x[VOLUME];
        self.blocks[i][1][row][VOLUME] -= 1.0;
        // The mixing length at the top.
        let length = super::state::LENGTH;
        self.residual[SIZE * i + length] += x[length];
        self.blocks[i][1][length][length] += 1.0;
    }

    /// Largest residual, each in units of the change of an unknown that would remove it.
    ///
    /// The unknown volumes are measured in themselves, since they fall by many decades towards the top.
    pub fn norm(&mut self, state: &[Unknowns]) -> f64 {
        let mut largest: f64 = 0.0;
        for (i, blocks) in self.blocks.iter().enumerate() {
            for row in 0..SIZE {
                let mut scale: f64 = 0.0;
                for (block, x) in blocks.iter().zip(neighbours(state, i)) {
                    let Some(x) = x else { continue };
                    for (k, slope) in block[row].iter().enumerate() {
                        scale = scale.max((slope * unit(k, x, self.velocity)).abs());
                    }
                }
                self.scales[SIZE * i + row] = scale;
                let part = self.residual[SIZE * i + row].abs() / scale;
                if !(part.is_finite()) {
                    return f64::NAN;
                }
                largest = largest.max(part);
            }
        }
        largest
    }

    /// Newton's step in units of [`unit()`], after [`Self::norm`].
    ///
    /// # Errors
    /// [`Singular`] if the matrix is.
    pub fn step(&mut self, state: &[Unknowns]) -> Result<Vec<f64>, Singular> {
        self.factor(state)?;
        let mut step: Vec<f64> = self.residual.iter().map(|x| -x).collect();
        self.solve(&mut step);
        Ok(step)
    }

    /// Solves with the factors of [`Self::factor`], in place: from a side in the units of the residuals to unknowns in those of
    /// [`unit()`].
    pub fn solve(&self, side: &mut [f64]) {
        side.iter_mut().zip(&self.scales).for_each(|(x, scale)| *x /= scale);
        self.matrix.solve(side);
    }

    /// Factors the derivatives, after [`Self::norm`].
    ///
    /// # Errors
    /// [`Singular`] if the matrix is.
    pub fn factor(&mut self, state: &[Unknowns]) -> Result<(), Singular> {
        self.matrix.clear();
        for (i, blocks) in self.blocks.iter().enumerate() {
            for (side, (block, x)) in blocks.iter().zip(neighbours(state, i)).enumerate() {
                let Some(x) = x else { continue };
                for (row, slopes) in block.iter().enumerate() {
                    let at = SIZE * i + row;
                    for (k, slope) in slopes.iter().enumerate() {
                        let column = SIZE * (i + side) - SIZE + k;
                        self.matrix.add(at, column, slope * unit(k, x, self.velocity) / self.scales[at]);
                    }
                }
            }
        }
        self.matrix.factor()
    }
}

/// What the unknown `k` is measured in, velocities in `velocity`: that of grains that fall their diameter in a vacuum, which
/// a fluid of any weight leaves as it is.
#[must_use]
pub fn unit(k: usize, x: &Unknowns, velocity: f64) -> f64 {
    match k {
        VOLUME => x[VOLUME].abs().max(LEAST),
        RISE | FLUID | GRAINS => velocity,
        _ => 1.0,
    }
}

fn neighbours(state: &[Unknowns], i: usize) -> [Option<&Unknowns>; 3] {
    [i.checked_sub(1).and_then(|j| state.get(j)), state.get(i), state.get(i + 1)]
}
