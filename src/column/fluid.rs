//! Streamwise momentum of the fluid, implicit in all that it exchanges.
//!
//! # Equation
//!
//! ```text
//! eps rho_f du/dt = [viscous] + dR/dz + eps G + beta (u_p - u) + F - eps rho_f (2/W) (f/8) u |u|
//! ```
//!
//! u the velocity of the fluid, G the driving force per volume of fluid, R the Reynolds stress, F the force in the medium. The
//! time derivative is that of the velocity: with the fluid's mass conserved it is what the momentum eps rho_f u gains, less
//! what the fluid itself carries up or down, and the column knows no vertical velocity.
//!
//! # Discrete equation
//!
//! Cell i has the width h and lies between the faces i and i + 1 ([`super::grid`]); k and m are the conductances of a face
//! (below), `D_f X = X_f - X_{f-1}` the difference across face f. Everything is taken at the end of the step:
//!
//! ```text
//! h eps_i rho_f (u_i - u_i^old)/dt = V_i + R_{i+1} - R_i + h [ eps_i G + beta_i (u_p,i - u_i) + F_i - S_i ],
//!
//! Mixture     U_i = eps_i u_i + phi_i u_p,i      tau_f = k_f D_f U,  1/k_f = sum over the two half cells of (h/2)/eta_e
//!             V_i = eps_i (tau_{i+1} - tau_i)    R_f = m_f |D_f U| D_f U
//!             and the grains of the cell take phi_i (tau_{i+1} - tau_i)
//! Fluid       tau_f = k_f D_f u                  1/k_f = sum over the two half cells of (h/2)/(eps eta_e)
//!             V_i = tau_{i+1} - tau_i            R_f = m_f |D_f u| D_f u
//! Effective   as Fluid
//! all         m_f = rho_f / (sum over the two half cells of int dz/(sqrt(eps) l_m))^2
//!             S_i = eps_i rho_f (2/W) (f(|u_i| W/nu)/8) u_i |u_i|,  nu = eta/rho_f of the clear fluid
//! ```
//!
//! tau in `Fluid` is the papers' eps tau: the stress per area of the whole. **`Fluid` and `Effective` are one equation**: eq.
//! (19) of Maurin et al. (2015) with `nu_t = eps l_m^2 |du/dz|` is eq. (2.7) of the kinetic model with
//! `nu_t = l_m^2 |du/dz|`. What differs in the papers is the viscosity put in, Einstein's in the first and that of the clear
//! fluid in the second, and that is the choice of [`Setup::viscosity`].
//!
//! At a wall the difference is taken over half a cell. That is first order in the wall stress of a single cell and second
//! order in the velocity everywhere, because the stresses are bound together by the balance of the cells.
//!
//! # Solution
//!
//! By Newton's method in corrections, one double sweep each, until no cell misses its balance. A lagged eddy viscosity would
//! not do: under a given stress T it iterates `s -> T/(rho_f l_m^2 s)`, which has period two and never settles. Newton's method
//! halves a gradient that is too large and doubles its digits once near; from rest, the laminar solution comes first and
//! is then halved some 10 to 20 times. Couplings are positive and drag, inertia and wall friction only add to the diagonal, so
//! the matrix is diagonally dominant up to factors of columns and needs no pivoting.

use super::balance::{Balance, Step};
use super::conductance::{Conductance, Face};
use super::medium::check_cells;
use super::setup::{Forcing, Setup};
use super::{ColumnError, Grid, Medium};
use crate::closures::side_wall::SideWall;
use crate::numerics::thomas;

/// A column of fluid. Its state is the velocity alone; all else is computed from it, so that a velocity put back by
/// [`Self::set_velocity`] continues to the bit. A step allocates nothing.
#[derive(Clone, Debug)]
pub struct FluidColumn {
    grid: Grid,
    setup: Setup,
    velocity: Vec<f64>,
    previous: Vec<f64>,
    conductance: Conductance,
    tau: Vec<f64>,
    reynolds: Vec<f64>,
    system: System,
}

/// `- d(residual)/du delta = residual`.
#[derive(Clone, Debug)]
struct System {
    lower: Vec<f64>,
    diagonal: Vec<f64>,
    upper: Vec<f64>,
    residual: Vec<f64>,
    /// what round-off leaves of each residual
    resolution: Vec<f64>,
}

