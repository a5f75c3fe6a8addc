//! Strokes, areas and text on a plotters backend, in units of the figure.

use std::sync::OnceLock;

use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle, register_font,
};

use super::PlotError;
use super::theme::{self, BOLD, Part, Role};
use crate::result::{Dash, Marker};

/// What differs between a vector and a bitmap backend.
#[derive(Clone, Copy)]
pub(super) struct Medium {
    /// backend pixels per unit of the figure
    pub scale: f64,
    /// distance from the top anchor of a text to its base line, over the size of the text
    pub ascent: f64,
    /// whether dashes are drawn by whoever shows the result
    pub dashes_later: bool,
    /// colour of a role
    pub paint: fn(Role, Dash) -> RGBColor,
}

/// A line: what it is for, how wide, with what pattern.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub role: Role,
    pub width: f64,
    pub dash: Dash,
}

/// Where a text stands on its anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
    /// centred, read from below
    Upward,
}

/// A drawing area with its medium.
pub(super) struct Canvas<'a, DB: DrawingBackend> {
    pub area: &'a DrawingArea<DB, Shift>,
    pub medium: Medium,
}

type Point = (f64, f64);

impl<DB: DrawingBackend> Canvas<'_, DB> {
    /// Begins a part of the drawing that a page finds again; a bitmap has no parts.
    pub fn open(&self, part: Part, panel: usize, curve: usize) -> Result<(), PlotError> {
        self.bracket(theme::opening(part, panel, curve))
    }

    /// Ends it.
    pub fn close(&self) -> Result<(), PlotError> {
        self.bracket(theme::CLOSING)
    }

    fn bracket(&self, colour: RGBColor) -> Result<(), PlotError> {
        if !self.medium.dashes_later {
            return Ok(());
        }
        self.area.draw_pixel((0, 0), &colour).map_err(PlotError::drawing)
    }

    /// A line through `points`.
    pub fn line(&self, points: &[Point], stroke: Stroke) -> Result<(), PlotError> {
        let scale = self.medium.scale;
        let grid = simplified(&points.iter().map(|p| (p.0 * scale, p.1 * scale)).collect::<Vec<_>>(), 0.04 * scale);
        let style = self.style(stroke.role, stroke.dash).stroke_width((stroke.width * scale).round().max(1.0) as u32);
        let pattern = if self.medium.dashes_later { &[] } else { theme::pattern(stroke.dash) };
        for piece in dashes(&grid, pattern, scale).iter().flat_map(|stroke| without_spikes(stroke)) {
            let piece = piece.iter().map(|&p| rounded(p)).collect::<Vec<_>>();
            self.area.draw(&PathElement::new(piece, style)).map_err(PlotError::drawing)?;
        }
        Ok(())
    }

    /// A filled rectangle between two corners, the upper left one first.
    pub fn fill(&self, from: Point, to: Point, role: Role) -> Result<(), PlotError> {
        let corners = [self.point(from), self.point(to)];
        self.area.draw(&Rectangle::new(corners, self.style(role, Dash::Solid).filled())).map_err(PlotError::drawing)
    }

    /// An open symbol of the size of a small letter: one in its colour and a smaller one in that of the paper.
    pub fn marker(&self, at: Point, marker: Marker, role: Role) -> Result<(), PlotError> {
        const RADIUS: f64 = 3.4;
        const INNER: f64 = 2.1;
        if marker == Marker::Cross {
            let stroke = Stroke { role, width: BOLD, dash: Dash::Solid };
            for slope in [-1.0, 1.0] {
                self.line(&[(at.0 - RADIUS, at.1 - slope * RADIUS), (at.0 + RADIUS, at.1 + slope * RADIUS)], stroke)?;
            }
            return Ok(());
        }
        for (radius, role) in [(RADIUS, role), (INNER, Role::Paper)] {
            let style = self.style(role, Dash::Solid).filled();
            let corners: &[Point] = match marker {
                Marker::Circle => {
                    let circle = Circle::new(self.point(at), (radius * self.medium.scale).round() as i32, style);
                    self.area.draw(&circle).map_err(PlotError::drawing)?;
                    continue;
                }
                Marker::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
                // Drawn above.
                Marker::Cross => continue,
                Marker::Triangle => &[(0.0, -1.3), (1.15, 0.75), (-1.15, 0.75)],
            };
            let around = corners.iter().map(|c| self.point((at.0 + radius * c.0, at.1 + radius * c.1)));
            self.area.draw(&Polygon::new(around.collect::<Vec<_>>(), style)).map_err(PlotError::drawing)?;
        }
        Ok(())
    }

    /// A line of text whose base line passes through `at`.
    pub fn text(&self, text: &str, at: Point, size: f64, align: Align, role: Role) -> Result<(), PlotError> {
        let size = size * self.medium.scale;
        let (x, y) = (at.0 * self.medium.scale, at.1 * self.medium.scale);
        let ascent = self.medium.ascent * size;
        let (h, transform) = match align {
            Align::Left => (HPos::Left, FontTransform::None),
            Align::Centre => (HPos::Center, FontTransform::None),
            Align::Right => (HPos::Right, FontTransform::None),
            Align::Upward => (HPos::Center, FontTransform::Rotate270),
        };
        let top = if align == Align::Upward { (x - ascent, y) } else { (x, y - ascent) };
        let colour = (self.medium.paint)(role, Dash::Solid);
        let style = TextStyle::from(font(size)?).color(&colour).transform(transform).pos(Pos::new(h, VPos::Top));
        let text = if self.medium.dashes_later { text.to_owned() } else { drawable(text) };
        self.area.draw_text(&text, &style, rounded(top)).map_err(PlotError::drawing)
    }

    fn point(&self, p: Point) -> (i32, i32) {
        rounded((p.0 * self.medium.scale, p.1 * self.medium.scale))
    }

    fn style(&self, role: Role, dash: Dash) -> ShapeStyle {
        ShapeStyle::from(&(self.medium.paint)(role, dash).to_rgba())
    }
}

