//! Newtonian fluid over a Coulomb bed between two planes: the closed form of Ouriemi et al. (2009), in the mixed form (one
//! velocity) and in the two-fluid form (fluid and grains slip).
//!
//! Units: H, (rho_p - rho_f) g H, eta/((rho_p - rho_f) g H); `f = -dp/dx/((rho_p - rho_f) g)`, `e = eta_e/eta`. The particle
//! pressure is hydrostatic, `P_p = phi (h_p - z)`. Summed over the phases and per phase (K permeability in H^2):
//!
//! ```text
//! clear fluid  h_p < z < 1     U'' + f = 0                    U(1) = 0
//! mobile bed   h_c < z < h_p   e U'' + f - mu_s phi = 0       U - u_p = K mu_s phi
//! static bed   0 < z < h_c     e U'' + f - U/K = 0            u_p = 0, U(0) = 0     (mixed: U = 0)
//! ```
//!
//! `U` and the fluid stress `e U'` are continuous. The grains yield where the stress they carry reaches `mu_s P_p`.
//!
//! - Mobile layer: `U = K mu_s phi + s (z - h_c) + B (z - h_c)^2/2`, `B = (mu_s phi - f)/e`, `s = U'(h_c)` of the static
//!   layer (mixed: K = 0, s = 0).
//! - No slip at the top gives the yield level: `K mu_s phi + s Y + B Y^2/2 + e (s + B Y) D - f D^2/2 = 0`, with
//!   `Y = h_p - h_c`, `D = 1 - h_p`; mixed: `Y = D (-e + sqrt(e^2 + f/B))`.
//! - Flux `phi (s Y^2/2 + B Y^3/6)`.
//! - The two-fluid form has a threshold: the grains rest while the seepage velocity at h_p stays below `K mu_s phi`. The
//!   mixed form has none.
//!
//! Sources: Ouriemi, Aussillous & Guazzelli (2009), J. Fluid Mech. 636, 295-319; Chauchat & Medale (2010), eq. (12)-(13)
//! and section 3.2.

mod model;
mod outcome;
#[cfg(test)]
mod tests;

use crate::closures::mixture_viscosity::RelativeViscosity;
pub(in crate::models) use outcome::{drag_text, viscosity_text};
pub use outcome::{equations, run};

use super::brinkman::Brinkman;
use super::no_root;
use crate::models::BedError;
use crate::models::bed_error::in_si;
use crate::models::exact::bed::{Drive, LaminarBed};
use crate::models::exact::bed_results::Maximum;
use crate::numerics::root::brent;
use crate::result::SolveError;

/// The numbers that the problem comes down to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// drive -dp/dx/((rho_p - rho_f) g)
    pub f: f64,
    /// mu_s phi: the drive that friction resists
    pub resistance: f64,
    /// eta_e/eta
    pub e: f64,
    /// bed level in H
    pub h_p: f64,
    /// permeability in H^2; `None` in the mixed form
    pub k: Option<f64>,
}

/// The closed form with its constants, in the units of the model.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// the problem
    pub scaled: Scaled,
    /// yield level; the bed level where the bed is at rest
    pub h_c: f64,
    /// U'(h_c)
    s: f64,
    /// U''(z) in the mobile layer
    b: f64,
    /// the static layer of the two-fluid form
    static_layer: Option<Brinkman>,
    /// U(h_p)
    u_interface: f64,
    /// fluid stress at h_p
    pub tau_interface: f64,
}

impl Scaled {
    /// Largest drive with a static layer at the bottom: where Y = h_p in the mixed form, mu_s phi in the two-fluid form, in
    /// which the yield level only approaches the wall.
    #[must_use]
    pub fn largest_drive(&self) -> f64 {
        if self.k.is_some() {
            return self.resistance;
        }
        let q = (self.h_p / (1.0 - self.h_p) + self.e).powi(2) - self.e * self.e;
        q * self.resistance / (self.e + q)
    }

    /// Depth Y \[H] of the mobile layer of the mixed form, as if the bed were deep enough.
    fn mixed_depth(&self) -> f64 {
        let ratio = self.f * self.e / (self.resistance - self.f);
        (1.0 - self.h_p) * ratio / (self.e + (self.e * self.e + ratio).sqrt())
    }

