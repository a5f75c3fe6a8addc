//! What a run writes: summary first (`running`) and last, the resolved case, tables, report, figures on demand.

use std::fs;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process;

use serde::{Deserialize, Serialize};
use serde_json::Map;
use sha2::{Digest, Sha256};

use super::error::OutputError;
use super::folder::{Folder, write_whole};
use super::grains::{ANIMATION, read_animation};
use super::lock::Site;
use super::ours::{FIGURES, WORDS};
use super::path::resolve;
use super::tables::read_field;
use crate::plot::{self, Page};
use crate::result::{
    Animation, Axis, Cost, ErrorReport, Failure, Field, Figure, Head, Outcome, Profile, Provenance, Results, Series,
    SideView, Statement, Status, Summary, TableError, quantity,
};

/// A run as it stands in its folder.
#[derive(Debug)]
#[non_exhaustive]
pub struct Written {
    /// its summary
    pub summary: Summary,
    /// figures that were drawn as PNG
    pub figures: Vec<PathBuf>,
    /// whether the folder still holds the finished run that it held before
    pub kept: bool,
}

/// SHA-256 of a text, such as a resolved case, as 64 hexadecimal digits.
#[must_use]
pub fn fingerprint(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The summary of a run that has just begun.
fn begin(head: &Head) -> Summary {
    Summary {
        format: Summary::FORMAT,
        status: Status::Running,
        case: head.case.clone(),
        model: head.model.clone(),
        scene: head.scene.clone(),
        results: Results::default(),
        balances: Vec::new(),
        regime: Vec::new(),
        validity: Vec::new(),
        regularisation: Map::new(),
        error: None,
        cost: Cost::default(),
        provenance: Provenance {
            source: head.source.clone(),
            overrides: head.overrides.clone(),
            case_sha256: fingerprint(&head.resolved),
            scene_sha256: fingerprint(&head.parts[0]),
            model_sha256: fingerprint(&head.parts[1]),
            threads: head.threads,
            ..Provenance::of_this_program()
        },
    }
}

/// Marks the folder as being computed and keeps the resolved case. Returns the summary to complete.
///
/// # Errors
/// [`OutputError::Interrupted`] with the file that cannot be written.
pub fn write_running(folder: &Folder, head: &Head) -> Result<Summary, OutputError> {
    let summary = begin(head);
    write_summary(folder, &summary)?;
    folder.write("case.toml", |to| to.write_all(head.resolved.as_bytes()))?;
    Ok(summary)
}

/// Writes what a run has computed, complete or stopped.
///
/// # Errors
/// [`OutputError::Interrupted`] with the file that cannot be written.
pub fn write_outcome(
    folder: &mut Folder,
    mut summary: Summary,
    head: &Head,
    outcome: &Outcome,
    cost: Cost,
    png: bool,
) -> Result<Written, OutputError> {
    summary.status = outcome.status;
    fill(&mut summary, outcome, cost);
    let figures = write_body(folder, &summary, head, Some(outcome), png)?;
    complete(folder, summary, figures)
}

/// Writes a failed run: the reason, and the last good state if there is one.
///
/// # Errors
/// [`OutputError::Interrupted`] with the file that cannot be written.
pub fn write_failure(
    folder: &mut Folder,
    mut summary: Summary,
    head: &Head,
    failure: &Failure,
    cost: Cost,
    png: bool,
) -> Result<Written, OutputError> {
    summary.status = Status::Failed;
    let Failure { error, last } = failure;
    summary.error = Some(ErrorReport {
        code: error.code().into(),
        message: error.to_string(),
        path: None,
        line: None,
        allowed: None,
        hint: Some(error.hint()),
    });
    if let Some(last) = last {
        fill(&mut summary, last, cost);
    } else {
        summary.cost = cost;
    }
    let figures = write_body(folder, &summary, head, last.as_deref(), png)?;
    complete(folder, summary, figures)
}

fn fill(summary: &mut Summary, outcome: &Outcome, cost: Cost) {
    summary.results = outcome.results.clone();
    summary.balances = outcome.balances.clone();
    summary.regime = outcome.regime.clone();
    summary.validity = outcome.validity.clone();
    summary.regularisation = outcome.regularisation.clone();
    summary.cost = Cost { work_units: outcome.work, ..cost };
}

fn complete(folder: &mut Folder, summary: Summary, figures: Vec<PathBuf>) -> Result<Written, OutputError> {
    write_summary(folder, &summary)?;
    // Ctrl-C loses nothing: what is only begun does not replace what is done.
    let kept = summary.status == Status::Stopped && folder.over_finished();
    if kept {
        folder.give_way();
    } else {
        folder.finish()?;
    }
    Ok(Written { summary, figures, kept })
}

fn write_summary(folder: &Folder, summary: &Summary) -> Result<(), OutputError> {
    folder.write("summary.json", |to| {
        serde_json::to_writer_pretty(&mut *to, summary)?;
        writeln!(to)
    })
}

/// Tables, report and figures.
fn write_body(
    folder: &Folder,
    summary: &Summary,
    head: &Head,
    outcome: Option<&Outcome>,
    png: bool,
) -> Result<Vec<PathBuf>, OutputError> {
    let comments = summary.provenance.lines();
    if let Some(profile) = outcome.and_then(|o| o.profile.as_ref()) {
        folder.write("profile.csv", |to| profile.write_csv(to, &comments).map_err(as_io))?;
    }
    if let Some(series) = outcome.and_then(|o| o.series.as_ref()) {
        folder.write("series.csv", |to| series.write_csv(to, &comments).map_err(as_io))?;
    }
    if let Some(outcome) = outcome {
        write_fields(folder, outcome)?;
    }
    let figures = outcome.map(|o| o.figures.clone()).unwrap_or_default();
    let words = Words { title: head.title.clone(), statement: head.statement.clone(), figures };
    folder.write(WORDS, |to| Ok(serde_json::to_writer(to, &words)?))?;
    let drawn = Drawn {
        profile: outcome.and_then(|o| o.profile.as_ref()),
        series: outcome.and_then(|o| o.series.as_ref()),
        field: outcome.and_then(|o| o.field.as_ref()),
        grains: outcome.and_then(|o| o.grains.as_ref()),
        animation: outcome.and_then(|o| o.animation.as_ref()).filter(|animation| animation.is_sound()),
    };
    draw((&folder.place, folder.path()), summary, &drawn, &words, &head.resolved, png)
}

/// Fields, grains and animation: what the report draws besides the tables.
fn write_fields(folder: &Folder, outcome: &Outcome) -> Result<(), OutputError> {
    if let Some(field) = &outcome.field {
        folder.write("section.csv", |to| to.write_all(field.csv().as_bytes()))?;
        folder.write("section.vts", |to| to.write_all(field.vts().as_bytes()))?;
    }
    if let Some(grains) = &outcome.grains {
        folder.write("grains.csv", |to| to.write_all(grains.csv().as_bytes()))?;
    }
    match &outcome.animation {
        Some(animation) => folder.write(ANIMATION, |to| Ok(serde_json::to_writer(to, animation)?)),
        None => Ok(()),
    }
}

fn as_io(error: TableError) -> io::Error {
    match error {
        TableError::Io(error) => error,
        TableError::Csv(error) => match error.into_kind() {
            csv::ErrorKind::Io(error) => error,
            other => io::Error::other(format!("{other:?}")),
        },
        other => io::Error::other(other),
    }
}

/// What the report shows that stands in no table: `page.json`.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct Words {
    title: String,
    #[serde(flatten)]
    statement: Statement,
    /// figures that only the model has
    figures: Vec<Figure>,
}