/// Round-off of a residual, in units of what was subtracted to form it.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

impl FluidColumn {
    /// A column at rest.
    ///
    /// # Errors
    /// [`ColumnError::Value`] if a density, a viscosity, a width or a tolerance is not finite and positive.
    pub fn new(grid: Grid, setup: Setup) -> Result<Self, ColumnError> {
        setup.check()?;
        let cells = grid.cells();
        let (zero, faces) = (vec![0.0; cells], vec![0.0; cells + 1]);
        let system = System {
            lower: zero.clone(),
            diagonal: zero.clone(),
            upper: zero.clone(),
            residual: zero.clone(),
            resolution: zero.clone(),
        };
        let conductance = Conductance::new(cells);
        Ok(Self {
            grid,
            setup,
            velocity: zero.clone(),
            previous: zero,
            conductance,
            tau: faces.clone(),
            reynolds: faces,
            system,
        })
    }

    /// The cells.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The laws.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Velocity of the fluid in the cells [m/s].
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Sets the velocity of the fluid in the cells [m/s].
    ///
    /// # Errors
    /// [`ColumnError`] if there is not one finite value per cell.
    pub fn set_velocity(&mut self, velocity: &[f64]) -> Result<(), ColumnError> {
        check_cells(&self.grid, "velocity [m/s]", velocity, (f64::NEG_INFINITY, "a finite number"))?;
        self.velocity.copy_from_slice(velocity);
        Ok(())
    }

    /// Viscous stress at the faces after the last step \[Pa], per area of the whole: the fluid takes its divergence, in the
    /// mixture form its share eps of it.
    #[must_use]
    pub fn tau_viscous(&self) -> &[f64] {
        &self.tau
    }

    /// Reynolds stress at the faces after the last step \[Pa], per area of the whole. The stress of a rough wall and a stress given
    /// at a boundary stand here too.
    #[must_use]
    pub fn tau_reynolds(&self) -> &[f64] {
        &self.reynolds
    }

    /// Mixing length at the faces in the last step \[m].
    #[must_use]
    pub fn mixing_length(&self) -> &[f64] {
        &self.conductance.lengths
    }

    /// Fills `force` with what the fluid gave to the grains of each cell in the last step [N/m3]: drag, and in the mixture form
    /// their share of the viscous force. The force that the medium prescribes is not in it.
    ///
    /// # Errors
    /// [`ColumnError::Length`] if `force` or the medium does not have one value per cell.
    pub fn force_on_grains(&self, medium: &Medium, force: &mut [f64]) -> Result<(), ColumnError> {
        medium.check(&self.grid)?;
        if force.len() != self.grid.cells() {
            let (what, found, cells) = ("force on the grains", force.len(), self.grid.cells());
            return Err(ColumnError::Length { what, found, cells });
        }
        for (i, force) in force.iter_mut().enumerate() {
            let viscous = (1.0 - self.conductance.share[i]) * (self.tau[i + 1] - self.tau[i]) / self.grid.widths()[i];
            *force = medium.beta[i] * (self.velocity[i] - medium.velocity[i]) + viscous;
        }
        Ok(())
    }

    /// Advances the velocity by `dt` \[s], or to the steady state if `dt` is infinite. Backward Euler: order 1 in time, any step
    /// is stable.
    ///
    /// # Errors
    /// [`ColumnError`] if a number is out of range, or the iteration fails; the velocity is then as before the step.
    pub fn step(&mut self, medium: &Medium, forcing: &Forcing, dt: f64) -> Result<Step, ColumnError> {
        medium.check(&self.grid)?;
        forcing.check(self.grid.distances()[0])?;
        // Not (dt > 0) is also true of what is not a number.
        let ahead = dt > 0.0;
        if !ahead {
            return Err(ColumnError::Value { what: "time step [s]", value: dt, allowed: "more than 0, or infinite" });
        }
        let held = dt.is_finite() || forcing.holds() || medium.beta.iter().any(|&beta| beta > 0.0);
        if !held && self.setup.side_wall == SideWall::None {
            return Err(ColumnError::Adrift);
        }
        self.conductance.fill(&self.setup, &self.grid, &medium.phi, forcing)?;
        self.previous.copy_from_slice(&self.velocity);
        let result = self.iterate(medium, forcing.drive, 1.0 / dt);
        if result.is_err() {
            self.velocity.copy_from_slice(&self.previous);
        }
        result
    }