fn rounded(p: Point) -> (i32, i32) {
    (p.0.round() as i32, p.1.round() as i32)
}

/// Height of the font's line over its em, which is the size that plotters asks for.
pub(super) const LINE_HEIGHT: f64 = 1.362;

const FAMILY: &str = "bedload";
static NOTO_SANS: &[u8] = include_bytes!("NotoSans-subset.ttf");

/// The embedded font with an em of `size` backend pixels.
fn font(size: f64) -> Result<FontDesc<'static>, PlotError> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    if *REGISTERED.get_or_init(|| register_font(FAMILY, FontStyle::Normal, NOTO_SANS).is_ok()) {
        Ok(FontDesc::new(FontFamily::Name(FAMILY), size * LINE_HEIGHT, FontStyle::Normal))
    } else {
        Err(PlotError::Font)
    }
}

/// The text with signs that the embedded font has: its minus is the en dash.
fn drawable(text: &str) -> String {
    text.replace('\u{2212}', "\u{2013}")
}

/// Width of a text whose em is `size`, in the same unit.
///
/// # Errors
/// [`PlotError::Font`] if the embedded font cannot be read.
pub(super) fn width(text: &str, size: f64) -> Result<f64, PlotError> {
    const FINE: f64 = 1000.0;
    let ((left, _), (right, _)) = font(FINE)?.layout_box(&drawable(text)).map_err(|_| PlotError::Font)?;
    Ok(f64::from(right - left) * size / FINE)
}