/// What the report draws.
struct Drawn<'a> {
    profile: Option<&'a Profile>,
    series: Option<&'a Series>,
    field: Option<&'a Field>,
    grains: Option<&'a SideView>,
    animation: Option<&'a Animation>,
}

/// Draws the report and, on demand, the figures as PNG, into `place`; `shown` is what the paths are called.
fn draw(
    (place, shown): (&Path, &Path),
    summary: &Summary,
    drawn: &Drawn<'_>,
    words: &Words,
    case: &str,
    png: bool,
) -> Result<Vec<PathBuf>, OutputError> {
    let mut figures = drawn.profile.map(|p| plot::profile_figures(p, summary)).unwrap_or_default();
    figures.extend(words.figures.iter().cloned());
    figures.extend(drawn.series.map(|series| plot::series_figures(series, &summary.case)).unwrap_or_default());
    let drawing = drawing(drawn, summary);
    let page = plot::report_html(&Page {
        summary,
        figures: &figures,
        drawing: drawing.as_ref().map(|(svg, caption)| (svg.as_str(), *caption)),
        animation: drawn.animation,
        statement: &words.statement,
        case_toml: case,
        notes: std::slice::from_ref(&words.title),
    });
    write_whole(&place.join("report.html"), |to| to.write_all(page.as_bytes()))?;
    if !png {
        return Ok(Vec::new());
    }
    let mut files = draw_png(place, shown, &figures)?;
    if let Some(map) = drawn.field.and_then(|field| map(field, summary)) {
        files.push(draw_one(place, shown, "section", |path| plot::map_png(&map, path))?);
    }
    Ok(files)
}

