//! What drives a flow, checked: what is given is enough and not too much, what of it not every model solves, and what follows from it.
//!
//! Under a free surface the weight of the fluid along the slope is the stress on the bed: `theta (rho_p - rho_f) g d = rho_f g D sin(beta)`.
//! Two of depth `D`, slope and stress give the third. Under a lid or a plane the depth is given, and one drive.

use super::bed::Top;
use super::{BedScene, BenchmarkScene, ChannelScene, GranularScene};
use crate::case::Fault;

/// Faults of a scene by their path.
pub type SceneFaults = Vec<(&'static str, Fault)>;

fn drives(given: &[&str], allowed: &[&str]) -> Fault {
    let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
    Fault::Drives { given: owned(given), allowed: owned(allowed) }
}

/// The names of what is given.
fn given<const N: usize>(values: [(&'static str, bool); N]) -> Vec<&'static str> {
    values.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
}

impl BedScene {
    /// What is wrong with its drive, by path.
    pub(super) fn faults(&self) -> SceneFaults {
        let flow = &self.flow;
        let mut faults = Vec::new();
        if flow.slope.is_none() && flow.slope_definition.is_some() {
            let name = "slope_definition".to_owned();
            let (model, allowed) = ("a flow without a slope".to_owned(), vec!["slope".to_owned()]);
            let fault = Fault::NotUsed { what: "key", name, model, users: Vec::new(), allowed };
            faults.push(("flow.slope_definition", fault));
        } else if flow.slope.is_some() && flow.slope_definition.is_none() {
            faults.push(("flow.slope_definition", Fault::Needed));
        } else if let Err(fault) = flow.angle() {
            faults.push(("flow.slope", fault));
        }
        let stress = given([("shields", flow.shields.is_some()), ("u_star", flow.u_star.is_some())]);
        let slope = given([("slope", flow.slope.is_some())]);
        let closed = given([
            ("pressure_gradient", flow.pressure_gradient.is_some()),
            ("discharge", flow.discharge.is_some()),
            ("mean_velocity", flow.mean_velocity.is_some()),
        ]);
        let depth = given([("depth", flow.depth.is_some())]);
        let fault = match flow.top {
            Top::FreeSurface => {
                // Waves alone, over a level bed.
                let level = flow.waves() && slope.is_empty() && stress.is_empty() && !depth.is_empty();
                let all = [depth, slope, stress.clone(), closed].concat();
                let allowed = [
                    "depth and slope",
                    "depth and shields",
                    "depth and u_star",
                    "slope and shields",
                    "slope and u_star",
                ];
                let enough = all.len() == if level { 1 } else { 2 } && stress.len() <= 1;
                let known = all.iter().all(|drive| ["depth", "slope", "shields", "u_star"].contains(drive));
                (!enough || !known).then(|| drives(&all, &allowed))
            }
            Top::Solved => {
                let all = [slope.clone(), stress.clone(), closed.clone()].concat();
                (slope.len() != 1 || stress.len() != 1 || !closed.is_empty())
                    .then(|| drives(&all, &["slope and shields", "slope and u_star"]))
            }
            Top::OverFixedGrains { .. } => {
                let all = [depth, slope.clone(), stress, closed].concat();
                (all != slope || slope.is_empty()).then(|| drives(&all, &["slope"]))
            }
            Top::Plane => {
                let allowed = ["pressure_gradient", "discharge", "mean_velocity", "shields", "u_star"];
                let all = [slope.clone(), stress, closed].concat();
                (all.len() != 1 || !slope.is_empty()).then(|| drives(&all, &allowed))
            }
            Top::Stress(_) | Top::ColebrookWhite(_) => {
                let all = [slope, stress, closed.clone()].concat();
                (all.len() != 1 || !closed.is_empty()).then(|| drives(&all, &["slope", "shields", "u_star"]))
            }
        };
        faults.extend(fault.map(|fault| ("flow", fault)));
        if flow.oscillation.is_some() && !flow.recorded.is_empty() {
            let both = ["oscillation", "recorded"];
            faults.push(("flow", drives(&both, &both)));
        }
        if let Some(pair) = flow.recorded.windows(2).find(|pair| pair[1].time <= pair[0].time) {
            let allowed = format!("more than {}, the time before it", pair[0].time);
            faults.push(("flow.recorded", Fault::OutOfRange { name: "time".into(), value: pair[1].time, allowed }));
        }
        if let [first, rest @ ..] = &flow.recorded[..]
            && (first.time != 0.0 || rest.is_empty())
        {
            let allowed = "0 for the first of two and more moments".to_owned();
            faults.push(("flow.recorded", Fault::OutOfRange { name: "time".into(), value: first.time, allowed }));
        }
        let level = flow.slope == Some(0.0) && flow.depth.is_none() && flow.top == Top::FreeSurface;
        if level && faults.is_empty() {
            let allowed = "more than 0 where the depth follows from the stress on the bed".to_owned();
            faults.push(("flow.slope", Fault::OutOfRange { name: "slope".into(), value: 0.0, allowed }));
        }
        if let (Some(depth), None) = (flow.depth, flow.slope)
            && flow.top == Top::FreeSurface
            && self.stress().is_some()
            && faults.is_empty()
            && self.slope_of(depth).is_none()
        {
            let value = self.stress().unwrap_or_default() / (self.fluid.density * flow.gravity * depth);
            faults.push(("flow.depth", Fault::TooSteep { definition: "sine", value }));
        }
        faults
    }

    /// What of it not every model solves, by path.
    pub(super) fn given(&self) -> Vec<&'static str> {
        let flow = &self.flow;
        given([
            ("flow.width", flow.width.is_some()),
            ("flow.section", flow.section.is_some()),
            ("flow.slope", flow.slope.is_some()),
            ("flow.shields", flow.shields.is_some()),
            ("flow.u_star", flow.u_star.is_some()),
            ("flow.pressure_gradient", flow.pressure_gradient.is_some()),
            ("flow.discharge", flow.discharge.is_some()),
            ("flow.mean_velocity", flow.mean_velocity.is_some()),
            ("flow.oscillation", flow.oscillation.is_some()),
            ("flow.recorded", !flow.recorded.is_empty()),
        ])
    }

    /// Its top.
    pub(super) fn top(&self) -> Option<&'static str> {
        Some(self.flow.top.name())
    }

    /// Wanted stress on the bed \[Pa], if there is one.
    fn stress(&self) -> Option<f64> {
        let of_u_star = || Some(self.fluid.density * self.flow.u_star?.powi(2));
        self.flow.shields.map(|theta| theta * self.stress_scale()).or_else(of_u_star)
    }

    /// Angle \[rad] at which fluid of this depth exerts the wanted stress on the bed.
    fn slope_of(&self, depth: f64) -> Option<f64> {
        let sine = self.stress()? / (self.fluid.density * self.flow.gravity * depth);
        Some(sine.asin()).filter(|angle| angle.is_finite())
    }

    /// Depth of the clear fluid over the bed at rest \[m]: given, or what exerts the wanted stress at the slope. `None` where it is known
    /// after the deposit alone.
    #[must_use]
    pub fn depth(&self) -> Option<f64> {
        let flow = &self.flow;
        if flow.depth.is_some() || flow.top != Top::FreeSurface {
            return flow.depth;
        }
        let sine = flow.angle().ok()??.sin();
        let of_shields =
            |theta: f64| theta * (self.grains.density / self.fluid.density - 1.0) * self.grains.diameter / sine;
        let of_u_star = || Some(flow.u_star?.powi(2) / (flow.gravity * sine));
        flow.shields.map(of_shields).or_else(of_u_star)
    }

    /// Slope \[rad]: given, 0 under waves that alone drive the flow, or that at which fluid of the given depth exerts the wanted stress on the bed under a free surface.
    #[must_use]
    pub fn slope(&self) -> Option<f64> {
        let flow = &self.flow;
        match flow.angle() {
            Ok(Some(angle)) => Some(angle),
            Ok(None) if flow.top == Top::FreeSurface && self.stress().is_none() => flow.waves().then_some(0.0),
            Ok(None) if flow.top == Top::FreeSurface => self.slope_of(flow.depth?),
            _ => None,
        }
    }
}

impl ChannelScene {
    /// What is wrong with its drive, by path.
    pub(super) fn faults(&self) -> SceneFaults {
        let flow = &self.flow;
        let given = given([
            ("pressure_gradient", flow.pressure_gradient.is_some()),
            ("mean_velocity", flow.mean_velocity.is_some()),
            ("u_star", flow.u_star.is_some()),
        ]);
        let fault = (given.len() != 1).then(|| drives(&given, &["pressure_gradient", "mean_velocity", "u_star"]));
        fault.map(|fault| ("flow", fault)).into_iter().collect()
    }
}

impl ChannelScene {
    /// What of it not every model solves, by path.
    pub(super) fn given(&self) -> Vec<&'static str> {
        let flow = &self.flow;
        given([
            ("fluid.yield_stress", self.fluid.yield_stress != 0.0),
            ("flow.section", flow.section.is_some()),
            ("flow.pressure_gradient", flow.pressure_gradient.is_some()),
            ("flow.mean_velocity", flow.mean_velocity.is_some()),
            ("flow.u_star", flow.u_star.is_some()),
        ])
    }

    /// A channel has none to choose.
    pub(super) fn top(&self) -> Option<&'static str> {
        None
    }
}

impl BenchmarkScene {
    /// What it needs depends on the model.
    pub(super) fn faults(&self) -> SceneFaults {
        Vec::new()
    }

    /// Its matter, by path.
    pub(super) fn given(&self) -> Vec<&'static str> {
        given([("fluid", self.fluid.is_some()), ("grains", self.grains.is_some())])
    }

    /// Its geometry is a matter of the model.
    pub(super) fn top(&self) -> Option<&'static str> {
        None
    }
}

impl GranularScene {
    /// Side walls, by path.
    pub(super) fn given(&self) -> Vec<&'static str> {
        given([("flow.width", self.flow.width.is_some())])
    }

    /// The top of the grains is free.
    pub(super) fn top(&self) -> Option<&'static str> {
        None
    }

    /// What is wrong with its slope, by path.
    pub(super) fn faults(&self) -> SceneFaults {
        let missing = self.flow.slope != 0.0 && self.flow.slope_definition.is_none();
        let missing = missing.then_some(("flow.slope_definition", Fault::Needed));
        let steep = self.flow.angle().err().map(|fault| ("flow.slope", fault));
        missing.into_iter().chain(steep).collect()
    }
}
