//! A checked problem: immutable values in SI, whatever the model. After this nothing is out of range and no unit remains.

use std::sync::Arc;

use super::{Description, Faults, ModelInfo, Solve, SteadyDrive};
use crate::case::{Case, Fault};
use crate::closures::{Info, Range};
use crate::result::{
    Class, Context, Failure, Figure, Head, NumericalError, Outcome, Profile, Results, StatedLaw, Statement, Status,
    quantity as q,
};
use crate::scene::{BedScene, Scene, Top};

/// Relative residual of a balance from which on a result has lost its digits: it is round-off otherwise.
const LARGEST_IMBALANCE: f64 = 1e-3;

/// Mean velocity against the drive, over the velocity scale of the model, that round-off may leave where nothing moves.
const AT_REST: f64 = 1e-9;

/// A checked problem.
#[derive(Clone, Debug)]
pub struct Problem {
    /// stem of the case
    pub name: String,
    /// the question
    pub title: String,
    /// name of the model
    pub kind: &'static str,
    /// whether its results are means of fluctuating quantities
    pub stochastic: bool,
    /// the flow, where a case states it
    pub scene: Option<Scene>,
    solver: Arc<dyn Solve>,
}

/// A case and the problem that it states.
pub type Checked = (Case, Problem);

impl Problem {
    pub(super) fn new(case: &Case, scene: Scene, info: ModelInfo, solver: Arc<dyn Solve>) -> Self {
        let (name, title) = (case.name.clone(), case.about().title.clone());
        Self { name, title, kind: info.name, stochastic: info.stochastic, scene: Some(scene), solver }
    }

    /// A problem that no case states.
    pub(super) fn of(name: &str, info: ModelInfo, solver: Arc<dyn Solve>) -> Self {
        Self {
            name: name.into(),
            title: name.into(),
            kind: info.name,
            stochastic: info.stochastic,
            scene: None,
            solver,
        }
    }

    /// Solves it and completes the outcome.
    ///
    /// # Errors
    /// As [`Problem::solve`].
    pub fn run(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        self.complete(self.solve(context))
    }

    /// Solves it. A result that is not a finite number is a failure, and so are a balance that does not close and a mean flow
    /// against a steady drive.
    ///
    /// # Errors
    /// [`Failure`]: why the method failed, with the numbers that say so and the last good state.
    pub fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        let outcome = self.solver.solve(context)?.trusted(LARGEST_IMBALANCE)?;
        match self.solver.drive().and_then(|drive| uphill(&drive, &outcome)) {
            None => Ok(outcome),
            Some(error) => Err(Failure { error: error.into(), last: Some(Box::new(outcome)) }),
        }
    }

    /// What was solved with what needs no solving: equations, laws, the figures of the model, the work.
    ///
    /// # Errors
    /// The failure that it is given, with its last state completed.
    pub fn complete(&self, solved: Result<Outcome, Failure>) -> Result<Outcome, Failure> {
        let complete = |outcome: &mut Outcome| {
            outcome.statement = self.statement();
            outcome.work = self.cells() as f64 * outcome.steps();
            if let Some(Scene::Bed(scene)) = &self.scene {
                shields(scene, &mut outcome.results);
            }
            if let Some(scene) = &self.scene {
                outcome.regime = self.solver.premises(scene, &outcome.results);
                outcome.regime.retain(|premise| premise.value.is_finite());
            }
            let figures = self.solver.figures(&self.name, outcome);
            outcome.figures.extend(figures.into_iter().map(Figure::finite));
        };
        match solved {
            Ok(mut outcome) => {
                complete(&mut outcome);
                Ok(outcome)
            }
            Err(mut failure) => {
                failure.last.iter_mut().for_each(|last| complete(last));
                Err(failure)
            }
        }
    }

    /// Its equations, and its laws as readers meet them.
    #[must_use]
    pub fn statement(&self) -> Statement {
        let Description { equations, laws, .. } = self.describe();
        let law = |info: &&Info| StatedLaw {
            family: info.family.into(),
            law: info.law.into(),
            equation: info.equation.into(),
            source: info.source.into(),
            ranges: info.ranges.iter().map(Range::to_string).collect(),
        };
        Statement { equations, laws: laws.iter().map(law).collect() }
    }

    /// What is known of a run of `case`, which states this problem, on `threads` threads.
    #[must_use]
    pub fn head(&self, case: &Case, threads: usize) -> Head {
        Head {
            case: self.name.clone(),
            title: self.title.clone(),
            model: self.model_name(),
            scene: self.scene.as_ref().map(Scene::record),
            source: case.source.clone(),
            overrides: case.overrides.clone(),
            resolved: case.resolved(),
            parts: case.parts(),
            threads,
            statement: self.statement(),
        }
    }

    /// Its equations and laws.
    #[must_use]
    pub fn describe(&self) -> Description {
        self.solver.describe()
    }

    /// Number of levels of the profile, or of mobile grains.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.solver.cells()
    }

    /// What is solved, whatever its type.
    #[must_use]
    pub fn solver(&self) -> &dyn Solve {
        self.solver.as_ref()
    }

    /// The model in words, with its form where it has one.
    #[must_use]
    pub fn model_name(&self) -> String {
        match self.describe().form {
            Some(form) => format!("{}, {form}", self.kind),
            None => self.kind.to_owned(),
        }
    }
}