/// The map of a run that has a section.
fn map(field: &Field, summary: &Summary) -> Option<plot::Map> {
    let get = |quantity: &quantity::Quantity| summary.results.get(quantity.name);
    let largest = get(&quantity::U_MAX).unwrap_or(1.0);
    let (unit, scale) = if largest < 0.1 { ("mm/s", 1e-3) } else { ("m/s", 1.0) };
    let half = get(&quantity::FLOW_RATE).is_some();
    let panel = plot::section_map(field, half, get(&quantity::BED_LEVEL), ("", scale))?;
    Some(plot::Map { panels: vec![panel], colours: Axis::linear("velocity", unit) })
}

/// The drawing of a run that has fields, with its caption.
fn drawing(drawn: &Drawn<'_>, summary: &Summary) -> Option<(String, &'static str)> {
    if let Some(svg) = drawn.grains.and_then(plot::grains_svg) {
        let caption =
            "Side view of the grains nearest to the viewer at the end, coloured by their velocity along the flow.";
        return Some((svg, caption));
    }
    let half = summary.results.get(quantity::FLOW_RATE.name).is_some();
    let svg = plot::section_svg(drawn.field?, half, summary.results.get(quantity::BED_LEVEL.name))?;
    let caption = "Velocity in the section; inside the white lines the material does not yield. Dashed: the bed level.";
    Some((svg, caption))
}

/// Draws figures as PNG into `place`/figures; `shown` is what that place is called in the paths that are returned.
pub(super) fn draw_png(place: &Path, shown: &Path, figures: &[Figure]) -> Result<Vec<PathBuf>, OutputError> {
    let folder = place.join(FIGURES);
    // A link would lead to somebody's files.
    if fs::symlink_metadata(&folder).is_ok_and(|known| !known.is_dir()) {
        return Err(OutputError::NotAFolder(folder));
    }
    fs::create_dir_all(&folder).map_err(|error| OutputError::Interrupted { path: folder.clone(), error })?;
    figures.iter().map(|figure| draw_one(place, shown, &figure.stem, |path| plot::png(figure, path))).collect()
}

/// Draws one figure into `place`/figures and returns what its path is called.
pub(super) fn draw_one(
    place: &Path,
    shown: &Path,
    stem: &str,
    draw: impl FnOnce(&Path) -> Result<(), plot::PlotError>,
) -> Result<PathBuf, OutputError> {
    let name = format!("{FIGURES}/{stem}.png");
    // Drawn beside and renamed, as every file: the ending tells the format.
    let partial = place.join(FIGURES).join(format!(".{stem}.part-{}.png", process::id()));
    let drawn = draw(&partial).map_err(io::Error::other).and_then(|()| fs::rename(&partial, place.join(&name)));
    if let Err(error) = drawn {
        let _ = fs::remove_file(&partial);
        return Err(OutputError::Interrupted { path: place.join(&name), error });
    }
    Ok(shown.join(&name))
}

