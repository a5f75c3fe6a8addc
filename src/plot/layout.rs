//! Where everything goes: frames side by side, room for labels and titles that do not touch, and for the legends.

use super::PlotError;
use super::axis::{self, Ruler};
use super::canvas::width;
use super::legend::{self, ROW, Stack};
use super::text::{LEADING, wrapped};
use super::theme::{LABEL, SMALL};
use crate::result::{Axis, Figure, Panel, Scale};

/// Positions in units of the figure: x to the right, y downward.
pub(super) struct Layout {
    /// size of the whole figure
    pub size: (f64, f64),
    /// the shared vertical axis; its span runs from the bottom of the frames to their top
    pub y: Ruler,
    /// one frame per panel
    pub frames: Vec<Frame>,
    /// title of the vertical axis, in lines from left to right
    pub title: Vec<String>,
    /// distance of its first line from the left edge
    pub title_x: f64,
    /// base lines of the labels of the levels, `None` where a level lies outside
    pub labels: Vec<Option<f64>>,
}

/// A panel's horizontal axis and its legend.
pub(super) struct Frame {
    /// the horizontal axis; its span runs from left to right
    pub x: Ruler,
    /// title of the horizontal axis, in lines
    pub title: Vec<String>,
    /// upper left corner of the legend, if it has one
    pub legend: Option<(f64, f64)>,
}

/// Space between neighbouring texts.
const APART: f64 = 6.0;
const FRAME_HEIGHT: f64 = 300.0;
const PANEL_GAP: f64 = 20.0;
/// The ends of logarithmic axes have longer numbers.
const LOG_GAP: f64 = 36.0;
const BELOW: f64 = 46.0;
const EDGE: f64 = 10.0;
/// Room for half of the last number of an axis.
const RIGHT: f64 = 20.0;
/// Room for the letter of a panel.
const LETTER: f64 = 26.0;

impl Layout {
    pub fn new(figure: &Figure) -> Result<Self, PlotError> {
        let count = figure.panels.len().max(1);
        let full_width = match count {
            1 => 420.0,
            2 => 570.0,
            _ => 760.0,
        };
        let letters = if count > 1 { ROW + 4.0 } else { EDGE };
        let vertical = |top: f64| {
            let values = figure.panels.iter().flat_map(|panel| points(figure, panel)).map(|p| p.1);
            Ruler::new(&figure.y, values, (top + FRAME_HEIGHT, top), 7)
        };
        let mut y = vertical(letters);
        let title = wrapped(&title(&figure.y, &y), FRAME_HEIGHT, LABEL)?;
        let widest = y.ticks.iter().map(|t| width(&t.label, SMALL)).try_fold(0.0, |w: f64, x| x.map(|x| w.max(x)))?;
        let left = EDGE + LABEL + LEADING * (title.len().max(1) - 1) as f64 + 8.0 + widest + 6.0;
        let inside = |level: &f64| y.holds(*level);
        let right = figure
            .levels
            .iter()
            .filter(|l| inside(&l.y))
            .map(|l| width(&l.label, SMALL))
            .try_fold(RIGHT, |w, x| x.map(|x| w.max(x + 8.0 + EDGE / 2.0)))?;
        let (mut frames, gap) = side_by_side(figure, (left, right), full_width)?;
        let (mut header, mut homeless, mut stack) = (letters, Vec::new(), Stack::new());
        let mut widest_legend = 0.0_f64;
        for (i, (panel, frame)) in figure.panels.iter().zip(&mut frames).enumerate() {
            let size = legend::size(figure, panel)?;
            frame.legend = size.and_then(|size| legend::free_place(figure, panel, (&frame.x, &y), size));
            if let (Some((width, height)), None) = (size, frame.legend) {
                // its last row beside the letter of the panel, unless it would reach the next letter
                let (from, to) = frame.x.span;
                let wide = count > 1 && LETTER + width > to - from + gap - APART;
                let aside = if wide || count == 1 { 0.0 } else { LETTER };
                let most = full_width - EDGE - width;
                let x = (from + aside).min(most).max(EDGE);
                let top = stack.push(x, if wide { letters } else { 0.0 }, (width, height));
                header = header.max(top + EDGE);
                widest_legend = widest_legend.max(width + 2.0 * EDGE);
                homeless.push((i, x, top));
            }
        }
        // legends without a free place stand above their frames, which move down to make room
        let shift = header - letters;
        if shift > 0.0 {
            y = vertical(header);
            for frame in &mut frames {
                frame.legend = frame.legend.map(|(x, y)| (x, y + shift));
            }
            for (i, x, top) in homeless {
                if let Some(frame) = frames.get_mut(i) {
                    frame.legend = Some((x, header - top - 2.0));
                }
            }
        }
        let lines = frames.iter().map(|frame| frame.title.len()).max().unwrap_or(1).max(1);
        let below = BELOW + LEADING * (lines - 1) as f64;
        let size = (full_width.max(widest_legend), header + FRAME_HEIGHT + below);
        let labels = spread(figure.levels.iter().map(|l| y.holds(l.y).then(|| y.at(l.y))).collect(), y.span);
        Ok(Self { size, y, frames, title, title_x: EDGE + LABEL * 0.75, labels })
    }
}

