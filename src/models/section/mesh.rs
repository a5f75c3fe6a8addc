//! Structured meshes of half a cross-section, the other half by symmetry: nine-node quadrilaterals in columns and rows.
//!
//! ```text
//! z
//! |  ----- wall -----          y = b(z) eta_i,  z = z_j,  i = 0..2 columns, j = 0..2 rows
//! |  |   |   |   |  |          rectangle  b = W/2; planes: the same, with a plane of symmetry for the wall
//! |  |---|---|---|--| wall     circle     b = sqrt(z (D - z)),  z = D (1 - cos(pi s))/2
//! |  |   |   |   |  |
//! |  ----- wall -----          even i and j: corners of elements, odd ones: the middles of their sides
//! +------------------ y
//! ```
//!
//! Rows are horizontal, so that one of them can lie on a bed level, in a circle, too. There the lowest and the highest row end
//! in a point; its nodes coincide and lie on the wall, where the velocity is known. Lengths in units of the height.

use std::f64::consts::PI;

use crate::models::section::Outline;
use crate::numerics::levels::graded;

impl Outline {
    /// Half the width at height `z`.
    #[must_use]
    pub fn half_width(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { width } => 0.5 * width,
            Self::Circle => (z * (1.0 - z)).max(0.0).sqrt(),
            Self::Planes => 0.5,
        }
    }

    /// Area of the whole section.
    #[must_use]
    pub fn area(&self) -> f64 {
        match self {
            Self::Rectangle { width } => *width,
            Self::Circle => 0.25 * PI,
            Self::Planes => 1.0,
        }
    }

    /// Yield stress over the drive, -dp/dx times the height, from which on nothing moves: the smallest ratio of area to rim of all parts
    /// of the section, which has arcs of this radius for corners. Source: Mosolov & Miasnikov (1965), J. Appl. Math. Mech. 29, 545-577;
    /// Kawohl & Lachand-Robert (2006), Pacific J. Math. 225, 103-118.
    #[must_use]
    pub fn critical_yield(&self) -> f64 {
        match self {
            Self::Rectangle { width } => (1.0 + width - ((1.0 - width).powi(2) + PI * width).sqrt()) / (4.0 - PI),
            Self::Circle => 0.25,
            Self::Planes => 0.5,
        }
    }

    /// Height of the row at `s` in 0..1.
    fn height(&self, s: f64) -> f64 {
        match self {
            Self::Rectangle { .. } | Self::Planes => s,
            Self::Circle => (0.5 * PI * s).sin().powi(2),
        }
    }

    /// The `s` of a height.
    fn row_at(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { .. } | Self::Planes => z,
            Self::Circle => z.sqrt().asin() / (0.5 * PI),
        }
    }
}

/// Nodes and elements of half a section.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// outline
    pub shape: Outline,
    /// elements from the symmetry plane to the wall
    pub columns: usize,
    /// elements from the bottom to the top
    pub rows: usize,
    /// rows below the bed level
    pub bed_rows: usize,
    /// eta of the node columns
    pub eta: Vec<f64>,
    /// z of the nodes
    z: Vec<f64>,
}

/// How a mesh is divided.
#[derive(Clone, Debug, PartialEq)]
pub struct Division<'a> {
    /// elements from the symmetry plane to the wall
    pub columns: usize,
    /// elements from the bottom to the top
    pub rows: usize,
    /// bed level, on which a row ends
    pub bed: Option<f64>,
    /// heights of a yield line below the bed level, one per node column, on which a row ends, too
    pub line: Option<&'a [f64]>,
    /// size of the elements just below that line, and of those just above it over equal ones
    pub layer: (f64, f64),
    /// size of the elements at the walls and at the bed level over the equal one; 1: equal elements
    pub finest: f64,
}

