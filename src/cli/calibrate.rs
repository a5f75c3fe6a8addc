//! `bedload calibrate`: numbers of a case fitted to a measured profile.

use std::path::PathBuf;

use clap::Args;

use super::study::StudyArgs;
use super::{Answers, CaseArgs, CliError, Verb, word};
use crate::model::Registry;
use crate::study::calibrate::{self, Request};

/// Fit numbers of a case to a measured profile: values with standard errors, and which of them the data tell apart.
#[derive(Clone, Debug, Args)]
pub(super) struct Calibrate {
    #[command(flatten)]
    case: CaseArgs,
    /// A measured profile as CSV: columns by their names in profile.csv, <name>_err is one sigma
    #[arg(long, value_name = "FILE.csv")]
    to: String,
    /// A positive number of the case, from the value that it has there; as often as needed. mu_2 is enough if there is one only
    #[arg(long, value_name = "KEY[=LOWER:UPPER]", required = true)]
    fit: Vec<String>,
    /// A column of the data that is fitted [default: all that the model has]
    #[arg(long, value_name = "NAME")]
    column: Vec<String>,
    /// One sigma in SI for values without one, or COLUMN=sigma [default: taken from the residuals]
    #[arg(long, value_name = "SIGMA")]
    sigma: Vec<String>,
    #[command(flatten)]
    pub(super) study: StudyArgs,
}

impl Verb for Calibrate {
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
        let request = Request {
            case: self.case.case.clone(),
            overrides: self.case.overrides.clone(),
            data: self.to,
            fit: self.fit,
            columns: self.column,
            sigma: self.sigma,
        };
        let (plan, next) = calibrate::plan(registry, &request)?;
        let mut options = vec![format!("--to {}", word(&request.data))];
        for (option, values) in [("fit", &request.fit), ("column", &request.columns), ("sigma", &request.sigma)] {
            options.extend(values.iter().map(|value| format!("--{option} {}", word(value))));
        }
        self.study.conduct_on(registry, answers, &self.case, &plan, next, &options)
    }
}
