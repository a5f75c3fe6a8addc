//! What joins the layers: drive, lid, and what the bed level is, which fixes the amount of grains.

use super::bed::{self, STRIDE, State};
use super::flow::Flow;
use super::linear::{self, LOCAL, LocalCell};
use super::newton::Column;
use super::suspension::{Inflow, Meshes, Totals, march};
use crate::closures::friction::FrictionLaw;
use crate::closures::lid::{ColebrookWhite, Lid, Stress};
use crate::models::sheet_flow::{BedLevel, SheetFlow};
use crate::numerics::dual::{Dual, Real};

/// The drive and the geometry, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// wanted stress on the interface
    pub tau_b: Option<f64>,
    /// given sine of the slope
    pub sine: Option<f64>,
    /// top of the flow; its stress is scaled, its roughness in d
    pub lid: Lid,
    /// total height
    pub height: f64,
    /// bed level
    pub level: f64,
    /// what the bed level is
    pub bed_level: BedLevel,
}

/// Inputs of the layers above: phi, dilation and velocity at the interface, tau_b, sine, m, and the volume at rest.
const INPUTS: usize = 7;

/// The four equations that close the column, with their derivatives.
#[derive(Clone, Debug)]
pub struct Closing {
    /// drive, lid, amount of grains, bottom of the cells
    pub residual: [f64; 4],
    /// by tau_b, sine, m and the volume at rest
    pub by_globals: [[f64; 4]; 4],
    /// by the unknowns of the bed, sparse
    pub by_unknowns: [Vec<(usize, f64)>; 4],
}

/// What lies under the last cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floor {
    /// grains at rest, from the yield level down
    Yield,
    /// the bottom of the bed
    Bottom,
}

/// Limit of the solid fraction at the interface, from the two cells below it, and the weights of these.
#[must_use]
pub fn interface_weights(middles: &[f64]) -> (f64, f64) {
    let (a, b) = (middles[0], middles[1]);
    (b / (b - a), -a / (b - a))
}

impl Setting {
    /// Drive and geometry of a flow, scaled.
    #[must_use]
    pub fn scaled<F: FrictionLaw>(sheet: &SheetFlow<F>) -> Self {
        let lid = match sheet.lid {
            Lid::Stress(law) => Lid::Stress(Stress { stress: law.stress / sheet.stress_scale() }),
            Lid::ColebrookWhite(law) => {
                Lid::ColebrookWhite(ColebrookWhite { roughness: law.roughness / sheet.d, ..law })
            }
            other => other,
        };
        Self {
            tau_b: sheet.tau_b.map(|tau| tau / sheet.stress_scale()),
            sine: sheet.sine,
            lid,
            height: sheet.height / sheet.d,
            level: sheet.level / sheet.d,
            bed_level: sheet.bed_level,
        }
    }

    /// Inputs of the layer above the interface for the state of the bed.
    pub fn inflow<T: Real, F: FrictionLaw>(
        flow: &Flow<F>,
        phi: T,
        d: T,
        u: T,
        (tau_b, sine, m): (T, T, T),
    ) -> Inflow<T> {
        Inflow { phi, length: flow.mixing_length(d, m), u, tau_b, sine }
    }

    /// Stress that the lid takes, for the totals of the layer above the interface and its stress.
    pub fn lid_stress<T: Real, F: FrictionLaw>(&self, flow: &Flow<F>, totals: &Totals<T>, inflow: &Inflow<T>) -> T {
        match self.lid {
            Lid::FreeSurface => T::constant(0.0),
            Lid::Stress(law) => T::constant(law.stress),
            Lid::Solved => flow.fluid_weight(inflow.sine) * totals.height - inflow.tau_b,
            Lid::ColebrookWhite(law) => {
                let mean = totals.discharge / totals.height;
                let diameter = totals.height * law.diameter.heights();
                law.factor(mean.abs() * diameter / flow.nu, diameter) * mean * mean / 8.0
            }
        }
    }

