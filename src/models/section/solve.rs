//! From a duct to its solution: the method that the case asks for, on a mesh that follows the yield surface of a bed.

use std::ops::ControlFlow;

use super::duct::{Divided, Duct, Filling};
use super::fit::along;
use super::mesh::Mesh;
use super::newton::{Solved, Unsolved};
use super::{dual, newton};
use crate::closures::regularisation::Regularisation;
use crate::models::section::{Method, Outline, SectionMethod};

/// Rows of the coarsest mesh on which the yield surface is looked for.
const COARSEST: usize = 24;
/// Iterations of solving and dividing on the coarsest mesh; on the others one is enough.
const DIVISIONS: usize = 3;

/// Size of the elements at the walls near the stop over what is missing to it, half of the layer that is sheared, and over equal elements
/// at least: arcs in the corners, which no row follows, need elements, too.
const IN_LAYER: f64 = 0.25;
const THINNEST: f64 = 0.05;

/// A solved duct.
#[derive(Clone, Debug)]
pub struct Solution {
    /// its elements
    pub divided: Divided,
    /// unknowns, strains, stresses
    pub solved: Solved<2>,
    /// yield surface of the bed: height in each node column
    pub line: Option<Vec<f64>>,
    /// iterations on all meshes
    pub iterations: usize,
}

impl Duct {
    /// Elements across half of the section, for `rows` from the bottom to the top.
    #[must_use]
    pub fn columns(&self, rows: usize) -> usize {
        match self.shape {
            Outline::Rectangle { width } => ((0.5 * width * rows as f64).round() as usize).clamp(3, 2 * rows),
            Outline::Circle => rows / 2,
            Outline::Planes => 1,
        }
    }

    /// Yield stress over that from which on nothing moves; for a Bingham fluid.
    #[must_use]
    pub fn yield_over_critical(&self) -> Option<f64> {
        match self.filling {
            Filling::Bingham(y) => Some(y / (self.f * self.shape.critical_yield())),
            Filling::Bed { .. } => None,
        }
    }

    /// Size of the elements at the walls over that of equal ones, `finest` or less: near the stop of a Bingham fluid nothing but a layer
    /// at the walls is sheared, half as thick as what is missing to the stop. Elements that do not fit into it do not yield.
    fn finest(&self, rows: usize, finest: f64) -> f64 {
        let Some(share) = self.yield_over_critical() else { return finest };
        let narrowest = if let Outline::Rectangle { width } = self.shape { width.min(1.0) } else { 1.0 };
        finest.min((IN_LAYER * narrowest * rows as f64 * (1.0 - share)).max(THINNEST))
    }

    /// Solves on `rows` elements from the bottom to the top; `see` receives the number of unknowns and the relative change of
    /// each iteration.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn solve(
        &self,
        rows: usize,
        law: &Regularisation,
        how: &SectionMethod,
        see: &mut dyn FnMut(usize, f64) -> ControlFlow<()>,
    ) -> Result<Solution, Unsolved> {
        let mut iterations = 0;
        let mut on = |rows: usize, line: Option<&[f64]>, last: bool| -> Result<Solution, Unsolved> {
            let divided = self.divide(self.columns(rows), rows, self.finest(rows, how.finest), line);
            let n = divided.program.size();
            let mut see = |change: f64| see(n, change);
            let solved = match how.method {
                // The mesh follows the exact yield surface, whatever the law.
                _ if !last => newton::solve(&divided.program, &Regularisation::EXACT, &mut see)?,
                Method::Newton => newton::solve(&divided.program, law, &mut see)?,
                Method::FirstOrder => dual::solve(&divided.program, how.tolerance, how.iterations, &mut see)?,
            };
            iterations += solved.history.len();
            let line = if law.is_exact() || !last {
                divided.yield_line(&divided.velocity(&solved.x), &divided.grains(&solved.x))
            } else {
                line.map(<[f64]>::to_vec)
            };
            Ok(Solution { divided, solved, line, iterations })
        };
        let followed = how.yield_row && matches!(self.filling, Filling::Bed { .. });
        if !followed {
            return on(rows, None, true);
        }
        // The yield surface from coarse to fine: on the last mesh it moves by less than an element.
        let mut meshes = vec![rows];
        while let Some(coarser) = meshes.last().map(|n| n / 2).filter(|n| *n >= COARSEST) {
            meshes.push(coarser);
        }
        let mut line: Option<(Vec<f64>, Vec<f64>)> = None;
        for (k, n) in meshes.iter().enumerate().rev() {
            let iterations = if k + 1 == meshes.len() { DIVISIONS + usize::from(k == 0) } else { 1 };
            for iteration in 0..iterations {
                let eta = Mesh::columns_at(self.columns(*n), how.finest);
                let here = line.as_ref().map(|(from, line)| along(from, line, &eta));
                let last = k == 0 && iteration + 1 == iterations;
                let solution = on(*n, here.as_deref(), last)?;
                if last {
                    return Ok(solution);
                }
                let Some(found) = solution.line else { break };
                line = Some((solution.divided.mesh.eta.clone(), found));
            }
            if line.is_none() {
                break;
            }
        }
        // No yield surface that a row could follow: the bed is at rest, or moves down to the wall.
        on(rows, None, true)
    }
}
