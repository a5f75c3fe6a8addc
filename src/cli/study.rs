//! What all studies have in common on the command line: where they go, how they run, what they say in the end.

use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;
use serde_json::{Value, json};

use super::interrupt;
use super::progress::Progress;
use super::run::not_strictly;
use super::{Answers, CaseArgs, CliError, say, word};
use crate::model::Registry;
use crate::output::Mode;
use crate::result::{ErrorReport, Snapshot, Status, Watch};
use crate::study::Assess;
use crate::study::{BROKEN, Conducted, Next, Observer, Plan, Settings, conduct};

/// How a study is conducted.
#[derive(Clone, Debug, Args)]
pub(super) struct StudyArgs {
    /// Folder to write [default: runs/<verb>-CASE]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Threads to use [default: all processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Draw the figures as PNG, too
    #[arg(long)]
    png: bool,
    /// No progress and no closing lines
    #[arg(long)]
    quiet: bool,
    /// Print study.json as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Replace whatever study the folder holds
    #[arg(long)]
    force: bool,
    /// Exit with code 3 where a premise of the model is broken at a point
    #[arg(long)]
    strict: bool,
    /// Keep the points of the same study that are done
    #[arg(long)]
    resume: bool,
}

/// Shows how many points are done, and listens for Ctrl-C.
struct OnScreen(Mutex<Progress>);

impl Observer for OnScreen {
    fn stop(&self) -> bool {
        interrupt::asked()
    }

    fn done(&self, done: usize, all: usize) {
        if let Ok(mut progress) = self.0.lock() {
            let fraction = done as f64 / all.max(1) as f64;
            // Each point asks for itself whether to stop.
            let _ = progress.see(&Snapshot { stage: "points", fraction, quantity: None });
        }
    }

    fn see(&self, snapshot: &Snapshot<'_>) {
        if let Ok(mut progress) = self.0.lock() {
            let _ = progress.see(snapshot);
        }
    }
}

impl StudyArgs {
    /// Conducts a study and says what came of it; `options` are the arguments of its verb.
    pub fn conduct(
        &self,
        registry: &Registry,
        answers: &Answers,
        case: &CaseArgs,
        plan: &Plan,
        assess: Assess,
        options: &[String],
    ) -> Result<(), CliError> {
        self.conduct_on(registry, answers, case, plan, Box::new(|_, _| (Vec::new(), assess)), options)
    }

    /// The same, with points that follow from the first ones.
    pub fn conduct_on(
        &self,
        registry: &Registry,
        answers: &Answers,
        case: &CaseArgs,
        plan: &Plan,
        next: Next,
        options: &[String],
    ) -> Result<(), CliError> {
        let sets = case.overrides.iter().map(|set| format!("--set {}", word(set)));
        let model = case.model.iter().map(|model| format!("--model {}", word(model)));
        let words = ["bedload".to_owned(), plan.verb.into(), word(&case.case)].into_iter().chain(model).chain(sets);
        let command = words.chain(options.iter().cloned()).collect::<Vec<_>>().join(" ");
        let on_screen = OnScreen(Mutex::new(Progress::new(self.quiet)));
        let settings = Settings {
            registry,
            out: self.out.clone(),
            mode: Mode { force: self.force, resume: self.resume },
            threads: self.threads.map_or(0, usize::from),
            png: self.png,
            command,
            observer: &on_screen,
        };
        let found = conduct(plan, &settings, next)?;
        let command = settings.command;
        drop(on_screen);
        let mut value = found.record.clone();
        if let Value::Object(object) = &mut value {
            object.insert("out".into(), found.out.display().to_string().into());
        }
        match found.status {
            Status::Failed => {
                let error = found.assessment.failure.clone().unwrap_or_else(|| every_point(&found));
                if let Value::Object(object) = &mut value {
                    object.insert("error".into(), json!(error));
                }
                Err(CliError::Failed(error, Some(value)))
            }
            Status::Stopped => Err(CliError::Stopped(value, found.kept)),
            _ if self.strict && found.broken().is_some() => Err(not_strictly(
                found.broken().map(|text| format!("broken premise: {text}")).unwrap_or_default(),
                value,
            )),
            _ if self.json => Ok(answers.give(&value)?),
            _ if self.quiet => Ok(()),
            _ => {
                let out = self.out.as_ref().map(|out| format!(" --out {}", word(&out.display().to_string())));
                Ok(say(&closing(plan, &found, &(command + &out.unwrap_or_default())))?)
            }
        }
    }
}

/// Why there is nothing: that of the first point.
fn every_point(found: &Conducted) -> ErrorReport {
    let first = found.rows.iter().find_map(|row| row.error.clone());
    let message = first.as_ref().map(|e| e.message.clone()).unwrap_or_default();
    ErrorReport {
        code: first.as_ref().map_or_else(|| "failed".into(), |e| e.code.clone()),
        message: format!("every point fails, the first because {message}"),
        path: None,
        line: None,
        allowed: None,
        hint: first.and_then(|e| e.hint),
    }
}

/// What a reader wants to know first, in at most twelve lines.
fn closing(plan: &Plan, found: &Conducted, command: &str) -> String {
    const MAX_FINDINGS: usize = 7;
    let failed: Vec<_> = found.rows.iter().filter(|row| row.status == Status::Failed).collect();
    let mut counts = format!("{} points, {} done", found.rows.len(), found.rows.len() - failed.len());
    if found.resumed > 0 {
        counts += &format!(" ({} before)", found.resumed);
    }
    let mut lines: Vec<String> = found.broken().map(|text| format!("broken premise: {text}")).into_iter().collect();
    lines.push(format!("{} {}: {counts}", plan.verb, plan.case));
    let mut line = |label: &str, text: String| lines.push(format!("  {label:<24} {text}"));
    let findings = found.assessment.findings.iter().filter(|(label, _)| label != BROKEN);
    for (label, text) in findings.take(MAX_FINDINGS) {
        line(label, text.clone());
    }
    if let Some(first) = failed.first() {
        let text = format!(
            "{} of {}, first {}: {}",
            failed.len(),
            found.rows.len(),
            first.point.name(&plan.varied),
            first.reason()
        );
        line("failed", text);
    }
    let cost = &found.cost;
    line("cost", format!("{:.1} ms to solve, {:.0} ms in all", 1e3 * cost.solve_s, 1e3 * cost.total_s));
    line("report", format!("{}/report.html", found.out.display()));
    if found.figures.is_empty() {
        line("next", format!("{command} --resume --png"));
    } else {
        line("figures", format!("{}/figures/", found.out.display()));
    }
    lines.join("\n") + "\n"
}
