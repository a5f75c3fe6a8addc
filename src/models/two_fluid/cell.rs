//! What happens inside a cell: weight, drag, inertia, and what becomes of the fluctuation energy.
//!
//! ```text
//! fluid     d(eps u)/dt + ... = eps G_f - phi eps K (u - v)
//! grains    r [d(phi v)/dt + ...] = r phi G_p + phi eps K (u - v)
//! heat      (3/2) r [d(phi T)/dt + ...] = ... - r F4 T^(3/2) - phi eps K m (T - T_0) - p dw/dz
//! ```
//!
//! T_0 is the granular temperature that grains keep in the fluid: it picks the branch with motion, since T = 0 solves the
//! equation of heat in any flow.

use super::face::Setting;
use super::state::{Cell, FLUID, GRAINS, HEAT, LENGTH, LOGIT, SIZE};
use crate::closures::kinetic::Moving;
use crate::closures::kinetic::drag_work::Damping;
use crate::numerics::dual::Real;

/// What is known of the time derivatives of a cell: `rate X + past` for X = eps u, phi v, phi T.
#[derive(Clone, Copy, Debug, Default)]
pub struct Past {
    /// of the momentum of the fluid
    pub fluid: f64,
    /// of the momentum of the grains over r
    pub grains: f64,
    /// of the fluctuation energy over 3/2 r
    pub heat: f64,
}

/// What a cell does.
#[derive(Clone, Copy, Debug)]
pub struct Inside<T> {
    /// drag on the grains
    pub drag: T,
    /// what contacts dissipate
    pub contacts: T,
    /// what the drag takes from the fluctuations
    pub drag_work: T,
    /// rows of the cell
    pub rows: [T; SIZE],
    /// inertia of the grains that rise or fall, for the rows of the lower and the upper face
    pub falling: [T; 2],
}

impl Setting<'_> {
    /// A cell of height `dz`, for the vertical velocity `below` at its lower face.
    pub fn inside<T: Real>(&self, dz: f64, cell: &Cell<T>, below: T, past: &Past) -> Inside<T> {
        let laws = self.laws;
        let zero = T::constant(0.0);
        let Cell { phi, u, v, t, rise, .. } = *cell;
        let eps = -phi + 1.0;
        let (slip, up) = (u - v, (rise + below) * 0.5 / eps);
        let (k, share) = laws.drag.per_volume(phi, (slip * slip + up * up).sqrt(), laws.drag.viscous(laws.nu, 1.0));
        let strength = phi * eps * k;
        let drag = strength * slip;
        let (contacts, drag_work) = match laws.moving {
            Moving::Kinetic(law) => (
                law.dissipation_per_grain(phi, cell.gap) * phi * t * t.sqrt() * laws.ratio,
                law.drag_work.factor(share) * strength * (t - laws.floors.temperature),
            ),
            Moving::Inertial(_) => (zero, t - laws.floors.temperature),
        };
        let mut rows = [zero; SIZE];
        rows[LOGIT] = -phi * dz;
        rows[FLUID] = (eps * u * self.rate + past.fluid - eps * laws.drive[0] + drag) * dz;
        rows[GRAINS] = ((phi * v * self.rate + past.grains - phi * laws.drive[1]) * laws.ratio - drag) * dz;
        rows[HEAT] = (contacts + drag_work) * dz;
        if let Moving::Kinetic(_) = laws.moving {
            rows[HEAT] = rows[HEAT] + (phi * t * self.rate + past.heat) * (1.5 * laws.ratio * dz);
        }
        rows[LENGTH] = -cell.clearance * dz;
        // w dw/dz at a face is taken from the cell that the grains come from.
        let stretch = (rise - below) * (laws.ratio / dz);
        let falling = [
            if below.value() < 0.0 { below * stretch } else { zero },
            if rise.value() > 0.0 { rise * stretch } else { zero },
        ];
        Inside { drag, contacts, drag_work, rows, falling }
    }
}