    /// Advances the velocity by `dt` \[s] with everything taken at the start of the step. Forward Euler: stable for steps below
    /// [`Self::explicit_limit`] alone, and there to show it.
    ///
    /// # Errors
    /// [`ColumnError`] if a number is out of range, or the velocity leaves the numbers; it is then as before the step.
    pub fn step_explicit(&mut self, medium: &Medium, forcing: &Forcing, dt: f64) -> Result<Step, ColumnError> {
        medium.check(&self.grid)?;
        forcing.check(self.grid.distances()[0])?;
        self.conductance.fill(&self.setup, &self.grid, &medium.phi, forcing)?;
        self.previous.copy_from_slice(&self.velocity);
        let side_walls = self.assemble(medium, forcing.drive, 0.0).side_walls;
        let gained = self.system.residual.iter().sum();
        let balance = Balance { side_walls, inertia: gained, ..self.balance(medium, forcing.drive, 0.0) };
        let mass = self.mass(&medium.phi);
        for ((u, residual), mass) in self.velocity.iter_mut().zip(&self.system.residual).zip(mass) {
            *u += dt * residual / mass;
        }
        if let Some(i) = self.velocity.iter().position(|u| !u.is_finite()) {
            self.velocity.copy_from_slice(&self.previous);
            return Err(ColumnError::NotFinite { iteration: 0, z: self.grid.centres()[i] });
        }
        Ok(Step { iterations: 1, residual: 0.0, balance })
    }

    /// Longest stable explicit step at the velocity of the last one \[s]: 2 over the largest sum of magnitudes in a row of the
    /// derivatives over the mass of its cell. That is h^2/(2 nu) for diffusion alone and 2 eps rho_f/beta for a drag alone.
    #[must_use]
    pub fn explicit_limit(&self, medium: &Medium) -> f64 {
        let System { lower, diagonal, upper, .. } = &self.system;
        let rows = lower.iter().zip(diagonal).zip(upper).map(|((a, b), c)| a.abs() + b.abs() + c.abs());
        rows.zip(self.mass(&medium.phi)).map(|(row, mass)| 2.0 * mass / row).fold(f64::INFINITY, f64::min)
    }

    /// Mass of the fluid in the cells, per area [kg/m2].
    fn mass(&self, phi: &[f64]) -> Vec<f64> {
        self.grid.widths().iter().zip(phi).map(|(h, phi)| h * (1.0 - phi) * self.setup.rho).collect()
    }

    fn iterate(&mut self, medium: &Medium, drive: f64, rate: f64) -> Result<Step, ColumnError> {
        let newton = self.setup.newton;
        let mut iterations = 0;
        loop {
            let Assembled { scale, side_walls } = self.assemble(medium, drive, rate);
            let Worst { done, residual, z } = self.worst(scale, iterations)?;
            if done {
                let balance = Balance { side_walls, ..self.balance(medium, drive, rate) };
                return Ok(Step { iterations, residual, balance });
            }
            if iterations >= newton.iterations {
                return Err(ColumnError::NotConverged { iterations, residual, tolerance: newton.tolerance, z });
            }
            iterations += 1;
            let System { lower, diagonal, upper, residual, .. } = &mut self.system;
            thomas::solve(lower, diagonal, upper, residual)
                .map_err(|reason| ColumnError::Singular { iteration: iterations, reason })?;
            for (u, correction) in self.velocity.iter_mut().zip(residual) {
                *u += *correction;
            }
        }
    }

    /// Velocity whose gradient makes the stresses [m/s].
    fn sheared(&self, medium: &Medium, i: usize) -> f64 {
        let share = self.conductance.share[i];
        share * self.velocity[i] + (1.0 - share) * medium.velocity[i]
    }

