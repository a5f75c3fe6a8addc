//! What a figure is, before anyone draws it: panels side by side over one shared vertical axis.

use serde::{Deserialize, Serialize};

/// One figure: panels that share their vertical axis, with levels drawn across all of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// name of its file, without extension: `profiles`
    pub stem: String,
    /// what it shows, in words: caption and accessible text
    pub caption: String,
    /// the shared vertical axis
    pub y: Axis,
    /// side by side; lettered (a), (b), ... where there are several
    pub panels: Vec<Panel>,
    /// thin dashed lines across all panels, labelled at the right
    pub levels: Vec<Level>,
    /// everything below this y is lightly tinted: the bed
    pub tint_below: Option<f64>,
}

/// One frame with its own horizontal axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// the horizontal axis
    pub x: Axis,
    /// drawn in order, the last on top
    pub curves: Vec<Curve>,
}

/// What an axis measures, in the unit in which the data are given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// `velocity`
    pub title: String,
    /// unit of the data: `mm/s`; empty or `1` for a pure number
    pub unit: String,
    /// linear or logarithmic
    pub scale: Scale,
    /// ends known beforehand, such as walls; widened where data lie outside. `None`: the data decide
    pub ends: Option<(f64, f64)>,
    /// what the values 0, 1, ... stand for, on an axis of kinds instead of numbers
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
}

/// How an axis divides its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// equal lengths are equal differences
    Linear,
    /// equal lengths are equal ratios; values that are not positive are not drawn
    Log,
}

/// A series of points, joined, marked, or both.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Curve {
    /// its entry in the legend; empty for none
    pub name: String,
    /// (x, y) in the units of the axes; `None`, and values that are not finite, break the line
    pub points: Vec<Option<(f64, f64)>>,
    /// index into the palette, 0 is the ink of the text
    pub colour: usize,
    /// how the points are joined; `None` leaves them apart
    pub line: Option<Dash>,
    /// drawn at each point
    pub marker: Option<Marker>,
    /// standard error of x per point, drawn as bars at some of them; empty if there is none
    pub errors: Vec<Option<f64>>,
    /// what a reader sees who points at a point; empty if there is nothing more to say
    pub notes: Vec<String>,
    /// written across each point: the name of a region of the panel
    #[serde(skip_serializing_if = "String::is_empty")]
    pub text: String,
}

/// Pattern of a line: with the colour it tells curves apart, without colour it still does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Dash {
    /// unbroken
    Solid,
    /// long strokes
    Dashed,
    /// dots
    Dotted,
    /// strokes and dots
    DashDotted,
}

/// Shape of an open symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Marker {
    /// circle
    Circle,
    /// square
    Square,
    /// triangle on its base
    Triangle,
    /// two crossed strokes: something that failed
    Cross,
}

/// A labelled horizontal line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// where, in the unit of the vertical axis
    pub y: f64,
    /// its label: `bed level`
    pub label: String,
}

impl Axis {
    /// A linear axis whose ends the data decide.
    #[must_use]
    pub fn linear(title: &str, unit: &str) -> Self {
        Self { title: title.into(), unit: unit.into(), scale: Scale::Linear, ends: None, names: Vec::new() }
    }

    /// An axis of kinds: the values 0, 1, ... stand for `names`.
    #[must_use]
    pub fn named(title: &str, names: Vec<String>) -> Self {
        Self { names, ..Self::linear(title, "") }
    }

    /// The elevation, whose ends the data decide.
    #[must_use]
    pub fn elevation(unit: &str) -> Self {
        Self::linear(ELEVATION, unit)
    }

    /// A logarithmic axis whose ends the data decide.
    #[must_use]
    pub fn log(title: &str, unit: &str) -> Self {
        Self { scale: Scale::Log, ..Self::linear(title, unit) }
    }

    /// Whether `value` has a place on the axis.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        value.abs() < LARGEST && (self.scale == Scale::Linear || value > 1.0 / LARGEST)
    }
}

/// Values beyond this are not drawn: differences of two of them must not overflow.
const LARGEST: f64 = 1e280;

/// Title of the vertical axis of profiles.
pub const ELEVATION: &str = "elevation z";

impl Figure {
    /// Whether its vertical axis is the elevation.
    #[must_use]
    pub fn is_over_elevation(&self) -> bool {
        self.y.title == ELEVATION
    }

    /// The same without numbers that are none: they break a line as a gap does.
    #[must_use]
    pub fn finite(mut self) -> Self {
        for curve in self.panels.iter_mut().flat_map(|panel| &mut panel.curves) {
            for point in &mut curve.points {
                *point = point.filter(|(x, y)| x.is_finite() && y.is_finite());
            }
            for error in &mut curve.errors {
                *error = error.filter(|e| e.is_finite());
            }
        }
        self
    }