fn simplified(points: &[Point], tolerance: f64) -> Vec<Point> {
    points.iter().zip(kept(points, tolerance)).filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

/// Which points a line needs to stay within `tolerance` of all of them (Douglas and Peucker 1973).
pub(super) fn kept(points: &[Point], tolerance: f64) -> Vec<bool> {
    let mut keep = vec![false; points.len()];
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((from, to)) = open.pop() {
        let (Some(&a), Some(&b)) = (points.get(from), points.get(to)) else { continue };
        keep[from] = true;
        keep[to] = true;
        let inner = points.iter().enumerate().take(to).skip(from + 1).map(|(i, &p)| (i, distance(p, a, b)));
        if let Some((split, far)) = inner.max_by(|p, q| p.1.total_cmp(&q.1))
            && far > tolerance
        {
            open.extend([(from, split), (split, to)]);
        }
    }
    keep
}

/// Distance of `p` from the segment between `a` and `b`.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let square = dx * dx + dy * dy;
    let share = if square > 0.0 { (((p.0 - a.0) * dx + (p.1 - a.1) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p.0 - a.0 - share * dx).hypot(p.1 - a.1 - share * dy)
}

/// Cuts a line into strokes by their length along it; an empty pattern leaves it whole.
fn dashes(points: &[Point], pattern: &[f64], scale: f64) -> Vec<Vec<Point>> {
    let Some((&first, rest)) = points.split_first() else { return Vec::new() };
    let mut lengths = pattern.iter().map(|l| l * scale).cycle();
    let mut left = lengths.next().unwrap_or(f64::INFINITY);
    let (mut on, mut here) = (true, first);
    let mut strokes = vec![vec![first]];
    for &next in rest {
        loop {
            let length = (next.0 - here.0).hypot(next.1 - here.1);
            if length <= left {
                left -= length;
                break;
            }
            here = (here.0 + (next.0 - here.0) * left / length, here.1 + (next.1 - here.1) * left / length);
            if let (true, Some(stroke)) = (on, strokes.last_mut()) {
                stroke.push(here);
            } else {
                strokes.push(vec![here]);
            }
            on = !on;
            left = lengths.next().unwrap_or(f64::INFINITY);
        }
        here = next;
        if let (true, Some(stroke)) = (on, strokes.last_mut()) {
            stroke.push(next);
        }
    }
    strokes
}

/// A line cut where it turns back: the join of a bitmap backend would reach far beyond such a corner.
fn without_spikes(points: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces = vec![Vec::new()];
    for (i, &point) in points.iter().enumerate() {
        let sharp = i.checked_sub(1).and_then(|before| Some((points[before], *points.get(i + 1)?))).is_some_and(
            |(before, after)| {
                let (a, b) = ((point.0 - before.0, point.1 - before.1), (after.0 - point.0, after.1 - point.1));
                a.0 * b.0 + a.1 * b.1 < 0.0
            },
        );
        pieces.iter_mut().rev().take(1).for_each(|piece| piece.push(point));
        if sharp {
            pieces.push(vec![point]);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_needs_two_points_and_a_corner_one_more() {
        let corner: Vec<Point> = (0..=100).map(|i| (f64::from(i.min(50)), f64::from(i.max(50)))).collect();
        assert_eq!(simplified(&corner, 0.1), [(0.0, 50.0), (50.0, 50.0), (50.0, 100.0)]);
        assert_eq!(simplified(&[(1.0, 2.0)], 0.1), [(1.0, 2.0)]);
        assert!(simplified(&[], 0.1).is_empty());
    }

    #[test]
    fn dashes_keep_to_their_pattern_around_corners() {
        let strokes = dashes(&[(0.0, 0.0), (3.0, 0.0), (3.0, 7.0)], &[4.0, 2.0], 1.0);
        assert_eq!(strokes, [vec![(0.0, 0.0), (3.0, 0.0), (3.0, 1.0)], vec![(3.0, 3.0), (3.0, 7.0)]]);
        assert_eq!(dashes(&[(0.0, 0.0), (9.0, 0.0)], &[], 1.0), [[(0.0, 0.0), (9.0, 0.0)]]);
    }

    #[test]
    fn a_line_that_turns_back_is_cut_and_a_right_angle_is_not() {
        let there = [(0.0, 0.0), (10.0, 0.0), (1.0, 1.0), (1.0, 9.0)];
        assert_eq!(without_spikes(&there), [&there[..2], &there[1..]]);
        let corner = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)];
        assert_eq!(without_spikes(&corner), [corner]);
    }

    #[test]
    fn the_embedded_font_has_the_signs_of_the_axes() {
        let blank = width("\u{4e2d}", 100.0).unwrap();
        for sign in "\u{3c6}\u{3b8}\u{3c4}\u{3bd}\u{b5}\u{b2}\u{207b}\u{2078}\u{2212}\u{d7}\u{209a}".chars() {
            assert_ne!(width(&sign.to_string(), 100.0).unwrap(), blank, "{sign}");
        }
        let whole = width("velocity (mm/s)", 13.0).unwrap();
        assert!((70.0..110.0).contains(&whole), "{whole}");
    }
}
