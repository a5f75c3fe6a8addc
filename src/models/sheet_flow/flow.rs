//! The flow in the units of the model: d, (rho_p - rho_f) g d, sqrt((rho_p/rho_f - 1) g d), rho_f.
//!
//! In these units a bed stress is a Shields number, a solid flux is the dimensionless transport rate, the density of the
//! fluid is 1 and that of the grains 1 + Delta, gravity is 1/Delta, and the buoyant weight of grains is 1 a volume.

use crate::closures::dilatancy::PhiI;
use crate::closures::drag::Dallavalle;
use crate::closures::friction::{FrictionLaw, MuI};
use crate::closures::mixture_viscosity::{MixtureViscosity, RelativeViscosity};
use crate::closures::rearrangement::{Clock, Grain, Rearrangement};
use crate::closures::suspension::Settling;
use crate::models::sheet_flow::SheetFlow;
use crate::numerics::dual::Real;

/// The largest regularisation whose sheet has a bottom, by a factor of ten [1/s] (docs/sheet-flow.md).
const CREEP: f64 = 1e-6;

/// Laws and constants of the flow, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<F = MuI> {
    /// rho_p/rho_f - 1
    pub delta: f64,
    /// kinematic viscosity
    pub nu: f64,
    /// friction of the grains
    pub friction: F,
    /// dilatancy of the grains
    pub dilatancy: PhiI,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases
    pub drag: Dallavalle,
    /// rearrangement time
    pub rearrangement: Rearrangement,
    /// von Karman's constant
    pub kappa: f64,
    /// solid fraction at which the turbulence dies
    pub phi_l: f64,
    /// settling velocity of grains in suspension, scaled; `None`: clear fluid above the bed
    pub settling: Option<f64>,
    /// regularisation; 0 for the exact yield
    pub lambda: f64,
    /// creep that rounds the edge of the flow, where the exact yield has none
    pub creep: f64,
    /// solid volume under the interface in which the buoyancy of the viscous stress is left out
    pub cut: f64,
}

/// What is known of a cell of the bed from its own unknowns.
#[derive(Clone, Copy, Debug)]
pub struct Cell<T> {
    /// solid volume
    pub dm: T,
    /// height
    pub dz: T,
    /// solid fraction
    pub phi: T,
    /// inertial number
    pub inertia: T,
    /// particle pressure
    pub pressure: T,
    /// shear rate of the grains
    pub gamma: T,
    /// shear rate of the mixture
    pub rate: T,
    /// stress of the grains
    pub tau_p: T,
    /// viscous stress of the fluid
    pub tau_f: T,
    /// mixing length
    pub length: T,
}

/// The unknowns that a cell depends on.
#[derive(Clone, Copy, Debug)]
pub struct Unknowns<T> {
    /// mobilised friction tau_p/P_p
    pub r: T,
    /// fluid stress, viscous and turbulent
    pub s: T,
    /// slip U - u_p, mean of the nodes above and below
    pub w: T,
    /// dilation, mean of the nodes above and below
    pub d: T,
    /// solid volume per area of the cells
    pub m: T,
    /// sine of the slope
    pub sine: T,
    /// solid volume per area at rest below the cells
    pub rest: T,
}

impl<F: FrictionLaw> Flow<F> {
    /// The laws of a flow, scaled.
    #[must_use]
    pub fn scaled(sheet: &SheetFlow<F>) -> Self {
        let velocity = sheet.velocity_scale();
        Self {
            delta: sheet.rho_p / sheet.rho_f - 1.0,
            nu: sheet.eta / (sheet.rho_f * velocity * sheet.d),
            friction: sheet.friction,
            dilatancy: sheet.dilatancy,
            viscosity: sheet.viscosity,
            drag: sheet.drag,
            rearrangement: sheet.rearrangement,
            kappa: sheet.mixing_length.kappa,
            phi_l: sheet.mixing_length.phi_max,
            settling: sheet.suspension.settling_velocity().map(|w_s| w_s / velocity),
            lambda: sheet.lambda * sheet.d / velocity,
            creep: CREEP * sheet.d / velocity,
            cut: sheet.cut / sheet.d,
        }
    }

    /// The grain and its fluid.
    #[must_use]
    pub fn grain(&self) -> Grain {
        Grain { d: 1.0, rho_p: 1.0 + self.delta, rho_f: 1.0, eta: self.nu }
    }

    /// Weight of the fluid along the slope, per volume.
    #[must_use]
    pub fn fluid_weight<T: Real>(&self, sine: T) -> T {
        sine / self.delta
    }

    /// Weight of the grains along the slope, per solid volume.
    #[must_use]
    pub fn grain_weight<T: Real>(&self, sine: T) -> T {
        sine * ((1.0 + self.delta) / self.delta)
    }

    /// Mixing length above the solid volume `below`, for the dilation `d` of what lies there.
    #[must_use]
    pub fn mixing_length<T: Real>(&self, d: T, below: T) -> T {
        let rest = 1.0 / self.dilatancy.phi_max - 1.0 / self.phi_l;
        (d + below * rest) * self.kappa
    }

    /// Shear rate and viscous stress under the fluid stress `s`: the root of `eta_e G + a |G| G = s`, `a` the density of the
    /// fluid times the squared mixing length, `f` the fluidity 1/eta_e, which may vanish.
    pub fn shear<T: Real>(s: T, a: T, f: T) -> (T, T) {
        let viscous = s * 2.0 / ((a * s.abs() * f * f * 4.0 + 1.0).sqrt() + 1.0);
        (f * viscous, viscous)
    }

    /// Drag force of a volume with the solid fraction `phi` at the slip `w`.
    #[must_use]
    pub fn drag<T: Real>(&self, phi: T, w: T) -> T {
        self.drag.coefficient(phi, w, (1.0, self.nu), 1.0) * w
    }

    /// The laws in the cell whose middle and size are the shares `middle` and `size` of the solid volume.
    pub fn cell<T: Real>(&self, middle: f64, size: f64, x: &Unknowns<T>) -> Cell<T> {
        let cosine = (-(x.sine * x.sine) + 1.0).sqrt();
        let pressure = cosine * x.m * middle;
        let rate = self.rearrangement.rate(&self.grain(), pressure, x.w);
        // The law is odd in the shear rate.
        let creep = if self.lambda == 0.0 { T::constant(0.0) } else { T::constant(self.lambda) / rate };
        let inertia = self.friction.mobilised(x.r.abs(), creep);
        let speed = inertia * rate;
        let gamma = if x.r.value() < 0.0 { -speed } else { speed };
        let phi = self.dilatancy.solid_fraction(inertia);
        let length = self.mixing_length(x.d, x.m * (1.0 - middle) + x.rest);
        let a = (-phi + 1.0) * length * length;
        let (shear, tau_f) = Self::shear(x.s, a, self.viscosity.fluidity(phi) / self.nu);
        let dm = x.m * size;
        Cell { dm, dz: dm / phi, phi, inertia, pressure, gamma, rate: shear, tau_p: x.r * pressure, tau_f, length }
    }
}
