//! `converge`: the error against exact, finest or closed form, and its order.

use super::errors::Reference;
use super::{Assess, Plan, Row, StudyError, mesh, regularisation};
use crate::case::shipped;
use crate::model::{Focus, Registry};

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Over {
    /// size of the regularisation of the yield, for each of its laws
    Regularisation,
    /// number of cells, for each kind of mesh that the model has
    Mesh,
}

/// What the user asks for.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Request {
    /// file or shipped case
    pub case: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// what is refined
    pub over: Over,
    /// what the error is measured against; by default exact, where there is such a thing
    pub reference: Option<Reference>,
    /// whether the regularisation has points between the decades
    pub half_decades: bool,
}

impl Request {
    /// The case as it stands, against the best reference that there is.
    #[must_use]
    pub fn new(case: &str, over: Over) -> Self {
        Self { case: case.into(), overrides: Vec::new(), over, reference: None, half_decades: false }
    }
}

impl Over {
    /// As on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Regularisation => "regularisation",
            Self::Mesh => "mesh",
        }
    }
}

/// The plan of a convergence study, and how to assess it.
///
/// # Errors
/// [`StudyError::Case`], and [`StudyError::NoSuchSetting`] or [`StudyError::NoClosedForm`] for a model that has none.
pub fn plan(registry: &Registry, request: &Request) -> Result<(Plan, Assess), StudyError> {
    let (case, problem) = registry.load(&request.case, &request.overrides).map_err(Box::new)?;
    let lacking = || lacking(registry, request.over, case.model);
    let no_reference = |what: &'static str| StudyError::NoClosedForm { model: problem.model_name(), what };
    let focus = problem.solver().study().focus.ok_or_else(lacking)?;
    let plan = |reference: Reference, varied: &str, points| Plan {
        verb: "converge",
        case: request.case.clone(),
        overrides: request.overrides.clone(),
        options: vec![("over".into(), request.over.name().into()), ("reference".into(), reference.name().into())],
        varied: vec![varied.to_owned()],
        points,
        repeats: 1,
    };
    match request.over {
        Over::Regularisation => {
            let sizes = focus.sizes.ok_or_else(lacking)?;
            let reference = match request.reference {
                Some(Reference::Exact) if sizes.exact.is_empty() => return Err(no_reference("exact yield")),
                None if sizes.exact.is_empty() => Reference::Finest,
                given => given.unwrap_or(Reference::Exact),
            };
            let points = regularisation::points(&sizes, reference, request.half_decades);
            let assess = move |rows: &[Row]| regularisation::assess(&focus, &sizes, reference, rows);
            Ok((plan(reference, sizes.key, points), Box::new(assess)))
        }
        Over::Mesh => {
            let meshes = focus.meshes.ok_or_else(lacking)?;
            let closed = match (request.reference, problem.solver().closed_form()) {
                (Some(Reference::Finest), _) | (None, None) => None,
                (_, Some(form)) => Some(form),
                (Some(Reference::Exact), None) => return Err(no_reference("closed form")),
            };
            let reference = if closed.is_some() { Reference::Exact } else { Reference::Finest };
            let points = mesh::points(&meshes, reference);
            let assess = move |rows: &[Row]| mesh::assess(&focus, &meshes, closed.as_deref(), rows);
            Ok((plan(reference, mesh::KEY, points), Box::new(assess)))
        }
    }
}

/// That `model` has nothing to refine, and which models have: those of which a shipped case has it.
fn lacking(registry: &Registry, over: Over, model: &str) -> StudyError {
    let has = |focus: &Focus| match over {
        Over::Regularisation => focus.sizes.is_some(),
        Over::Mesh => focus.meshes.is_some(),
    };
    let mut models: Vec<&str> = shipped::names()
        .filter_map(|name| registry.load(name, &[]).ok())
        .filter(|(_, problem)| problem.solver().study().focus.as_ref().is_some_and(has))
        .map(|(case, _)| case.model)
        .collect();
    models.sort_unstable();
    models.dedup();
    let allowed = match models.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => "no models".into(),
    };
    StudyError::NoSuchSetting { over: over.name(), model: model.to_owned(), allowed }
}
