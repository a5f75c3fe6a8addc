//! Momentum between the grains and the fluid: taken implicitly, given grain by grain, the difference carried on.
//!
//! # Equations
//!
//! A period τ begins with grains at v and fluid at uⁿ. The drag on each grain is f(u_f(z) + u' - v), eq. (11) of Maurin et al.
//! (2015), u_f of the cell of its centre; a cell has the share of the volume of the grain within it. The fluid of cell i meets
//!
//! ```text
//! n f = D_i + b_i (u - uⁿ),   D_i = Σ share f_x/(A h),   b_i = Σ share ∂f_x/∂u/(A h) > 0
//! ```
//!
//! implicitly in u. At u = uⁿ that is β (u - v) of eq. (17)-(18) to round-off; β itself, a quotient of sums that pass zero
//! with the slip, and that eddies and neighbouring cells make negative, is never formed, and nothing is clipped.
//!
//! The fluid velocity at the grains is uⁿ for the whole period. So the impulse that the fluid lost, T_i = τ h n f, is not what they got,
//! G_i = Σ share ∫ f_x dt/A. The difference is a residual impulse c_i, of which a quarter is returned in each period:
//!
//! ```text
//! c' = c + T - G - c/4,    and the fluid gets c/4
//! ```
//!
//! With a strong drag, a = τ β/(ε ρ_f) >> 1, the error of u then halves in each period; returning all of it at once would make
//! it oscillate undamped. T - G - (change of c) is round-off for every cell. The share of fixed grains goes to the ground.

use super::fluid_at_grains::FluidAtGrains;
use crate::closures::drag::DallavalleGrain;
use crate::column::{Balance, Bottom, ColumnError, FluidColumn, Forcing, Grid, Medium, Setup, Top, ViscousForm};
use crate::dem::checkpoint::{Reader, Writer};
use crate::dem::engine::Engine;
use crate::dem::law::ContactLaw;
use crate::models::coupled::{Coupled, FluidScheme};
use crate::numerics::sum::Sum;
use crate::result::CheckpointError;

/// Share of the residual impulse that is returned in a period.
const RETURNED: f64 = 0.25;

/// The fluid, what it takes from the grains, and what it owes them.
#[derive(Debug)]
pub struct Exchange {
    /// the fluid
    pub column: FluidColumn,
    /// fluid velocity and hindrance at the grains
    pub at_grains: FluidAtGrains,
    law: DallavalleGrain,
    d: f64,
    medium: Medium,
    forcing: Forcing,
    area: f64,
    height: f64,
    /// per cell, of mobile and of fixed grains: drag [N/m3] and its slope [kg/(m3 s)]
    drag: [Vec<f64>; 2],
    slope: [Vec<f64>; 2],
    /// impulse given to mobile grains in the last period, per area [Pa s]
    given: Vec<f64>,
    /// the residual impulse c, per area [Pa s]
    pub(super) residual: Vec<f64>,
    /// impulse taken less what was returned, and given, so far, per area [Pa s]
    pub(super) totals: [Sum; 2],
    /// largest relative error of the momentum of the fluid in a step
    pub(super) worst: f64,
    /// whether the fluid is stepped forward
    explicit: bool,
    /// longest stable explicit step of the fluid in the last period \[s]
    bearable: f64,
    /// slope of the drag on a mobile grain over its mass, where that is largest [1/s]
    steepest: f64,
    /// solid volume that crosses a unit of width in a unit of time [m2/s]
    rate: f64,
    volumes: Vec<f64>,
    /// Reynolds stress at the centres of the cells after the last step \[Pa]
    reynolds: Vec<f64>,
}

