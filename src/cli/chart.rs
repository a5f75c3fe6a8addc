//! `bedload chart`: speed against accuracy of the models and settings that answer one scene.

use std::path::PathBuf;

use clap::Args;

use super::study::StudyArgs;
use super::{Answers, CaseArgs, CliError, Verb, word};
use crate::model::Registry;
use crate::study::StudyError;
use crate::study::chart::{self, Request};

/// What each model and setting of a scene costs, and how far its answer lies from the best one.
#[derive(Clone, Debug, Args)]
pub(super) struct Chart {
    /// The scene, and other models of it: files or shipped cases; --set is for the first file
    #[arg(value_name = "CASE", required = true, num_args = 1..)]
    cases: Vec<String>,
    /// A model that answers the scene; repeat it for several [default: those of the case, or all that take the scene]
    #[arg(long, value_name = "MODEL")]
    model: Vec<String>,
    /// Change a value of the first file: table.key=value; an empty value removes the key
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// The number that is assessed: a name in summary.json [default: the transport rate, or what the model has instead]
    #[arg(long, value_name = "NAME")]
    quantity: Option<String>,
    /// What errors are measured against: the folder of a finished run, exact or finest [default: the best there is]
    #[arg(long, value_name = "RUN")]
    reference: Option<String>,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

impl Verb for Chart {
    fn out(&mut self) -> Option<&mut PathBuf> {
        self.study.out.as_mut()
    }

    fn json(&self) -> bool {
        self.study.json
    }

    fn execute(mut self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        // Points side by side would share the processor and spoil each other's times.
        self.study.threads.get_or_insert(1);
        let mut cases = Vec::new();
        for (at, case) in self.cases.iter().enumerate() {
            let overrides = if at == 0 { self.overrides.as_slice() } else { &[] };
            cases.extend(registry.cases_of(case, overrides, &self.model).map_err(StudyError::from)?);
        }
        let request =
            Request { cases, overrides: self.overrides.clone(), quantity: self.quantity, reference: self.reference };
        let (plan, assess) = chart::plan(registry, &request)?;
        let mut cases = self.cases.into_iter();
        let case = CaseArgs { case: cases.next().unwrap_or_default(), model: self.model, overrides: self.overrides };
        let mut options: Vec<String> = cases.map(|case| word(&case)).collect();
        options.extend(request.quantity.map(|name| format!("--quantity {}", word(&name))));
        options.extend(request.reference.map(|run| format!("--reference {}", word(&run))));
        self.study.conduct(registry, answers, &case, &plan, assess, &options)
    }
}