/// Checks name catalogued results, or columns at a level; a limit is along a key of a table of the case.
pub(super) fn checks(case: &Case, faults: &mut Faults) {
    if let Some(limit) = case.limit() {
        let key = limit.over.split_once('=').map(|(key, values)| (key.trim(), values.trim()));
        if key.is_none_or(|(key, values)| key.is_empty() || values.is_empty()) {
            faults.push(("limit.over", Fault::LimitKey { over: limit.over.clone() }));
        }
        if limit.beyond == Class::Holds {
            faults.push(("limit.beyond", Fault::LimitHolds));
        }
    }
    for (i, check) in case.checks().iter().enumerate() {
        let column = check.quantity.strip_prefix("profile.");
        let list = if column.is_some() { q::COLUMNS } else { q::RESULTS };
        let name = column.unwrap_or(&check.quantity);
        if q::find(list, name).is_none() {
            let nearest = crate::case::nearest(name, list.iter().map(|q| q.name));
            let prefix = if column.is_some() { "profile." } else { "" };
            let fault = Fault::UnknownQuantity {
                name: check.quantity.clone(),
                nearest: nearest.map(|n| format!("{prefix}{n}")),
            };
            faults.push((format!("check.{i}.quantity"), fault));
        } else if column.is_some() != check.at.is_some() {
            let fault = Fault::CheckLevel { name: check.quantity.clone(), column: column.is_some() };
            faults.push((format!("check.{i}.quantity"), fault));
        }
    }
}

/// The Shields numbers of every flow over a bed, each with its friction velocity, or why it has none. What the scene alone fixes is the
/// same in every model; a model says what else its walls or its lid leave.
fn shields(scene: &BedScene, results: &mut Results) {
    if let (Some(theta), Some(u_star)) = (scene.shields_drive().filter(|theta| theta.is_finite()), scene.u_star_drive())
    {
        results.set(&q::SHIELDS_DRIVE, theta);
        results.set(&q::U_STAR_DRIVE, u_star);
        if results.get(q::SHIELDS.name).is_none() {
            results.set(&q::SHIELDS, theta);
            results.set(&q::U_STAR, u_star);
        }
    } else {
        let why = match scene.flow.top {
            Top::OverFixedGrains { .. } => "the depth is known after the deposit",
            Top::Plane | Top::Stress(_) | Top::Solved | Top::ColebrookWhite(_) => {
                "the scene does not fix the stress on the bed: the top takes its share of the drive"
            }
            Top::FreeSurface => "the scene does not fix the stress on the bed",
        };
        results.undefined(&q::SHIELDS_DRIVE, why);
        results.undefined(&q::U_STAR_DRIVE, why);
        if results.iter().all(|(name, _)| name != q::SHIELDS.name) {
            results.undefined(&q::SHIELDS, "it was not found");
        }
    }
    let known = |quantity: &q::Quantity| results.iter().any(|(name, _)| name == quantity.name);
    if !known(&q::U_STAR) {
        match results.get(q::SHIELDS.name) {
            Some(theta) => results.set(&q::U_STAR, scene.u_star(theta)),
            None => results.undefined(&q::U_STAR, "the Shields number is not known"),
        }
    }
}

