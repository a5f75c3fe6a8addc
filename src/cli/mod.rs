//! The command line: one file per verb. Answers go to standard output, everything else to standard error.
// The doc lines of arguments are their help, which is plain text.
#![allow(rustdoc::broken_intra_doc_links, rustdoc::invalid_html_tags)]

mod advise;
mod answers;
mod calibrate;
mod case_args;
mod chart;
mod check;
mod compare;
mod completions;
mod converge;
mod explain;
mod interrupt;
mod list;
mod man;
mod migrate;
mod new;
mod progress;
mod report;
mod run;
mod schema;
mod stability;
mod study;
mod sweep;
#[cfg(test)]
mod tests;
mod validate;

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde_json::{Value, json};

use crate::advise::AdviseError;
use crate::case::{CaseError, printable};
use crate::compare::CompareError;
use crate::model::Registry;
use crate::output::{OutputError, word};
use crate::result::ErrorReport;
use crate::study::StudyError;
use crate::validate::ValidateError;
use answers::{Answers, usage, wants_json};
use case_args::{CaseArgs, all_are_right};
use interrupt::STOPPED;

/// Sediment transport from several models of the same flow, with what each one costs and how far it can be trusted.
#[derive(Debug, Parser)]
#[command(name = "bedload", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "CASE is a file or the name of a shipped case (`bedload list cases`).\n\
    Exit codes: 0 done; 1 disk full or a bug; 2 wrong input, nothing was run; 3 the method failed; 4 stopped by Ctrl-C.")]
pub struct Cli {
    #[command(subcommand)]
    verb: Verbs,
}

/// A verb of the command line.
trait Verb {
    /// Whether its answer is one JSON object, also where it fails.
    fn json(&self) -> bool {
        false
    }

    /// Its case, if it does the same to one case by each of several models.
    fn case(&mut self) -> Option<&mut CaseArgs> {
        None
    }

    /// Whether it writes folders of its own accord.
    fn writes(&self) -> bool {
        false
    }

    /// Where it writes, if that was said: a folder in it where there are several models.
    fn out(&mut self) -> Option<&mut PathBuf> {
        None
    }

    /// Does it.
    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError>;
}

