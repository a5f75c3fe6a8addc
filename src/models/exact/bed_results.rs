//! The numbers of a laminar bed, the same for the closed form and for the solvers.

use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::{Info, Range};
use crate::models::exact::bed::{Drive, LaminarBed};
use crate::models::premises::outside;
use crate::result::{Results, Validity, quantity as q};

/// A continuum layer is at least one grain thick.
const THICKNESS: Range = Range { variable: "mobile_depth_m/d", min: 1.0, max: f64::INFINITY };
/// A bed at rest under the moving grains, too.
const REST: Range = Range { variable: "yield_level_m/d", min: 1.0, max: f64::INFINITY };

/// The largest value of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// its level
    pub level: f64,
    /// the value
    pub value: f64,
}

/// What a solution of the bed comes down to, in units of H, (rho_p - rho_f) g H and (rho_p - rho_f) g H^2/eta.
#[derive(Clone, Copy, Debug)]
pub(in crate::models) struct BedNumbers {
    /// drive
    pub f: f64,
    /// integral of the solid fraction times the grain velocity over the bed
    pub flux: f64,
    /// solid fraction just under the bed level
    pub phi_interface: f64,
    /// integral of the mixture velocity over the height
    pub discharge: f64,
    /// fluid stress at the bed level
    pub tau: f64,
    /// yield level
    pub h_c: f64,
    /// largest velocity
    pub largest: Maximum,
    /// slip U - u_p in the mobile layer just under the bed level, seepage there if nothing moves
    pub slip: f64,
    /// shear rate of the grains at the bed level
    pub shear: f64,
}

/// Reports the transport rate per unit width [m2/s] in all its units.
pub fn transport(results: &mut Results, bed: &LaminarBed, rate: f64) {
    let reduced = (bed.rho_p / bed.rho_f - 1.0) * bed.g;
    results.set(&q::TRANSPORT_RATE, rate);
    results.set(&q::TRANSPORT_RATE_MASS, rate * bed.rho_p);
    results.set(&q::TRANSPORT_RATE_BULK, rate / bed.phi);
    results.set(&q::TRANSPORT_RATE_DIMENSIONLESS, rate / (bed.d * (reduced * bed.d).sqrt()));
}

impl BedNumbers {
    fn moves(&self, bed: &LaminarBed) -> bool {
        self.h_c < bed.h_p / bed.h
    }

    /// Particle Reynolds number, as the catalogue defines it.
    fn particle_reynolds(&self, bed: &LaminarBed) -> f64 {
        let velocity = match bed.drag {
            Some(_) => self.slip / (1.0 - bed.phi) * bed.velocity_scale(),
            None => self.shear * bed.velocity_scale() * bed.d / bed.h,
        };
        bed.rho_f * velocity * bed.d / bed.eta
    }

    /// The reported results, SI.
    pub fn results(&self, bed: &LaminarBed) -> Results {
        let (h, velocity, stress) = (bed.h, bed.velocity_scale(), bed.stress_scale());
        let rate = self.flux * velocity * h;
        let tau = self.tau * stress;
        let discharge = self.discharge * velocity * h;
        let mut results = Results::default();
        transport(&mut results, bed, rate);
        let reduced = (bed.rho_p / bed.rho_f - 1.0) * bed.g;
        results.set(&q::SHIELDS, tau / (reduced * bed.rho_f * bed.d));
        results.set(&q::U_STAR, (tau / bed.rho_f).sqrt());
        results.set(&q::MOBILE_DEPTH, bed.h_p - self.h_c * h);
        results.set(&q::YIELD_LEVEL, self.h_c * h);
        results.set(&q::BED_LEVEL, bed.h_p);
        results.set(&q::FLOW_HEIGHT, h);
        results.set(&q::PHI_INTERFACE, self.phi_interface);
        results.set(&q::U_MAX, self.largest.value * velocity);
        results.set(&q::U_MAX_LEVEL, self.largest.level * h);
        results.set(&q::MEAN_VELOCITY, discharge / h);
        results.set(&q::FLUID_DISCHARGE, discharge - rate);
        if bed.drag.is_some() {
            results.set(&q::SLIP_VELOCITY, self.slip * velocity);
        }
        let drive = match bed.drive {
            Drive::PressureGradient(given) => given,
            Drive::Wanted(..) => self.f * stress / h,
        };
        results.set(&q::DRIVE, drive);
        results.set(&q::DRIVE_DIMENSIONLESS, self.f);
        results.set(&q::REYNOLDS, bed.rho_f * discharge / bed.eta);
        results.set(&q::REYNOLDS_GAP, self.bulk_reynolds(bed));
        results.set(&q::REYNOLDS_PARTICLE, self.particle_reynolds(bed));
        results
    }

    /// Bulk Reynolds number on the gap over the bed: its mean velocity over the gap times the gap over the viscosity.
    fn bulk_reynolds(&self, bed: &LaminarBed) -> f64 {
        // A parabola with the stress tau on the bed and at rest on the wall above.
        let gap = 1.0 - bed.h_p / bed.h;
        let discharge = gap * gap * (self.f * gap / 3.0 - 0.5 * self.tau);
        bed.rho_f * discharge * bed.velocity_scale() * bed.h / bed.eta
    }

    /// Closures used outside their range.
    pub fn validity(&self, bed: &LaminarBed) -> Vec<Validity> {
        let viscosity = bed.viscosity.info();
        let mut found: Vec<Validity> = Vec::new();
        // Einstein's law is for dilute suspensions, which no bed is: docs/theory.md says so once.
        for range in viscosity.ranges.iter().filter(|_| bed.viscosity != MixtureViscosity::Einstein) {
            found.extend(outside(closure_name(viscosity), range, bed.phi));
        }
        if self.moves(bed) {
            let grains = (bed.h_p - self.h_c * bed.h) / bed.d;
            found.extend(outside("continuum/mobile layer".into(), &THICKNESS, grains));
        }
        found.extend(outside("continuum/static layer".into(), &REST, self.h_c * bed.h / bed.d));
        found
    }
}

/// `family/law`.
pub(in crate::models) fn closure_name(info: &Info) -> String {
    format!("{}/{}", info.family, info.law)
}