impl Exchange {
    /// Fluid at rest up to the surface `top` \[m], for `grains` grains.
    ///
    /// # Errors
    /// [`ColumnError`] if there can be no such column.
    pub fn new(flow: &Coupled, top: f64, grains: usize) -> Result<Self, ColumnError> {
        let bed = &flow.bed;
        let cells = ((top / (bed.discrete.slice * bed.d)).round() as usize).clamp(4, 1_000_000);
        let grid = Grid::uniform(0.0, top, cells)?;
        let height = top / cells as f64;
        let setup = Setup {
            viscosity: flow.viscosity,
            form: ViscousForm::Fluid,
            mixing_length: flow.mixing_length,
            side_wall: flow.side_wall,
            width: if bed.side_walls { bed.size[1] } else { f64::INFINITY },
            ..Setup::laminar(flow.rho_f, flow.eta)
        };
        let drive = flow.rho_f * bed.g * bed.beta.sin();
        let zero = || vec![0.0; cells];
        Ok(Self {
            column: FluidColumn::new(grid, setup)?,
            at_grains: FluidAtGrains::new(flow.drag, flow.drag.viscous(flow.nu(), bed.d), cells, height, grains),
            law: flow.drag,
            d: bed.d,
            medium: Medium::clear(cells),
            forcing: Forcing { drive, bottom: Bottom::NoSlip, top: Top::FreeSurface },
            area: bed.size[0] * bed.size[1],
            height,
            drag: [zero(), zero()],
            slope: [zero(), zero()],
            given: zero(),
            residual: zero(),
            totals: [Sum::default(); 2],
            worst: 0.0,
            explicit: flow.fluid_scheme == FluidScheme::Explicit,
            bearable: f64::INFINITY,
            steepest: 0.0,
            rate: 0.0,
            volumes: Vec::new(),
            reynolds: zero(),
        })
    }

    /// Solid fraction of the cells.
    #[must_use]
    pub fn phi(&self) -> &[f64] {
        &self.medium.phi
    }

    /// Transport rate when the grains were last averaged [m2/s].
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Reynolds stress of the cells \[Pa].
    #[must_use]
    pub fn reynolds(&self) -> &[f64] {
        &self.reynolds
    }

    /// Height of a cell \[m].
    #[must_use]
    pub fn cell_height(&self) -> f64 {
        self.height
    }

    /// Longest step of the grains that the drag on them bears, as they were last averaged \[s]: it is taken at the start of a step.
    #[must_use]
    pub fn drag_limit(&self) -> f64 {
        2.0 / self.steepest
    }

    /// Longest stable step of the fluid \[s] if it is stepped forward.
    #[must_use]
    pub fn fluid_limit(&self) -> Option<f64> {
        self.explicit.then_some(self.bearable)
    }

    /// Averages the grains over the cells: solid fraction and velocity, drag and its slope at the present velocities, and the
    /// impulse that the fluid gave since the last average, `dt` \[s] being the step of the grains.
    pub fn average<C: ContactLaw>(&mut self, engine: &Engine<C>, dt: f64) {
        let Self { medium, drag, slope, given, at_grains, volumes, .. } = self;
        let cells = medium.phi.len();
        let grains = engine.grains();
        for sums in drag.iter_mut().chain(slope.iter_mut()).chain([given, &mut medium.phi, &mut medium.velocity]) {
            sums.fill(0.0);
        }
        let ([mobile_drag, fixed_drag], [mobile_slope, fixed_slope]) = (drag, slope);
        let per_volume = 1.0 / (self.area * self.height);
        (self.rate, self.steepest) = (0.0, 0.0);
        for i in 0..grains.len() {
            let (r, [_, _, z], velocity) = (grains.radius(i), grains.position(i), grains.velocity(i));
            let (id, fixed) = (grains.ids[i], grains.is_fixed(i));
            let whole = 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
            let (first, inside) = shares(z, r, self.height, cells, volumes);
            let dragged = at_grains.drag(id, z, velocity);
            if !fixed {
                self.rate += whole * velocity[0];
                self.steepest = self.steepest.max(dragged.slope * grains.spins[i].0[3]);
            }
            // Of a mobile grain the part inside counts for all; of one in the bottom, only the part in the flow.
            let scale = if fixed { per_volume / whole } else { per_volume / inside };
            let sum = at_grains.take(id) * dt;
            if fixed {
                for (s, part) in volumes.iter().enumerate() {
                    medium.phi[first + s] += part * per_volume;
                    fixed_drag[first + s] += part * scale * dragged.force[0];
                    fixed_slope[first + s] += part * scale * dragged.slope;
                }
            } else if inside > 0.0 {
                for (s, part) in volumes.iter().enumerate() {
                    medium.phi[first + s] += part * per_volume;
                    medium.velocity[first + s] += part * per_volume * velocity[0];
                    mobile_drag[first + s] += part * scale * dragged.force[0];
                    mobile_slope[first + s] += part * scale * dragged.slope;
                    self.given[first + s] += part / inside * sum / self.area;
                }
            } else {
                // It left the water within the period.
                self.given[cells - 1] += sum / self.area;
            }
        }
        self.rate /= self.area;
        for (sum, phi) in medium.velocity.iter_mut().zip(&medium.phi) {
            *sum = if *phi > 0.0 { *sum / phi } else { 0.0 };
        }
        let given: f64 = self.given.iter().sum();
        self.totals[1].add(given);
        for (residual, given) in self.residual.iter_mut().zip(&self.given) {
            *residual -= given;
        }
    }

