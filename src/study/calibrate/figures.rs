//! What a fit looks like: data and model before and after, and what is left between them.

use super::assessment::Found;
use super::{Column, Target};
use crate::plot::{Trace, shared_figures};
use crate::result::Profile;
use crate::result::quantity;
use crate::result::{Axis, Curve, Dash, Figure, Marker, Panel};
use crate::study::Row;
use crate::units::readable_unit;

/// Panels of one figure.
const PANELS: usize = 4;

impl Found {
    /// Data and model before and after, and the residuals of both.
    pub(super) fn figures(&self, rows: &[Row]) -> Vec<Figure> {
        let profiles: Vec<(&str, Profile)> = rows
            .iter()
            .filter_map(|row| Some((row.point.series.as_str(), self.reduced(row.profile.as_ref()?)?)))
            .collect();
        let Some(data) = self.reduced(&self.data.profile) else { return Vec::new() };
        let bed = rows.last().and_then(|row| row.result(quantity::BED_LEVEL.name));
        let errors = self.data.errors.clone().or_else(|| self.data.profile.standard_errors());
        let trace =
            |name, profile, measured: bool, errors| Trace { name, profile, errors, measured, bed, phi_interface: None };
        let mut traces = vec![trace(self.data.name.as_str(), &data, true, errors.as_ref())];
        traces.extend(profiles.iter().map(|(name, profile)| trace(name, profile, false, None)));
        let mut figures = shared_figures(&traces, None, None);
        let pages = self.target.columns.chunks(PANELS).enumerate();
        figures.extend(pages.map(|(i, columns)| self.residual_figure(i, columns, &profiles)));
        figures
    }

    /// The columns that are fitted, and nothing else.
    fn reduced(&self, profile: &Profile) -> Option<Profile> {
        let mut reduced = Profile::new(profile.axis()).ok()?;
        for quantity in self.target.columns.iter().map(|c| c.quantity) {
            reduced.push(quantity, profile.get(quantity)?.to_vec()).ok()?;
        }
        Some(reduced)
    }

    fn residual_figure(&self, page: usize, columns: &[Column], profiles: &[(&str, Profile)]) -> Figure {
        let highest = columns.iter().flat_map(|c| &c.levels).fold(0.0_f64, |m, level| m.max(level.z.abs()));
        let (factor, unit) = readable_unit(highest, quantity::Z.unit);
        let unit_of = if self.target.known { "σ" } else { "of the largest" };
        let panel = |(k, column): (usize, &Column)| {
            let of = |(i, (name, profile)): (usize, &(&str, Profile))| {
                let one = Target { columns: vec![column.clone()], known: self.target.known };
                let residuals = one.residuals(profile).unwrap_or_default();
                Curve {
                    name: if k == 0 { (*name).into() } else { String::new() },
                    points: residuals
                        .iter()
                        .zip(&column.levels)
                        .map(|(r, level)| Some((*r, level.z * factor)))
                        .collect(),
                    colour: i + 1,
                    marker: Some([Marker::Square, Marker::Triangle][i % 2]),
                    ..Curve::default()
                }
            };
            let zero =
                [column.levels.first(), column.levels.last()].map(|level| level.map(|level| (0.0, level.z * factor)));
            let name = if k == 0 { "zero".into() } else { String::new() };
            let zero = Curve { name, points: zero.into(), line: Some(Dash::Dotted), ..Curve::default() };
            let curves = std::iter::once(zero).chain(profiles.iter().enumerate().map(of)).collect();
            Panel { x: Axis::linear(&format!("residual of the {}", column.quantity.title), unit_of), curves }
        };
        Figure {
            stem: if page == 0 { "residuals".into() } else { format!("residuals_{}", page + 1) },
            caption: "Model less data before the fit and after it, over the elevation z.".into(),
            y: Axis::linear("elevation z", unit),
            panels: columns.iter().enumerate().map(panel).collect(),
            levels: Vec::new(),
            tint_below: None,
        }
    }
}