    /// Stresses, residuals and Jacobian at the present velocity.
    fn assemble(&mut self, medium: &Medium, drive: f64, rate: f64) -> Assembled {
        let cells = self.grid.cells();
        let Setup { rho, eta, side_wall, width, .. } = self.setup;
        let [bottom, top] = self.conductance.outside;
        let mut sheared = self.sheared(medium, 0);
        let mut below = self.conductance.at(0, bottom, sheared);
        below.reynolds += self.conductance.given[0];
        below.turbulent = below.turbulent.max(self.conductance.least);
        (self.tau[0], self.reynolds[0]) = (below.tau, below.reynolds);
        let mut scale = below.tau.abs() + below.reynolds.abs();
        let (mut share_below, mut side_walls) = (0.0, 0.0);
        for i in 0..cells {
            let (share, last) = (self.conductance.share[i], i + 1 == cells);
            let upper = if last { top } else { self.sheared(medium, i + 1) };
            let mut above = self.conductance.at(i + 1, sheared, upper);
            if last {
                above.reynolds += self.conductance.given[1];
            }
            (self.tau[i + 1], self.reynolds[i + 1]) = (above.tau, above.reynolds);

            let (h, u, u_p) = (self.grid.widths()[i], self.velocity[i], medium.velocity[i]);
            let (eps, beta) = (1.0 - medium.phi[i], medium.beta[i]);
            let mass = h * eps * rho * rate;
            let wall = side_wall.stress(u, width, eta / rho);
            let wall_area = h * eps * rho * 2.0 / width;
            side_walls += wall_area * wall.value;
            let terms = [
                h * eps * drive,
                h * beta * (u_p - u),
                h * medium.force[i],
                -wall_area * wall.value,
                -mass * (u - self.previous[i]),
            ];
            let stress = share * (above.tau - below.tau) + (above.reynolds - below.reynolds);
            let coupling = |face: &Face| share * face.viscous + face.turbulent;

            let System { lower, diagonal, upper: upper_row, residual, resolution } = &mut self.system;
            residual[i] = stress + terms.iter().sum::<f64>();
            lower[i] = -coupling(&below) * share_below;
            diagonal[i] = (coupling(&below) + coupling(&above)) * share + h * beta + mass + wall_area * wall.derivative;
            let share_above = if last { 0.0 } else { self.conductance.share[i + 1] };
            upper_row[i] = -coupling(&above) * share_above;
            resolution[i] = below.resolution
                + above.resolution
                + h * beta * (u.abs() + u_p.abs())
                + mass * (u.abs() + self.previous[i].abs());

            let largest = terms.iter().fold(above.tau.abs() + above.reynolds.abs(), |m, term| m.max(term.abs()));
            scale = scale.max(largest);
            (below, sheared, share_below) = (above, upper, share);
        }
        Assembled { scale, side_walls }
    }

    /// The cell that misses its balance most, and whether all meet it.
    fn worst(&self, scale: f64, iteration: usize) -> Result<Worst, ColumnError> {
        let mut worst = Worst { done: true, residual: 0.0, z: self.grid.centres()[0] };
        let rows = self.system.residual.iter().zip(&self.system.resolution).zip(self.grid.centres());
        for ((residual, resolution), &z) in rows {
            let residual = residual.abs();
            if !(residual.is_finite() && resolution.is_finite()) {
                return Err(ColumnError::NotFinite { iteration, z });
            }
            worst.done &= residual <= self.setup.newton.tolerance * scale + ROUND_OFF * resolution;
            if residual > worst.residual * scale {
                worst = Worst { residual: residual / scale, z, ..worst };
            }
        }
        Ok(worst)
    }

    /// The momentum of the fluid at the present velocity, but for the side walls.
    fn balance(&self, medium: &Medium, drive: f64, rate: f64) -> Balance {
        let rho = self.setup.rho;
        let cells = self.grid.cells();
        let total = |f: usize| self.tau[f] + self.reynolds[f];
        let mut balance = Balance { top: total(cells), bottom: total(0), ..Balance::default() };
        for (i, &h) in self.grid.widths().iter().enumerate() {
            let (eps, u) = (1.0 - medium.phi[i], self.velocity[i]);
            balance.grains_share += (1.0 - self.conductance.share[i]) * (self.tau[i + 1] - self.tau[i]);
            balance.drive += h * eps * drive;
            balance.drag += h * medium.beta[i] * (medium.velocity[i] - u);
            balance.force += h * medium.force[i];
            balance.inertia += h * eps * rho * rate * (u - self.previous[i]);
        }
        balance
    }
}

/// Sums over the cells.
#[derive(Clone, Copy)]
struct Assembled {
    /// largest force on any cell \[Pa]
    scale: f64,
    /// friction of the side walls \[Pa]
    side_walls: f64,
}

/// The cell that misses its balance most.
#[derive(Clone, Copy)]
struct Worst {
    done: bool,
    residual: f64,
    z: f64,
}
