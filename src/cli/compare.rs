//! `bedload compare`: cases, runs and measured profiles side by side.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::progress::Progress;
use super::run::not_strictly;
use super::{Answers, CliError, Verb, say, word};
use crate::case::{Case, for_model};
use crate::compare::{Align, CompareError, Comparison, Request, Stated, Subject, compare, data, of_one_kind};
use crate::model::Problem;
use crate::model::Registry;
use crate::output::{Compared, prepare_comparison, read_run, write_comparison};
use crate::result::Context;
use crate::result::{Cost, ErrorReport, Provenance, Status, Verdict};
use crate::runtime::cost::peak_memory_mb;

/// Set cases, runs and measured profiles side by side: norms, numbers, figure. The first one is the reference.
#[derive(Clone, Debug, Args)]
pub(super) struct Compare {
    /// Cases, shipped or as files, which are run; or folders of runs, which are read
    #[arg(value_name = "CASE|RUN")]
    subjects: Vec<String>,
    /// A model that solves the cases, where they have the tables of several; repeat it to compare models
    #[arg(long, value_name = "MODEL")]
    model: Vec<String>,
    /// Change a value of every case: table.key=value; with the name of a model before it, of the cases of that model. An empty value
    /// removes the key
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// A measured profile as CSV: columns by their names in profile.csv, <name>_err is one sigma
    #[arg(long, value_name = "FILE.csv")]
    data: Vec<String>,
    /// Where z is 0
    #[arg(long, value_enum, default_value_t = Datum::Bottom)]
    align: Datum,
    /// Divide by flow height, mean velocity and fluid stress at the bed of each one
    #[arg(long)]
    scale: bool,
    /// Folder to write [default: runs/compare-A-B]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw the figures as PNG, too
    #[arg(long)]
    png: bool,
    /// No progress and no closing lines
    #[arg(long)]
    quiet: bool,
    /// Print compare.json as one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// Replace whatever comparison the folder holds
    #[arg(long)]
    force: bool,
    /// Exit with code 3 where a premise of a model is broken
    #[arg(long)]
    strict: bool,
}

/// [`Align`] on the command line.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Datum {
    /// At the bottom of the sediment, as every model reports it
    Bottom,
    /// At the bed level of each one
    Bed,
    /// As it is, wherever that may be
    None,
}

/// Something to compare, checked but not yet run.
enum Loaded {
    Case(Box<(Case, Problem)>),
    Ready(Box<Subject>),
}

impl Loaded {
    /// Its name and the kind of its scene, if that is known.
    fn kind(&self) -> Option<(String, String)> {
        match self {
            Self::Case(case) => Some((case.0.name.clone(), case.1.scene.as_ref()?.kind().to_owned())),
            Self::Ready(subject) => Some((subject.name.clone(), subject.stated.as_ref()?.scene.kind.clone())),
        }
    }
}

impl Verb for Compare {
    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let start = Instant::now();
        let given = self.subjects.len() * self.model.len().max(1) + self.data.len();
        if given < 2 {
            let chosen = self.subjects.first().filter(|_| self.model.is_empty());
            let refused = chosen.and_then(|case| registry.load(case, &[]).err());
            let models = refused.as_ref().and_then(|error| Some(error.choices()?.models.to_vec()));
            return Err(CompareError::TooFew { given, models: models.unwrap_or_default() }.into());
        }
        let request = self.request();
        let (loaded, names) = self.load(registry)?;
        of_one_kind(loaded.iter().filter_map(Loaded::kind))?;
        let mut progress = Progress::new(self.quiet);
        let out = self.out.clone().unwrap_or_else(|| Comparison::folder(&names, request.align, request.scale));
        let folder = prepare_comparison(&out, &json!(request), self.force)?;
        let provenance = Provenance { source: self.command(""), ..Provenance::of_this_program() };
        let mut subjects = Vec::with_capacity(given);
        for one in loaded {
            subjects.push(match one {
                Loaded::Ready(subject) => *subject,
                Loaded::Case(case) => solve(&case.0, &case.1, &mut progress)?,
            });
        }
        drop(progress);
        let comparison = compare(subjects, request.align, request.scale)?;
        let cost = Cost {
            solve_s: comparison.subjects.iter().map(|s| s.solve_s).sum(),
            total_s: start.elapsed().as_secs_f64(),
            peak_memory_mb: peak_memory_mb(),
            work_units: comparison.subjects.iter().map(|s| s.work).sum(),
            ..Cost::default()
        };
        let figures = comparison.figures();
        let compared = Compared {
            record: &comparison.to_json(&request, &cost, &provenance),
            norms: &|to| comparison.write_norms(to, &provenance),
            page: &comparison.html(&figures, &cost, &provenance),
            figures: &figures,
        };
        let figures = write_comparison(folder, &compared, self.png)?;
        let mut value = compared.record.clone();
        if let Value::Object(object) = &mut value {
            object.insert("out".into(), out.display().to_string().into());
        }
        if let Some(message) = broken(&comparison.subjects).filter(|_| self.strict) {
            return Err(not_strictly(message, value));
        }
        if self.json {
            return Ok(answers.give(&value)?);
        }
        if self.quiet {
            return Ok(());
        }
        Ok(say(&self.closing(&comparison, &cost, &out, !figures.is_empty()))?)
    }
}

