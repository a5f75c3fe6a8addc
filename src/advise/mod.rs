//! `advise`: the least model that a scene needs, and term by term what can go.
//!
//! Numbers of the scene (Shields, fall velocity over friction velocity, grain Reynolds, ...) say which model is the least that serves. What a term
//! is worth is not guessed where it can be had: models that answer in milliseconds are solved with and without it, and the change of
//! the transport rate is the error that dropping it costs. For grains, which take minutes, the threshold that the source gives decides.
//! Thresholds are of the papers that the sources name, or measured here (docs/coupled.md).

mod laminar;
mod subject;
mod turbulent;

use std::time::Instant;

use subject::Subject;

use crate::case::CaseError;
use crate::model::{Flow, ModelInfo, Offer, OwnCase, Registry};
use crate::result::Context;

use crate::result::{Failure, SolveError, Verdict, codes};
use crate::units::significant;

/// A number that describes the scene.
#[derive(Clone, Debug)]
pub struct Number {
    /// what it is, with its symbol
    pub name: &'static str,
    /// its value \[1]
    pub value: f64,
    /// what it says here
    pub says: String,
}

/// A term, or a part of the numerics, and whether the scene needs it.
#[derive(Clone, Debug)]
pub struct Term {
    /// what it is
    pub what: &'static str,
    /// whether the flow needs it
    pub keep: bool,
    /// whether the case has it
    pub has: bool,
    /// relative change of the transport rate without it, where both were solved
    pub error: Option<f64>,
    /// why, in words
    pub because: String,
    /// where the threshold comes from
    pub source: &'static str,
    /// what is changed in the case to drop it; nothing where a threshold decides
    change: Vec<String>,
}

/// The least model that serves.
#[derive(Clone, Debug)]
pub struct Least {
    /// the model
    pub kind: &'static str,
    /// whether its results are means of fluctuating quantities
    pub stochastic: bool,
    /// why this one
    pub because: String,
    /// what an answer costs
    pub cost: Cost,
    /// how far its transport rate lies from what is known better, in words with the source
    pub off: &'static str,
    /// how far its numbers lie from those on a mesh much finer, where there is one
    pub mesh: Option<MeshError>,
    /// its case for this scene, every default filled in; `None` where the case that was given is of that model already
    pub case: Option<String>,
}

/// What an answer costs, on one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cost {
    /// time that it took \[s]
    Took(f64),
    /// time that it takes \[s], from its number of steps
    Takes(f64),
    /// not known
    Unknown,
}

/// How far the transport rate lies from that of the finest setting of the model.
#[derive(Clone, Debug)]
pub struct MeshError {
    /// relative error of the transport rate
    pub share: f64,
    /// the finest setting, in words
    pub against: String,
}

/// What is reported of a scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Advice {
    /// numbers of the scene
    pub numbers: Vec<Number>,
    /// the model
    pub least: Least,
    /// the model whose terms are assessed: that of the case, or, of a scene alone, the least one
    pub of: &'static str,
    /// its terms
    pub terms: Vec<Term>,
    /// relative change of the transport rate without any of the terms that can go, where those are several
    pub together: Option<f64>,
}

/// Why there is no advice.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AdviseError {
    /// the case is wrong
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// the model is no scene of sediment transport
    #[error("advice is for steady flows over a bed of grains: {}", no_bed(model, scene))]
    OneModel {
        /// the model
        model: String,
        /// the kind of its scene
        scene: &'static str,
    },
    /// no model is known to answer this flow
    #[error("no model is known to answer this flow to a relative error of {tolerance} with its premises met")]
    NoneServes {
        /// largest relative error
        tolerance: f64,
    },
    /// there is no such flow: its own model finds none
    #[error("there is nothing to advise on: {0}")]
    NoFlow(#[source] SolveError),
    /// there is no such flow: no bed stays at rest
    #[error(
        "there is nothing to advise on: no bed rests on this slope: what pulls grains and water down it is {} of what friction holds",
        significant(*share, 3)
    )]
    NoBed {
        /// what pulls grains and water down the slope over what friction holds
        share: f64,
    },
    /// the case of the advised model is refused
    #[error("no case of {kind} serves this scene: {}", first(error))]
    Refused {
        /// the model
        kind: &'static str,
        /// what is wrong with its case
        #[source]
        error: Box<CaseError>,
    },
    /// the case of the advised model fails
    #[error("no case of {kind} serves this scene: {error}")]
    Fails {
        /// the model
        kind: &'static str,
        /// why
        #[source]
        error: SolveError,
    },
}