    /// The closed form. `see` receives the residuals of the search for the yield level.
    ///
    /// # Errors
    /// [`BedError::NoStaticBed`] if the drive exceeds the friction, [`BedError::WholeBedMoves`] in units of H if the mixed
    /// form has no static layer, [`NumericalError::NoRoot`](crate::result::NumericalError::NoRoot) if the yield level is not found.
    pub fn solve(self, see: impl FnMut(f64)) -> Result<Solution, SolveError> {
        if self.f >= self.resistance {
            return Err(BedError::NoStaticBed { drive: self.f, limit: self.resistance }.into());
        }
        match self.k {
            None => self.mixed(),
            Some(k) => self.two_fluid(k, see),
        }
    }

    fn mixed(self) -> Result<Solution, SolveError> {
        let y = self.mixed_depth();
        if y >= self.h_p {
            return Err(BedError::WholeBedMoves {
                mobile_depth_m: y,
                bed_m: self.h_p,
                limit_pa_m: self.largest_drive(),
            }
            .into());
        }
        let b = (self.resistance - self.f) / self.e;
        Ok(Solution {
            scaled: self,
            h_c: self.h_p - y,
            s: 0.0,
            b,
            static_layer: None,
            u_interface: 0.5 * b * y * y,
            tau_interface: self.e * b * y,
        })
    }

    fn two_fluid(self, k: f64, see: impl FnMut(f64)) -> Result<Solution, SolveError> {
        let Self { f, resistance, e, h_p, .. } = self;
        let d = 1.0 - h_p;
        let b = (resistance - f) / e;
        let slip = k * resistance;
        let layer = |h: f64, top: f64| Brinkman { seepage: k * f, length: (k * e).sqrt(), h, top };
        // Residual of no slip at the upper wall for a yield level h_c, relative to the drive of the clear fluid.
        let residual = |h_c: f64| {
            let y = h_p - h_c;
            let s = layer(h_c, slip).slope(h_c);
            (slip + s * y + 0.5 * b * y * y + e * (s + b * y) * d) / (0.5 * f * d * d) - 1.0
        };
        if residual(h_p) >= 0.0 {
            // At rest: U(h_p) is linear in the velocity at the top of the seepage.
            let (slope_0, slope_1) = (layer(h_p, 0.0).slope(h_p), layer(h_p, slip).slope(h_p));
            let gain = (slope_1 - slope_0) / slip;
            let u = (0.5 * f * d * d - e * slope_0 * d) / (1.0 + e * gain * d);
            let rest = layer(h_p, u);
            let tau = e * rest.slope(h_p);
            return Ok(Solution {
                scaled: self,
                h_c: h_p,
                s: rest.slope(h_p),
                b,
                static_layer: Some(rest),
                u_interface: u,
                tau_interface: tau,
            });
        }
        // The slope K mu_s phi/h_c of a thin static layer grows without bound, so the residual is positive near the bottom.
        let low = (0.5 * e * slip / (f * d)).min(0.5 * h_p);
        let h_c = brent(residual, low, h_p, see).map_err(no_root("no slip at the upper wall, for the yield level"))?;
        let rest = layer(h_c, slip);
        let (s, y) = (rest.slope(h_c), h_p - h_c);
        Ok(Solution {
            scaled: self,
            h_c,
            s,
            b,
            static_layer: Some(rest),
            u_interface: slip + s * y + 0.5 * b * y * y,
            tau_interface: e * (s + b * y),
        })
    }
}

impl Solution {
    /// Depth Y of the mobile layer; 0 where the bed is at rest.
    #[must_use]
    pub fn mobile_depth(&self) -> f64 {
        self.scaled.h_p - self.h_c
    }