    /// Advances the fluid by `period` \[s] in `steps` steps with the grains as they were last averaged.
    ///
    /// # Errors
    /// [`ColumnError`] of the step that failed.
    pub fn advance(&mut self, period: f64, steps: u32) -> Result<(), ColumnError> {
        let before = self.column.velocity().to_vec();
        let owed = RETURNED / (period * self.height);
        self.expand(&before, owed);
        let dt = period / f64::from(steps);
        let mut taken = vec![0.0; before.len()];
        self.bearable = f64::INFINITY;
        for _ in 0..steps {
            let step = if self.explicit { FluidColumn::step_explicit } else { FluidColumn::step };
            let balance = step(&mut self.column, &self.medium, &self.forcing, dt)?.balance;
            self.worst = self.worst.max(relative(&balance));
            if self.explicit {
                self.bearable = self.bearable.min(self.column.explicit_limit(&self.medium));
            }
            for (i, taken) in taken.iter_mut().enumerate() {
                let change = self.column.velocity()[i] - before[i];
                *taken += dt * self.height * (self.drag[0][i] + self.slope[0][i] * change);
            }
        }
        let mut net = 0.0;
        for (residual, taken) in self.residual.iter_mut().zip(taken) {
            let back = RETURNED * *residual;
            net += taken - back;
            *residual += taken - back;
        }
        self.totals[0].add(net);
        self.update_grains();
        Ok(())
    }

    /// The drag as the fluid meets it: D + b (u - uⁿ) around the velocity `before`, less `owed` [1/(m s)] of the residual impulse.
    fn expand(&mut self, before: &[f64], owed: f64) {
        let Self { medium, drag, slope, residual, .. } = self;
        for (i, u) in before.iter().enumerate() {
            medium.beta[i] = slope[0][i] + slope[1][i];
            let at_rest = medium.beta[i] * (u - medium.velocity[i]);
            medium.force[i] = at_rest - (drag[0][i] + drag[1][i]) + owed * residual[i];
        }
    }

    /// The steady flow through grains that stay where they are.
    ///
    /// # Errors
    /// [`ColumnError`] if there is none.
    pub fn begin<C: ContactLaw>(&mut self, engine: &Engine<C>) -> Result<(), ColumnError> {
        for _ in 0..100 {
            self.average(engine, 0.0);
            self.residual.fill(0.0);
            self.totals = [Sum::default(); 2];
            self.update_grains();
            self.average(engine, 0.0);
            let before = self.column.velocity().to_vec();
            self.expand(&before, 0.0);
            self.column.step(&self.medium, &self.forcing, f64::INFINITY)?;
            self.update_grains();
            let largest = self.column.velocity().iter().fold(0.0, |m: f64, u| m.max(u.abs()));
            let change = self.column.velocity().iter().zip(&before).fold(0.0, |m: f64, (u, v)| m.max((u - v).abs()));
            if change <= 1e-6 * largest {
                break;
            }
        }
        Ok(())
    }

