//! Draws a laid-out figure on any plotters backend.

use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::prelude::DrawingBackend;

use super::PlotError;
use super::canvas::{Canvas, Medium, Stroke};
use super::labels::texts;
use super::layout::{Frame, Layout};
use super::legend::{self, ROW, SAMPLE};
use super::theme::{BOLD, HAIR, Part, Role};
use crate::result::{Curve, Dash, Figure, Panel};

const TICK: f64 = 5.0;
const MINOR_TICK: f64 = 2.8;
const BARS_APART: f64 = 9.0;
const FRAME: Stroke = Stroke { role: Role::Ink, width: HAIR, dash: Dash::Solid };
const LEVEL: Stroke = Stroke { role: Role::Faint, width: HAIR, dash: Dash::Dashed };

/// Draws `figure` as `layout` says.
pub(super) fn draw<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    medium: Medium,
    figure: &Figure,
    layout: &Layout,
) -> Result<(), PlotError> {
    let canvas = Canvas { area, medium };
    for (i, (panel, frame)) in figure.panels.iter().zip(&layout.frames).enumerate() {
        tint(&canvas, figure, layout, frame)?;
        for level in figure.levels.iter().filter(|l| layout.y.holds(l.y)) {
            let y = layout.y.at(level.y);
            canvas.line(&[(frame.x.span.0, y), (frame.x.span.1, y)], LEVEL)?;
        }
        axes(&canvas, layout, frame)?;
        // A curve of words alone is no curve: its words are written with the other texts.
        for (c, curve) in panel.curves.iter().enumerate().filter(|(_, curve)| curve.text.is_empty()) {
            canvas.open(Part::Curve, i, c)?;
            draw_curve(&canvas, figure, panel, curve, (layout, frame))?;
            canvas.close()?;
        }
        draw_legend(&canvas, (figure, panel), i, frame)?;
    }
    for text in texts(figure, layout) {
        canvas.text(&text.text, text.at, text.size, text.align, text.role)?;
    }
    Ok(())
}

fn tint<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    figure: &Figure,
    layout: &Layout,
    frame: &Frame,
) -> Result<(), PlotError> {
    let (low, high) = layout.y.limits;
    match figure.tint_below {
        Some(level) if level > low => {
            let top = layout.y.at(level.min(high));
            canvas.fill((frame.x.span.0, top), (frame.x.span.1, layout.y.span.0), Role::Tint)
        }
        _ => Ok(()),
    }
}

/// Frame, and ticks inside on all four sides.
fn axes<DB: DrawingBackend>(canvas: &Canvas<'_, DB>, layout: &Layout, frame: &Frame) -> Result<(), PlotError> {
    let (left, right) = frame.x.span;
    let (bottom, top) = layout.y.span;
    for tick in &frame.x.ticks {
        let (x, length) = (frame.x.at(tick.at), if tick.label.is_empty() { MINOR_TICK } else { TICK });
        if x > left + 1.0 && x < right - 1.0 {
            canvas.line(&[(x, bottom), (x, bottom - length)], FRAME)?;
            canvas.line(&[(x, top), (x, top + length)], FRAME)?;
        }
    }
    for tick in &layout.y.ticks {
        let (y, length) = (layout.y.at(tick.at), if tick.label.is_empty() { MINOR_TICK } else { TICK });
        if y < bottom - 1.0 && y > top + 1.0 {
            canvas.line(&[(left, y), (left + length, y)], FRAME)?;
            canvas.line(&[(right, y), (right - length, y)], FRAME)?;
        }
    }
    // the ends meet without overlap: a bitmap backend would leave out what a line covers twice
    let half = HAIR / 2.0;
    canvas.line(&[(left - half, top), (right, top), (right, bottom), (left, bottom), (left, top + half)], FRAME)
}

fn draw_curve<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    figure: &Figure,
    panel: &Panel,
    curve: &Curve,
    (layout, frame): (&Layout, &Frame),
) -> Result<(), PlotError> {
    let role = Role::Series(curve.colour);
    for piece in figure.pieces(panel, curve) {
        let line: Vec<(f64, f64)> = piece.iter().map(|&(x, y)| (frame.x.at(x), layout.y.at(y))).collect();
        match (curve.line, line.as_slice()) {
            // a lone point would be an invisible line
            (Some(_), &[(x, y)]) => {
                canvas.line(&[(x - 2.0, y), (x + 2.0, y)], Stroke { role, width: BOLD, dash: Dash::Solid })?;
            }
            (Some(dash), points) => canvas.line(points, Stroke { role, width: BOLD, dash })?,
            (None, _) => {}
        }
        if let Some(marker) = curve.marker {
            for &at in &line {
                canvas.marker(at, marker, role)?;
            }
        }
    }
    error_bars(canvas, curve, panel, figure, (layout, frame))
}

/// Bars of one standard error to either side, so far apart that they can be told from each other.
fn error_bars<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    curve: &Curve,
    panel: &Panel,
    figure: &Figure,
    (layout, frame): (&Layout, &Frame),
) -> Result<(), PlotError> {
    let (role, dash) = (Role::Series(curve.colour), Dash::Solid);
    let (left, right) = frame.x.span;
    let mut last = f64::INFINITY;
    for (point, error) in curve.points.iter().zip(&curve.errors) {
        let (Some((x, y)), Some(error)) = (*point, *error) else { continue };
        if !(panel.x.holds(x - error) && panel.x.holds(x + error) && figure.y.holds(y)) {
            continue;
        }
        let ends = [x - error, x + error].map(|x| frame.x.at(x).clamp(left, right));
        let y = layout.y.at(y);
        if (curve.marker.is_none() && (y - last).abs() < BARS_APART) || ends[1] - ends[0] < HAIR {
            continue;
        }
        last = y;
        canvas.line(&[(ends[0], y), (ends[1], y)], Stroke { role, width: HAIR, dash })?;
        for x in ends {
            canvas.line(&[(x, y - 2.0), (x, y + 2.0)], Stroke { role, width: HAIR, dash })?;
        }
    }
    Ok(())
}

fn draw_legend<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    (figure, panel): (&Figure, &Panel),
    i: usize,
    frame: &Frame,
) -> Result<(), PlotError> {
    let Some((left, top)) = frame.legend else { return Ok(()) };
    for (row, (c, curve)) in legend::named(figure, panel).enumerate() {
        canvas.open(Part::Key, i, c)?;
        let (role, middle) = (Role::Series(curve.colour), top + ROW * (row as f64 + 0.5));
        if let Some(dash) = curve.line {
            canvas.line(&[(left, middle), (left + SAMPLE, middle)], Stroke { role, width: BOLD, dash })?;
        }
        if let Some(marker) = curve.marker {
            canvas.marker((left + SAMPLE / 2.0, middle), marker, role)?;
        }
        let entry = legend::entry(&curve.name, (left, top), row);
        canvas.text(&entry.text, entry.at, entry.size, entry.align, entry.role)?;
        canvas.close()?;
    }
    Ok(())
}