    /// Whether grains move.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.h_c < self.scaled.h_p
    }

    /// Slip U - u_p in the mobile layer.
    #[must_use]
    pub fn slip(&self) -> f64 {
        self.scaled.k.unwrap_or(0.0) * self.scaled.resistance
    }

    /// Mixture velocity U(z).
    #[must_use]
    pub fn mixture(&self, z: f64) -> f64 {
        if z > self.scaled.h_p {
            // As a product, so that it vanishes at the wall to the last bit.
            let Scaled { f, h_p, .. } = self.scaled;
            (1.0 - z) * (self.u_interface / (1.0 - h_p) + 0.5 * f * (z - h_p))
        } else if z > self.h_c {
            self.slip() + self.particle(z)
        } else {
            self.static_layer.map_or(0.0, |layer| layer.velocity(z))
        }
    }

    /// Grain velocity u_p(z), for z up to h_p.
    #[must_use]
    pub fn particle(&self, z: f64) -> f64 {
        let x = (z - self.h_c).max(0.0);
        self.s * x + 0.5 * self.b * x * x
    }

    /// Shear rate of the grains u_p'(z), for z up to h_p.
    #[must_use]
    pub fn shear_rate(&self, z: f64) -> f64 {
        if z > self.h_c { self.s + self.b * (z - self.h_c) } else { 0.0 }
    }

    /// Viscous stress of the fluid.
    #[must_use]
    pub fn fluid_stress(&self, z: f64) -> f64 {
        if z > self.scaled.h_p {
            self.tau_interface - self.scaled.f * (z - self.scaled.h_p)
        } else if z > self.h_c {
            self.scaled.e * self.shear_rate(z)
        } else {
            self.static_layer.map_or(0.0, |layer| self.scaled.e * layer.slope(z))
        }
    }

    /// Shear stress of the grains, for z up to h_p. Below the yield level it is what the momentum of the grains asks for:
    /// the integral of the drag in the two-fluid form, of the drive in the mixed form.
    #[must_use]
    pub fn particle_stress(&self, z: f64) -> f64 {
        let Scaled { resistance, h_p, f, k, .. } = self.scaled;
        if z > self.h_c {
            return resistance * (h_p - z);
        }
        let below = match (self.static_layer, k) {
            (Some(layer), Some(k)) => layer.integral_above(z) / k,
            _ => f * (self.h_c - z),
        };
        resistance * self.mobile_depth() + below
    }

    /// Solid flux, integral of phi u_p, per phi.
    #[must_use]
    pub fn flux(&self) -> f64 {
        let y = self.mobile_depth();
        0.5 * self.s * y * y + self.b * y * y * y / 6.0
    }

    /// Integral of U over the whole height.
    #[must_use]
    pub fn discharge(&self) -> f64 {
        let (d, y) = (1.0 - self.scaled.h_p, self.mobile_depth());
        let clear = self.u_interface * d + 0.5 * self.tau_interface * d * d - self.scaled.f * d * d * d / 6.0;
        self.static_layer.map_or(0.0, |layer| layer.integral_above(0.0)) + self.slip() * y + self.flux() + clear
    }

    /// The largest velocity.
    #[must_use]
    pub fn largest_velocity(&self) -> Maximum {
        let x = (self.tau_interface / self.scaled.f).min(1.0 - self.scaled.h_p);
        let value = self.u_interface + self.tau_interface * x - 0.5 * self.scaled.f * x * x;
        Maximum { level: self.scaled.h_p + x, value }
    }
}

/// The drive f and the closed form of `bed`; a wanted Shields number, mean velocity or discharge is solved for. `see` receives residuals.
///
/// # Errors
/// Those of [`Scaled::solve`], in SI; [`BedError::OutOfReach`] if no drive gives what is wanted.
pub fn solve(bed: &LaminarBed, see: impl FnMut(f64)) -> Result<Solution, SolveError> {
    let weight = (bed.rho_p - bed.rho_f) * bed.g;
    let scaled = |f: f64| Scaled {
        f,
        resistance: bed.friction.stress(bed.phi),
        e: bed.viscosity.relative(bed.phi),
        h_p: bed.h_p / bed.h,
        k: bed.drag.map(|law| law.permeability(bed.phi, bed.d / bed.h)),
    };
    let f = match bed.drive {
        Drive::PressureGradient(gradient) => gradient / weight,
        Drive::Wanted(what, wanted) => {
            let found = |f: f64| {
                let flow = scaled(f).solve(|_| {}).ok()?;
                Some(what.of(bed, [flow.tau_interface, flow.discharge(), flow.flux() * bed.phi]))
            };
            let (low, high) = (1e-15 * scaled(0.0).largest_drive(), (1.0 - 1e-9) * scaled(0.0).largest_drive());
            let largest = found(high).unwrap_or(0.0);
            if wanted > largest {
                return Err(BedError::OutOfReach { quantity: what.name(), wanted, largest }.into());
            }
            // The history is that of the drive: the searches inside it have other scales.
            let f = brent(|f| found(f).map_or(f64::NAN, |value| value / wanted - 1.0), low, high, see)
                .map_err(no_root("the drive that gives what is wanted"))?;
            return scaled(f).solve(|_| {});
        }
    };
    scaled(f).solve(see).map_err(|error| in_si(error, bed))
}