/// The frames between the margins, as far apart as the numbers at the ends of their axes need, with their titles in as many lines
/// as keep them apart; and the gap between two frames.
fn side_by_side(figure: &Figure, (left, right): (f64, f64), full_width: f64) -> Result<(Vec<Frame>, f64), PlotError> {
    let count = figure.panels.len();
    let log = figure.panels.iter().any(|panel| panel.x.scale == Scale::Log);
    let mut gap: f64 = if log { LOG_GAP } else { PANEL_GAP };
    let mut right = right;
    // A gap that grows makes frames narrower, whose numbers may be others.
    for last in [false, false, false, true] {
        let frame_width = (full_width - left - right - gap * count.saturating_sub(1) as f64) / count.max(1) as f64;
        let mut frames = Vec::new();
        for (i, panel) in figure.panels.iter().enumerate() {
            let from = left + (frame_width + gap) * i as f64;
            let x = horizontal(figure, panel, (from, from + frame_width))?;
            frames.push(Frame { x, title: Vec::new(), legend: None });
        }
        let (mut needed, mut beyond) = (gap, right);
        let overhangs: Vec<(f64, f64)> = frames.iter().map(|frame| overhang(&frame.x)).collect::<Result<_, _>>()?;
        for pair in overhangs.windows(2) {
            if let [(_, a), (b, _)] = pair {
                needed = needed.max(a + b + APART);
            }
        }
        beyond = beyond.max(overhangs.last().map_or(0.0, |(_, over)| over + EDGE / 2.0));
        if last || (needed <= gap && beyond <= right) {
            for (i, (panel, frame)) in figure.panels.iter().zip(&mut frames).enumerate() {
                let (from, to) = frame.x.span;
                let centre = (from + to) / 2.0;
                let room = [
                    if i == 0 { centre - EDGE / 2.0 } else { centre - from + (gap - APART) / 2.0 },
                    if i + 1 == count { full_width - EDGE / 2.0 - centre } else { to - centre + (gap - APART) / 2.0 },
                ];
                frame.title = wrapped(&title(&panel.x, &frame.x), 2.0 * room[0].min(room[1]), LABEL)?;
            }
            return Ok((frames, gap));
        }
        (gap, right) = (needed, beyond);
    }
    Ok((Vec::new(), gap))
}

/// How far the first and the last number of an axis reach beyond its ends.
fn overhang(ruler: &Ruler) -> Result<(f64, f64), PlotError> {
    let (from, to) = ruler.span;
    let mut over = (0.0_f64, 0.0_f64);
    for tick in ruler.ticks.iter().filter(|t| !t.label.is_empty()) {
        let (at, half) = (ruler.at(tick.at), width(&tick.label, SMALL)? / 2.0);
        over = (over.0.max(from - (at - half)), over.1.max(at + half - to));
    }
    Ok(over)
}

/// All points of a panel that are drawn.
fn points(figure: &Figure, panel: &Panel) -> impl Iterator<Item = (f64, f64)> {
    panel.curves.iter().flat_map(|curve| figure.pieces(panel, curve).into_iter().flatten())
}

/// The horizontal axis with as many labels as fit side by side.
fn horizontal(figure: &Figure, panel: &Panel, span: (f64, f64)) -> Result<Ruler, PlotError> {
    let mut values: Vec<f64> = points(figure, panel).map(|p| p.0).collect();
    for curve in &panel.curves {
        let bars = curve.points.iter().zip(&curve.errors);
        let ends = bars.filter_map(|(point, error)| point.zip(*error)).flat_map(|((x, _), e)| [x - e, x + e]);
        values.extend(ends.filter(|&x| panel.x.holds(x)));
    }
    let mut labels = 7;
    loop {
        let ruler = Ruler::new(&panel.x, values.iter().copied(), span, labels);
        let mut end = f64::NEG_INFINITY;
        let mut fits = true;
        for tick in ruler.ticks.iter().filter(|t| !t.label.is_empty()) {
            let half = width(&tick.label, SMALL)? / 2.0;
            fits &= ruler.at(tick.at) - half > end + 7.0;
            end = ruler.at(tick.at) + half;
        }
        if fits || labels <= 2 {
            return Ok(ruler);
        }
        labels -= 1;
    }
}