    /// Updates velocity and hindrance at the grains.
    pub(super) fn update_grains(&mut self) {
        let cells = self.medium.phi.len();
        self.at_grains.velocity[..cells].copy_from_slice(self.column.velocity());
        let (law, rho, d) = (self.law, self.column.setup().rho, self.d);
        for (size, phi) in self.at_grains.size.iter_mut().zip(&self.medium.phi) {
            *size = law.size(*phi, rho, d);
        }
        let faces = self.column.tau_reynolds().windows(2);
        self.reynolds.iter_mut().zip(faces).for_each(|(centre, pair)| *centre = 0.5 * (pair[0] + pair[1]));
    }

    /// Writes the state.
    pub fn save(&self, to: &mut Writer) {
        to.whole(self.medium.phi.len() as u64);
        to.number(self.height);
        let state = [self.column.velocity(), &self.medium.phi, &self.residual, &self.reynolds];
        state.into_iter().flatten().for_each(|x| to.number(*x));
        for sum in self.totals {
            to.number(sum.value);
            to.number(sum.rest);
        }
        to.number(self.worst);
        to.number(self.rate);
        self.at_grains.carried().for_each(|x| to.number(x));
    }

    /// Reads what [`Self::save`] wrote, for `grains` grains.
    ///
    /// # Errors
    /// [`CheckpointError`] if it cannot be.
    pub fn restore(flow: &Coupled, grains: usize, from: &mut Reader<'_>) -> Result<Self, CheckpointError> {
        const WRONG: CheckpointError = CheckpointError::Corrupt { what: "the fluid" };
        let cells = usize::try_from(from.whole()?).ok().filter(|n| (1..=1_000_000).contains(n)).ok_or(WRONG)?;
        let top = from.number()? * cells as f64;
        let mut this = Self::new(flow, top, grains).map_err(|_| WRONG)?;
        if this.medium.phi.len() != cells {
            return Err(WRONG);
        }
        let (mut velocity, mut reynolds) = (vec![0.0; cells], vec![0.0; cells]);
        for values in [&mut velocity, &mut this.medium.phi, &mut this.residual, &mut reynolds] {
            for x in values {
                *x = from.number()?;
            }
        }
        this.column.set_velocity(&velocity).map_err(|_| WRONG)?;
        for sum in &mut this.totals {
            *sum = Sum { value: from.number()?, rest: from.number()? };
        }
        this.worst = from.number()?;
        this.rate = from.number()?;
        for word in this.at_grains.carried_mut() {
            *word = from.number()?.to_bits();
        }
        this.update_grains();
        // The column knows its stresses only after a step.
        this.reynolds = reynolds;
        Ok(this)
    }

    /// Impulse taken less given less carried, over the given one.
    #[must_use]
    pub fn defect(&self) -> f64 {
        let mut sum = Sum::default();
        for part in [self.totals[0].total(), -self.totals[1].total()] {
            sum.add(part);
        }
        self.residual.iter().for_each(|c| sum.add(-c));
        let scale = self.totals[1].total().abs().max(self.totals[0].total().abs());
        if scale > 0.0 { sum.total() / scale } else { 0.0 }
    }
}

fn relative(balance: &Balance) -> f64 {
    balance.relative().abs()
}

/// Volumes of a sphere of radius `r` at `z` in cells of height `h` \[m], the first of them, and their sum.
fn shares(z: f64, r: f64, h: f64, cells: usize, volumes: &mut Vec<f64>) -> (usize, f64) {
    volumes.clear();
    let first = ((z - r).max(0.0) / h) as usize;
    let end = (((z + r) / h).ceil().max(0.0) as usize).min(cells);
    // Antiderivative of the section, pi (r^2 t - t^3/3).
    let below = |face: f64| {
        let t = (face - z).clamp(-r, r);
        std::f64::consts::PI * t * (r * r - t * t / 3.0)
    };
    let mut low = below(first as f64 * h);
    let mut inside = 0.0;
    for cell in first..end {
        let high = below((cell + 1) as f64 * h);
        volumes.push(high - low);
        inside += high - low;
        low = high;
    }
    (first, inside)
}
