//! Runs the points of a plan in parallel and writes the folder of the study.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde_json::Value;

use super::Assess;
use super::{Assessment, Plan, Point, Row, STOPPED, StudyError, page, record};
use crate::case::{Case, CaseError};
use crate::model::{Problem, Registry};
use crate::output::{
    Folder, Mode, OutputError, StudyFolder, fingerprint, read_field, read_run, read_series, write_failure,
    write_outcome, write_running,
};
use crate::result::Context;
use crate::result::Verdict;
use crate::result::{Cost, ErrorReport, Provenance, Results, Snapshot, Status, Watch};
use crate::runtime::cost::peak_memory_mb;

/// A point that took longer than this in all is not solved again.
const ENOUGH: Duration = Duration::from_secs(2);

/// Sees points end, and may ask to stop; called from several threads.
pub trait Observer: Sync {
    /// Whether to end with what there is.
    fn stop(&self) -> bool;
    /// `done` of `all` points have ended.
    fn done(&self, done: usize, all: usize);
    /// Work between points: a number that shrinks.
    fn see(&self, _snapshot: &Snapshot<'_>) {}
}

/// What follows from the first rows: further points, and how all rows are assessed.
pub type Next = Box<dyn FnOnce(&[Row], &dyn Observer) -> (Vec<Point>, Assess) + Send>;

/// How a study is conducted; none of it changes a result.
#[non_exhaustive]
pub struct Settings<'a> {
    /// the models
    pub registry: &'a Registry,
    /// folder to write; by default [`Plan::folder`]
    pub out: Option<PathBuf>,
    /// what may be done with a folder that is not empty
    pub mode: Mode,
    /// threads; 0 for as many as there are processors
    pub threads: usize,
    /// whether figures are drawn as PNG, too
    pub png: bool,
    /// the command that makes this study
    pub command: String,
    /// sees it
    pub observer: &'a dyn Observer,
}

impl<'a> Settings<'a> {
    /// On all processors, into the folder of the plan, which must be new or hold the same study.
    #[must_use]
    pub fn new(registry: &'a Registry, command: &str, observer: &'a dyn Observer) -> Self {
        Self { registry, out: None, mode: Mode::default(), threads: 0, png: false, command: command.into(), observer }
    }
}

/// A study as it stands in its folder.
#[derive(Debug)]
#[non_exhaustive]
pub struct Conducted {
    /// `study.json`
    pub record: Value,
    /// the rows, in the order of the plan
    pub rows: Vec<Row>,
    /// what they say
    pub assessment: Assessment,
    /// done; failed if every point failed; stopped
    pub status: Status,
    /// its folder
    pub out: PathBuf,
    /// figures that were drawn as PNG
    pub figures: Vec<PathBuf>,
    /// whether the folder still holds the finished study that it held before
    pub kept: bool,
    /// points that were taken from an earlier study
    pub resumed: usize,
    /// what all of it cost
    pub cost: Cost,
}

/// Label of what says which premise is broken at how many points.
pub const BROKEN: &str = "broken premise";

impl Conducted {
    /// At how many points a premise is broken, and the first; `None` where none is.
    #[must_use]
    pub fn broken(&self) -> Option<&str> {
        let found = self.assessment.findings.iter().find(|(label, _)| label == BROKEN);
        found.map(|(_, text)| text.as_str())
    }
}

/// A point with its case, if that can be used.
struct Loaded {
    case: Result<(Case, Problem, String), CaseError>,
    sha256: Option<String>,
}

/// Runs the points of `plan` and those that follow from them, assesses them and writes the folder.
///
/// # Errors
/// [`StudyError::Case`] if the case is refused at every point, [`StudyError::Output`], [`StudyError::Threads`].
pub fn conduct(plan: &Plan, settings: &Settings<'_>, next: Next) -> Result<Conducted, StudyError> {
    let start = Instant::now();
    let mut loaded: Vec<Loaded> = plan.points.iter().map(|point| load(settings.registry, plan, point)).collect();
    let Some(name) = loaded.iter().find_map(|l| l.case.as_ref().ok().map(|(case, ..)| case.name.clone())) else {
        let first = loaded.drain(..).find_map(|l| l.case.err());
        let empty = || StudyError::BadOver { argument: String::new(), reason: "there is no point".into() };
        return Err(first.map_or_else(empty, |error| StudyError::Case(Box::new(error))));
    };
    let out = settings.out.clone().unwrap_or_else(|| plan.folder(&name));
    let identity = identity(plan, &loaded);
    let mut folder = StudyFolder::prepare(&out, &identity, settings.mode)?;
    let begun = Begun { start, name: &name, identity: &identity, out };
    carry_out(plan, settings, loaded, next, begun, &mut folder).map_err(|error| match error {
        StudyError::Output(error) => StudyError::Output(folder.failed(error)),
        other => other,
    })
}

