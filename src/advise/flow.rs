//! What matters of a turbulent scene, from the case of any of its models.

use std::f64::consts::PI;

use super::AdviseError;
use super::turbulent::COLLISIONS;
use crate::case::grain_tables::Bottom;
use crate::closures::contact::LinearSpring;
use crate::closures::fluctuation::Fluctuation;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::suspension::Suspension;
use crate::problem::{Coupled, Problem, SheetFlow, State, Surface, TwoFluid};
use crate::result::Quiet;
use crate::result::quantity as q;

/// Where these two were measured: slopes, densities of grains over that of the fluid, depths over d.
const MEASURED: [(f64, f64); 3] = [(0.03, 0.07), (2.0, 3.0), (5.0, f64::INFINITY)];
/// Friction of spheres that flow, at vanishing inertial number (Maurin et al. 2016).
const BULK: f64 = 0.35;
/// Solid fraction of a packed bed, and of what moves.
pub(super) const PACKED: f64 = 0.6;

/// What matters of a turbulent scene. All values SI.
pub(super) struct Turbulent {
    pub rho_f: f64,
    pub rho_p: f64,
    pub nu: f64,
    pub d: f64,
    pub g: f64,
    /// depth of the water
    pub depth: f64,
    pub sine: f64,
    pub theta: f64,
    pub mu_s: f64,
    /// friction and restitution coefficient of two grains
    pub contacts: Option<(f64, f64)>,
    /// fall velocity if the case gives it
    pub settling: Option<f64>,
    /// whether a suspension and a viscosity of the mixture are in the case; `None` in a model of grains
    pub continuum: Option<(bool, bool)>,
    pub grains: Option<Grains>,
    /// `kind` of the model of the case
    pub kind: &'static str,
}

/// What only grains have.
pub(super) struct Grains {
    pub contact: LinearSpring,
    pub eddies: bool,
    pub walls: bool,
    pub size: [f64; 2],
    pub layers: f64,
    pub slice: bool,
}

/// Whether a two-fluid scene is a steady flow of water over grains: waves, settling and dry grains have no other model.
pub(super) fn is_steady_in_water(flow: &TwoFluid) -> bool {
    flow.state == State::Steady && flow.oscillation.is_none() && flow.shields() > 0.0 && flow.rho_p < 20.0 * flow.rho_f
}

pub(super) fn of_sheet_flow(flow: &SheetFlow, problem: &Problem) -> Result<Turbulent, AdviseError> {
    let known = flow.tau_b.is_some() && flow.sine.is_some();
    let solved = match crate::run(problem, &mut Quiet) {
        Ok(outcome) => Some(outcome.results),
        Err(_) if known => None,
        Err(failure) => return Err(AdviseError::NoFlow { reason: failure.error.to_string() }),
    };
    let result = |name: &str| solved.as_ref().and_then(|results| results.get(name));
    let theta = flow.tau_b.map(|tau| tau / flow.stress_scale()).or(result(q::SHIELDS.name)).unwrap_or(f64::NAN);
    let depth = flow.height - flow.level;
    let sine =
        flow.sine.or(result(q::SLOPE_SINE.name)).unwrap_or(theta * flow.stress_scale() / (flow.rho_f * flow.g * depth));
    Ok(Turbulent {
        rho_f: flow.rho_f,
        rho_p: flow.rho_p,
        nu: flow.eta / flow.rho_f,
        d: flow.d,
        g: flow.g,
        depth,
        sine,
        theta,
        mu_s: flow.friction.mu_s,
        contacts: None,
        settling: match flow.suspension {
            Suspension::Rouse(law) => Some(law.settling_velocity),
            Suspension::None => None,
        },
        continuum: Some((
            !matches!(flow.suspension, Suspension::None),
            !matches!(flow.viscosity, MixtureViscosity::Clear),
        )),
        grains: None,
        kind: "sheet-flow",
    })
}

pub(super) fn of_two_fluids(flow: &TwoFluid) -> Turbulent {
    Turbulent {
        rho_f: flow.rho_f,
        rho_p: flow.rho_p,
        nu: flow.eta / flow.rho_f,
        d: flow.d,
        g: flow.g,
        depth: flow.depth,
        sine: flow.beta.sin(),
        theta: flow.shields(),
        mu_s: BULK,
        contacts: Some((flow.mu_p, flow.e)),
        settling: None,
        continuum: None,
        grains: None,
        kind: "two-fluid",
    }
}

pub(super) fn of_grains(flow: &Coupled) -> Turbulent {
    let bed = &flow.bed;
    let across = if bed.side_walls { bed.size[1].min(bed.d) } else { bed.size[1] };
    let volume = bed.mobile as f64 * PI / 6.0 * bed.d.powi(3);
    let thickness = volume / (PACKED * bed.size[0] * across.max(bed.size[1]));
    let depth = match flow.surface {
        Surface::Depth(depth) => depth,
        Surface::Height(height) => height - thickness,
    };
    Turbulent {
        rho_f: flow.rho_f,
        rho_p: bed.rho_p,
        nu: flow.nu(),
        d: bed.d,
        g: bed.g,
        depth,
        sine: bed.beta.sin(),
        theta: flow.rho_f * bed.g * depth * bed.beta.sin() / flow.stress_scale(),
        mu_s: BULK,
        contacts: Some((bed.contact.mu, bed.contact.e_n)),
        settling: None,
        continuum: None,
        grains: Some(Grains {
            contact: bed.contact,
            eddies: !matches!(flow.fluctuation, Fluctuation::None),
            walls: bed.side_walls,
            size: bed.size,
            layers: thickness / bed.d,
            slice: bed.bottom == Bottom::Slice,
        }),
        kind: "coupled",
    }
}

impl Turbulent {
    /// Whether what the continua are worth was measured in flows like this one.
    pub fn is_measured(&self) -> bool {
        let values = [self.sine, self.rho_p / self.rho_f, self.depth / self.d];
        values.iter().zip(MEASURED).all(|(x, (low, high))| (low..=high).contains(x))
            && (0.99 * COLLISIONS..=1.1).contains(&self.theta)
    }

    /// Whether the Shields number is that or more: thresholds are not known to the per cent.
    pub fn at_least(&self, threshold: f64) -> bool {
        self.theta >= 0.99 * threshold
    }

    pub fn excess(&self) -> f64 {
        self.rho_p / self.rho_f - 1.0
    }

    pub fn u_star(&self) -> f64 {
        (self.theta * self.excess() * self.g * self.d).sqrt()
    }

    /// Fall velocity [m/s]: that of the case, else of a sphere with the drag 0.4 + 24.4/Re.
    pub fn fall(&self) -> f64 {
        let (c, viscous) = (0.4, 24.4 * self.nu / self.d);
        let weight = 4.0 / 3.0 * self.excess() * self.g * self.d;
        self.settling.unwrap_or(((viscous * viscous + 4.0 * c * weight).sqrt() - viscous) / (2.0 * c))
    }

    /// Share of the weight of the moving bed along the slope in what drives it.
    pub fn weight(&self) -> f64 {
        (1.0 / self.excess() + PACKED) * self.sine / (self.mu_s * PACKED)
    }

    /// Thickness of the moving layer over d: Revil-Baudard & Chauchat (2013), eq. (32).
    pub fn layers(&self) -> f64 {
        self.theta / (self.mu_s * PACKED * (1.0 - self.weight())).max(1e-12)
    }
}
