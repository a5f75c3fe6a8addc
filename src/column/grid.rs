//! Cells of a column, given by their faces.
//!
//! ```text
//!   z ^
//!     |   faces    cells           lives on faces (n + 1 values)        lives in cells (n values, at the centres)
//!     |   ── n ──  ───────────     stresses tau, R; mixing length       solid fraction phi, velocities u_f, u_p
//!     |            .  n-1          l_m; velocity gradient; the walls    drag beta, forces; effective viscosity eta_e
//!     |   ─ n-1 ─  ───────────
//!     |            .  ...          width[i]    = face[i+1] - face[i]
//!     |   ── 2 ──  ───────────     distance[f] = centre[f] - centre[f-1] between two cells,
//!     |            .  1                          half a width at the first and the last face
//!     |   ── 1 ──  ───────────
//!     |            .  0            The centre is the middle of the cell. Cell i lies between the faces i and i + 1.
//!     |   ── 0 ──  ═══════════
//! ```
//!
//! A balance over cell i takes what enters through its faces, so that row i of every matrix couples it with its neighbours:
//! `lower[i]` multiplies cell i - 1, `diagonal[i]` cell i, `upper[i]` cell i + 1 ([`crate::numerics::thomas`]).
//!
//! Widths may vary. Order 2 needs them to vary smoothly, as a smooth map of equal cells does
//! ([`crate::numerics::levels::graded`]).

use super::ColumnError;

/// The cells of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    faces: Vec<f64>,
    centres: Vec<f64>,
    widths: Vec<f64>,
    distances: Vec<f64>,
}

impl Grid {
    /// `cells` equal cells from `bottom` \[m] to `top` \[m].
    ///
    /// # Errors
    /// [`ColumnError`] if there is no cell, or the top is not above the bottom.
    pub fn uniform(bottom: f64, top: f64, cells: usize) -> Result<Self, ColumnError> {
        let at = |i: usize| if i == cells { top } else { bottom + (top - bottom) * (i as f64 / cells as f64) };
        Self::from_faces((0..=cells).map(at).collect())
    }

    /// The cells between the ascending `faces` \[m].
    ///
    /// # Errors
    /// [`ColumnError`] if there are fewer than two faces, or they do not ascend, or one is not finite.
    pub fn from_faces(faces: Vec<f64>) -> Result<Self, ColumnError> {
        if faces.len() < 2 {
            return Err(ColumnError::TooFewFaces { faces: faces.len() });
        }
        for (i, pair) in faces.windows(2).enumerate() {
            let (below, above) = (pair[0], pair[1]);
            if !(below < above && (above - below).is_finite()) {
                return Err(ColumnError::FacesNotAscending { index: i + 1, below, above });
            }
        }
        let widths: Vec<f64> = faces.windows(2).map(|f| f[1] - f[0]).collect();
        let centres = faces.windows(2).map(|f| 0.5 * (f[0] + f[1])).collect();
        // From the widths, not from the centres, so that the two half cells add up exactly.
        let half = |i: usize| 0.5 * widths.get(i).copied().unwrap_or(0.0);
        let distances = (0..faces.len()).map(|f| if f == 0 { half(0) } else { half(f - 1) + half(f) }).collect();
        Ok(Self { faces, centres, widths, distances })
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.widths.len()
    }

    /// Elevations of the faces \[m], one more than cells.
    #[must_use]
    pub fn faces(&self) -> &[f64] {
        &self.faces
    }

    /// Elevations of the centres \[m].
    #[must_use]
    pub fn centres(&self) -> &[f64] {
        &self.centres
    }

    /// Widths of the cells \[m].
    #[must_use]
    pub fn widths(&self) -> &[f64] {
        &self.widths
    }

    /// Distances \[m] over which the velocity differs at each face: between two centres, or from a centre to the wall.
    #[must_use]
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_things_are() {
        let grid = Grid::from_faces(vec![0.0, 1.0, 3.0, 7.0]).unwrap();
        assert_eq!(grid.cells(), 3);
        assert_eq!(grid.centres(), [0.5, 2.0, 5.0]);
        assert_eq!(grid.widths(), [1.0, 2.0, 4.0]);
        assert_eq!(grid.distances(), [0.5, 1.5, 3.0, 2.0]);
        let grid = Grid::uniform(-1.0, 1.0, 4).unwrap();
        assert_eq!(grid.faces(), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert_eq!(grid.distances(), [0.25, 0.5, 0.5, 0.5, 0.25]);
    }

    #[test]
    fn what_is_no_grid_is_said() {
        assert_eq!(Grid::uniform(0.0, 1.0, 0), Err(ColumnError::TooFewFaces { faces: 1 }));
        let equal = Grid::from_faces(vec![0.0, 1.0, 1.0]);
        assert_eq!(equal, Err(ColumnError::FacesNotAscending { index: 2, below: 1.0, above: 1.0 }));
        assert!(Grid::uniform(1.0, 0.0, 3).is_err());
        assert!(Grid::uniform(0.0, f64::INFINITY, 3).is_err());
        assert!(Grid::from_faces(vec![0.0, f64::NAN, 2.0]).is_err());
    }
}
