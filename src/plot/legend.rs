//! Legends: what they name, and a place for each that no curve crosses.

use super::PlotError;
use super::axis::Ruler;
use super::canvas::{Align, width};
use super::text::{Rectangle, Text, overlap};
use super::theme::{Role, SMALL};
use crate::result::{Curve, Figure, Panel};

/// Line spacing of legends and of labels at levels.
pub(super) const ROW: f64 = 15.5;
/// Length of the sample line in a legend.
pub(super) const SAMPLE: f64 = 22.0;
/// Space between sample and name.
const SAMPLE_GAP: f64 = 5.0;

/// The curves that the legend of a panel names, with their places among the curves: what is drawn nowhere gets no entry.
pub(super) fn named<'a>(figure: &'a Figure, panel: &'a Panel) -> impl Iterator<Item = (usize, &'a Curve)> {
    panel.curves.iter().enumerate().filter(|(_, curve)| !curve.name.is_empty() && figure.is_drawn(curve))
}

/// The text of an entry of the legend whose upper left corner is `corner`.
pub(super) fn entry(name: &str, corner: (f64, f64), row: usize) -> Text {
    let middle = corner.1 + ROW * (row as f64 + 0.5);
    let at = (corner.0 + SAMPLE + SAMPLE_GAP, middle + 0.34 * SMALL);
    Text { text: name.into(), at, size: SMALL, align: Align::Left, role: Role::Ink }
}

/// Width and height of a legend, `None` if it names no curve.
pub(super) fn size(figure: &Figure, panel: &Panel) -> Result<Option<(f64, f64)>, PlotError> {
    let (mut widest, mut rows) = (0.0_f64, 0);
    for (_, curve) in named(figure, panel) {
        widest = widest.max(width(&curve.name, SMALL)?);
        rows += 1;
    }
    Ok((rows > 0).then(|| (SAMPLE + SAMPLE_GAP + widest, ROW * f64::from(rows))))
}

/// Legends that found no place in their frames, stacked above them: each as low as those before it leave room.
pub(super) struct Stack {
    placed: Vec<Rectangle>,
}

impl Stack {
    pub fn new() -> Self {
        Self { placed: Vec::new() }
    }

    /// Places a legend whose lower left corner is wanted at `left`, `bottom`, upward from the frames; the height of its top.
    pub fn push(&mut self, left: f64, mut bottom: f64, (width, height): (f64, f64)) -> f64 {
        let room = |bottom: f64| (left - ROW / 2.0, bottom, left + width + ROW / 2.0, bottom + height);
        while let Some(other) = self.placed.iter().find(|other| overlap(room(bottom), **other)) {
            bottom = other.3;
        }
        self.placed.push(room(bottom));
        bottom + height
    }
}

/// A place in the frame that neither a curve nor a level crosses, as near to a corner as there is one.
pub(super) fn free_place(
    figure: &Figure,
    panel: &Panel,
    (x, y): (&Ruler, &Ruler),
    size: (f64, f64),
) -> Option<(f64, f64)> {
    const MARGIN: f64 = 9.0;
    const STEPS: u32 = 24;
    let mut lines: Vec<Vec<(f64, f64)>> = panel
        .curves
        .iter()
        .flat_map(|curve| figure.pieces(panel, curve))
        .map(|piece| piece.iter().map(|p| (x.at(p.0), y.at(p.1))).collect())
        .collect();
    for curve in &panel.curves {
        let bars = curve.points.iter().zip(&curve.errors).filter_map(|(point, error)| point.zip(*error));
        let drawn =
            bars.filter(|((at, up), e)| [at - e, at + e].iter().all(|x| panel.x.holds(*x)) && figure.y.holds(*up));
        lines.extend(drawn.map(|((at, up), e)| vec![(x.at(at - e), y.at(up)), (x.at(at + e), y.at(up))]));
        for piece in figure.pieces(panel, curve).iter().filter(|_| !curve.text.is_empty()) {
            let half = width(&curve.text, SMALL).unwrap_or(0.0) / 2.0;
            lines.extend(piece.iter().map(|p| vec![(x.at(p.0) - half, y.at(p.1)), (x.at(p.0) + half, y.at(p.1))]));
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legends_above_their_frames_stand_on_each_other_where_they_would_meet() {
        let mut stack = Stack::new();
        assert_eq!(stack.push(0.0, 2.0, (100.0, 30.0)), 32.0);
        assert_eq!(stack.push(200.0, 2.0, (100.0, 30.0)), 32.0);
        assert_eq!(stack.push(90.0, 2.0, (120.0, 15.0)), 47.0);
    }

    #[test]
    fn a_segment_through_a_room_without_an_end_in_it_crosses_it() {
        assert!(segment_crosses((-1.0, 0.5), (2.0, 0.6), (0.0, 0.0, 1.0, 1.0)));
        assert!(!segment_crosses((-1.0, 1.5), (2.0, 1.6), (0.0, 0.0, 1.0, 1.0)));
        assert!(!segment_crosses((-1.0, 0.9), (0.2, 2.5), (0.0, 0.0, 1.0, 1.0)));
        assert!(crosses(&[(0.5, 0.5)], (0.0, 0.0, 1.0, 1.0)));
    }
}