/// The summary of a run folder; anything that is not one is foreign.
pub(super) fn read_summary(folder: &Path) -> Result<Summary, OutputError> {
    let foreign = |entry: &str| OutputError::Foreign { folder: folder.into(), entry: entry.into() };
    let path = folder.join("summary.json");
    let text = fs::read_to_string(&path).map_err(|_| foreign("no summary.json"))?;
    serde_json::from_str(&text).map_err(|_| foreign("a summary.json of something else"))
}

/// The summary and the profile of a run, from its folder.
///
/// # Errors
/// [`OutputError::NotARun`] if the folder does not hold a run.
pub fn read_run(folder: &Path) -> Result<(Summary, Option<Profile>), OutputError> {
    let wrong = |reason: String| OutputError::NotARun { folder: folder.into(), reason };
    let text = read_text(folder, "summary.json")?;
    let summary = serde_json::from_str(&text).map_err(|error| wrong(format!("summary.json: {error}")))?;
    let profile = match fs::File::open(folder.join("profile.csv")) {
        Ok(file) => {
            Some(Profile::read_csv(BufReader::new(file)).map_err(|error| wrong(format!("profile.csv: {error}")))?)
        }
        Err(_) => None,
    };
    Ok((summary, profile))
}

fn read_text(folder: &Path, name: &str) -> Result<String, OutputError> {
    let wrong = |error: io::Error| OutputError::NotARun { folder: folder.into(), reason: format!("{name}: {error}") };
    fs::read_to_string(folder.join(name)).map_err(wrong)
}

/// Draws the report of a finished run again, from its tables alone.
///
/// # Errors
/// [`OutputError::NotARun`] if the folder does not hold a run, [`OutputError::Interrupted`] if it cannot be written.
pub fn redraw(folder: &Path, png: bool) -> Result<Written, OutputError> {
    let wrong = |reason: String| OutputError::NotARun { folder: folder.into(), reason };
    let before = read_run(folder);
    let _site = match Site::take(&resolve(folder)?) {
        Ok(site) => site,
        Err(error @ OutputError::InUse { .. }) => return Err(error),
        // What stands there tells more than that no lock can be made.
        Err(error) => return before.and(Err(error)),
    };
    // Read again: it may have been written until it was locked.
    let (summary, profile) = read_run(folder)?;
    let text = read_text(folder, "case.toml")?;
    if fingerprint(&text) != summary.provenance.case_sha256 {
        return Err(wrong("case.toml is not the case of the summary".into()));
    }
    let named = |name: &'static str| move |error: TableError| wrong(format!("{name}: {error}"));
    let file = |name: &str| fs::File::open(folder.join(name)).ok().map(BufReader::new);
    let series = file("series.csv").map(Series::read_csv).transpose().map_err(named("series.csv"))?;
    let field = read_field(folder)?;
    let grains = file("grains.csv").map(SideView::read).transpose().map_err(named("grains.csv"))?.flatten();
    let words = match file(WORDS) {
        Some(file) => serde_json::from_reader(file).map_err(|error| wrong(format!("{WORDS}: {error}")))?,
        // An earlier version wrote none: the tables are drawn.
        None => Words::default(),
    };
    let animation = read_animation(folder);
    let drawn = Drawn {
        profile: profile.as_ref(),
        series: series.as_ref(),
        field: field.as_ref(),
        grains: grains.as_ref(),
        animation: animation.as_ref(),
    };
    let figures = draw((folder, folder), &summary, &drawn, &words, &text, png)?;
    Ok(Written { summary, figures, kept: false })
}
