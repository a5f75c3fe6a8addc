//! The page of a study: what was found, the first figure, what is missing, the other figures, every point, the origin.

use super::record::Head;
use super::{Assessment, Numbers, Row};
use crate::compare::origin;
use crate::plot::{Cell, Document, Section, document_html};
use crate::result::{Cost, Provenance, Status, quantity};
use crate::units::{CommonUnits, significant};

/// Results that the table of points shows, where any point has them; all of them are in `points.csv`.
const QUANTITIES: &[&quantity::Quantity] = &[
    &quantity::TRANSPORT_RATE,
    &quantity::SHIELDS,
    &quantity::YIELD_LEVEL,
    &quantity::PLUG_VELOCITY,
    &quantity::SURFACE_VELOCITY,
    &quantity::MEAN_VELOCITY,
];

/// The page as one self-contained HTML document.
pub(super) fn html(
    head: &Head<'_>,
    rows: &[Row],
    assessment: &Assessment,
    cost: &Cost,
    provenance: &Provenance,
) -> String {
    let title = format!("{} {}", head.plan.verb, head.name);
    let (first, others) = assessment.figures.split_at(assessment.figures.len().min(1));
    let mut sections = vec![
        Section::Answer(assessment.findings.clone()),
        Section::Figures(first),
        Section::Warnings(warnings(head, rows, assessment)),
    ];
    sections.extend(assessment.parameters.as_ref().map(numbers));
    sections.extend([
        Section::Figures(others),
        points(head, rows, assessment),
        origin(cost, &Provenance { source: head.command.into(), ..provenance.clone() }),
    ]);
    document_html(&Document { title: &title, subtitle: &assessment.subtitle, sections: &sections })
}

/// What failed as a whole, and the points that are missing, and why.
fn warnings(head: &Head<'_>, rows: &[Row], assessment: &Assessment) -> Vec<String> {
    let missing = rows.iter().filter(|row| row.status != Status::Done);
    let missing = missing.map(|row| format!("{}: {}.", row.point.name(&head.plan.varied), row.reason()));
    assessment.failure.iter().map(|failure| format!("{}.", failure.message)).chain(missing).collect()
}

/// A table of names and numbers.
fn numbers(table: &Numbers) -> Section<'static> {
    let cell = |x: &Option<f64>| match x {
        Some(x) => Cell::Number { shown: significant(*x, 4), full: format!("{x:?}") },
        None => Cell::Empty("not known"),
    };
    let row = |(name, values): &(String, Vec<Option<f64>>)| {
        std::iter::once(Cell::Text(name.clone())).chain(values.iter().map(cell)).collect()
    };
    Section::Table {
        heading: table.heading,
        lead: table.lead.clone(),
        head: table.head.iter().map(|name| name.replace('_', " ")).collect(),
        rows: table.rows.iter().map(row).collect(),
    }
}

fn points(head: &Head<'_>, rows: &[Row], assessment: &Assessment) -> Section<'static> {
    let reported: Vec<&quantity::Quantity> =
        QUANTITIES.iter().copied().filter(|q| rows.iter().any(|row| row.result(q.name).is_some())).collect();
    let mut heads: Vec<String> = vec!["series".into()];
    heads.extend(head.plan.varied.iter().cloned());
    heads.push("status".into());
    heads.extend(assessment.measures.iter().map(|(name, _)| name.replace('_', " ")));
    heads.extend(reported.iter().map(|q| q.title.to_owned()));
    heads.extend(["iterations".to_owned(), "solver".to_owned()]);
    let sizes = reported.iter().flat_map(|q| rows.iter().filter_map(|row| Some((row.result(q.name)?, q.unit))));
    let units = CommonUnits::of(sizes);
    let cells = rows.iter().enumerate().map(|(i, row)| {
        let number = |x: Option<f64>, text: &dyn Fn(f64) -> String| {
            x.map_or(Cell::Empty("no value"), |x| Cell::Number { shown: text(x), full: format!("{x:?}") })
        };
        let mut cells: Vec<Cell> = vec![row.point.series.as_str().into()];
        cells.extend(row.point.values.iter().map(|value| value.as_str().into()));
        cells.push(Cell::Text(row.status.to_string()));
        let measures = assessment.measures.iter();
        cells.extend(measures.map(|(_, all)| number(all.get(i).copied().flatten(), &measure)));
        cells.extend(reported.iter().map(|q| number(row.result(q.name), &|x| units.readable(x, q.unit))));
        cells.push(number(row.iterations.map(|n| n as f64), &|n| format!("{n}")));
        let ran = (row.status == Status::Done).then_some(row.cost.solve_s);
        cells.push(number(ran, &|s| format!("{:.2} ms", 1e3 * s)));
        cells
    });
    let lead = "Each point is a run folder of its own under points/; all of its results are in points.csv.";
    Section::Table { heading: "Points", lead: lead.into(), rows: cells.collect(), head: heads }
}

/// Three digits, or a whole number as it is.
fn measure(x: f64) -> String {
    if x.fract() == 0.0 && x.abs() < 1e15 { format!("{x}") } else { significant(x, 3) }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}
