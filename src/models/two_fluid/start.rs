//! States to start from: the bed at rest, and a guess of the flow.

use super::state::{FLUID, GRAINS, HEAT, LOGIT, SIZE, Unknowns};
use super::system::Column;

/// Granular temperature of the guess over the Shields number.
const AGITATION: f64 = 0.2;
/// Velocity of the grains at the top of the guessed layer, over the friction velocity.
const FASTEST: f64 = 8.0;
/// Velocity of the fluid over that of the grains in the guess, and within the bed at rest.
const SLIP: (f64, f64) = (1.2, 0.03);
/// Thickness of the guessed layer over the Shields number, and the least one.
const LAYER: f64 = 10.0;
const THINNEST: f64 = 1.0;
/// Solid fraction on top of the guessed layer, and the height over which it falls e-fold.
const SKY: (f64, f64) = (1e-3, 0.3);
/// Share of phi_max that a guess stays below.
const FULL: f64 = 0.99;

/// A first guess of the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// the bed at rest under still water
    Rest,
    /// a layer that moves over the bed
    Layer {
        /// Shields number
        shields: f64,
        /// thickness of the moving layer in units of the usual one
        thickness: f64,
    },
}

impl Column {
    /// Grains of the solid fraction `phi` up to the level where they end, under still water.
    #[must_use]
    pub fn at_rest(&self, phi: f64) -> Vec<Unknowns> {
        let level = self.solids / phi;
        let mut state = self.fill(|below, above| {
            let filled = ((level - below) / (above - below)).clamp(0.0, 1.0);
            (phi * filled, 0.0, 0.0, 0.0)
        });
        self.accumulate(&mut state);
        state
    }

    /// The state of a first guess over a bed of the solid fraction `phi`.
    #[must_use]
    pub fn from(&self, phi: f64, start: Start) -> Vec<Unknowns> {
        match start {
            Start::Rest => self.at_rest(phi),
            Start::Layer { shields, thickness } => self.layer(phi, shields, thickness),
        }
    }

    /// A layer that moves over a bed of the solid fraction `phi`: linear in solid fraction and velocity, agitated in its middle.
    fn layer(&self, phi: f64, shields: f64, thickness: f64) -> Vec<Unknowns> {
        let level = self.solids / phi;
        let half = (0.5 * LAYER * shields).max(0.5 * THINNEST) * thickness;
        let u_star = shields.sqrt();
        let mut state = self.fill(|below, above| {
            let height = 0.5 * (below + above) - level;
            let share = height / half;
            let sky = SKY.0 * (-(height - half).max(0.0) / SKY.1).exp();
            let solid = phi * (0.5 - 0.5 * share).clamp(0.0, 1.0);
            let rising = 0.5 * FASTEST * u_star * (share + 1.0).clamp(0.0, 2.0);
            let below_middle = share.min(0.0);
            let heat = AGITATION * shields * (-(below_middle * below_middle).min(2.25)).exp();
            (solid.max(sky), SLIP.0 * rising + SLIP.1, rising, heat)
        });
        self.accumulate(&mut state);
        state
    }

    /// Solid fraction, velocities and granular temperature of each cell by its lower and upper level.
    fn fill(&self, of: impl Fn(f64, f64) -> (f64, f64, f64, f64)) -> Vec<Unknowns> {
        let (floors, phi_max) = (self.laws.floors, self.laws.phi_max);
        let mut z = 0.0;
        let cells = self.widths.iter().map(|dz| {
            let below = z;
            z += dz;
            let (phi, u, v, t) = of(below, z);
            let phi = phi.max(floors.phi).min(FULL * phi_max);
            let mut x = [0.0; SIZE];
            x[LOGIT] = (phi / (phi_max - phi)).ln();
            x[HEAT] = t.max(floors.temperature).ln();
            (x[FLUID], x[GRAINS]) = (u, v);
            x
        });
        cells.collect()
    }

    /// The state `from` of another column, on these cells: linear between the middles of the cells.
    #[must_use]
    pub fn transfer(&self, other: &Self, from: &[Unknowns]) -> Vec<Unknowns> {
        let (old, new) = (middles(&other.widths), middles(&self.widths));
        let mut state: Vec<Unknowns> = Vec::with_capacity(new.len());
        for z in new {
            let above = old.partition_point(|middle| *middle < z).clamp(1, old.len() - 1);
            let share = ((z - old[above - 1]) / (old[above] - old[above - 1])).clamp(0.0, 1.0);
            let (low, high) = (&from[above - 1], &from[above]);
            let mut x = [0.0; SIZE];
            for k in [LOGIT, FLUID, GRAINS, HEAT] {
                x[k] = low[k] + share * (high[k] - low[k]);
            }
            state.push(x);
        }
        self.accumulate(&mut state);
        state
    }
}

/// Middles of the cells.
#[must_use]
pub fn middles(widths: &[f64]) -> Vec<f64> {
    let mut z = 0.0;
    let mut middle = |dz: &f64| {
        z += dz;
        z - 0.5 * dz
    };
    widths.iter().map(&mut middle).collect()
}
