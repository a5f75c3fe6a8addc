//! Maps of a plane as PNG: a velocity in colours with lines and arrows on it, panels side by side over one scale.

use std::path::Path;

use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea};

use super::PlotError;
use super::axis::{Ruler, caption};
use super::canvas::{Align, Canvas, LINE_HEIGHT, Medium, Stroke};
use super::grains::shade;
use super::png::{FINER, WIDTH, averaged};
use super::theme::{self, BOLD, HAIR, LABEL, Role, SMALL};
use crate::result::{Axis, Dash};

/// Panels side by side, with one scale of colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// from left to right
    pub panels: Vec<MapPanel>,
    /// what the colours mean, from 0 to the largest value
    pub colours: Axis,
}

/// One panel; both axes have the same scale.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPanel {
    /// above the panel
    pub title: String,
    /// the horizontal axis with its ends
    pub x: Axis,
    /// the vertical axis with its ends
    pub y: Axis,
    /// triangles with a value in each corner
    pub triangles: Vec<[Corner; 3]>,
    /// lines on them
    pub trails: Vec<Trail>,
    /// from where to where
    pub arrows: Vec<(Place, Place)>,
}

/// A place in the units of the axes.
pub type Place = (f64, f64);

/// A place and its value.
pub type Corner = (Place, f64);

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    /// in the units of the axes
    pub points: Vec<Place>,
    /// its dash
    pub dash: Dash,
    /// whether it is drawn boldly
    pub bold: bool,
}

/// Margins around a panel in units of the figure.
struct Margins {
    left: f64,
    right: f64,
    above: f64,
    below: f64,
}

const MARGINS: Margins = Margins { left: 62.0, right: 16.0, above: 30.0, below: 50.0 };
/// Height of all panels, and room for the scale of colours under them.
const HEIGHT: f64 = 300.0;
const SCALE: f64 = 52.0;

/// Writes a map as a PNG file 1600 pixels wide.
///
/// # Errors
/// As [`super::png()`].
pub fn map_png(map: &Map, path: &Path) -> Result<(), PlotError> {
    let widths: Vec<f64> = map.panels.iter().map(|p| HEIGHT * span(&p.x) / span(&p.y)).collect();
    let width = widths.iter().map(|w| MARGINS.left + w + MARGINS.right).sum::<f64>();
    let whole = MARGINS.above + HEIGHT + MARGINS.below + SCALE;
    let size = (WIDTH, (f64::from(WIDTH) * whole / width).ceil() as u32);
    let scale = f64::from(WIDTH * FINER) / width;
    let fine_size = (size.0 * FINER, size.1 * FINER);
    let mut fine = vec![255; 3 * fine_size.0 as usize * fine_size.1 as usize];
    let corners = map.panels.iter().flat_map(|p| &p.triangles).flatten();
    let most = corners.map(|c| c.1).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let share = |value: f64| if most > 0.0 { value / most } else { 0.0 };
    let mut left = MARGINS.left;
    let mut frames = Vec::new();
    for (panel, width) in map.panels.iter().zip(&widths) {
        let frame = Frame::new(panel, left, *width);
        for triangle in &panel.triangles {
            let at = triangle.map(|((x, y), value)| ((frame.x.at(x) * scale, frame.y.at(y) * scale), share(value)));
            paint(&mut fine, fine_size.0 as usize, &at);
        }
        frames.push(frame);
        left += width + MARGINS.right + MARGINS.left;
    }
    {
        let area = BitMapBackend::with_buffer(&mut fine, fine_size).into_drawing_area();
        let medium = Medium { scale, ascent: LINE_HEIGHT / 2.0, dashes_later: false, paint: theme::light };
        let canvas = Canvas { area: &area, medium };
        for (panel, frame) in map.panels.iter().zip(&frames) {
            frame.draw(panel, &canvas)?;
        }
        draw_scale(&canvas, map, most, width)?;
        area.present().map_err(PlotError::drawing)?;
    }
    let bar = |k: usize| (MARGINS.left + 3.0 * k as f64, MARGINS.left + 3.0 * (k + 1) as f64);
    for k in 0..BARS {
        let ((a, b), (top, bottom)) = (bar(k), (whole - SCALE + 10.0, whole - SCALE + 20.0));
        let share = k as f64 / (BARS - 1) as f64;
        let corner = |x: f64, y: f64| ((x * scale, y * scale), share);
        paint(&mut fine, fine_size.0 as usize, &[corner(a, top), corner(b, top), corner(b, bottom)]);
        paint(&mut fine, fine_size.0 as usize, &[corner(a, top), corner(b, bottom), corner(a, bottom)]);
    }
    let small = averaged(&fine, fine_size.0 as usize, FINER as usize);
    let failed = |message: String| PlotError::Write { path: path.into(), message };
    let mut file = BitMapBackend::new(path, size);
    file.blit_bitmap((0, 0), size, &small).map_err(|e| failed(e.to_string()))?;
    file.present().map_err(|e| failed(e.to_string()))
}

