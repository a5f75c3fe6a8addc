//! How strongly neighbouring cells are coupled: `tau = viscous dU` and `R = turbulent |dU| dU` at each face, dU the
//! difference of the velocity across it.
//!
//! Between two centres one stress passes through two half cells, so their resistances add up. For the viscous stress that is
//! the harmonic mean of the viscosity. For the turbulent one, `R = rho_f eps l_m^2 (dU/dz)^2` gives
//! `dU = sqrt(R/rho_f) int dz/(sqrt(eps) l_m)`, so the integral of 1/l_m counts: exactly, since l_m is linear in a half cell.
//! Layers of different viscosity, and the logarithmic law over a rough wall, are exact then on any grid; the values at the
//! face instead would shift that law by a tenth of u_*/kappa on any equal cells, however fine. Both means are of order 2
//! where the profiles are smooth.

use super::setup::{Bottom, Forcing, Setup, Top, ViscousForm};
use super::{ColumnError, Grid};
use crate::closures::mixing_length::Length;
use crate::closures::mixture_viscosity::RelativeViscosity;

/// The couplings of all faces. Depends on the grains and the boundaries, not on the velocity.
#[derive(Clone, Debug, Default)]
pub(super) struct Conductance {
    /// tau/dU [Pa s/m], one per face
    pub viscous: Vec<f64>,
    /// R/(|dU| dU) [Pa s2/m2], one per face
    pub turbulent: Vec<f64>,
    /// mixing lengths at the faces, as published \[m]
    pub lengths: Vec<f64>,
    /// share of the viscous force that the fluid takes, and of u_f in U, one per cell
    pub share: Vec<f64>,
    /// velocity below the first and above the last face [m/s]
    pub outside: [f64; 2],
    /// stress given at the first and at the last face \[Pa]
    pub given: [f64; 2],
    /// least derivative of the stress at face 0 [Pa s/m], for the Jacobian only: a rough wall at rest holds nothing
    pub least: f64,
}

impl Conductance {
    pub fn new(cells: usize) -> Self {
        let zero = vec![0.0; cells + 1];
        Self {
            viscous: zero.clone(),
            turbulent: zero.clone(),
            lengths: zero,
            share: vec![1.0; cells],
            ..Self::default()
        }
    }

    /// Computes all of it for the solid fractions `phi`.
    pub fn fill(&mut self, setup: &Setup, grid: &Grid, phi: &[f64], forcing: &Forcing) -> Result<(), ColumnError> {
        setup.mixing_length.fill(grid.faces(), phi, &mut self.lengths);
        if let Bottom::Flow { mixing_length, .. } = forcing.bottom {
            self.lengths.iter_mut().for_each(|length| *length += mixing_length);
        }
        let mut below = Half::default();
        for (i, (&phi, &width)) in phi.iter().zip(grid.widths()).enumerate() {
            let (eps, eta) = (1.0 - phi, setup.eta * setup.viscosity.relative(phi));
            if !(eta.is_finite() && eta > 0.0) {
                let (what, z) = ("viscosity of the mixture [Pa s]", grid.centres()[i]);
                return Err(ColumnError::Cell { what, z, value: eta, allowed: "finite and more than 0" });
            }
            let (weight, share) = match setup.form {
                ViscousForm::Mixture => (1.0, eps),
                ViscousForm::Fluid | ViscousForm::Effective => (eps, 1.0),
            };
            self.share[i] = share;
            let (half, root) = (0.5 * width, eps.sqrt());
            let (low, high) = (self.lengths[i], self.lengths[i + 1]);
            let middle = 0.5 * (low + high);
            let viscous = half / (weight * eta);
            let lower = Half { viscous, turbulent: half / root * mean_inverse(low, middle) };
            self.viscous[i] = 1.0 / (below.viscous + lower.viscous);
            self.turbulent[i] = setup.rho / (below.turbulent + lower.turbulent).powi(2);
            below = Half { viscous, turbulent: half / root * mean_inverse(middle, high) };
        }
        let top = grid.cells();
        self.viscous[top] = 1.0 / below.viscous;
        // A lid is a wall: turbulence vanishes at it, whatever a mixing length counted from the bottom says.
        self.turbulent[top] = 0.0;
        self.close(setup, grid, phi[0], forcing);
        Ok(())
    }