    /// The letter of a panel: `(a)`; empty if there is only one panel.
    #[must_use]
    pub fn letter(&self, panel: usize) -> String {
        let letter = u8::try_from(panel).ok().and_then(|i| b'a'.checked_add(i)).map_or('?', char::from);
        if self.panels.len() > 1 { format!("({letter})") } else { String::new() }
    }

    /// Whether a legend may name a curve: a curve of its look is drawn in one of the panels.
    #[must_use]
    pub fn is_drawn(&self, curve: &Curve) -> bool {
        let drawn = |panel: &Panel| {
            panel.curves.iter().any(|other| other.looks_like(curve) && !self.pieces(panel, other).is_empty())
        };
        self.panels.iter().any(drawn)
    }

    /// The unbroken pieces of a curve, with the points that both axes hold.
    #[must_use]
    pub fn pieces<'a>(&self, panel: &Panel, curve: &'a Curve) -> Vec<Vec<(f64, f64)>> {
        let visible = |p: &'a Option<(f64, f64)>| p.filter(|&(x, y)| panel.x.holds(x) && self.y.holds(y));
        let mut pieces = vec![Vec::new()];
        for point in curve.points.iter().map(visible) {
            match (point, pieces.last_mut()) {
                (Some(point), Some(piece)) => piece.push(point),
                _ => pieces.push(Vec::new()),
            }
        }
        pieces.retain(|piece| !piece.is_empty());
        pieces
    }
}

impl Curve {
    /// Whether one entry of a legend stands for both.
    #[must_use]
    pub fn looks_like(&self, other: &Self) -> bool {
        (self.colour, self.line, self.marker) == (other.colour, other.line, other.marker)
    }
}

/// What the panels show, lettered where there are several: `(a) velocity, (b) shear stress`.
#[must_use]
pub fn sentence(panels: &[Panel]) -> String {
    let lettered = |(i, panel): (usize, &Panel)| match panels.len() {
        1 => panel.x.title.clone(),
        _ => format!("({}) {}", char::from(b'a'.saturating_add(i as u8)), panel.x.title),
    };
    panels.iter().enumerate().map(lettered).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_values_without_a_place_break_a_curve() {
        let curve = Curve {
            name: String::new(),
            points: vec![Some((1.0, 1.0)), Some((2.0, 2.0)), None, None, Some((-3.0, 3.0)), Some((4.0, 4.0))],
            colour: 0,
            line: Some(Dash::Solid),
            ..Curve::default()
        };
        let mut figure = Figure {
            stem: "f".into(),
            caption: "c".into(),
            y: Axis::linear("z", "m"),
            panels: vec![Panel { x: Axis::log("u", "m/s"), curves: vec![curve] }],
            levels: vec![],
            tint_below: None,
        };
        let panel = figure.panels[0].clone();
        assert_eq!(figure.pieces(&panel, &panel.curves[0]), [vec![(1.0, 1.0), (2.0, 2.0)], vec![(4.0, 4.0)]]);
        figure.panels[0].x.scale = Scale::Linear;
        let panel = figure.panels[0].clone();
        assert_eq!(figure.pieces(&panel, &panel.curves[0])[1], [(-3.0, 3.0), (4.0, 4.0)]);
        assert!(!panel.x.holds(f64::NAN) && !panel.x.holds(f64::INFINITY) && !panel.x.holds(1e300));
    }

    #[test]
    fn numbers_that_are_none_become_gaps_and_the_figure_reads_back() {
        let curve = Curve {
            points: vec![Some((1.0, 2.0)), Some((f64::NAN, 1.0)), Some((1.0, f64::INFINITY)), None],
            errors: vec![Some(0.1), Some(f64::NAN), None, None],
            ..Curve::default()
        };
        let panels = vec![Panel { x: Axis::linear("u", "m/s"), curves: vec![curve] }];
        let (y, stem) = (Axis::elevation("m"), "f".to_owned());
        let figure = Figure { stem, caption: String::new(), y, panels, levels: Vec::new(), tint_below: None }.finite();
        assert_eq!(figure.panels[0].curves[0].points, [Some((1.0, 2.0)), None, None, None]);
        assert_eq!(figure.panels[0].curves[0].errors, [Some(0.1), None, None, None]);
        let text = serde_json::to_string(&figure).unwrap();
        assert_eq!(serde_json::from_str::<Figure>(&text).unwrap(), figure);
    }
}