/// The verbs: a line each, its file and its arguments.
macro_rules! verbs {
    ($($(#[$doc:meta])* $name:ident($file:ident::$arguments:ident),)*) => {
        #[derive(Clone, Debug, Subcommand)]
        enum Verbs {
            $($(#[$doc])* $name($file::$arguments),)*
        }

        impl Verb for Verbs {
            fn json(&self) -> bool {
                match self { $(Self::$name(verb) => verb.json(),)* }
            }

            fn case(&mut self) -> Option<&mut CaseArgs> {
                match self { $(Self::$name(verb) => verb.case(),)* }
            }

            fn writes(&self) -> bool {
                match self { $(Self::$name(verb) => verb.writes(),)* }
            }

            fn out(&mut self) -> Option<&mut PathBuf> {
                match self { $(Self::$name(verb) => verb.out(),)* }
            }

            fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
                match self { $(Self::$name(verb) => verb.execute(registry, answers),)* }
            }
        }
    };
}

verbs! {
    /// Solve a case and write its folder: numbers, tables, report
    Run(run::Run),
    /// Say whether a case is valid, without running it
    Check(check::Check),
    /// Show the equations that a case solves, with its numbers, and the laws in them
    Explain(explain::Explain),
    /// Write a case to start from
    New(new::New),
    /// Write a case of format 1 in format 2: the flow, and the table of its model
    Migrate(migrate::Migrate),
    /// List models, shipped cases and closures
    List(list::List),
    /// Redraw figures and page of a run from its tables
    Report(report::Report),
    /// Set cases, runs and measured profiles side by side
    Compare(compare::Compare),
    /// Show how fast the error of a case falls with its regularisation or its mesh
    Converge(converge::Converge),
    /// Run a case over values of one key, or a grid of several
    Sweep(sweep::Sweep),
    /// Chart speed against accuracy of the models and settings that answer one scene
    Chart(chart::Chart),
    /// Map where a case holds over one key or two, and how it fails beyond
    Stability(stability::Stability),
    /// Fit numbers of a case to a measured profile, with their errors
    Calibrate(calibrate::Calibrate),
    /// Name the least model that serves a scene, and what in it can go
    Advise(advise::Advise),
    /// Re-run what the cases claim and write the table
    Validate(validate::Validate),
    /// Print the JSON Schema of case files, for editors
    Schema(schema::Schema),
    /// Print a completion script for a shell
    Completions(completions::Completions),
    /// Print the manual, or write a page for each verb
    Man(man::Man),
}

/// How a verb ended, if not well.
#[derive(Debug)]
enum CliError {
    /// the case is wrong: 2
    Case(Box<CaseError>),
    /// the folder is refused (2) or writing it broke (1)
    Output(OutputError),
    /// the subjects cannot be compared: 2
    Compare(CompareError),
    /// the study cannot be made: 2
    Study(StudyError),
    /// there is no advice, or no case of it
    Advise(AdviseError),
    /// the method failed, the folder says how: 3. The answer for `--json`
    Failed(ErrorReport, Option<Value>),
    /// some rows of a validation are red: 3
    Red(usize),
    /// stopped by the user: 4. The answer for `--json`, and whether the folder keeps an earlier run
    Stopped(Value, bool),
    /// an argument that clap cannot accept: 2
    Usage { message: String, hint: String },
    /// standard output or a file: 1
    Io(io::Error),
    /// everything has been reported: only the code is left
    Quiet(u8),
}

impl From<CaseError> for CliError {
    fn from(error: CaseError) -> Self {
        Self::Case(Box::new(error))
    }
}

impl From<CompareError> for CliError {
    fn from(error: CompareError) -> Self {
        Self::Compare(error)
    }
}

impl From<StudyError> for CliError {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Case(error) => Self::Case(error),
            StudyError::Output(error) => Self::Output(error),
            other => Self::Study(other),
        }
    }
}

impl From<AdviseError> for CliError {
    fn from(error: AdviseError) -> Self {
        match error {
            AdviseError::Case(error) => Self::Case(error),
            other => Self::Advise(other),
        }
    }
}

impl From<OutputError> for CliError {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

impl From<ValidateError> for CliError {
    fn from(error: ValidateError) -> Self {
        match error {
            ValidateError::Case(error) => Self::Case(error),
            ValidateError::Limit(error) => error.into(),
        }
    }
}

impl From<io::Error> for CliError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// Parses the arguments, does what they ask, and returns the exit code.
#[must_use]
pub fn execute(registry: &Registry) -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are errors of exit code 0.
            let code = error.exit_code();
            if error.use_stderr() && wants_json() {
                return ExitCode::from(usage(&error).report(Some(&Answers::default())));
            }
            return if error.print().is_err() {
                ExitCode::FAILURE
            } else {
                ExitCode::from(u8::try_from(code).unwrap_or(2))
            };
        }
    };
    let json = cli.verb.json();
    let mut verb = cli.verb;
    let models = verb.case().map(|case| case.model.clone()).unwrap_or_default();
    if models.len() < 2 {
        let chosen = models.first().map(|model| registry.clone().choosing(model));
        return match verb.execute(chosen.as_ref().unwrap_or(registry), &Answers::default()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => ExitCode::from(error.report(json.then_some(&Answers::default()))),
        };
    }
    let answers = Answers::several();
    let mut code = 0;
    if verb.writes()
        && let Err(error) = all_are_right(registry, &mut verb, &models)
    {
        code = error.report(json.then_some(&answers));
        return ExitCode::from(if json && answers.end().is_err() { 1 } else { code });
    }
    // Each model by itself: one that fails does not keep the next from its answer.
    for model in &models {
        let mut one = verb.clone();
        if let Some(case) = one.case() {
            *case = case.of(model, &models);
        }
        if let Some(out) = one.out() {
            *out = out.join(model);
        }
        if let Err(error) = one.execute(&registry.clone().choosing(model), &answers) {
            let stopped = matches!(error, CliError::Stopped(..));
            code = code.max(error.report(json.then_some(&answers)));
            if stopped {
                break;
            }
        }
    }
    if json && answers.end().is_err() {
        code = 1;
    }
    ExitCode::from(code)
}