/// Steps of the scale of colours.
const BARS: usize = 64;

fn span(axis: &Axis) -> f64 {
    axis.ends.map_or(1.0, |(a, b)| b - a)
}

/// Title and numbers of the scale of colours; its colours are painted afterwards.
fn draw_scale<DB: DrawingBackend>(canvas: &Canvas<'_, DB>, map: &Map, most: f64, width: f64) -> Result<(), PlotError> {
    let top = MARGINS.above + HEIGHT + MARGINS.below + 10.0;
    let ends = (MARGINS.left, MARGINS.left + 3.0 * BARS as f64);
    let ruler = Ruler::new(&Axis { ends: Some((0.0, most)), ..map.colours.clone() }, [0.0, most].into_iter(), ends, 5);
    for tick in ruler.ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let x = ruler.at(tick.at);
        canvas.line(&[(x, top + 10.0), (x, top + 14.0)], FRAME)?;
        canvas.text(&tick.label, (x, top + 26.0), SMALL, Align::Centre, Role::Ink)?;
    }
    let title = caption(&map.colours, ruler.exponent);
    let room = width - ends.1 - 12.0;
    let fits = super::canvas::width(&title, LABEL)? < room;
    let size = if fits { LABEL } else { SMALL };
    canvas.text(&title, (ends.1 + 12.0, top + 10.0), size, Align::Left, Role::Ink)
}

const FRAME: Stroke = Stroke { role: Role::Ink, width: HAIR, dash: Dash::Solid };

/// A panel on the paper.
struct Frame {
    x: Ruler,
    y: Ruler,
}

/// An axis of a plane, which ends where the plane does: no head room.
pub(super) fn plane_ruler(axis: &Axis, place: (f64, f64), labels: usize) -> Ruler {
    let ends = axis.ends.unwrap_or((0.0, 1.0));
    let mut ruler = Ruler::new(axis, [ends.0, ends.1].into_iter(), place, labels);
    ruler.limits = ends;
    ruler.ticks.retain(|tick| tick.at >= ends.0 && tick.at <= ends.1);
    ruler
}

impl Frame {
    fn new(panel: &MapPanel, left: f64, width: f64) -> Self {
        Self {
            x: plane_ruler(&panel.x, (left, left + width), 6),
            y: plane_ruler(&panel.y, (MARGINS.above + HEIGHT, MARGINS.above), 7),
        }
    }