impl Mesh {
    /// Divides a section.
    #[must_use]
    pub fn new(shape: Outline, division: &Division<'_>) -> Self {
        let Division { columns, rows, bed, line, layer, finest } = *division;
        let towards = |a: f64, b: f64, n: usize| {
            let finest = if finest < 1.0 { finest * (b - a) / n as f64 } else { f64::INFINITY };
            graded(a, b, n, finest)
        };
        let mirrored = |faces: Vec<f64>, a: f64, b: f64| faces.into_iter().rev().skip(1).map(move |s| a + b - s);
        let eta = Self::columns_at(columns, finest);
        let across = eta.len();
        let bed_rows = bed.map_or(0, |level| ((rows as f64 * shape.row_at(level)).round() as usize).clamp(2, rows - 1));
        let still_rows = if line.is_some() { bed_rows / 2 } else { 0 };
        let mut z = vec![0.0; across * (2 * rows + 1)];
        for i in 0..across {
            let mut s = vec![0.0];
            if let Some(level) = bed {
                let at = shape.row_at(level);
                // Towards the bed level from both sides, and towards the yield line.
                let mut from = 0.0;
                if let Some(line) = line {
                    // Rows keep a height where the surface nears the bottom or the bed level.
                    from = shape.row_at(line[i].clamp(0.02 * level, 0.98 * level));
                    s.extend(graded(0.0, from, still_rows, layer.0).into_iter().skip(1));
                }
                let mobile = bed_rows - still_rows;
                if line.is_some() && layer.1 < 1.0 {
                    let first = layer.1 * (at - from) / mobile as f64;
                    s.extend(mirrored(graded(from, at, mobile, first), from, at));
                } else {
                    s.extend(towards(from, at, mobile).into_iter().skip(1));
                }
                s.extend(mirrored(towards(at, 1.0, rows - bed_rows), at, 1.0));
            } else {
                s.extend(mirrored(towards(0.5, 1.0, rows / 2), 0.5, 1.0).map(|s| s - 0.5));
                s.extend(towards(0.5, 1.0, rows - rows / 2).into_iter().skip(1));
            }
            for (j, s) in with_middles(&s).iter().enumerate() {
                z[j * across + i] = shape.height(*s);
            }
            if let Some(level) = bed {
                z[2 * bed_rows * across + i] = level;
            }
        }
        Self { shape, columns, rows, bed_rows, eta, z }
    }

    /// eta of the node columns.
    #[must_use]
    pub fn columns_at(columns: usize, finest: f64) -> Vec<f64> {
        let finest = if finest < 1.0 { finest / columns as f64 } else { f64::INFINITY };
        with_middles(&graded(0.0, 1.0, columns, finest))
    }

    /// Node columns and node rows.
    #[must_use]
    pub fn lines(&self) -> (usize, usize) {
        (2 * self.columns + 1, 2 * self.rows + 1)
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        let (across, up) = self.lines();
        across * up
    }

    /// Number of elements.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.columns * self.rows
    }

    /// Node in node column `i` and node row `j`.
    #[must_use]
    pub fn node(&self, i: usize, j: usize) -> usize {
        j * (2 * self.columns + 1) + i
    }

    /// Position `(y, z)` of a node.
    #[must_use]
    pub fn position(&self, node: usize) -> (f64, f64) {
        let z = self.z[node];
        (self.eta[node % self.eta.len()] * self.shape.half_width(z), z)
    }

    /// Whether a node lies on the wall.
    #[must_use]
    pub fn on_wall(&self, node: usize) -> bool {
        let across = 2 * self.columns + 1;
        let (i, j) = (node % across, node / across);
        i == 2 * self.columns && self.shape != Outline::Planes || j == 0 || j == 2 * self.rows
    }

    /// Nodes of an element, row by row from the lower left.
    #[must_use]
    pub fn element(&self, element: usize) -> [usize; 9] {
        let (c, r) = (element % self.columns, element / self.columns);
        std::array::from_fn(|k| self.node(2 * c + k % 3, 2 * r + k / 3))
    }

    /// Nodes in the order of their elimination: nested dissection along sides of elements.
    #[must_use]
    pub fn dissection(&self) -> Vec<usize> {
        let (across, up) = self.lines();
        let mut order = Vec::with_capacity(across * up);
        dissect((0, across), (0, up), &mut |i, j| order.push(self.node(i, j)));
        order
    }
}

/// Nodes of a block in the order of their elimination: both halves first, then the side of elements between them.
fn dissect(x: (usize, usize), z: (usize, usize), see: &mut impl FnMut(usize, usize)) {
    let (wide, high) = (x.1 - x.0, z.1 - z.0);
    let middle = |(from, to): (usize, usize)| ((from + to) / 2) & !1;
    if wide.max(high) < 6 {
        (z.0..z.1).for_each(|j| (x.0..x.1).for_each(|i| see(i, j)));
    } else if wide >= high {
        let m = middle(x);
        dissect((x.0, m), z, see);
        dissect((m + 1, x.1), z, see);
        (z.0..z.1).for_each(|j| see(m, j));
    } else {
        let m = middle(z);
        dissect(x, (z.0, m), see);
        dissect(x, (m + 1, z.1), see);
        (x.0..x.1).for_each(|i| see(i, m));
    }
}

/// Every value and the mean of each with the next.
fn with_middles(values: &[f64]) -> Vec<f64> {
    let mut all = Vec::with_capacity(2 * values.len());
    for pair in values.windows(2) {
        all.extend([pair[0], 0.5 * (pair[0] + pair[1])]);
    }
    all.extend(values.last());
    all
}