impl Compare {
    fn request(&self) -> Request {
        let align = match self.align {
            Datum::Bottom => Align::Bottom,
            Datum::Bed => Align::Bed,
            Datum::None => Align::None,
        };
        Request {
            subjects: self.subjects.clone(),
            models: self.model.clone(),
            overrides: self.overrides.clone(),
            data: self.data.clone(),
            align,
            scale: self.scale,
        }
    }

    /// Reads and checks everything before anything is run; the names are those of the default folder.
    fn load(&self, registry: &Registry) -> Result<(Vec<Loaded>, Vec<String>), CliError> {
        let (mut loaded, mut names) = (Vec::new(), Vec::new());
        let models: Vec<String> = registry.entries().map(|entry| entry.info.name.to_owned()).collect();
        let mut taken = Vec::new();
        for argument in &self.subjects {
            let path = Path::new(argument);
            if path.is_dir() {
                let (summary, profile) = read_run(path)?;
                names.push(path.file_name().map_or(summary.case.clone(), |n| n.to_string_lossy().into_owned()));
                let mut subject = Subject::of_run(argument, summary, profile)?;
                subject.stated = stated_by(registry, path).or(subject.stated);
                loaded.push(Loaded::Ready(Box::new(subject)));
            } else if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv")) {
                let message = format!("{argument} is a table, not a case or a run");
                return Err(CliError::Usage { message, hint: format!("give it as --data {}", word(argument)) });
            } else {
                let chosen = self.model.iter().map(|model| registry.clone().choosing(model)).collect::<Vec<_>>();
                let registries = if chosen.is_empty() { std::slice::from_ref(registry) } else { &chosen };
                for registry in registries {
                    // What is set in the table of a model is for the cases of that model alone.
                    let own = registry.load(argument, &[]).ok().map(|(case, _)| case.model);
                    let overrides =
                        own.map_or_else(|| self.overrides.clone(), |own| for_model(own, &models, &self.overrides));
                    let (case, problem) = registry.load(argument, &overrides)?;
                    taken.extend(overrides);
                    names.push(case.name.clone());
                    loaded.push(Loaded::Case(Box::new((case, problem))));
                }
            }
        }
        // Nothing that was asked for is passed over: runs and data are read as they are.
        if let Some(idle) = self.overrides.iter().find(|argument| !taken.contains(argument)) {
            let message = format!("--set {} changes no case of this comparison", word(idle));
            let hint = "runs and data are read as they are; MODEL.key=value is for cases of that model".into();
            return Err(CliError::Usage { message, hint });
        }
        for file in &self.data {
            let path = Path::new(file);
            loaded.push(Loaded::Ready(Box::new(data::read(path).map_err(CompareError::from)?)));
            names.push(path.file_stem().map_or_else(|| "data".into(), |s| s.to_string_lossy().into_owned()));
        }
        Ok((loaded, names))
    }

    /// The command that makes this comparison, with something added to it.
    fn command(&self, added: &str) -> String {
        let mut words = vec!["bedload compare".to_owned()];
        words.extend(self.subjects.iter().map(|s| word(s)));
        words.extend(self.model.iter().map(|model| format!("--model {}", word(model))));
        words.extend(self.overrides.iter().map(|set| format!("--set {}", word(set))));
        words.extend(self.data.iter().map(|d| format!("--data {}", word(d))));
        if let (Datum::Bed | Datum::None, Some(value)) = (self.align, self.align.to_possible_value()) {
            words.push(format!("--align {}", value.get_name()));
        }
        if self.scale {
            words.push("--scale".into());
        }
        if !added.is_empty() {
            words.push(added.into());
        }
        words.join(" ")
    }

    /// What a reader wants to know first, in at most twelve lines.
    fn closing(&self, comparison: &Comparison, cost: &Cost, out: &Path, drawn: bool) -> String {
        const MAX_SUBJECTS: usize = 6;
        let mut lines = Vec::new();
        let mut line = |label: &str, text: String| lines.push(format!("  {label:<16} {text}"));
        let others = comparison.subjects.iter().enumerate().skip(1);
        for (i, subject) in others.clone().take(MAX_SUBJECTS) {
            line("against it", format!("{}: {}", subject.name, comparison.headline(i)));
        }
        let left = others.count().saturating_sub(MAX_SUBJECTS);
        if left > 0 {
            line("", format!("and {left} more in norms.csv"));
        }
        if let Some(flows) = comparison.flows_that_differ() {
            line("flow", flows);
        }
        if let Some(models) = comparison.models_that_differ() {
            line("solved with", models);
        }
        let warnings = comparison.warnings();
        // What is broken comes first there, and was said before.
        let said = comparison.subjects.iter().map(breaks).sum();
        let others: Vec<&String> = warnings.iter().skip(said).collect();
        if let Some(first) = others.first() {
            let more =
                if others.len() > 1 { format!(" (1 of {}, see the report)", others.len()) } else { String::new() };
            line("bear in mind", format!("{first}{more}"));
        }
        line("cost", format!("{:.2} ms to solve, {:.1} ms in all", 1e3 * cost.solve_s, 1e3 * cost.total_s));
        line("report", format!("{}/report.html", out.display()));
        let apart = warnings.iter().any(|w| w.contains("--align bed"));
        match (apart && self.align != Datum::Bed, drawn) {
            (true, _) => line("next", self.command("--align bed")),
            (false, true) => line("figures", format!("{}/figures/", out.display())),
            (false, false) => line("next", self.command("--png")),
        }
        let reference = comparison.subjects.first().map_or("", |s| s.name.as_str());
        let units = if comparison.scaled { "scaled" } else { "in SI" };
        let broken = broken(&comparison.subjects).map(|line| line + "\n").unwrap_or_default();
        format!("{broken}{reference} is the reference; {}, {units}\n{}\n", comparison.align.datum(), lines.join("\n"))
    }
}

