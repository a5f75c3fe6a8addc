//! What a reader could not read in a figure, from where everything stands in it.

use super::PlotError;
use super::labels::texts;
use super::layout::Layout;
use super::legend;
use super::text::{Rectangle, overlap};
use crate::result::{Curve, Figure, Panel};

/// Letters that touch by less than this are apart [units of the figure].
const SLACK: f64 = 0.75;
/// Places that agree to this share are the same.
const SAME: f64 = 1e-9;

/// What is wrong with how a figure is laid out, a sentence each; empty for a sound one: texts that overlap or leave the
/// sheet, a curve that leaves its panel, an axis without a title, an entry of a legend for what is not drawn, a curve without an entry beside others
/// that have one, two panels of the same curves.
///
/// # Errors
/// [`PlotError::Font`] if the embedded font cannot be read.
pub fn faults(figure: &Figure) -> Result<Vec<String>, PlotError> {
    let layout = Layout::new(figure)?;
    let mut found = overlaps(figure, &layout)?;
    if figure.y.title.is_empty() || figure.panels.iter().any(|panel| panel.x.title.is_empty()) {
        found.push("an axis has no title".into());
    }
    for (i, (panel, frame)) in figure.panels.iter().zip(&layout.frames).enumerate() {
        for curve in &panel.curves {
            let outside = |&(x, y): &(f64, f64)| {
                let (x, y, (left, right), (bottom, top)) = (frame.x.at(x), layout.y.at(y), frame.x.span, layout.y.span);
                !(left - SLACK..=right + SLACK).contains(&x) || !(top - SLACK..=bottom + SLACK).contains(&y)
            };
            if let Some((x, y)) = figure.pieces(panel, curve).into_iter().flatten().find(outside) {
                found.push(format!("panel {}: {:?} is outside at ({x}, {y})", i + 1, curve.name));
            }
        }
        found.extend(
            unnamed(figure, panel)
                .map(|curve| format!("panel {}: a curve of colour {} has no entry in a legend", i + 1, curve.colour)),
        );
        let entries = legend::named(figure, panel).filter(|(_, curve)| !figure.is_drawn(curve));
        found.extend(entries.map(|(_, curve)| format!("panel {}: {:?} is not drawn", i + 1, curve.name)));
        let twin = figure.panels.iter().take(i).position(|other| same(figure, other, panel));
        found.extend(twin.map(|other| format!("panels {} and {} are the same", other + 1, i + 1)));
    }
    Ok(found)
}

/// Texts that overlap or leave the sheet.
fn overlaps(figure: &Figure, layout: &Layout) -> Result<Vec<String>, PlotError> {
    let mut all = texts(figure, layout);
    for (panel, frame) in figure.panels.iter().zip(&layout.frames) {
        let corner = frame.legend;
        all.extend(
            legend::named(figure, panel)
                .enumerate()
                .filter_map(|(row, (_, curve))| Some(legend::entry(&curve.name, corner?, row))),
        );
    }
    let rooms: Vec<Rectangle> = all.iter().map(|text| text.room()).collect::<Result<_, _>>()?;
    let smaller = |r: Rectangle| (r.0 + SLACK, r.1 + SLACK, r.2 - SLACK, r.3 - SLACK);
    let mut found = Vec::new();
    for (i, (text, room)) in all.iter().zip(&rooms).enumerate() {
        let (wide, high) = layout.size;
        if room.0 < 0.0 || room.1 < 0.0 || room.2 > wide || room.3 > high {
            found.push(format!("{:?} leaves the sheet", text.text));
        }
        for (other, taken) in all.iter().zip(&rooms).take(i) {
            if overlap(smaller(*room), smaller(*taken)) {
                found.push(format!("{:?} lies on {:?}", text.text, other.text));
            }
        }
    }
    Ok(found)
}

