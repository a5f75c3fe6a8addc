//! Figures of what a coupled flow says of kinetic theory, from the columns of its profile (`theory.rs`).
//!
//! The content of figures 4 to 7 and 10 to 12 of Chassagne et al. (2023); figure 2 is that of the profiles and of the budget.

use super::theory::{Assessment, Measured};
use crate::closures::kinetic::radial::PHI_MAX;
use crate::closures::kinetic::{Inertial, PHI_C};
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Axis, Curve, Dash, Figure, Marker, Panel, Profile};

/// Points that are drawn of the grains.
const POINTS: usize = 70;

type Grains<'a> = (&'a str, Marker, &'a dyn Fn(usize) -> Measured);
type Law<'a> = (&'a str, Dash, &'a dyn Fn(usize) -> Option<f64>);

/// The figures of the run `name`; none where too few levels have grains that move.
pub(super) fn figures(name: &str, profile: &Profile) -> Vec<Figure> {
    let drawing = Drawing { grains: Assessment::of(profile) };
    let rows = drawing.grains.rows();
    if rows.len() < 5 {
        return Vec::new();
    }
    [drawing.laws(name, &rows), drawing.rheology(name, &rows)].into_iter().flatten().collect()
}

struct Drawing<'a> {
    grains: Assessment<'a>,
}

impl Drawing<'_> {
    /// A panel over the column `y`; none where the run did not keep what it takes.
    fn panel(
        &self,
        (rows, y): (&[usize], &Quantity),
        x: Axis,
        grains: &[Grains<'_>],
        laws: &[Law<'_>],
    ) -> Option<Panel> {
        let every = rows.len().div_ceil(POINTS);
        let mut curves: Vec<Curve> = Vec::new();
        // Lines along the axis, not along the elevation: the solid fraction of a layered bed goes to and fro.
        let mut along: Vec<(usize, f64)> =
            rows.iter().step_by(every).filter_map(|&row| Some((row, self.grains.at(y, row)?))).collect();
        along.sort_by(|a, b| a.1.total_cmp(&b.1));
        for (colour, (name, dash, of)) in laws.iter().enumerate() {
            let points = along.iter().map(|&(row, y)| Some((of(row)?, y))).collect();
            curves.push(Curve { name: (*name).into(), points, colour, line: Some(*dash), ..Curve::default() });
        }
        for (colour, (name, marker, of)) in grains.iter().enumerate() {
            let known: Vec<(Measured, Option<f64>)> =
                rows.iter().step_by(every).map(|&row| (of(row), self.grains.at(y, row))).collect();
            if known.iter().all(|(x, _)| x.is_none()) {
                continue;
            }
            let points = known.iter().map(|(x, y)| Some(((*x)?.0, (*y)?))).collect();
            let errors = known.iter().map(|(x, _)| (*x)?.1).collect();
            let (name, marker) = ((*name).into(), Some(*marker));
            curves.push(Curve { name, points, colour: 2 + colour, marker, errors, ..Curve::default() });
        }
        (curves.len() > laws.len()).then_some(Panel { x, curves })
    }

    /// The coefficients over the solid fraction.
    fn laws(&self, case: &str, rows: &[usize]) -> Option<Figure> {
        let panel = |title, measured: &[(&str, Marker, &Quantity)], laws: [(&str, Dash, &Quantity); 2]| {
            let [new, old] = laws.map(|(name, dash, column)| (name, dash, move |row| self.grains.at(column, row)));
            let laws: [Law<'_>; 2] = [(new.0, new.1, &new.2), (old.0, old.1, &old.2)];
            let means: Vec<_> =
                measured.iter().map(|(_, _, column)| move |row| self.grains.mean(column, row)).collect();
            let grains: Vec<Grains<'_>> = measured
                .iter()
                .zip(&means)
                .map(|((name, marker, _), of)| -> Grains<'_> { (name, *marker, of) })
                .collect();
            self.panel((rows, &q::PHI), Axis::log(title, ""), &grains, &laws)
        };
        let (solid, dashed, circle) = (Dash::Solid, Dash::Dashed, Marker::Circle);
        let panels: Vec<Panel> = [
            panel(
                "g₀",
                &[("grains", circle, &q::RADIAL)],
                [("with friction", solid, &q::RADIAL_THEORY), ("smooth", dashed, &q::RADIAL_CLASSICAL)],
            ),
            panel(
                "viscosity F₂",
                &[("", circle, &q::VISCOSITY_FACTOR)],
                [
                    ("saltation", solid, &q::VISCOSITY_FACTOR_THEORY),
                    ("classical", dashed, &q::VISCOSITY_FACTOR_CLASSICAL),
                ],
            ),
            panel(
                "conductivity F₃",
                &[("", circle, &q::CONDUCTIVITY_FACTOR)],
                [
                    ("saltation", solid, &q::CONDUCTIVITY_FACTOR_THEORY),
                    ("classical", dashed, &q::CONDUCTIVITY_FACTOR_CLASSICAL),
                ],
            ),
            panel(
                "contacts F₄",
                &[("budget", circle, &q::CONTACT_FACTOR), ("power", Marker::Square, &q::CONTACT_FACTOR_DIRECT)],
                [("e_eff", solid, &q::CONTACT_FACTOR_THEORY), ("e", dashed, &q::CONTACT_FACTOR_CLASSICAL)],
            ),
            panel(
                "drag work",
                &[("", circle, &q::DRAG_FACTOR)],
                [("quadratic", solid, &q::DRAG_FACTOR_THEORY), ("linear", dashed, &q::DRAG_FACTOR_CLASSICAL)],
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let y = Axis { ends: Some((0.0, PHI_MAX)), ..Axis::linear("solid fraction φ", "") };
        let what = "coefficients of kinetic theory from the grains, with standard errors, and its laws at their state";
        (!panels.is_empty())
            .then(|| figure("assessment", format!("{case}: {what}, over the solid fraction φ."), y, panels))
    }

    /// Friction and solid fraction over the inertial number.
    fn rheology(&self, case: &str, rows: &[usize]) -> Option<Figure> {
        let dense = Inertial::default();
        let of = (rows, &q::INERTIAL_NUMBER);
        let i = |row| self.grains.at(&q::INERTIAL_NUMBER, row);
        let friction = |row: usize| {
            let (p, spread) = self.grains.mean(&q::P_PARTICLE, row)?;
            Assessment::over(self.grains.mean(&q::TAU_PARTICLE, row), Some(p), Some((p, spread)), 1.0)
        };
        let panels: Vec<Panel> = [
            self.panel(
                of,
                Axis::linear("friction τₚ/Pₚ", ""),
                &[("grains", Marker::Circle, &friction)],
                &[("μ(I)", Dash::DashDotted, &|row| i(row).map(|i| dense.mu(i)))],
            ),
            self.panel(
                of,
                Axis::linear("solid fraction φ", ""),
                &[("", Marker::Circle, &|row| self.grains.mean(&q::PHI, row))],
                &[("φ(I)", Dash::DashDotted, &|row| i(row).map(|i| PHI_C / (1.0 + dense.b * i)))],
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let caption = format!(
            "{case}: friction and solid fraction of the grains, with standard errors, and the dense rheology, over the inertial number I."
        );
        (!panels.is_empty()).then(|| figure("assessment_rheology", caption, Axis::log("inertial number I", ""), panels))
    }
}

fn figure(stem: &str, caption: String, y: Axis, panels: Vec<Panel>) -> Figure {
    Figure { stem: stem.into(), caption, y, panels, levels: Vec::new(), tint_below: None }
}
