//! Figure of grains that collide: their velocity fluctuations and what feeds them.

use crate::result::figure::sentence;
use crate::result::quantity::{self, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Panel};
use crate::result::{Profile, Summary};
use crate::units::readable_unit;

/// The figure; none for a profile without the budget of the fluctuations.
pub(super) fn figures(profile: &Profile, summary: &Summary) -> Vec<Figure> {
    let budget = profile.get(&quantity::PRODUCTION);
    budget.map(|_| Drawing { profile, z: profile.axis() }.fluctuations(&summary.case)).into_iter().collect()
}

struct Drawing<'a> {
    profile: &'a Profile,
    z: Vec<f64>,
}

impl Drawing<'_> {
    fn at(&self, quantity: &Quantity, row: usize) -> Option<f64> {
        self.profile.get(quantity)?.get(row).copied().flatten()
    }

    fn largest(&self, quantity: &Quantity) -> f64 {
        self.profile.range(quantity).map_or(0.0, |(low, high)| high.abs().max(low.abs()))
    }

    /// Standard errors of a column; none where it has none.
    fn errors(&self, quantity: &Quantity) -> impl Iterator<Item = Option<f64>> {
        let name = format!("{}_stderr", quantity.name);
        let column = quantity::find(quantity::COLUMNS, &name).and_then(|error| self.profile.get(error));
        column.into_iter().flatten().copied()
    }

    fn curve(name: &str, (colour, dash): (usize, Dash), points: Vec<Option<(f64, f64)>>) -> Curve {
        Curve { name: name.into(), points, colour, line: Some(dash), ..Curve::default() }
    }

    /// Granular temperature, and the budget of the fluctuation energy, over the elevation.
    fn fluctuations(&self, case: &str) -> Figure {
        let highest = self.z.iter().copied().fold(0.0, f64::max);
        let (factor, unit) = readable_unit(highest, "m");
        let over = |quantity: &Quantity, scale: f64, sign: f64| -> Vec<Option<(f64, f64)>> {
            let point = |row: usize| Some((sign * self.at(quantity, row)? * scale, self.z[row] * factor));
            (0..self.z.len()).map(point).collect()
        };
        let panel = |title: &str, unit: &'static str, lines: &[(&str, usize, Dash, &Quantity, f64)]| {
            let largest = lines.iter().map(|(_, _, _, quantity, _)| self.largest(quantity)).fold(0.0, f64::max);
            let (scale, symbol) = readable_unit(largest, unit);
            let curves = lines
                .iter()
                .map(|(name, colour, dash, quantity, sign)| {
                    let errors = self.errors(quantity).map(|error| error.map(|error| error * scale)).collect();
                    Curve { errors, ..Self::curve(name, (*colour, *dash), over(quantity, scale, *sign)) }
                })
                .collect();
            Panel { x: Axis::linear(title, symbol), curves }
        };
        let temperature = [("", 2, Dash::Solid, &quantity::GRANULAR_TEMPERATURE, 1.0)];
        let budget = [
            ("production", 0, Dash::Solid, &quantity::PRODUCTION, 1.0),
            ("diffusion", 1, Dash::Dotted, &quantity::DIFFUSION, 1.0),
            ("contacts", 2, Dash::Dashed, &quantity::CONTACT_LOSS, -1.0),
            ("drag", 3, Dash::DashDotted, &quantity::DRAG_LOSS, -1.0),
        ];
        let panels =
            vec![panel("granular temperature T", "m²/s²", &temperature), panel("budget of T", "W/m³", &budget)];
        Figure {
            stem: "fluctuations".into(),
            caption: format!("{case}: {} over the elevation z.", sentence(&panels)),
            y: Axis { ends: Some((0.0, highest * factor)), ..Axis::elevation(unit) },
            panels,
            levels: Vec::new(),
            tint_below: None,
        }
    }
}
