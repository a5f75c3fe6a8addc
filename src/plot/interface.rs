//! The top of the grains, where the solid fraction and what it weighs jump between two levels.

use crate::result::Profile;
use crate::result::quantity::{self, Quantity};

/// Where the grains end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    /// bed level, in the unit of the elevations
    pub bed: f64,
    /// solid fraction just below it, if it is known
    pub phi: Option<f64>,
}

impl Interface {
    /// Where the grains end between two levels, a quantity that jumps there: the first row above, and the limits from
    /// below and from above.
    pub fn jump(self, profile: &Profile, quantity: &Quantity) -> Option<(usize, f64, f64)> {
        let (bed, name) = (self.bed, quantity.name);
        if ![quantity::PHI.name, quantity::FLUX.name, quantity::U_MIXTURE.name].contains(&name) {
            return None;
        }
        let (z, slack) = (profile.axis(), 1e-9 * bed.abs());
        let (phi, values) = (profile.get(&quantity::PHI)?, profile.get(quantity)?);
        let below = (0..z.len()).rev().find(|&i| {
            z.get(i).is_some_and(|&z| z <= bed + slack) && phi.get(i).copied().flatten().is_some_and(|phi| phi > 0.0)
        })?;
        let above = below + 1;
        if phi.get(above).copied().flatten() != Some(0.0) || z.get(above).is_none_or(|&z| z < bed - slack) {
            return None;
        }
        let limit_of_phi = self.phi.or(phi.get(below).copied().flatten())?;
        let from =
            |values: &[Option<f64>], near: usize, next: Option<usize>| extrapolated(&z, values, near, next?, bed);
        let under = below.checked_sub(1);
        let low = if name == quantity::PHI.name {
            limit_of_phi
        } else if name == quantity::FLUX.name
            && let Some(u) = profile.get(&quantity::U_PARTICLE).and_then(|u| from(u, below, under))
        {
            // the flux ends with the velocity that the grains have at their top
            limit_of_phi * u
        } else {
            from(values, below, under)?
        };
        // undefined above: the line ends at the interface
        Some((above, low, from(values, above, Some(above + 1)).unwrap_or(low)))
    }
}

/// Linear extrapolation to `to` from the rows `near` and `next`; the value in `near` where `next` has none.
fn extrapolated(z: &[f64], values: &[Option<f64>], near: usize, next: usize, to: f64) -> Option<f64> {
    let at = |i: usize| Some((*z.get(i)?, values.get(i).copied().flatten()?));
    let (z1, b) = at(near)?;
    let slope = at(next).filter(|(z0, _)| *z0 != z1).map_or(0.0, |(z0, a)| (b - a) / (z1 - z0));
    Some(b + slope * (to - z1))
}
