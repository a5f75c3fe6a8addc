//! `bedload run`: solve a case and write its folder.

use std::cell::RefCell;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::Value;

use super::progress::Progress;
use super::{Answers, CaseArgs, CliError, Verb, say};
use crate::case::Case;
use crate::model::{Problem, Registry};
use crate::output::{
    CHECKPOINT, Folder, Mode, OutputError, Written, default_folder, write_failure, write_outcome, write_running,
};
use crate::result::{Checkpoints, Context, Cost, ErrorReport, Frames, Premise, Status, Summary, Validity, Verdict};
use crate::runtime::cost::peak_memory_mb;
use crate::units::significant;

/// Code of an answer that rests on a broken premise, where that is no answer (`--strict`).
pub(super) const BROKEN_PREMISE: &str = "broken-premise";

/// Under `--strict` an answer that rests on a broken premise, of which `message` says which, is a failure; the folder keeps it.
pub(super) fn not_strictly(message: String, mut answer: Value) -> CliError {
    let hint = "another model (`bedload advise`), or another flow; without --strict it is an answer";
    let error = ErrorReport {
        code: BROKEN_PREMISE.into(),
        message,
        path: None,
        line: None,
        allowed: None,
        hint: Some(hint.into()),
    };
    if let Value::Object(object) = &mut answer {
        object.insert("error".into(), serde_json::json!(error));
    }
    CliError::Failed(error, Some(answer))
}

/// Solve a case and write its folder: numbers, tables, report.
#[derive(Clone, Debug, Args)]
pub(super) struct Run {
    #[command(flatten)]
    case: CaseArgs,
    /// Folder to write [default: runs/CASE]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads to use
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
    /// Draw the figures as PNG, too
    #[arg(long)]
    png: bool,
    /// No progress and no closing lines
    #[arg(long)]
    quiet: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// Replace whatever run the folder holds
    #[arg(long)]
    force: bool,
    /// Exit with code 3 where a premise of the model is broken
    #[arg(long)]
    strict: bool,
    /// Go on with an unfinished run of the same case
    #[arg(long)]
    resume: bool,
    /// Seconds between two checkpoints of a run of grains; 0 is none but at Ctrl-C
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    checkpoint: f64,
}

impl Verb for Run {
    fn case(&mut self) -> Option<&mut CaseArgs> {
        Some(&mut self.case)
    }

    fn out(&mut self) -> Option<&mut PathBuf> {
        self.out.as_mut()
    }

    fn json(&self) -> bool {
        self.json
    }

    fn writes(&self) -> bool {
        true
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let start = Instant::now();
        let (case, problem) = self.case.load(registry)?;
        // Listening begins before there is anything that Ctrl-C could leave half done.
        let progress = Progress::new(self.quiet);
        let out = self.out.clone().unwrap_or_else(|| default_folder(&case.name));
        let mode = Mode { force: self.force, resume: self.resume };
        let mut folder = Folder::prepare(&out, &case.resolved(), mode)?;
        let checkpoint = if self.resume { Self::checkpoint(folder.path(), &problem)? } else { None };
        let begun = Begun { start, progress, checkpoint };
        let written = self.compute(&mut folder, &case, &problem, begun).map_err(|error| folder.failed(error))?;
        drop(folder);
        let mut value = written.summary.to_json();
        if let Value::Object(object) = &mut value {
            object.insert("out".into(), out.display().to_string().into());
        }
        match (written.summary.status, &written.summary.error) {
            (Status::Failed, Some(error)) => Err(CliError::Failed(error.clone(), Some(value))),
            (Status::Stopped, _) => Err(CliError::Stopped(value, written.kept)),
            _ if self.strict && broken(&written.summary).is_some() => {
                Err(not_strictly(broken(&written.summary).unwrap_or_default(), value))
            }
            _ if self.json => Ok(answers.give(&value)?),
            _ if self.quiet => Ok(()),
            _ => Ok(say(&closing(&written, &out.display().to_string(), &self.case.as_typed()))?),
        }
    }
}

impl Run {
    /// Solves the case into its folder.
    fn compute(
        &self,
        folder: &mut Folder,
        case: &Case,
        problem: &Problem,
        begun: Begun,
    ) -> Result<Written, OutputError> {
        let Begun { start, mut progress, checkpoint } = begun;
        let head = problem.head(case, usize::from(self.threads));
        let summary = write_running(folder, &head)?;
        let solving = Instant::now();
        let going_on = checkpoint.is_some();
        if going_on {
            folder.carry_over()?;
        }
        let between = (self.checkpoint > 0.0).then(|| Duration::from_secs_f64(self.checkpoint));
        let broken = Broken::default();
        let last = Instant::now();
        let mut keeper = Keeper { folder, checkpoint, going_on, between, last, broken: &broken };
        let mut camera = Camera { folder, going_on, broken: &broken };
        let context = Context::new(&mut progress).threads(usize::from(self.threads));
        let result = problem.solve(&mut context.checkpoints(&mut keeper).frames(&mut camera));
        let solve_s = solving.elapsed().as_secs_f64();
        let result = problem.complete(result);
        drop(progress);
        if let Some(error) = broken.into_inner() {
            return Err(error);
        }
        let cost = Cost {
            solve_s,
            total_s: start.elapsed().as_secs_f64(),
            peak_memory_mb: peak_memory_mb(),
            work_units: problem.cells() as f64,
            ..Cost::default()
        };
        match &result {
            Ok(outcome) => write_outcome(folder, summary, &head, outcome, cost, self.png),
            Err(failure) => write_failure(folder, summary, &head, failure, cost, self.png),
        }
    }

