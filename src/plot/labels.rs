//! The texts of a figure outside its legends: where each stands.

use super::canvas::Align;
use super::layout::Layout;
use super::text::{LEADING, Text};
use super::theme::{LABEL, Role, SMALL};
use crate::result::Figure;

/// Numbers, titles, letters, names of levels and of regions.
pub(super) fn texts(figure: &Figure, layout: &Layout) -> Vec<Text> {
    let mut texts = Vec::new();
    let mut put = |text: &str, at, size, align, role| {
        if !text.is_empty() {
            texts.push(Text { text: text.into(), at, size, align, role });
        }
    };
    let (bottom, top) = layout.y.span;
    for (i, (panel, frame)) in figure.panels.iter().zip(&layout.frames).enumerate() {
        let (left, right) = frame.x.span;
        for tick in &frame.x.ticks {
            put(&tick.label, (frame.x.at(tick.at), bottom + 16.0), SMALL, Align::Centre, Role::Ink);
        }
        for tick in layout.y.ticks.iter().filter(|_| i == 0) {
            put(&tick.label, (left - 6.0, layout.y.at(tick.at) + 0.36 * SMALL), SMALL, Align::Right, Role::Ink);
        }
        for (line, text) in frame.title.iter().enumerate() {
            let at = ((left + right) / 2.0, bottom + 36.0 + LEADING * line as f64);
            put(text, at, LABEL, Align::Centre, Role::Ink);
        }
        put(&figure.letter(i), (left, top - 6.0), LABEL, Align::Left, Role::Ink);
        for curve in panel.curves.iter().filter(|curve| !curve.text.is_empty()) {
            for (x, y) in figure.pieces(panel, curve).into_iter().flatten() {
                let at = (frame.x.at(x), layout.y.at(y) + 0.36 * SMALL);
                put(&curve.text, at, SMALL, Align::Centre, Role::Faint);
            }
        }
    }
    for (line, text) in layout.title.iter().enumerate() {
        let at = (layout.title_x + LEADING * line as f64, (bottom + top) / 2.0);
        put(text, at, LABEL, Align::Upward, Role::Ink);
    }
    if let Some(last) = layout.frames.last() {
        for (level, y) in figure.levels.iter().zip(&layout.labels).filter_map(|(level, y)| Some((level, (*y)?))) {
            put(&level.label, (last.x.span.1 + 7.0, y), SMALL, Align::Left, Role::Faint);
        }
    }
    texts
}