/// What is known of a study before it is carried out.
struct Begun<'a> {
    start: Instant,
    name: &'a str,
    identity: &'a str,
    out: PathBuf,
}

fn carry_out(
    plan: &Plan,
    settings: &Settings<'_>,
    loaded: Vec<Loaded>,
    next: Next,
    begun: Begun<'_>,
    folder: &mut StudyFolder,
) -> Result<Conducted, StudyError> {
    let Begun { start, name, identity, out } = begun;
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(settings.threads)
        .build()
        .map_err(|error| StudyError::Threads { wanted: settings.threads, error: error.into() })?;
    let mut provenance = Provenance { source: plan.case.clone(), ..Provenance::of_this_program() };
    (provenance.overrides, provenance.threads) = (plan.overrides.clone(), threads.current_num_threads());
    let head = record::Head { plan, name, identity, command: &settings.command };
    folder.begin(&head.running(&provenance))?;
    let (rows, resumed, assess) = threads.install(|| -> Result<_, OutputError> {
        let (mut rows, resumed) = run(plan, &plan.points, loaded, folder, settings)?;
        let (points, assess) = next(&rows, settings.observer);
        let loaded = points.iter().map(|point| load(settings.registry, plan, point)).collect();
        let (more, again) = run(plan, &points, loaded, folder, settings)?;
        rows.extend(more);
        Ok((rows, resumed + again, assess))
    })?;
    let mut assessment = assess(&rows);
    assessment.findings.splice(0..0, premises(&rows));
    let status = match () {
        () if rows.iter().any(|row| row.status == Status::Stopped) => Status::Stopped,
        () if assessment.failure.is_some() && settings.observer.stop() => Status::Stopped,
        () if assessment.failure.is_some() || rows.iter().all(|row| row.status == Status::Failed) => Status::Failed,
        () => Status::Done,
    };
    let cost = Cost {
        solve_s: rows.iter().map(|row| row.cost.solve_s).sum(),
        total_s: start.elapsed().as_secs_f64(),
        peak_memory_mb: peak_memory_mb(),
        work_units: rows.iter().map(|row| row.cost.work_units).sum(),
        ..Cost::default()
    };
    let written = head.complete(status, &rows, &assessment, &cost, &provenance);
    let page = page::html(&head, &rows, &assessment, &cost, &provenance);
    let mut comments: Vec<String> = provenance.lines().into_iter().take(1).collect();
    comments.extend([settings.command.clone(), format!("started {}", provenance.started_utc)]);
    if let Some(table) = &assessment.parameters {
        folder.write_parameters(|to| record::write_numbers(to, table, &comments))?;
    }
    let table = |to: &mut dyn std::io::Write| record::write_table(to, plan, &rows, &assessment, &comments);
    let (figures, kept) = folder.finish((status, &written), table, &page, &assessment.figures, settings.png)?;
    Ok(Conducted { record: written, rows, assessment, status, out, figures, kept, resumed, cost })
}

fn load(registry: &Registry, plan: &Plan, point: &Point) -> Loaded {
    let case = match &point.case {
        Some(case) => registry.load(case, &point.overrides),
        None => registry.load(&plan.case, &[plan.overrides.as_slice(), &point.overrides].concat()),
    };
    let case = case.map(|(case, problem)| {
        let resolved = case.resolved();
        (case, problem, resolved)
    });
    let sha256 = case.as_ref().ok().map(|(.., resolved)| fingerprint(resolved));
    Loaded { case, sha256 }
}

/// What tells this plan from another: the same points of the same case, value for value.
fn identity(plan: &Plan, loaded: &[Loaded]) -> String {
    let mut text = format!("{} {:?} {:?}\n", plan.verb, plan.options, plan.varied);
    for (point, loaded) in plan.points.iter().zip(loaded) {
        text += &format!("{} {:?} {:?}\n", point.series, point.values, loaded.sha256);
    }
    fingerprint(&text)
}

/// Runs each different case once; points that resolve to the same case share its run.
fn run(
    plan: &Plan,
    points: &[Point],
    loaded: Vec<Loaded>,
    folder: &StudyFolder,
    settings: &Settings<'_>,
) -> Result<(Vec<Row>, usize), OutputError> {
    let mut seen = BTreeSet::new();
    let jobs: Vec<_> =
        loaded.iter().filter(|one| one.sha256.as_ref().is_some_and(|sha256| seen.insert(sha256))).collect();
    let (ended, resumed) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let all = jobs.len();
    let solved = jobs.par_iter().filter_map(|one| Some((one.sha256.as_ref()?, one.case.as_ref().ok()?))).map(
        |(sha256, case)| {
            let row = match finished(&folder.point(sha256), settings.mode) {
                Some(row) => {
                    resumed.fetch_add(1, Ordering::Relaxed);
                    row
                }
                None => {
                    let prepare = || folder.prepare_point(sha256, &case.2);
                    solve(case, prepare, settings.observer, plan.repeats)?
                }
            };
            settings.observer.done(ended.fetch_add(1, Ordering::Relaxed) + 1, all);
            Ok((sha256.clone(), row))
        },
    );
    let solved: BTreeMap<String, Row> = solved.collect::<Result<_, OutputError>>()?;
    let rows = points.iter().zip(&loaded).map(|(point, one)| {
        let row = match (&one.sha256, &one.case) {
            (Some(sha256), _) => solved.get(sha256).cloned().unwrap_or_else(|| Row::empty(Status::Stopped)),
            (None, Err(error)) => Row { error: error.reports().into_iter().next(), ..Row::empty(Status::Failed) },
            (None, Ok(_)) => Row::empty(Status::Failed),
        };
        Row { point: point.clone(), sha256: one.sha256.clone(), ..row }
    });
    Ok((rows.collect(), resumed.into_inner()))
}