/// How many premises of a subject are broken.
fn breaks(subject: &Subject) -> usize {
    subject.regime.iter().filter(|premise| premise.verdict == Verdict::Broken).count()
}

/// The premise that is broken, before everything else.
fn broken(subjects: &[Subject]) -> Option<String> {
    let more = match subjects.iter().map(breaks).sum::<usize>() {
        0 | 1 => String::new(),
        n => format!(" ({} more in the report)", n - 1),
    };
    let first = subjects.iter().find_map(|subject| {
        let premise = subject.regime.iter().find(|premise| premise.verdict == Verdict::Broken)?;
        Some((&subject.name, premise))
    });
    first.map(|(name, premise)| format!("broken premise of {name}: {}: {}{more}", premise.line(), premise.why))
}

/// Runs a case. A failure ends the comparison, for what is left of it would not be what was asked for.
fn solve(case: &Case, problem: &Problem, progress: &mut Progress) -> Result<Subject, CliError> {
    let solving = Instant::now();
    let solved = problem.solve(&mut Context::new(progress));
    let solve_s = solving.elapsed().as_secs_f64();
    let outcome = problem.complete(solved).map_err(|failure| {
        let error = ErrorReport {
            code: failure.error.code().into(),
            message: format!("{}: {}", case.source, failure.error),
            path: None,
            line: None,
            allowed: None,
            hint: Some(failure.error.hint()),
        };
        CliError::Failed(error, None)
    })?;
    if outcome.status == Status::Stopped {
        return Err(CliError::Stopped(json!({ "status": Status::Stopped }), false));
    }
    let subject = Subject::of_case(&case.name, &case.source, problem.model_name(), outcome, solve_s)?;
    Ok(Subject { stated: stated(case, problem), ..subject })
}

/// The flow of a case and how it is solved.
fn stated(case: &Case, problem: &Problem) -> Option<Stated> {
    problem.scene.as_ref().map(|scene| Stated::new(case.model, scene.record(), case.tables()))
}

/// The same of a run, if its folder holds a case that this program reads.
fn stated_by(registry: &Registry, run: &Path) -> Option<Stated> {
    let text = std::fs::read_to_string(run.join("case.toml")).ok()?;
    let (case, problem) = registry.parse("run", "case.toml", text, &[]).ok()?;
    stated(&case, &problem)
}
