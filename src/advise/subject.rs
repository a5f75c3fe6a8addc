//! A case that is solved as it stands, without a term, and on a finer mesh.

use std::cell::OnceCell;

use super::{MeshError, Term, share};
use crate::case::{Case, CaseError};
use crate::model::{self, Checked, OwnCase, Registry, TermTest};
use crate::result::quantity as q;
use crate::result::{Context, Results};

/// The case that is advised on.
pub(super) struct Subject<'a> {
    /// where the case is that of its model
    registry: Registry,
    case: &'a Case,
    tolerance: f64,
    /// transport rate of the case as it stands, once it was asked for
    rate: OnceCell<Option<f64>>,
}

impl<'a> Subject<'a> {
    pub fn new(registry: &Registry, case: &'a Case, kind: &str, tolerance: f64) -> Self {
        Self { registry: registry.clone().choosing(kind), case, tolerance, rate: OnceCell::new() }
    }

    /// Transport rate of the case as it stands.
    fn rate(&self) -> Option<f64> {
        *self.rate.get_or_init(|| self.solve(&[]).as_ref().and_then(rate))
    }

    pub fn solve(&self, change: &[String]) -> Option<Results> {
        let Case { name, source, overrides, .. } = self.case;
        let overrides = [overrides, change].concat();
        let (_, problem) = self.registry.parse(name, source, self.case.text().to_owned(), &overrides).ok()?;
        Context::quiet(|context| problem.run(context)).ok().map(|outcome| outcome.results)
    }

    /// The case of the model `kind` for this scene.
    pub fn of(&self, kind: &str, own: &OwnCase) -> Result<Checked, CaseError> {
        let registry = self.registry.clone().choosing(kind);
        match own {
            OwnCase::Scene(changes) => {
                let overrides = [self.case.overrides_of_the_flow(), changes.clone()].concat();
                registry.parse(&self.case.name, &self.case.source, self.case.text().to_owned(), &overrides)
            }
            OwnCase::Other(text) => registry.parse(&self.case.name, "advised", text.clone(), &[]),
        }
    }

    /// What all terms that can go change together. Where that is more than may be, the one that changes most is kept.
    pub fn together(&self, terms: &mut [Term]) -> Option<f64> {
        loop {
            let goes = |term: &Term| !term.keep && !term.change.is_empty();
            let changes: Vec<String> =
                terms.iter().filter(|term| goes(term)).flat_map(|term| term.change.clone()).collect();
            if terms.iter().filter(|term| goes(term)).count() < 2 {
                return None;
            }
            let with = self.rate()?;
            let error = self.solve(&changes).as_ref().and_then(rate).map(|without| (without / with - 1.0).abs());
            if let Some(error) = error.filter(|error| *error <= self.tolerance) {
                return Some(error);
            }
            let of = |term: &Term| term.error.unwrap_or(0.0);
            let most = terms.iter_mut().filter(|term| goes(term)).max_by(|a, b| of(a).total_cmp(&of(b)))?;
            most.keep = true;
            most.because += "; with the others that go it is too much";
        }
    }

    /// How far the transport rate lies from that of the finest setting of its model.
    pub fn mesh_error(&self, results: &Results, finest: Option<(String, Vec<String>)>) -> Option<MeshError> {
        let (against, changes) = finest?;
        let (found, fine) = (rate(results)?, rate(&self.solve(&changes)?)?);
        (fine != 0.0).then(|| MeshError { share: (found / fine - 1.0).abs(), against })
    }

    /// Whether the scene needs a term: by a threshold, or by solving the case as it stands and without the term.
    pub fn assess(&self, term: &model::Term) -> Option<Term> {
        let model::Term { what, source, .. } = *term;
        let (change, left, free) = match &term.test {
            TermTest::Known { keep, has, because } => {
                return Some(Term {
                    what,
                    keep: *keep,
                    has: *has,
                    error: None,
                    because: because.clone(),
                    source,
                    change: Vec::new(),
                });
            }
            TermTest::Solve { change, left, free } => (change, left, free),
        };
        let with = self.rate()?;
        let (error, keep) = match self.solve(change).as_ref().and_then(rate) {
            Some(without) if with != 0.0 => {
                let error = (without / with - 1.0).abs();
                (Some(error), error > self.tolerance)
            }
            // Nothing to compare, or no flow without it.
            Some(without) => (None, without != with),
            None => (None, true),
        };
        let because = match error {
            Some(error) => format!("{left} changes the transport rate by {}", share(error)),
            None if keep => format!("{left} leaves no such flow"),
            None => format!("{left} changes nothing"),
        };
        // The better answer, where there is one.
        let better = *free && error.is_some();
        let (keep, because) = if better { (false, format!("{because}, and is no slower")) } else { (keep, because) };
        Some(Term { what, keep, has: true, error, because, source, change: change.clone() })
    }
}

/// Transport rate per width [m2/s]: that of a section over its mean width.
fn rate(results: &Results) -> Option<f64> {
    let of = |quantity: &q::Quantity| results.get(quantity.name);
    let in_section = || Some(of(&q::BED_FLUX)? * of(&q::FLOW_HEIGHT)? / of(&q::SECTION_AREA)?);
    of(&q::TRANSPORT_RATE).or_else(in_section)
}