/// Curves that are drawn beside named ones, and named nowhere in the figure.
fn unnamed<'a>(figure: &'a Figure, panel: &'a Panel) -> impl Iterator<Item = &'a Curve> {
    let is_named = |curve: &Curve| {
        figure
            .panels
            .iter()
            .flat_map(|panel| &panel.curves)
            .any(|other| !other.name.is_empty() && other.looks_like(curve))
    };
    let several = panel.curves.iter().any(|curve| !curve.name.is_empty());
    let drawn = |curve: &&Curve| curve.text.is_empty() && !figure.pieces(panel, curve).is_empty();
    panel.curves.iter().filter(move |curve| several && drawn(curve) && !is_named(curve))
}

/// Whether two panels show the same curves over the same values; constants may well agree.
fn same(figure: &Figure, a: &Panel, b: &Panel) -> bool {
    let points = |panel: &Panel, curve: &Curve| figure.pieces(panel, curve).concat();
    let near = |p: f64, q: f64| (p - q).abs() <= SAME * p.abs().max(q.abs());
    let varies = |panel: &Panel| {
        panel.curves.iter().any(|curve| points(panel, curve).windows(2).any(|pair| !near(pair[0].0, pair[1].0)))
    };
    a.curves.len() == b.curves.len()
        && varies(a)
        && a.curves.iter().zip(&b.curves).all(|(c, d)| {
            let (p, q) = (points(a, c), points(b, d));
            p.len() == q.len() && p.iter().zip(&q).all(|(p, q)| near(p.0, q.0) && near(p.1, q.1))
        })
}

#[cfg(test)]
mod tests {
    use super::super::{profile_figures, samples};
    use super::*;
    use crate::result::{Axis, Dash};

    #[test]
    fn the_samples_have_none() {
        for (profile, summary) in
            [samples::laminar_bed(), samples::two_fluid_bed(), samples::log_law(), samples::bingham_plane()]
        {
            for figure in profile_figures(&profile, &summary).into_iter().chain([samples::convergence()]) {
                assert_eq!(faults(&figure).unwrap(), Vec::<String>::new(), "{} of {}", figure.stem, summary.case);
            }
        }
    }

    #[test]
    fn each_is_seen() {
        let curve = |name: &str, colour: usize, scale: f64| Curve {
            name: name.into(),
            points: (0..4).map(|i| Some((scale * f64::from(i), f64::from(i)))).collect(),
            colour,
            line: Some(Dash::Solid),
            ..Curve::default()
        };
        let panel =
            |scale| Panel { x: Axis::linear("u", "m/s"), curves: vec![curve("a", 1, scale), curve("b", 2, scale)] };
        let figure = Figure {
            stem: "f".into(),
            caption: String::new(),
            y: Axis::elevation("m"),
            panels: vec![panel(1.0), panel(2.0)],
            levels: vec![],
            tint_below: None,
        };
        assert_eq!(faults(&figure).unwrap(), Vec::<String>::new());
        let with = |change: &dyn Fn(&mut Figure)| {
            let mut figure = figure.clone();
            change(&mut figure);
            faults(&figure).unwrap().join("; ")
        };
        assert!(with(&|f| f.panels[1] = f.panels[0].clone()).contains("panels 1 and 2 are the same"));
        assert!(
            with(&|f| f.panels.iter_mut().for_each(|p| p.curves[1].name.clear())).contains("colour 2 has no entry")
        );
        assert!(with(&|f| f.panels[0].x.title.clear()).contains("no title"));
        let long = "a_title_of_one_word_that_cannot_be_broken_into_lines_and_is_wider_than_its_panel";
        assert!(with(&|f| f.panels.iter_mut().for_each(|p| p.x.title = long.into())).contains("lies on"));
        let words = "a title of many words that can be broken into lines and is wider than its panel";
        assert_eq!(with(&|f| f.panels.iter_mut().for_each(|p| p.x.title = words.into())), "");
        // What is not drawn gets no entry, and one that has an entry elsewhere needs none.
        assert_eq!(with(&|f| f.panels.iter_mut().for_each(|p| p.curves[1].points.clear())), "");
        assert_eq!(with(&|f| f.panels[1].curves.iter_mut().for_each(|c| c.name.clear())), "");
    }
}