/// What a reader wants to know before everything else: points whose model is not meant for them.
fn premises(rows: &[Row]) -> Option<(String, String)> {
    let broken: Vec<&Row> = rows.iter().filter(|row| !row.broken.is_empty()).collect();
    let first = broken.first()?.broken.first()?;
    Some((BROKEN.into(), format!("{} of {} points, the first: {}", broken.len(), rows.len(), first.line())))
}

/// The run in `place`, if it is done and may be taken as it is.
fn finished(place: &Path, mode: Mode) -> Option<Row> {
    let (summary, profile) = read_run(place).ok().filter(|_| mode.resume)?;
    (summary.status == Status::Done).then(|| Row {
        broken: summary.premises(Verdict::Broken).cloned().collect(),
        results: summary.results,
        iterations: read_series(place).map(|series| series.rows()),
        cost: summary.cost,
        profile,
        field: read_field(place).ok().flatten(),
        ..Row::empty(Status::Done)
    })
}

/// Solves one case into its run folder.
fn solve(
    (case, problem, _): &(Case, Problem, String),
    prepare: impl FnOnce() -> Result<Folder, OutputError>,
    observer: &dyn Observer,
    repeats: usize,
) -> Result<Row, OutputError> {
    if observer.stop() {
        return Ok(Row::empty(Status::Stopped));
    }
    let start = Instant::now();
    let mut folder = prepare()?;
    let head = problem.head(case, 1);
    let summary = write_running(&folder, &head)?;
    let solving = Instant::now();
    let result = problem.solve(&mut Context::new(&mut Listening(observer)));
    let mut times = vec![solving.elapsed()];
    while times.len() < repeats && times.iter().sum::<Duration>() < ENOUGH && result.is_ok() && !observer.stop() {
        let again = Instant::now();
        let _ = problem.solve(&mut Context::new(&mut Listening(observer)));
        times.push(again.elapsed());
    }
    times.sort();
    let solve_s = times[times.len() / 2].as_secs_f64();
    let cost = Cost {
        solve_s,
        total_s: start.elapsed().as_secs_f64(),
        peak_memory_mb: peak_memory_mb(),
        work_units: problem.cells() as f64,
        repeats: times.len(),
        spread_s: (times.len() > 1).then(|| (times[3 * times.len() / 4] - times[times.len() / 4]).as_secs_f64()),
    };
    Ok(match problem.complete(result) {
        Ok(outcome) => {
            let written = write_outcome(&mut folder, summary, &head, &outcome, cost, false)?.summary;
            Row {
                broken: written.premises(Verdict::Broken).cloned().collect(),
                results: written.results,
                iterations: outcome.series.as_ref().map(|series| series.rows()),
                cost: written.cost,
                profile: outcome.profile,
                field: outcome.field,
                ..Row::empty(outcome.status)
            }
        }
        Err(failure) => {
            let written = write_failure(&mut folder, summary, &head, &failure, cost, false)?.summary;
            Row {
                error: written.error,
                class: Some(failure.error.class()),
                results: written.results,
                cost: written.cost,
                ..Row::empty(Status::Failed)
            }
        }
    })
}

/// Asks a run to stop when the study is asked to.
struct Listening<'a>(&'a dyn Observer);

impl Watch for Listening<'_> {
    fn see(&mut self, _: &Snapshot<'_>) -> ControlFlow<()> {
        if self.0.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Row {
    /// A row of which nothing but its state is known.
    pub(super) fn empty(status: Status) -> Self {
        let error = (status == Status::Stopped).then(|| ErrorReport {
            code: STOPPED.into(),
            message: "stopped by the user".into(),
            path: None,
            line: None,
            allowed: None,
            hint: None,
        });
        Self {
            point: Point::default(),
            sha256: None,
            status,
            error,
            class: None,
            broken: Vec::new(),
            results: Results::default(),
            iterations: None,
            cost: Cost::default(),
            profile: None,
            field: None,
        }
    }
}
