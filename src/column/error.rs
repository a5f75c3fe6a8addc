//! What can go wrong in a column, with the numbers that say so.

use crate::numerics::thomas::Unsolved;

/// A column that cannot be set up, or a step that was not made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ColumnError {
    /// Fewer than two faces.
    #[error("a column needs at least 2 faces, not {faces}")]
    TooFewFaces {
        /// number of faces
        faces: usize,
    },
    /// Faces that do not ascend, or are not finite.
    #[error("face {index} at {above} m does not lie above the face at {below} m")]
    FacesNotAscending {
        /// the upper of the two faces, from 0
        index: usize,
        /// the lower face \[m]
        below: f64,
        /// the upper face \[m]
        above: f64,
    },
    /// An array that is not as long as the column has cells.
    #[error("{what} has {found} values for {cells} cells")]
    Length {
        /// the array
        what: &'static str,
        /// its length
        found: usize,
        /// cells of the column
        cells: usize,
    },
    /// A number that is not finite or out of range.
    #[error("{what} = {value}, but must be {allowed}")]
    Value {
        /// the quantity, with its unit
        what: &'static str,
        /// its value
        value: f64,
        /// what it may be
        allowed: &'static str,
    },
    /// A value in one cell that is not finite or out of range.
    #[error("{what} = {value} at z = {z} m, but must be {allowed}")]
    Cell {
        /// the quantity, with its unit
        what: &'static str,
        /// centre of the cell \[m]
        z: f64,
        /// its value
        value: f64,
        /// what it may be
        allowed: &'static str,
    },
    /// A roughness length that reaches the centre of the lowest cell.
    #[error("the roughness length {z_0} m is not below the centre of the lowest cell, {distance} m above the wall")]
    RoughnessAboveCell {
        /// roughness length \[m]
        z_0: f64,
        /// distance of the centre from the wall \[m]
        distance: f64,
    },
    /// A steady velocity that nothing holds.
    #[error("nothing holds a steady velocity: stresses at both ends, no drag, no side wall")]
    Adrift,
    /// A linear system without a solution.
    #[error("the momentum equations have no solution (iteration {iteration}): {reason}")]
    Singular {
        /// iteration, from 1
        iteration: usize,
        /// where the elimination stopped
        reason: Unsolved,
    },
    /// A velocity or a stress that is not finite.
    #[error("the momentum of the cell at z = {z} m is not finite (iteration {iteration})")]
    NotFinite {
        /// iteration, from 0
        iteration: usize,
        /// centre of the first such cell \[m]
        z: f64,
    },
    /// The iteration did not reach its tolerance.
    #[error("residual {residual} after {iterations} iterations, largest at z = {z} m; wanted {tolerance}")]
    NotConverged {
        /// iterations made
        iterations: usize,
        /// largest residual of a cell over the largest force in the column
        residual: f64,
        /// wanted residual
        tolerance: f64,
        /// centre of the cell of the largest residual \[m]
        z: f64,
    },
}