/// Why a flow under a steady drive is none: it goes the other way.
fn uphill(drive: &SteadyDrive, outcome: &Outcome) -> Option<NumericalError> {
    let against = |u: &f64| outcome.status == Status::Done && *u < -AT_REST * drive.velocity_scale;
    let velocity_m_s = mean_velocity(outcome).filter(against)?;
    Some(NumericalError::FlowsUphill { velocity_m_s, over_s: drive.at_s.map(|at| [at; 2]), hint: drive.hint })
}

/// Mean velocity of the fluid over its height [m/s]: as reported, from its discharge, or from its profile.
fn mean_velocity(outcome: &Outcome) -> Option<f64> {
    let result = |quantity: &q::Quantity| outcome.results.get(quantity.name);
    let discharge = || Some(result(&q::FLUID_DISCHARGE)? / result(&q::FLOW_HEIGHT)?);
    result(&q::MEAN_VELOCITY).or_else(discharge).or_else(|| over_height(outcome.profile.as_ref()?))
}

/// Mean of the velocity of the mixture between the lowest and the highest level, by the trapezoidal rule [m/s].
fn over_height(profile: &Profile) -> Option<f64> {
    let (z, u) = (profile.axis(), profile.get(&q::U_MIXTURE)?);
    let known: Vec<(f64, f64)> = z.iter().zip(u).filter_map(|(z, u)| Some((*z, (*u)?))).collect();
    let height = known.last()?.0 - known.first()?.0;
    let sum: f64 = known.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum();
    (height > 0.0).then(|| sum / height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::builtin;

    fn drive(case: &str) -> Option<SteadyDrive> {
        builtin().load(case, &[]).unwrap().1.solver().drive()
    }

    #[test]
    fn a_mean_flow_against_a_steady_drive_is_a_failure_and_a_wave_is_none() {
        let (_, problem) = builtin().load("flow_theta06-sheet-flow", &[]).unwrap();
        let steady = drive("flow_theta06-sheet-flow").unwrap();
        let mut outcome = Context::quiet(|context| problem.run(context)).unwrap();
        assert!(mean_velocity(&outcome).unwrap() > 0.5, "{:?}", mean_velocity(&outcome));
        assert_eq!(uphill(&steady, &outcome), None);
        let column = |sign: f64| {
            let profile = outcome.profile.as_ref().unwrap();
            let mut turned = Profile::new(profile.axis()).unwrap();
            let u = profile.get(&q::U_MIXTURE).unwrap();
            turned.push(&q::U_MIXTURE, u.iter().map(|u| u.map(|u| sign * u)).collect()).unwrap();
            turned
        };
        let (turned, kept) = (column(-1.0), column(1.0));
        outcome.profile = Some(kept);
        assert_eq!(uphill(&steady, &outcome), None);
        outcome.profile = Some(turned);
        let error = uphill(&steady, &outcome).unwrap();
        assert_eq!(error.code(), "flows-uphill");
        assert!(error.to_string().contains("against the drive"), "{error}");
        // A discharge stands before a profile.
        outcome.results.set(&q::FLUID_DISCHARGE, -0.25 * outcome.results.get(q::FLOW_HEIGHT.name).unwrap());
        for (case, at) in [
            ("kinetic_1d_start", Some("at t = ")),
            ("flow_theta06-two-fluid", Some("-0.25")),
            ("kinetic_1d_waves", None),
        ] {
            let message = drive(case).and_then(|drive| uphill(&drive, &outcome)).map(|error| error.to_string());
            assert_eq!(message.is_some(), at.is_some(), "{case}: {message:?}");
            assert!(message.unwrap_or_default().contains(at.unwrap_or_default()), "{case}");
        }
        // A run that was stopped is not assessed.
        outcome.status = Status::Stopped;
        assert_eq!(uphill(&steady, &outcome), None);
    }
}