/// Moves labels apart until none touches another, and keeps them beside the frame.
fn spread(positions: Vec<Option<f64>>, (bottom, top): (f64, f64)) -> Vec<Option<f64>> {
    let mut order: Vec<usize> =
        (0..positions.len()).filter(|&i| positions.get(i).is_some_and(Option::is_some)).collect();
    let at = |i: usize| positions.get(i).copied().flatten().unwrap_or(top);
    order.sort_by(|&a, &b| at(a).total_cmp(&at(b)));
    let mut placed: Vec<f64> = order.iter().map(|&i| at(i)).collect();
    let mut floor = top;
    for y in &mut placed {
        *y = y.max(floor);
        floor = *y + ROW;
    }
    let mut ceiling = bottom;
    for y in placed.iter_mut().rev() {
        *y = y.min(ceiling);
        ceiling = *y - ROW;
    }
    let mut labels = vec![None; positions.len()];
    for (i, y) in order.into_iter().zip(placed) {
        if let Some(label) = labels.get_mut(i) {
            *label = Some(y + 0.36 * SMALL);
        }
    }
    labels
}

/// The title of an axis as it is drawn.
pub(super) fn title(axis: &Axis, ruler: &Ruler) -> String {
    axis::caption(axis, if axis.scale == Scale::Log { 0 } else { ruler.exponent })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::{Curve, Dash, Level};

    fn figure(points: Vec<Option<(f64, f64)>>) -> Figure {
        let name = "a long legend".to_owned();
        let curve = Curve { name, points, colour: 1, line: Some(Dash::Solid), ..Curve::default() };
        Figure {
            stem: "f".into(),
            caption: String::new(),
            y: Axis::linear("z", "m"),
            panels: vec![Panel { x: Axis::linear("u", "m/s"), curves: vec![curve] }],
            levels: vec![],
            tint_below: None,
        }
    }

    #[test]
    fn a_legend_takes_a_free_corner_and_leaves_the_frame_when_there_is_none() {
        let rising = figure((0..=50).map(|i| Some((f64::from(i), f64::from(i)))).collect());
        let layout = Layout::new(&rising).unwrap();
        let (x, y) = layout.frames[0].legend.unwrap();
        assert!(x >= layout.frames[0].x.span.0 && y >= layout.y.span.1 && y < layout.y.span.1 + 20.0);
        let scribble = figure((0..=4000).map(|i| Some((f64::from(i % 61), f64::from(i % 67)))).collect());
        let layout = Layout::new(&scribble).unwrap();
        assert!(layout.frames[0].legend.unwrap().1 + ROW <= layout.y.span.1);
    }

    #[test]
    fn a_legend_wider_than_its_panel_stands_above_the_letters() {
        let mut wide = figure((0..=4000).map(|i| Some((f64::from(i % 61), f64::from(i % 67)))).collect());
        let beside = |figure: &Figure| {
            let layout = Layout::new(figure).unwrap();
            let (x, y) = layout.frames[0].legend.unwrap();
            (x - layout.frames[0].x.span.0, layout.y.span.1 - (y + ROW))
        };
        wide.panels = vec![wide.panels[0].clone(); 4];
        assert!((beside(&wide).0 - LETTER).abs() < 1e-9);
        wide.panels[0].curves[0].name = "a legend that is wider than its panel".into();
        let (x, room) = beside(&wide);
        assert!(x.abs() < 1e-9 && room >= ROW - 1e-9, "{x} {room}");
    }

    #[test]
    fn labels_of_close_levels_do_not_touch() {
        let mut close = figure(vec![Some((0.0, 0.0)), Some((1.0, 1.0))]);
        close.levels = [0.5, 0.501, 0.0, 7.0].map(|y| Level { y, label: "level".into() }).to_vec();
        let labels = Layout::new(&close).unwrap().labels;
        assert!((labels[0].unwrap() - labels[1].unwrap()).abs() >= ROW - 1e-9);
        assert_eq!(labels[3], None);
    }
}