codes!(AdviseError {
    Self::Case(_) => "case",
    Self::OneModel { .. } => "one-model",
    Self::NoFlow(_) | Self::NoBed { .. } => "no-flow",
    Self::NoneServes { .. } | Self::Refused { .. } | Self::Fails { .. } => "no-case",
});

/// Why a case of `model` is no such flow.
fn no_bed(model: &str, scene: &str) -> String {
    match scene {
        "bed" => format!("this case of {model} is none"),
        _ => format!("{model} solves a scene of the kind \"{scene}\""),
    }
}

/// The first thing that is wrong with a case.
fn first(error: &CaseError) -> String {
    error.reports().into_iter().next().map(|report| report.message).unwrap_or_default()
}

impl AdviseError {
    /// What a user can do.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Case(_) | Self::OneModel { .. } => "give a case with scene = \"bed\" and a steady drive",
            Self::NoneServes { .. } => "a larger --tolerance, or `bedload chart` for what its models differ by",
            Self::NoFlow(_) | Self::NoBed { .. } => "lower the drive or the slope",
            Self::Refused { .. } | Self::Fails { .. } => "a smaller --tolerance asks for the next better model",
        }
    }
}

/// Advice for the scene of `case` with `overrides`: terms that change the transport rate by less than `tolerance` can go. A case may be a
/// scene alone.
///
/// # Errors
/// [`AdviseError::Case`]; [`AdviseError::OneModel`] for cases that are no steady flow over a bed; [`AdviseError::NoFlow`] and
/// [`AdviseError::NoBed`]; [`AdviseError::NoneServes`].
pub fn advise(registry: &Registry, case: &str, overrides: &[String], tolerance: f64) -> Result<Advice, AdviseError> {
    let (alone, (case, problem)) = match registry.load(case, overrides) {
        Ok(checked) => (false, checked),
        // Any model that takes the scene says which flow it is.
        Err(error) if error.choices().is_some() => {
            let any = registry.takers(case, overrides).next().ok_or_else(|| Box::new(error))?;
            (true, any)
        }
        Err(error) => return Err(Box::new(error).into()),
    };
    let no_flow = |failure: Failure| AdviseError::NoFlow(failure.error);
    let Some(mut flow) = problem.solver().flow().map_err(no_flow)? else {
        let scene = problem.scene.as_ref().map_or("", |scene| scene.kind());
        return Err(AdviseError::OneModel { model: problem.kind.into(), scene });
    };
    let subject = Subject::new(registry, &case, case.model, tolerance);
    let numbers = match &flow {
        Flow::Laminar(bed) => laminar::numbers(bed, subject.solve(&[]).as_ref()),
        Flow::Turbulent(bed) if bed.theta.is_finite() && bed.weight() < 1.0 => turbulent::numbers(bed),
        Flow::Turbulent(bed) => {
            return Err(AdviseError::NoBed { share: bed.weight() });
        }
    };
    let mut terms: Vec<Term> = Vec::new();
    let own = if alone { Vec::new() } else { problem.solver().terms() };
    terms.extend(own.iter().filter_map(|term| subject.assess(term)));
    let mut together = subject.together(&mut terms);
    for term in &own {
        let goes = terms.iter().any(|assessed| assessed.what == term.what && !assessed.keep);
        if let Some(drop) = term.dropped.filter(|_| goes) {
            drop(&mut flow);
        }
    }
    let offers = registry.entries().filter_map(|entry| Some((entry.info, entry.offer(&flow, tolerance)?)));
    let mut offers: Vec<(ModelInfo, Offer)> = offers.collect();
    offers.sort_by_key(|(_, offer)| offer.effort);
    let mut refused = None;
    for (info, Offer { because, case: own, off, .. }) in offers {
        let same = !alone && info.name == case.model && problem.solver().flow().is_ok();
        let drops =
            matches!(&own, OwnCase::Scene(changes) if !changes.is_empty()) && terms.iter().any(|term| !term.keep);
        let (kind, stochastic) = (info.name, info.stochastic);
        let found = if same && !drops {
            // A scene alone is no case of the model that was chosen for it.
            Ok(((!case.has_table()).then(|| case.clone()), problem.clone()))
        } else {
            subject.of(kind, &own).map(|(own, found)| (Some(own), found))
        };
        let (own, found) = match found {
            Ok(found) => found,
            Err(error) => {
                refused = refused.or(Some(AdviseError::Refused { kind, error: Box::new(error) }));
                continue;
            }
        };
        let (mut cost, mut mesh) = (found.solver().takes_s().map_or(Cost::Unknown, Cost::Takes), None);
        // A continuum takes milliseconds: what is advised has a solution, and none of its premises is broken.
        if !stochastic {
            let clock = Instant::now();
            match Context::quiet(|context| found.run(context)) {
                Err(failure) => {
                    refused = refused.or(Some(AdviseError::Fails { kind, error: failure.error }));
                    continue;
                }
                Ok(outcome) if outcome.regime.iter().any(|premise| premise.verdict == Verdict::Broken) => continue,
                Ok(outcome) => {
                    cost = Cost::Took(clock.elapsed().as_secs_f64());
                    let subject = Subject::new(registry, own.as_ref().unwrap_or(&case), kind, tolerance);
                    mesh = subject.mesh_error(&outcome.results, found.solver().study().finest);
                }
            }
        }
        let Some(own) = own else {
            return Ok(Advice {
                numbers,
                least: Least { kind, stochastic, because, cost, off, mesh, case: None },
                of: case.model,
                terms,
                together,
            });
        };
        let of = if alone { kind } else { case.model };
        if alone {
            let subject = Subject::new(registry, &own, kind, tolerance);
            terms.extend(found.solver().terms().iter().filter_map(|term| subject.assess(term)));
            together = subject.together(&mut terms);
        }
        let resolved = own.resolved();
        // The claims of the case are not those of another model.
        let text = resolved.split("\n[[").next().unwrap_or(&resolved).trim_end();
        let case = Some(format!("{text}\n"));
        return Ok(Advice {
            numbers,
            least: Least { kind, stochastic, because, cost, off, mesh, case },
            of,
            terms,
            together,
        });
    }
    Err(refused.unwrap_or(AdviseError::NoneServes { tolerance }))
}

impl Advice {
    /// The text of a case file of the least model: `None` where the case that was given is one.
    ///
    /// # Errors
    /// [`AdviseError::Refused`] if that model refuses the scene, [`AdviseError::Fails`] if it finds no flow.
    pub fn case(&self, registry: &Registry) -> Result<Option<String>, AdviseError> {
        let Some(text) = &self.least.case else { return Ok(None) };
        let kind = self.least.kind;
        let (_, problem) = registry
            .parse("advised", "advised", text.clone(), &[])
            .map_err(|error| AdviseError::Refused { kind, error: error.into() })?;
        // A continuum takes milliseconds: what is written has a solution.
        if !problem.stochastic {
            let no_case = |failure: Failure| AdviseError::Fails { kind, error: failure.error };
            Context::quiet(|context| problem.run(context)).map_err(no_case)?;
        }
        Ok(Some(format!("# Written by `bedload advise`: the least model that serves, {kind}, for this scene.\n{text}")))
    }
}

/// `2.1 %`, or `3e-5` where a per cent says nothing.
pub(crate) fn share(error: f64) -> String {
    if error >= 1e-4 { format!("{} %", significant(100.0 * error, 2)) } else { format!("{error:.0e}") }
}