    /// The checkpoint of the unfinished run in `out`, if there is one; one that cannot be used is refused.
    fn checkpoint(out: &Path, problem: &Problem) -> Result<Option<Vec<u8>>, CliError> {
        let Ok(bytes) = fs::read(out.join(CHECKPOINT)) else { return Ok(None) };
        let Some(accepted) = problem.solver().accepts(&bytes) else { return Ok(None) };
        accepted.map(|()| Some(bytes)).map_err(|error| CliError::Usage {
            message: format!("{}: {error}", out.join(CHECKPOINT).display()),
            hint: "--force starts again".into(),
        })
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|s| (0.0..=1e9).contains(s));
    value.ok_or_else(|| "a number of seconds from 0 to 1e9".into())
}

/// What there is before a run is computed.
struct Begun {
    start: Instant,
    progress: Progress,
    checkpoint: Option<Vec<u8>>,
}

/// What could not be written first: no failure of the method, whatever that makes of it.
type Broken = RefCell<Option<OutputError>>;

/// Remembers an error of the folder, and says it to the run.
fn breaks(broken: &Broken) -> impl Fn(OutputError) -> io::Error + '_ {
    move |error| {
        let said = io::Error::other(error.to_string());
        broken.borrow_mut().get_or_insert(error);
        said
    }
}

/// Keeps the states of the run in its folder as they come.
struct Keeper<'a> {
    folder: &'a Folder,
    checkpoint: Option<Vec<u8>>,
    going_on: bool,
    /// time between two checkpoints that are not asked for, if there are any
    between: Option<Duration>,
    last: Instant,
    broken: &'a Broken,
}

impl Checkpoints for Keeper<'_> {
    fn keep(&mut self, now: bool, content: &mut dyn FnMut() -> Vec<u8>) -> io::Result<()> {
        if !now && self.between.is_none_or(|between| self.last.elapsed() < between) {
            return Ok(());
        }
        let bytes = content();
        self.last = Instant::now();
        self.folder.write_on_the_way(CHECKPOINT, &bytes, self.going_on).map_err(breaks(self.broken))
    }

    fn resumed(&mut self) -> Option<Vec<u8>> {
        self.checkpoint.take()
    }
}

/// Writes the frames of the run into its folder.
struct Camera<'a> {
    folder: &'a Folder,
    going_on: bool,
    broken: &'a Broken,
}

impl Frames for Camera<'_> {
    fn take(&mut self, number: u64, content: &mut dyn FnMut() -> String) -> io::Result<()> {
        let name = format!("grains_{number:05}.vtp");
        self.folder.write_on_the_way(&name, content().as_bytes(), self.going_on).map_err(breaks(self.broken))
    }
}

/// What a reader wants to know first, in at most twelve lines.
fn closing(written: &Written, out: &str, case: &str) -> String {
    let Summary { balances, validity, cost, model, .. } = &written.summary;
    let mut lines: Vec<String> = broken(&written.summary).into_iter().collect();
    lines.push(format!("{}: {model}", written.summary.case));
    let mut line = |label: &str, text: String| lines.push(format!("  {label:<16} {text}"));
    // What the case states of its grains, and they are not.
    let (stated, laws): (Vec<&Validity>, Vec<_>) = validity.iter().partition(|v| v.closure.starts_with("grains/"));
    for v in stated {
        let text = format!(
            "as given, it is not that of these grains: {} = {} ({})",
            v.variable,
            significant(v.value, 3),
            v.range
        );
        line(v.closure.trim_start_matches("grains/"), text);
    }
    for (label, text) in written.summary.answer() {
        line(&label, text);
    }
    if !balances.is_empty() {
        let text: Vec<String> = balances.iter().map(|b| format!("{} {:.0e}", b.name, b.relative.abs())).collect();
        line("balances", format!("{}  (relative)", text.join(", ")));
    }
    let outside = |v: &Validity| format!("{}: {} = {} ({})", v.closure, v.variable, significant(v.value, 3), v.range);
    let mut trusted = vec![regime(&written.summary)];
    if !laws.is_empty() {
        trusted.push(format!("outside range: {}", laws.into_iter().map(outside).collect::<Vec<_>>().join("; ")));
    }
    line("regime", trusted.join("; "));
    let memory = cost.peak_memory_mb.map(|mb| format!(", {mb:.0} MB")).unwrap_or_default();
    line("cost", format!("{:.2} ms to solve, {:.1} ms in all{memory}", 1e3 * cost.solve_s, 1e3 * cost.total_s));
    line("report", format!("{out}/report.html"));
    if written.figures.is_empty() {
        line("next", format!("bedload explain {case}"));
    } else {
        line("figures", format!("{out}/figures/"));
    }
    lines.join("\n") + "\n"
}

/// What the flow says of the premises of its model.
fn regime(summary: &Summary) -> String {
    let doubtful: Vec<String> = summary.premises(Verdict::Doubtful).map(Premise::line).collect();
    match (summary.regime.len(), summary.premises(Verdict::Broken).count(), doubtful.as_slice()) {
        (0, ..) => "no premise of this model is checked".into(),
        (1, 0, []) => "its premise holds".into(),
        (n, 0, []) => format!("all {n} premises hold"),
        (_, 0, doubtful) => format!("doubtful: {}", doubtful.join("; ")),
        (_, broken, []) => format!("{broken} broken"),
        (_, broken, doubtful) => format!("{broken} broken; doubtful: {}", doubtful.join("; ")),
    }
}

/// The premise that is broken, before everything else.
fn broken(summary: &Summary) -> Option<String> {
    let mut broken = summary.premises(Verdict::Broken);
    let first = broken.next()?;
    let more: Vec<String> = broken.map(|premise| premise.premise.clone()).collect();
    let more = if more.is_empty() { String::new() } else { format!(" (also broken: {})", more.join("; ")) };
    Some(format!("broken premise: {}: {}{more}", first.line(), first.why))
}
