//! What a page must know of a drawing to answer a pointer: where the panels are, what their axes measure, which curve is
//! which and where it goes, to more digits than a pixel has.

use std::fmt::Write as _;

use super::axis::Ruler;
use super::canvas::kept;
use super::layout::{Frame, Layout};
use super::svg::{GRID, escape};
use super::theme::Part;
use crate::result::{Axis, Curve, Figure, Panel, Scale};

/// A line without markers is given by the points that it needs to stay within this of all of them [units of the figure].
const TOLERANCE: f64 = 0.003;

/// One invisible rectangle a panel. Figures over the elevation are linked: they have `data-link` in common.
pub(super) fn panes(figure: &Figure, layout: &Layout) -> String {
    let mut out = String::new();
    for (panel, frame) in figure.panels.iter().zip(&layout.frames) {
        let ((left, right), (bottom, top)) = (frame.x.span, layout.y.span);
        let link = if figure.is_over_elevation() {
            format!(" data-link=\"{}\"", escape(&format!("{} {}", figure.y.title, figure.y.unit)))
        } else {
            String::new()
        };
        let _ = writeln!(
            out,
            "<rect class=\"pane\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\"{}{}{link}/>",
            GRID * left,
            GRID * top,
            GRID * (right - left),
            GRID * (bottom - top),
            axis("x", &panel.x, &frame.x),
            axis("y", &figure.y, &layout.y),
        );
    }
    out
}

/// The ends of an axis at those of the rectangle, how it divides its length, its title and its unit.
fn axis(name: &str, axis: &Axis, ruler: &Ruler) -> String {
    let (low, high) = ruler.limits;
    let scale = match axis.scale {
        Scale::Linear => "linear",
        Scale::Log => "log",
    };
    let unit = if axis.unit == "1" { "" } else { axis.unit.as_str() };
    let title = escape(&axis.title);
    format!(
        " data-{name}=\"{low:?} {high:?} {scale}\" data-{name}-title=\"{title}\" data-{name}-unit=\"{}\"",
        escape(unit)
    )
}

/// The opening tag of a part of a drawing; `key` is what the curves have in common that one entry of a legend names.
pub(super) fn open(part: Part, (p, c): (usize, usize), figure: &Figure, layout: &Layout) -> String {
    let (Some(panel), Some(frame)) = (figure.panels.get(p), layout.frames.get(p)) else { return "<g>".into() };
    let Some(curve) = panel.curves.get(c) else { return "<g>".into() };
    let home = home(figure, p);
    let key = format!("data-key=\"{home}.{c}\"");
    if part == Part::Key {
        return format!("<g class=\"key\" {key}>");
    }
    let named = figure.panels.get(home).and_then(|panel| panel.curves.get(c)).unwrap_or(curve);
    let marked = if curve.marker.is_some() { " data-marked=\"\"" } else { "" };
    format!(
        "<g class=\"curve\" data-panel=\"{p}\" {key} data-name=\"{}\" data-colour=\"{}\"{marked} data-points=\"{}\">",
        escape(&named.name),
        super::theme::series(curve.colour),
        points(figure, panel, curve, (frame, layout))
    )
}

/// The panel whose legend names the curves of panel `p`: the first one, where it has the same curves and `p` has no legend.
fn home(figure: &Figure, p: usize) -> usize {
    let look = |panel: &Panel| panel.curves.iter().map(|c| (c.colour, c.line, c.marker)).collect::<Vec<_>>();
    let same = match (figure.panels.first(), figure.panels.get(p)) {
        (Some(first), Some(panel)) => panel.curves.iter().all(|c| c.name.is_empty()) && look(first) == look(panel),
        _ => false,
    };
    if same && figure.panels.first().is_some_and(|first| first.curves.len() > 1) { 0 } else { p }
}

/// `x,y x,y;x,y` in the units of the axes, pieces apart.
fn points(figure: &Figure, panel: &Panel, curve: &Curve, (frame, layout): (&Frame, &Layout)) -> String {
    let mut out = String::new();
    for piece in figure.pieces(panel, curve) {
        let drawn: Vec<(f64, f64)> = piece.iter().map(|&(x, y)| (frame.x.at(x), layout.y.at(y))).collect();
        let keep = if curve.marker.is_some() { vec![true; piece.len()] } else { kept(&drawn, TOLERANCE) };
        for ((x, y), _) in piece.iter().zip(keep).filter(|(_, keep)| *keep) {
            let _ = write!(out, "{},{} ", number(*x), number(*y));
        }
        out.pop();
        out.push(';');
    }
    out.pop();
    out
}

/// Six digits, in as few characters as they take.
fn number(x: f64) -> String {
    let rounded = format!("{x:.5e}").parse::<f64>().unwrap_or(x);
    let text = format!("{rounded:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::super::{profile_figures, samples, several};
    use super::*;
    use crate::result::Dash;

    #[test]
    fn numbers_are_short_and_keep_six_digits() {
        let shown = [0.0, -12.0, 1.0 / 3.0, 1.234_567_89e-7, 123_456_789.0, 9.999_999_9e279].map(number);
        assert_eq!(shown, ["0", "-12", "0.333333", "1.23457e-7", "123457000", "1e280"]);
    }

    #[test]
    fn a_straight_line_is_its_ends_and_a_gap_makes_two_pieces() {
        let mut figure = samples::convergence();
        figure.y = Axis::linear("y", "m");
        figure.panels.truncate(1);
        figure.panels[0].x = Axis::linear("x", "m");
        let line = (0..=10).map(|i| (i != 5).then(|| (f64::from(i), 0.3 * f64::from(i))));
        figure.panels[0].curves = vec![Curve { points: line.collect(), line: Some(Dash::Solid), ..Curve::default() }];
        let layout = Layout::new(&figure).unwrap();
        let tag = open(Part::Curve, (0, 0), &figure, &layout);
        assert!(tag.contains("data-points=\"0,0 4,1.2;6,1.8 10,3\""), "{tag}");
        assert_eq!(
            panes(&figure, &layout).matches("data-x=\"0.0 10.5 linear\" data-x-title=\"x\" data-x-unit=\"m\"").count(),
            1
        );
        assert!(!panes(&figure, &layout).contains("data-link"));
    }

    #[test]
    fn one_entry_of_a_legend_names_the_curves_of_all_panels_that_have_none() {
        let (profile, summary) = samples::laminar_bed();
        let figure = &profile_figures(&profile, &summary)[0];
        let homes: Vec<usize> = (0..figure.panels.len()).map(|p| home(figure, p)).collect();
        assert_eq!(homes, (0..figure.panels.len()).collect::<Vec<_>>(), "each panel has its own curves");
        assert!(panes(figure, &Layout::new(figure).unwrap()).contains("data-link=\"elevation z mm\""));
        let trace = |name| several::Trace {
            name,
            profile: &profile,
            errors: None,
            measured: false,
            bed: None,
            phi_interface: None,
        };
        let shared = &several::shared_figures(&[trace("a"), trace("b")], None, None)[0];
        assert!(shared.panels.len() > 1 && (0..shared.panels.len()).all(|p| home(shared, p) == 0));
    }
}