    /// The boundaries.
    fn close(&mut self, setup: &Setup, grid: &Grid, phi: f64, forcing: &Forcing) {
        let top = grid.cells();
        (self.outside, self.given, self.least) = ([0.0; 2], [0.0; 2], 0.0);
        match forcing.bottom {
            Bottom::NoSlip => self.turbulent[0] = 0.0,
            Bottom::Flow { velocity, .. } => self.outside[0] = velocity,
            Bottom::Rough { z_0, kappa } => {
                self.least = self.viscous[0];
                self.viscous[0] = 0.0;
                self.turbulent[0] = setup.rho * (1.0 - phi) * (kappa / (grid.distances()[0] / z_0).ln()).powi(2);
            }
            Bottom::Stress(tau) => {
                self.given[0] = tau;
                (self.viscous[0], self.turbulent[0]) = (0.0, 0.0);
            }
        }
        match forcing.top {
            Top::NoSlip => {}
            Top::Lid(u) => self.outside[1] = u,
            Top::FreeSurface => self.viscous[top] = 0.0,
            Top::Stress(tau) => {
                self.given[1] = tau;
                self.viscous[top] = 0.0;
            }
        }
    }

    /// The stresses at face `f` for the velocities below and above it.
    pub fn at(&self, f: usize, lower: f64, upper: f64) -> Face {
        let (difference, size) = (upper - lower, upper.abs() + lower.abs());
        let turbulent = self.turbulent[f] * difference.abs();
        let viscous = self.viscous[f];
        let resolution = (viscous + 2.0 * turbulent) * size;
        Face {
            tau: viscous * difference,
            reynolds: turbulent * difference,
            viscous,
            turbulent: 2.0 * turbulent,
            resolution,
        }
    }
}

/// The resistances of half a cell.
#[derive(Clone, Copy, Default)]
struct Half {
    viscous: f64,
    turbulent: f64,
}

/// The stresses at one face and their derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Face {
    /// viscous stress \[Pa]
    pub tau: f64,
    /// turbulent stress \[Pa]
    pub reynolds: f64,
    /// d tau/d dU [Pa s/m]
    pub viscous: f64,
    /// d R/d dU [Pa s/m]
    pub turbulent: f64,
    /// size of what was subtracted to form them \[Pa]: round-off goes with it
    pub resolution: f64,
}

/// Mean of 1/l over an interval in which l is linear between `a` and `b`: `ln(b/a)/(b - a)`; infinite if l reaches 0.
fn mean_inverse(a: f64, b: f64) -> f64 {
    if a <= 0.0 || b <= 0.0 {
        return f64::INFINITY;
    }
    let (sum, r) = (a + b, (b - a) / (a + b));
    let q = r * r;
    // ln(b/a) = 2 atanh r: the series up to r^8 is exact to round-off here.
    let ratio = if q < 1e-3 {
        1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q / 9.0)))
    } else {
        (b / a).ln() / (2.0 * r)
    };
    2.0 * ratio / sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::quadrature::simpson;
    use approx::assert_relative_eq;

    #[test]
    fn mean_of_the_inverse_by_quadrature() {
        for (a, b) in [(1.0, 1.0), (1.0, 1.01), (1.0, 1.0653), (1.0, 1.0654), (1.0, 2.0), (3.0, 1.0)] {
            let mean = simpson(|x| 1.0 / (a + (b - a) * x), 0.0, 1.0, 1000);
            assert_relative_eq!(mean_inverse(a, b), mean, max_relative = 1e-12);
        }
        assert_eq!(mean_inverse(0.0, 1.0), f64::INFINITY);
        assert_eq!(mean_inverse(1.0, 0.0), f64::INFINITY);
    }
}