impl CliError {
    /// Says what went wrong, as text or as JSON, and returns the exit code.
    fn report(self, json: Option<&Answers>) -> u8 {
        let code = self.exit_code();
        if let Self::Quiet(code) = self {
            return code;
        }
        // A reader that went away is no error of ours.
        if matches!(&self, Self::Io(error) if error.kind() == io::ErrorKind::BrokenPipe) {
            return 0;
        }
        let written = match json {
            Some(answers) => answers.give(&self.answer()),
            None => self.explain(),
        };
        if written.is_err() { 1 } else { code }
    }

    fn exit_code(&self) -> u8 {
        match self {
            Self::Case(_) | Self::Compare(_) | Self::Study(_) | Self::Advise(_) | Self::Usage { .. } => 2,
            Self::Output(error) => {
                if error.is_refusal() {
                    2
                } else {
                    1
                }
            }
            Self::Failed(..) | Self::Red(_) => 3,
            Self::Stopped(..) => STOPPED as u8,
            Self::Io(_) => 1,
            Self::Quiet(code) => *code,
        }
    }

    /// The one object of `--json` on failure.
    fn answer(self) -> Value {
        let one = |code: &str, message: String, hint: Option<String>| {
            let error = ErrorReport { code: code.into(), message, path: None, line: None, allowed: None, hint };
            json!({ "status": "failed", "error": error })
        };
        match self {
            Self::Case(error) => {
                let reports = error.reports();
                json!({ "status": "failed", "error": reports.first(), "errors": reports })
            }
            Self::Output(error) => one(error.code(), error.to_string(), error.hint()),
            Self::Compare(error) => one(error.code(), error.to_string(), Some(error.hint())),
            Self::Study(error) => one(error.code(), error.to_string(), Some(error.hint())),
            Self::Advise(error) => one(error.code(), error.to_string(), Some(error.hint().into())),
            Self::Failed(error, summary) => summary.unwrap_or_else(|| json!({ "status": "failed", "error": error })),
            Self::Stopped(summary, _) => summary,
            Self::Usage { message, hint } => one("usage", message, Some(hint)),
            Self::Io(error) => one("io", error.to_string(), None),
            Self::Red(_) | Self::Quiet(_) => Value::Null,
        }
    }

    fn explain(self) -> io::Result<()> {
        let mut to = io::stderr().lock();
        let (message, hint) = match self {
            Self::Case(error) => return write!(to, "{}", error.render(colour())),
            Self::Output(error) => (format!("error: {error}"), error.hint()),
            Self::Failed(error, _) => (format!("failed: {}", error.message), error.hint),
            Self::Red(rows) => (format!("{rows} rows are red"), None),
            Self::Stopped(_, kept) => {
                ("stopped".into(), kept.then(|| "the finished run that the folder held is still there".into()))
            }
            Self::Compare(error) => (format!("error: {error}"), Some(error.hint())),
            Self::Study(error) => (format!("error: {error}"), Some(error.hint())),
            Self::Advise(error) => (format!("error: {error}"), Some(error.hint().into())),
            Self::Usage { message, hint, .. } => (format!("error: {message}"), Some(hint)),
            Self::Io(error) => (format!("error: {error}"), None),
            Self::Quiet(_) => return Ok(()),
        };
        let hint = hint.map(|hint| format!("  {hint}\n")).unwrap_or_default();
        write!(to, "{}", printable(&format!("{message}\n{hint}")))
    }
}

/// Whether standard error takes colour.
fn colour() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

/// Writes text to standard output. Titles and names of files are not ours: they must not command the terminal.
fn say(text: &str) -> io::Result<()> {
    let mut to = io::stdout().lock();
    to.write_all(printable(text).as_bytes())?;
    to.flush()
}
