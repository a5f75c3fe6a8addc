//! Where everything goes: frames side by side, room for labels, and a place for each legend that no curve crosses.

use super::PlotError;
use super::axis::{self, Ruler};
use super::canvas::width;
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
    /// distance of the title of the vertical axis from the left edge
    pub title_x: f64,
    /// base lines of the labels of the levels, `None` where a level lies outside
    pub labels: Vec<Option<f64>>,
}

/// A panel's horizontal axis and its legend.
pub(super) struct Frame {
    /// the horizontal axis; its span runs from left to right
    pub x: Ruler,
    /// upper left corner of the legend, if it has one
    pub legend: Option<(f64, f64)>,
}

/// Line spacing of legends and of labels at levels.
pub(super) const ROW: f64 = 15.5;
/// Length of the sample line in a legend.
pub(super) const SAMPLE: f64 = 22.0;
/// Space between sample and name.
pub(super) const SAMPLE_GAP: f64 = 5.0;
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

type Rectangle = (f64, f64, f64, f64);

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
        let widest = y.ticks.iter().map(|t| width(&t.label, SMALL)).try_fold(0.0, |w: f64, x| x.map(|x| w.max(x)))?;
        let left = EDGE + LABEL + 8.0 + widest + 6.0;
        let inside = |level: &f64| y.holds(*level);
        let right = figure
            .levels
            .iter()
            .filter(|l| inside(&l.y))
            .map(|l| width(&l.label, SMALL))
            .try_fold(RIGHT, |w, x| x.map(|x| w.max(x + 8.0 + EDGE / 2.0)))?;
        let log = figure.panels.iter().any(|panel| panel.x.scale == Scale::Log);
        let gap = if log { LOG_GAP } else { PANEL_GAP };
        let frame_width = (full_width - left - right - gap * (count - 1) as f64) / count as f64;
        let mut frames = Vec::new();
        let (mut header, mut homeless) = (letters, Vec::new());
        for (i, panel) in figure.panels.iter().enumerate() {
            let from = left + (frame_width + gap) * i as f64;
            let x = horizontal(figure, panel, (from, from + frame_width))?;
            let size = legend_size(panel)?;
            let place = size.and_then(|size| free_place(figure, panel, (&x, &y), size));
            if let (Some((width, height)), None) = (size, place) {
                // its last row beside the letter of the panel, unless it would reach the next letter
                let wide = count > 1 && LETTER + width > frame_width;
                let above = if wide { letters } else { 0.0 };
                header = header.max(height + EDGE + above);
                homeless.push((i, height + above, if wide || count == 1 { 0.0 } else { LETTER }));
            }
            frames.push(Frame { x, legend: place });
        }
        // legends without a free place stand above their frames, which move down to make room
        let shift = header - letters;
        if shift > 0.0 {
            y = vertical(header);
            for frame in &mut frames {
                frame.legend = frame.legend.map(|(x, y)| (x, y + shift));
            }
            for (i, height, beside) in homeless {
                if let Some(frame) = frames.get_mut(i) {
                    frame.legend = Some((frame.x.span.0 + beside, header - height - 2.0));
                }
            }
        }
        let size = (full_width, header + FRAME_HEIGHT + BELOW);
        let labels = spread(figure.levels.iter().map(|l| y.holds(l.y).then(|| y.at(l.y))).collect(), y.span);
        Ok(Self { size, y, frames, title_x: EDGE + LABEL * 0.75, labels })
    }
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

/// Width and height of a legend, `None` if no curve has a name.
fn legend_size(panel: &Panel) -> Result<Option<(f64, f64)>, PlotError> {
    let (mut widest, mut rows) = (0.0_f64, 0);
    for curve in panel.curves.iter().filter(|c| !c.name.is_empty()) {
        widest = widest.max(width(&curve.name, SMALL)?);
        rows += 1;
    }
    Ok((rows > 0).then(|| (SAMPLE + SAMPLE_GAP + widest, ROW * f64::from(rows))))
}

/// A place in the frame that neither a curve nor a level crosses, as near to a corner as there is one.
fn free_place(figure: &Figure, panel: &Panel, (x, y): (&Ruler, &Ruler), size: (f64, f64)) -> Option<(f64, f64)> {
    const MARGIN: f64 = 9.0;
    const STEPS: u32 = 24;
    let lines: Vec<Vec<(f64, f64)>> = panel
        .curves
        .iter()
        .flat_map(|curve| figure.pieces(panel, curve))
        .map(|piece| piece.iter().map(|p| (x.at(p.0), y.at(p.1))).collect())
        .collect();
    let levels: Vec<f64> = figure.levels.iter().filter(|l| y.holds(l.y)).map(|l| y.at(l.y)).collect();
    let (first, last) = (x.span.0 + MARGIN, x.span.1 - MARGIN - size.0);
    let (top, bottom) = (y.span.1 + MARGIN, y.span.0 - MARGIN - size.1);
    let columns = if last < first { vec![] } else { vec![last, first, (first + last) / 2.0] };
    let rows = (0..=STEPS).map(|i| top + (bottom - top) * f64::from(i) / f64::from(STEPS));
    let candidates = rows.flat_map(|row| columns.iter().map(move |&column| (column, row)));
    let clearance = |(left, up): (f64, f64)| {
        let room = (left - 5.0, up - 5.0, left + size.0 + 5.0, up + size.1 + 4.0);
        !lines.iter().any(|line| crosses(line, room)) && !levels.iter().any(|&l| l > room.1 && l < room.3)
    };
    // the distance from the nearest of top and bottom, then from the sides: corners first, upper right before all
    let rank = |&(column, row): &(f64, f64)| {
        let middle = if column > first && column < last { 40.0 } else { 0.0 };
        (row - top).min(bottom - row + 3.0) + middle + if column < last { 2.0 } else { 0.0 }
    };
    candidates.filter(|&c| clearance(c)).min_by(|a, b| rank(a).total_cmp(&rank(b)))
}

/// Whether a line touches a rectangle (left, top, right, bottom).
fn crosses(line: &[(f64, f64)], room: Rectangle) -> bool {
    let single = line.first().zip(line.first()).filter(|_| line.len() == 1);
    line.iter().zip(line.iter().skip(1)).chain(single).any(|(a, b)| segment_crosses(*a, *b, room))
}

/// Liang and Barsky's clipping test.
fn segment_crosses(a: (f64, f64), b: (f64, f64), (left, top, right, bottom): Rectangle) -> bool {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (slope, room) in [(-dx, a.0 - left), (dx, right - a.0), (-dy, a.1 - top), (dy, bottom - a.1)] {
        if slope == 0.0 && room < 0.0 {
            return false;
        }
        if slope < 0.0 {
            enter = enter.max(room / slope);
        } else if slope > 0.0 {
            leave = leave.min(room / slope);
        }
    }
    enter <= leave
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

    #[test]
    fn a_segment_through_a_room_without_an_end_in_it_crosses_it() {
        assert!(segment_crosses((-1.0, 0.5), (2.0, 0.6), (0.0, 0.0, 1.0, 1.0)));
        assert!(!segment_crosses((-1.0, 1.5), (2.0, 1.6), (0.0, 0.0, 1.0, 1.0)));
        assert!(!segment_crosses((-1.0, 0.9), (0.2, 2.5), (0.0, 0.0, 1.0, 1.0)));
        assert!(crosses(&[(0.5, 0.5)], (0.0, 0.0, 1.0, 1.0)));
    }
}
