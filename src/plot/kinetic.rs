//! Figures of grains that collide: their velocity fluctuations and what feeds them, and how friction and solid fraction go with
//! the inertial number.

use super::profile::sentence;
use super::{Axis, Curve, Dash, Figure, Panel};
use crate::closures::kinetic::Inertial;
use crate::result::quantity::{self, Quantity};
use crate::result::{Profile, Summary};
use crate::units::readable_unit;

/// Inertial numbers that are drawn.
const DRAWN: (f64, f64) = (1e-4, 1e2);
/// Solid fraction at rest of phi(I): Maurin, Chauchat & Frey (2016).
pub(super) const PHI_C: f64 = 0.61;
/// Solid fraction above which grains are drawn in the plane of the inertial number.
const ENOUGH: f64 = 1e-3;

/// The figures; none for a profile without the budget of the fluctuations.
pub(super) fn kinetic_figures(profile: &Profile, summary: &Summary) -> Vec<Figure> {
    let scene = Scene { profile, z: profile.axis() };
    if profile.get(&quantity::PRODUCTION).is_none() {
        return Vec::new();
    }
    let mut figures = vec![scene.fluctuations(&summary.case)];
    // Grains with error bars have a figure of their own.
    if profile.get(&quantity::P_PARTICLE_STDERR).is_none() {
        figures.extend(scene.rheology(&summary.case));
    }
    figures
}

struct Scene<'a> {
    profile: &'a Profile,
    z: Vec<f64>,
}

impl Scene<'_> {
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

    /// Friction and solid fraction over the inertial number.
    fn rheology(&self, case: &str) -> Vec<Figure> {
        let rows: Vec<usize> = (0..self.z.len())
            .filter(|&row| self.at(&quantity::PHI, row).is_some_and(|phi| phi > ENOUGH))
            .filter(|&row| self.at(&quantity::INERTIAL_NUMBER, row).is_some_and(|i| (DRAWN.0..DRAWN.1).contains(&i)))
            .collect();
        if rows.len() < 2 {
            return Vec::new();
        }
        let over = |value: &dyn Fn(usize) -> Option<f64>| -> Vec<Option<(f64, f64)>> {
            rows.iter().map(|&row| Some((self.at(&quantity::INERTIAL_NUMBER, row)?, value(row)?))).collect()
        };
        let friction = |row: usize| Some(self.at(&quantity::TAU_PARTICLE, row)? / self.at(&quantity::P_PARTICLE, row)?);
        let phi = |row: usize| self.at(&quantity::PHI, row);
        let dense = Inertial::default();
        let figure =
            |stem: &str, title: &str, value: &dyn Fn(usize) -> Option<f64>, law: (&str, &dyn Fn(f64) -> f64)| Figure {
                stem: stem.into(),
                caption: format!("{case}: {title} over the inertial number."),
                y: Axis::linear(title, ""),
                panels: vec![Panel {
                    x: Axis::log("inertial number I", ""),
                    curves: vec![
                        Self::curve("here", (2, Dash::Solid), over(value)),
                        Self::curve(
                            law.0,
                            (0, Dash::DashDotted),
                            over(&|row| Some(law.1(self.at(&quantity::INERTIAL_NUMBER, row)?))),
                        ),
                    ],
                }],
                levels: Vec::new(),
                tint_below: None,
            };
        vec![
            figure("friction_inertial", "friction τₚ/Pₚ", &friction, ("μ(I)", &|i| dense.mu(i))),
            figure("fraction_inertial", "solid fraction φ", &phi, ("φ(I)", &|i| PHI_C / (1.0 + dense.b * i))),
        ]
    }
}