    /// The closing equations for phi, dilation and velocity at the interface, and tau_b, sine, m, rest; but the last.
    fn equations<T: Real, F: FrictionLaw>(
        &self,
        flow: &Flow<F>,
        meshes: &Meshes,
        [phi, d, u, tau_b, sine, m, rest]: [T; INPUTS],
    ) -> [T; 3] {
        let h_p = (m + rest) / flow.dilatancy.phi_max + d;
        let height = -h_p + self.height;
        let drive = match (self.tau_b, self.sine) {
            (Some(wanted), _) => tau_b - wanted,
            (None, given) => sine - given.unwrap_or_default(),
        };
        let inflow = Self::inflow(flow, phi, d, u, (tau_b, sine, m + rest));
        let needs_layer = matches!(self.lid, Lid::ColebrookWhite(_)) || self.bed_level == BedLevel::AtRest;
        let totals = if needs_layer {
            march(flow, meshes, &inflow, height, |_| {})
        } else {
            let zero = T::constant(0.0);
            Totals { volume: zero, flux: zero, discharge: zero, height }
        };
        let totals = Totals { height, ..totals };
        let lid = match (self.lid, self.sine) {
            (Lid::Solved, Some(given)) => sine - given,
            _ => tau_b - flow.fluid_weight(sine) * height + self.lid_stress(flow, &totals, &inflow),
        };
        let amount = match self.bed_level {
            BedLevel::InFlow => h_p - self.level,
            BedLevel::AtRest => m + rest + totals.volume - flow.dilatancy.phi_max * self.level,
        };
        [drive, lid, amount]
    }

    /// Residuals of the closing equations at `state`.
    #[must_use]
    pub fn closing_residual<F: FrictionLaw>(&self, column: &Column<F>, state: &State) -> [f64; 4] {
        let Column { flow, mesh, meshes, .. } = column;
        let weights = interface_weights(&mesh.middles);
        let phi = |c: usize| bed::cell(flow, mesh, state, c).phi;
        let phi_0 = weights.0 * phi(0) + weights.1 * phi(1);
        let [drive, lid, amount] = self.equations(flow, meshes, inputs(state, phi_0));
        let bottom = match column.floor {
            Floor::Yield => bed::yield_residual(flow, mesh, state),
            Floor::Bottom => state.rest,
        };
        [drive, lid, amount, bottom]
    }

    /// The closing equations at `state`, with their derivatives.
    #[must_use]
    pub fn closing<F: FrictionLaw>(&self, column: &Column<F>, state: &State, cells: &[LocalCell]) -> Closing {
        let Column { flow, mesh, meshes, .. } = column;
        let weights = interface_weights(&mesh.middles);
        let phi_0 = weights.0 * cells[0].phi.value + weights.1 * cells[1].phi.value;
        let inputs = inputs(state, phi_0);
        let inputs = std::array::from_fn(|i| Dual::<INPUTS>::variable(inputs[i], i));
        let three = self.equations(flow, meshes, inputs);
        let n = cells.len();
        let mut closing =
            Closing { residual: [0.0; 4], by_globals: [[0.0; 4]; 4], by_unknowns: std::array::from_fn(|_| Vec::new()) };
        for (i, x) in three.iter().enumerate() {
            closing.residual[i] = x.value;
            let by = x.slope[0];
            let phi = |k: usize| by * (weights.0 * cells[0].phi.slope[k] + weights.1 * cells[1].phi.slope[k]);
            closing.by_globals[i] = [x.slope[3], x.slope[4] + phi(5), x.slope[5] + phi(4), x.slope[6] + phi(6)];
            let mut entries = vec![(2, x.slope[1]), (0, x.slope[2]), (1, x.slope[2])];
            if by != 0.0 {
                for (c, weight) in [(0, weights.0), (1, weights.1)] {
                    linear::spread(c, n, &cells[c].phi.slope, by * weight, |k, slope| entries.push((k, slope)));
                }
            }
            entries.retain(|(_, slope)| *slope != 0.0);
            closing.by_unknowns[i] = entries;
        }
        match column.floor {
            Floor::Bottom => (closing.residual[3], closing.by_globals[3][3]) = (state.rest, 1.0),
            Floor::Yield => {
                let x = linear::yield_slopes(flow, mesh, state, &cells[n - 1]);
                closing.residual[3] = x.value;
                closing.by_globals[3] = [0.0, x.slope[5], x.slope[4], x.slope[6]];
                let mut entries = vec![(STRIDE * (n - 1) + 1, x.slope[LOCAL])];
                let slope = std::array::from_fn(|i| x.slope[i]);
                linear::spread(n - 1, n, &slope, 1.0, |k, slope| entries.push((k, slope)));
                closing.by_unknowns[3] = entries;
            }
        }
        closing
    }
}

fn inputs(state: &State, phi: f64) -> [f64; INPUTS] {
    [phi, state.d(0), state.u(0) + state.w(0), state.tau_b, state.sine, state.m, state.rest]
}
