//! What a state says of each cell, in the units of the grains.

use super::face::Mobilised;
use super::laws::Laws;
use super::start::middles;
use super::state::{Cell, Unknowns};
use super::system::{Column, Memory};
use crate::closures::kinetic::Moving;
use crate::closures::kinetic::radial::AtContact;
use crate::closures::mixing_length::Length;

/// Below this solid fraction there are no grains to speak of.
pub const NONE: f64 = 1e-6;

/// One cell.
#[derive(Clone, Copy, Debug, Default)]
pub struct Level {
    /// elevation of the middle
    pub z: f64,
    /// height
    pub dz: f64,
    /// solid fraction
    pub phi: f64,
    /// velocities of fluid and grains
    pub u: f64,
    /// see `u`
    pub v: f64,
    /// granular temperature
    pub t: f64,
    /// viscous stress of the fluid
    pub viscous: f64,
    /// turbulent stress of the fluid
    pub turbulent: f64,
    /// stress of moving grains
    pub kinetic: f64,
    /// stress of enduring contacts
    pub contact: f64,
    /// pressure of moving grains
    pub pressure: f64,
    /// pressure of enduring contacts
    pub elastic: f64,
    /// shear rate of the grains
    pub shear: f64,
    /// mixing length
    pub length: f64,
    /// eddy viscosity
    pub eddy: f64,
    /// production of fluctuation energy
    pub production: f64,
    /// its flux upward
    pub flux: f64,
    /// what its flux brings
    pub diffusion: f64,
    /// what contacts dissipate
    pub contacts: f64,
    /// what the drag takes
    pub drag_work: f64,
    /// drag on the grains
    pub drag: f64,
    /// radial distribution function
    pub radial: Option<f64>,
}

/// A solved column in levels.
#[derive(Clone, Debug)]
pub struct Levels {
    /// cells, from the bottom
    pub cells: Vec<Level>,
    /// stress of fluid and of grains on the bottom
    pub bottom: [f64; 2],
}

impl Levels {
    /// The levels of `state`, with the friction of enduring contacts that is mobilised.
    #[must_use]
    pub fn new(column: &Column, state: &[Unknowns], mobilised: &[Mobilised]) -> Self {
        let (faces, inside) = column.evaluate(state, &Memory::steady(column.cells()), mobilised);
        let laws = &column.laws;
        let heights = middles(&column.widths);
        let kinetic = matches!(laws.moving, Moving::Kinetic(_));
        let cells = inside.iter().enumerate().map(|(i, inside)| {
            let cell = Cell::new(laws, &state[i]);
            let (below, above) = (&faces[i], faces.get(i + 1));
            let mean = |of: fn(&super::face::Face<f64>) -> f64| 0.5 * (of(below) + above.map_or(0.0, of));
            let dz = column.widths[i];
            let work = |face: &super::face::Face<f64>| face.kinetic * face.shear;
            let length = |i: usize| laws.mixing_length.length(state[i].as_slice()[super::state::LENGTH], cell.phi);
            Level {
                z: heights[i],
                dz,
                phi: cell.phi,
                u: cell.u,
                v: cell.v,
                t: cell.t,
                viscous: mean(|face| face.viscous),
                turbulent: mean(|face| face.turbulent),
                kinetic: mean(|face| face.kinetic),
                contact: mean(|face| face.contact),
                pressure: cell.kinetic,
                elastic: cell.elastic,
                shear: mean(|face| face.shear),
                length: 0.5 * (i.checked_sub(1).map_or(0.0, length) + length(i)),
                eddy: mean(|face| face.eddy),
                production: if kinetic { 0.5 * (work(below) + above.map_or(0.0, work)) } else { 0.0 },
                flux: mean(|face| face.flux),
                diffusion: (below.flux - above.map_or(0.0, |face| face.flux)) / dz,
                contacts: inside.contacts,
                drag_work: if kinetic { inside.drag_work } else { 0.0 },
                drag: inside.drag,
                radial: radial(laws, &cell),
            }
        });
        let cells = cells.collect();
        Self { cells, bottom: [faces[0].viscous + faces[0].turbulent, faces[0].kinetic + faces[0].contact] }
    }

    /// Sum over the cells of a density times their height.
    pub fn integral(&self, of: impl Fn(&Level) -> f64) -> f64 {
        self.cells.iter().map(|level| of(level) * level.dz).sum()
    }

    /// Solid volume that passes per width and time.
    #[must_use]
    pub fn flux(&self) -> f64 {
        self.integral(|level| level.phi * level.v)
    }

    /// Elevation below which the share `share` of the grains are transported, linear within a cell.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let whole = self.flux();
        let mut below = 0.0;
        for level in &self.cells {
            let here = level.phi * level.v * level.dz / whole;
            if here > 0.0 && below + here >= share {
                return Some(level.z - 0.5 * level.dz + level.dz * (share - below) / here);
            }
            below += here;
        }
        None
    }

    /// Elevation at which the solid fraction falls to half of its largest value, linear between the middles.
    #[must_use]
    pub fn bed_level(&self) -> Option<f64> {
        let half = 0.5 * self.cells.iter().map(|level| level.phi).fold(0.0, f64::max);
        let pair = self.cells.windows(2).rev().find(|pair| pair[0].phi >= half && pair[1].phi < half)?;
        let (low, high) = (&pair[0], &pair[1]);
        Some(low.z + (high.z - low.z) * (low.phi - half) / (low.phi - high.phi))
    }

    /// Largest granular temperature where there are grains, and its elevation: the top of the parabola through the three middles.
    #[must_use]
    pub fn hottest(&self) -> Option<(f64, f64)> {
        let dense = |level: &&Level| level.phi > 1e3 * NONE;
        let (t, i) = self
            .cells
            .iter()
            .enumerate()
            .filter(|(_, level)| dense(level))
            .map(|(i, level)| (level.t, i))
            .fold((0.0, None), |best, (t, i)| if t > best.0 { (t, Some(i)) } else { best });
        let i = i?;
        let here = &self.cells[i];
        let (Some(below), Some(above)) = (i.checked_sub(1).map(|j| &self.cells[j]), self.cells.get(i + 1)) else {
            return Some((t, here.z));
        };
        let (down, up) = (here.z - below.z, above.z - here.z);
        let (left, right) = ((here.t - below.t) / down, (above.t - here.t) / up);
        let bend = (right - left) / (down + up);
        let slope = (left * up + right * down) / (down + up);
        if bend < 0.0 && above.phi > 1e3 * NONE {
            let x = -0.5 * slope / bend;
            Some((t + 0.5 * slope * x, here.z + x))
        } else {
            Some((t, here.z))
        }
    }

    /// Linear between the middles, at the elevation `z`.
    #[cfg(test)]
    #[must_use]
    pub fn at(&self, z: f64, of: impl Fn(&Level) -> f64) -> Option<f64> {
        let pair = self.cells.windows(2).find(|pair| pair[0].z <= z && z <= pair[1].z)?;
        let share = (z - pair[0].z) / (pair[1].z - pair[0].z);
        Some(of(&pair[0]) + share * (of(&pair[1]) - of(&pair[0])))
    }
}

fn radial(laws: &Laws, cell: &Cell<f64>) -> Option<f64> {
    match laws.moving {
        Moving::Kinetic(law) => Some(law.radial.contact(cell.phi, cell.gap, law.a)),
        Moving::Inertial(_) => None,
    }
}
