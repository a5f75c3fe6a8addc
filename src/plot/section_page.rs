//! The map of a section as it stands on a page: SVG with axes and a scale of its colours, in the ink of the page.

use std::fmt::Write;

use super::axis::caption;
use super::grains::colour;
use super::map::plane_ruler;
use super::section::Grid;
use super::svg::escape;
use crate::result::{Axis, Field};
use crate::units::readable_unit;

/// Width or height of the plane, whichever is larger \[px].
const SIZE: f64 = 560.0;
/// Margins of the drawing around the plane \[px], and the height of the scale of colours under it.
const LEFT: f64 = 62.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 12.0;
const BELOW: f64 = 52.0;
const SCALE: f64 = 46.0;
/// Smallest share of its size to which a page shrinks the drawing: its letters stay legible.
const SMALLEST: f64 = 0.72;

/// The map of a field with u_mixture_m_s or speed_m_s, and unyielded, with its axes and the scale of its colours; `symmetric` adds the
/// other half of the section, `bed` \[m] draws a level. None if there is nothing to draw.
#[must_use]
pub fn section_svg(field: &Field, symmetric: bool, bed: Option<f64>) -> Option<String> {
    let grid = Grid::of(field)?;
    let high = |of: &dyn Fn(&(f64, f64)) -> f64| grid.places.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (right, top) = (high(&|p| p.0), high(&|p| p.1));
    let left = if symmetric { -right } else { 0.0 };
    let fast = grid.speed.iter().copied().fold(0.0, f64::max);
    if !(right > left && top > 0.0 && fast.is_finite()) {
        return None;
    }
    let scale = SIZE / (right - left).max(top);
    let (width, height) = (scale * (right - left), scale * top);
    let whole = (LEFT + width.max(SIZE / 2.0) + RIGHT, TOP + height + BELOW + SCALE);
    let sides: &[f64] = if symmetric { &[1.0, -1.0] } else { &[1.0] };
    let mut svg = format!(
        "<svg class=\"map\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.1} {:.1}\" \
         style=\"min-width:{:.0}px;max-width:{:.0}px\" role=\"img\" \
         aria-label=\"velocity in the section, with the outline of what does not yield\">\n",
        whole.0,
        whole.1,
        SMALLEST * whole.0,
        whole.0
    );
    let at = |side: f64, p: (f64, f64)| (LEFT + scale * (side * p.0 - left), TOP + scale * (top - p.1));
    svg += "<g shape-rendering=\"crispEdges\">\n";
    for (corners, speed) in grid.tiles() {
        for side in sides {
            let points: Vec<String> =
                corners.iter().map(|p| at(*side, *p)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            let fill = colour(if fast > 0.0 { speed / fast } else { 0.0 });
            let _ = writeln!(svg, "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{fill}\"/>", points.join(" "));
        }
    }
    svg += "</g>\n";
    let mut outline = String::new();
    for (a, b) in grid.outline() {
        for side in sides {
            let ((x0, y0), (x1, y1)) = (at(*side, a), at(*side, b));
            let _ = write!(outline, "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}");
        }
    }
    let _ = writeln!(svg, "<path d=\"{outline}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"2\"/>");
    if let Some(level) = bed {
        let y = at(1.0, (0.0, level)).1;
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {y:.1}h{width:.1}\" stroke=\"#e0e0e0\" stroke-width=\"1\" stroke-dasharray=\"6 4\"/>"
        );
    }
    let (factor, unit) = readable_unit((right - left).max(top), "m");
    let axis = |name: &str, ends: (f64, f64)| Axis {
        ends: Some((factor * ends.0, factor * ends.1)),
        ..Axis::linear(name, unit)
    };
    svg += &across(&axis("y", (left, right)), (LEFT, LEFT + width), TOP + height);
    svg += &up(&axis("z", (0.0, top)), (TOP + height, TOP), LEFT);
    let _ = writeln!(
        svg,
        "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"currentColor\"/>"
    );
    svg += &colours(fast, (LEFT, TOP + height + BELOW));
    Some(svg + "</svg>\n")
}

/// Sizes of numbers and of titles \[px].
const SMALL: f64 = 12.0;
const LABEL: f64 = 13.5;

fn text(at: (f64, f64), size: f64, more: &str, words: &str) -> String {
    format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{size}\" fill=\"currentColor\"{more}>{}</text>\n",
        at.0,
        at.1,
        escape(words)
    )
}

const MIDDLE: &str = " text-anchor=\"middle\"";