    fn draw<DB: DrawingBackend>(&self, panel: &MapPanel, canvas: &Canvas<'_, DB>) -> Result<(), PlotError> {
        let at = |(x, y): Place| (self.x.at(x), self.y.at(y));
        for trail in &panel.trails {
            let line: Vec<Place> = trail.points.iter().map(|p| at(*p)).collect();
            // Light on dark and dark on light.
            if trail.bold {
                canvas.line(&line, Stroke { role: Role::Ink, width: 2.2 * BOLD, dash: trail.dash })?;
            }
            let width = if trail.bold { BOLD } else { HAIR };
            canvas.line(&line, Stroke { role: Role::Paper, width, dash: trail.dash })?;
        }
        for (from, to) in &panel.arrows {
            arrow(canvas, at(*from), at(*to))?;
        }
        let ((left, right), (bottom, top)) = (self.x.span, self.y.span);
        for tick in self.x.ticks.iter().filter(|tick| !tick.label.is_empty()) {
            let x = self.x.at(tick.at);
            canvas.line(&[(x, bottom), (x, bottom + 4.0)], FRAME)?;
            canvas.text(&tick.label, (x, bottom + 17.0), SMALL, Align::Centre, Role::Ink)?;
        }
        for tick in self.y.ticks.iter().filter(|tick| !tick.label.is_empty()) {
            let y = self.y.at(tick.at);
            canvas.line(&[(left - 4.0, y), (left, y)], FRAME)?;
            canvas.text(&tick.label, (left - 8.0, y + 0.36 * SMALL), SMALL, Align::Right, Role::Ink)?;
        }
        let half = HAIR / 2.0;
        canvas.line(&[(left - half, top), (right, top), (right, bottom), (left, bottom), (left, top + half)], FRAME)?;
        let (centre, middle) = ((left + right) / 2.0, (bottom + top) / 2.0);
        canvas.text(&caption(&panel.x, self.x.exponent), (centre, bottom + 36.0), LABEL, Align::Centre, Role::Ink)?;
        canvas.text(&caption(&panel.y, self.y.exponent), (left - 40.0, middle), LABEL, Align::Upward, Role::Ink)?;
        canvas.text(&panel.title, (left, top - 9.0), LABEL, Align::Left, Role::Ink)
    }
}

/// An arrow whose head is a third of its length.
fn arrow<DB: DrawingBackend>(canvas: &Canvas<'_, DB>, from: Place, to: Place) -> Result<(), PlotError> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if dx.hypot(dy) < 1.0 {
        return Ok(());
    }
    let stroke = Stroke { role: Role::Ink, width: HAIR, dash: Dash::Solid };
    let side = |s: f64| (to.0 - 0.3 * dx - s * 0.15 * dy, to.1 - 0.3 * dy + s * 0.15 * dx);
    canvas.line(&[from, to], stroke)?;
    canvas.line(&[side(1.0), to, side(-1.0)], stroke)
}

/// Fills a triangle with the colours of the shares in its corners, on an image `width` pixels wide of three bytes each.
fn paint(image: &mut [u8], width: usize, triangle: &[Corner; 3]) {
    let [((ax, ay), a), ((bx, by), b), ((cx, cy), c)] = *triangle;
    let area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    let (low, high) = (ay.min(by).min(cy).floor().max(0.0), ay.max(by).max(cy).ceil());
    let (left, right) = (ax.min(bx).min(cx).floor().max(0.0), ax.max(bx).max(cx).ceil());
    if area == 0.0 || !area.is_finite() {
        return;
    }
    // Neighbours overlap by a hair, so that nothing shines through between them.
    const HAIRLINE: f64 = -1e-3;
    for y in low as usize..(high as usize).min(image.len() / (3 * width)) {
        for x in left as usize..(right as usize).min(width) {
            let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
            let s = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) / area;
            let t = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / area;
            if s >= HAIRLINE && t >= HAIRLINE && s + t <= 1.0 - HAIRLINE {
                let at = 3 * (y * width + x);
                image[at..at + 3].copy_from_slice(&shade(a + s * (b - a) + t * (c - a)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_fill_a_square_without_a_gap() {
        let mut image = vec![7; 3 * 20 * 20];
        let corner = |x: f64, y: f64| ((x, y), 0.5);
        let [a, b, c, d] = [corner(2.0, 3.0), corner(17.3, 3.4), corner(16.0, 15.0), corner(2.5, 15.5)];
        paint(&mut image, 20, &[a, b, c]);
        paint(&mut image, 20, &[a, c, d]);
        for y in 4..14 {
            for x in 4..15 {
                assert_eq!(image[3 * (20 * y + x)..][..3], shade(0.5), "{x} {y}");
            }
        }
        assert_eq!(image[..3], [7, 7, 7]);
    }
}
