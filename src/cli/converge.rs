//! `bedload converge`: the error over regularisation or mesh, and its order.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::study::StudyArgs;
use super::{Answers, CaseArgs, CliError, Verb};
use crate::model::Registry;
use crate::study::converge::{self, Request};

/// How fast the error of a case falls: against exact or finest, with the observed order.
#[derive(Clone, Debug, Args)]
pub(super) struct Converge {
    #[command(flatten)]
    case: CaseArgs,
    /// What is refined
    #[arg(long, value_enum)]
    over: Over,
    /// What the error is measured against [default: exact where there is a closed form or an exact yield]
    #[arg(long, value_enum)]
    reference: Option<Reference>,
    /// Points between the decades of the regularisation, too
    #[arg(long)]
    half_decades: bool,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

/// [`converge::Over`] on the command line.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Over {
    /// Size of the regularisation of the yield, decade by decade, for each law of the model
    Regularisation,
    /// Number of cells, for each kind of mesh that the model has
    Mesh,
}

/// [`crate::study::Reference`] on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Reference {
    /// The exact yield on the same mesh; the closed form for meshes
    Exact,
    /// The smallest regularisation of each law; a mesh finer than all others
    Finest,
}

impl Verb for Converge {
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn out(&mut self) -> Option<&mut PathBuf> {
        self.study.out.as_mut()
    }

    fn json(&self) -> bool {
        self.study.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let over = match self.over {
            Over::Regularisation => converge::Over::Regularisation,
            Over::Mesh => converge::Over::Mesh,
        };
        if self.half_decades && self.over == Over::Mesh {
            let message = "--half-decades is for --over regularisation".to_owned();
            return Err(CliError::Usage { message, hint: "meshes are doubled".into() });
        }
        let mut options = vec![format!("--over {}", over.name())];
        options.extend(
            self.reference.and_then(|r| r.to_possible_value()).map(|v| format!("--reference {}", v.get_name())),
        );
        options.extend(self.half_decades.then(|| "--half-decades".to_owned()));
        let request = Request {
            case: self.case.case.clone(),
            overrides: self.case.overrides.clone(),
            over,
            reference: self.reference.map(|reference| match reference {
                Reference::Exact => crate::study::Reference::Exact,
                Reference::Finest => crate::study::Reference::Finest,
            }),
            half_decades: self.half_decades,
        };
        let (plan, assess) = converge::plan(registry, &request)?;
        self.study.conduct(registry, answers, &self.case, &plan, assess, &options)
    }
}
