//! Figures that only a sheet flow has: who carries the stress and where the grains go, within the sheet, and which time rules
//! the rearrangement of the grains.

use crate::result::figure::sentence;
use crate::result::quantity::{self, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Level, Marker, Outcome, Panel, Profile};
use crate::units::significant;

/// The figures of the run `name`; none without a sheet.
pub(super) fn figures(name: &str, outcome: &Outcome) -> Vec<Figure> {
    let result = |quantity: &Quantity| outcome.results.get(quantity.name);
    let (Some(profile), Some(thickness), Some(bottom), Some(shields)) = (
        outcome.profile.as_ref(),
        result(&quantity::SHEET_THICKNESS),
        result(&quantity::YIELD_LEVEL),
        result(&quantity::SHIELDS),
    ) else {
        return Vec::new();
    };
    let sheet = Sheet { profile, z: profile.axis(), bottom, thickness };
    // The stress of the interface, where the grains carry none.
    let interface = sheet.z.iter().position(|&z| z >= bottom + thickness);
    let tau_b = interface.and_then(|row| sheet.total(row + 2)).filter(|tau| *tau > 0.0);
    let mut figures = Vec::new();
    if let Some(tau_b) = tau_b {
        figures.push(sheet.repartition(name, tau_b));
    }
    figures.extend(sheet.regimes(name, shields));
    figures
}

/// The moving layer, in the levels of the profile.
struct Sheet<'a> {
    profile: &'a Profile,
    z: Vec<f64>,
    bottom: f64,
    thickness: f64,
}

impl Sheet<'_> {
    fn at(&self, quantity: &Quantity, row: usize) -> Option<f64> {
        self.profile.get(quantity)?.get(row).copied().flatten()
    }

    fn fluid(&self, row: usize) -> Option<f64> {
        Some(self.at(&quantity::TAU_VISCOUS, row)? + self.at(&quantity::TAU_REYNOLDS, row)?)
    }

    /// In grains at rest that of the fluid is not defined, and grains carry the whole.
    fn total(&self, row: usize) -> Option<f64> {
        let grains = self.at(&quantity::TAU_PARTICLE, row);
        self.fluid(row).map(|fluid| fluid + grains.unwrap_or(0.0)).or(grains.filter(|_| self.z[row] < self.bottom))
    }

    /// A curve over the height in the sheet.
    fn curve(&self, name: &str, (colour, dash): (usize, Dash), value: impl Fn(usize) -> Option<f64>) -> Curve {
        let point = |row: usize| {
            let y = (self.z[row] - self.bottom) / self.thickness;
            let x = value(row).filter(|_| (-0.05..=1.5).contains(&y))?;
            Some((x, y))
        };
        let points = (0..self.z.len()).map(point).filter(Option::is_some).collect();
        Curve { name: name.into(), points, colour, line: Some(dash), ..Curve::default() }
    }

    /// Stresses over that of the interface, solid fraction, flux and its integral over their largest values.
    fn repartition(&self, case: &str, tau_b: f64) -> Figure {
        let share = |quantity: &'static Quantity| {
            let largest = self.profile.range(quantity).map_or(1.0, |(_, high)| high.max(f64::MIN_POSITIVE));
            move |row: usize| Some(self.at(quantity, row)? / largest)
        };
        let over = |value: Option<f64>| value.map(|tau| tau / tau_b);
        let bed = |row: usize| self.z[row] < self.bottom + self.thickness;
        let stresses = vec![
            self.curve("mixture", (0, Dash::Dotted), |row| over(self.total(row))),
            self.curve("grains", (2, Dash::Dashed), |row| over(self.at(&quantity::TAU_PARTICLE, row))),
            self.curve("fluid", (1, Dash::Solid), |row| over(self.fluid(row))),
            self.curve("viscous", (3, Dash::DashDotted), |row| {
                over(self.at(&quantity::TAU_VISCOUS, row).filter(|_| bed(row)))
            }),
        ];
        let grains = vec![
            self.curve("flux", (2, Dash::Dashed), share(&quantity::FLUX)),
            self.curve("cumulative", (0, Dash::Solid), share(&quantity::CUMULATIVE_FLUX)),
        ];
        let fraction = vec![self.curve("", (1, Dash::Solid), |row| self.at(&quantity::PHI, row))];
        let panels = vec![
            Panel { x: Axis::linear("stress over that on the bed", ""), curves: stresses },
            Panel { x: Axis::linear("solid fraction φ", ""), curves: fraction },
            Panel { x: Axis::linear("flux over its maximum", ""), curves: grains },
        ];
        Figure {
            stem: "sheet".into(),
            caption: format!(
                "{case}: {} over the height in the sheet. At the bed level the flux jumps: below it grains lag behind the fluid, above it \
                 they move with it.",
                sentence(&panels)
            ),
            y: Axis::linear("height over the yield level, in δₛ", ""),
            panels,
            levels: vec![Level { y: 1.0, label: "bed level".into() }],
            tint_below: Some(1.0),
        }
    }

    /// The plane of the rearrangement times: free fall at St > 1 and r > 1, viscous at St < 1 and r > St, turbulent at r < 1
    /// and St > r.
    fn regimes(&self, case: &str, shields: f64) -> Option<Figure> {
        let moving = |row: &usize| self.z[*row] > self.bottom;
        let pair = |row: usize| Some((self.at(&quantity::RATIO_R, row)?, self.at(&quantity::STOKES, row)?));
        let points: Vec<_> = (0..self.z.len()).filter(moving).filter_map(pair).map(Some).collect();
        let cells = Curve { name: "cells".into(), points, colour: 2, marker: Some(Marker::Circle), ..Curve::default() };
        if cells.points.is_empty() {
            return None;
        }
        // The plane holds all cells and some of each region.
        let (mut left, mut right, mut low, mut high) = (0.1_f64, 10.0_f64, 0.1_f64, 100.0_f64);
        for (r, stokes) in cells.points.iter().flatten().filter(|(r, stokes)| *r > 0.0 && *stokes > 0.0) {
            (left, right, low, high) = (left.min(*r), right.max(*r), low.min(*stokes), high.max(*stokes));
        }
        let line = |name: &str, from: (f64, f64), to: (f64, f64)| Curve {
            name: name.into(),
            points: vec![Some(from), Some(to)],
            colour: 0,
            line: Some(Dash::Dashed),
            ..Curve::default()
        };
        let corner = left.max(low);
        let borders = [
            line("borders", (1.0, 1.0), (right, 1.0)),
            line("", (1.0, 1.0), (1.0, high)),
            line("", (corner, corner), (1.0, 1.0)),
        ];
        let middle = |a: f64, b: f64| (a * b).sqrt();
        let region =
            |text: &str, at: (f64, f64)| Curve { text: text.into(), points: vec![Some(at)], ..Curve::default() };
        let regions = [
            region("turbulent", (middle(left, 1.0), middle(1.0, high))),
            region("free fall", (middle(1.0, right), middle(1.0, high))),
            region("viscous", (middle(1.0, right), middle(low, 1.0))),
        ];
        Some(Figure {
            stem: "regimes".into(),
            caption: format!(
                "{case}: rearrangement of the moving grains at a Shields number of {}, free fall at the upper right, \
                 turbulent at the upper left, viscous below.",
                significant(shields, 3)
            ),
            y: Axis::log("Stokes number St", ""),
            panels: vec![Panel {
                x: Axis::log("rearrangement ratio r", ""),
                curves: borders.into_iter().chain(regions).chain([cells]).collect(),
            }],
            levels: Vec::new(),
            tint_below: None,
        })
    }
}