/// A labelled mark for every 80 pixels or so.
fn marks(span: f64) -> usize {
    (span.abs() / 80.0).round().clamp(2.0, 7.0) as usize
}

fn across(axis: &Axis, span: (f64, f64), y: f64) -> String {
    let ruler = plane_ruler(axis, span, marks(span.1 - span.0));
    let mut svg = String::new();
    for tick in ruler.ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let x = ruler.at(tick.at);
        svg += &format!("<path d=\"M{x:.1} {y:.1}v5\" stroke=\"currentColor\"/>");
        svg += &text((x, y + 18.0), SMALL, MIDDLE, &tick.label);
    }
    svg + &text(((span.0 + span.1) / 2.0, y + 38.0), LABEL, MIDDLE, &caption(axis, ruler.exponent))
}

fn up(axis: &Axis, span: (f64, f64), x: f64) -> String {
    let ruler = plane_ruler(axis, span, marks(span.1 - span.0));
    let mut svg = String::new();
    for tick in ruler.ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let y = ruler.at(tick.at);
        svg += &format!("<path d=\"M{x:.1} {y:.1}h-5\" stroke=\"currentColor\"/>");
        svg += &text((x - 8.0, y + 0.36 * SMALL), SMALL, " text-anchor=\"end\"", &tick.label);
    }
    let (x, y) = (x - 44.0, (span.0 + span.1) / 2.0);
    let turned = format!("{MIDDLE} transform=\"rotate(-90 {x:.1} {y:.1})\"");
    svg + &text((x, y), LABEL, &turned, &caption(axis, ruler.exponent))
}

/// The scale of colours from 0 to the largest velocity [m/s], with its numbers and what they are.
fn colours(fast: f64, (x, y): (f64, f64)) -> String {
    const STEPS: usize = 60;
    const LENGTH: f64 = 0.4 * SIZE;
    let (factor, unit) = readable_unit(fast, "m/s");
    let axis =
        Axis { ends: Some((0.0, if fast > 0.0 { factor * fast } else { 1.0 })), ..Axis::linear("velocity", unit) };
    let ruler = plane_ruler(&axis, (x, x + LENGTH), 4);
    let mut svg = String::new();
    for step in 0..STEPS {
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"10\" fill=\"{}\"/>",
            x + LENGTH * step as f64 / STEPS as f64,
            LENGTH / STEPS as f64 + 0.5,
            colour(step as f64 / (STEPS - 1) as f64)
        );
    }
    for tick in ruler.ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let at = ruler.at(tick.at);
        svg += &format!("<path d=\"M{at:.1} {:.1}v4\" stroke=\"currentColor\"/>", y + 10.0);
        svg += &text((at, y + 27.0), SMALL, MIDDLE, &tick.label);
    }
    svg + &text((x + LENGTH + 14.0, y + 10.0), LABEL, "", &caption(&axis, ruler.exponent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_of_both_halves_an_outline_and_nothing_from_nothing() {
        let mut table = String::from("column,row,y_m,z_m,u_mixture_m_s,unyielded\n");
        for j in 0..3 {
            for i in 0..3 {
                let _ = writeln!(table, "{i},{j},{i},{j},{},{}", i + j, u8::from(j == 0));
            }
        }
        let field = Field::read(table.as_bytes()).unwrap().unwrap();
        let svg = section_svg(&field, true, Some(1.0)).unwrap();
        assert_eq!(svg.matches("<polygon").count(), 8);
        for title in [">y (m)<", ">z (m)<", ">velocity (m/s)<"] {
            assert_eq!(svg.matches(title).count(), 1, "{title} in {svg}");
        }
        // Marks from -2 to 2 across, from 0 to 2.0 up, and of the velocities from 0 to 4 m/s.
        for (mark, times) in [(">\u{2212}2<", 1), (">0<", 3), (">2<", 2), (">2.0<", 1), (">4<", 1)] {
            assert_eq!(svg.matches(mark).count(), times, "{mark} in {svg}");
        }
        assert!(svg.contains("M") && svg.contains("stroke-dasharray"));
        let outline = Grid::of(&field).unwrap().outline();
        assert!(!outline.is_empty() && outline.iter().all(|(a, b)| a.1 == 0.5 && b.1 == 0.5), "{outline:?}");
        let again = Field::read(field.csv().as_bytes()).unwrap().unwrap();
        assert_eq!((again.across, again.up, again.csv()), (3, 3, field.csv()));
        assert!(Field::read("column,row,y_m,z_m\n".as_bytes()).unwrap().is_none());
    }
}
