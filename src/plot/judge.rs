//! Grains as the judge of kinetic theory: what a coupled flow says of each of its laws, beside the laws themselves.
//!
//! | panel | from the grains | laws at their state |
//! |---|---|---|
//! | radial distribution | `g₀ = (p/(ρ_p φ T) - 1)/(2 φ (1 + e))` | with and without friction |
//! | viscosity | `F₂ = τ_p/(ρ_p d T^½ |du_p/dz|)` | with and without saltation |
//! | conductivity | `F₃ = -q/(ρ_p d T^½ dT/dz)` | with and without saltation |
//! | contacts | `F₄ = d/(ρ_p T^(3/2))` times what the budget leaves | with e_eff and with e |
//! | drag | `d/(ρ_p T^(3/2))` times its work on the fluctuations | quadratic and linear |
//!
//! The content of figures 4 to 7 and 10 to 12 of Chassagne et al. (2023); figure 2 is that of the profiles and of the budget.

use super::kinetic::PHI_C;
use super::{Axis, Curve, Dash, Figure, Marker, Panel};
use crate::closures::kinetic::radial::PHI_MAX;
use crate::closures::kinetic::{FrictionalCollisional, GarzoDufty, Inertial, Kinetic};
use crate::model::Problem;
use crate::models::coupled::Coupled;
use crate::result::Profile;
use crate::result::quantity::{self as q, Quantity};

/// Solid fractions and inertial numbers at which grains are asked: a few that fly by, and those at rest, have nothing to say.
const PHI: (f64, f64) = (3e-3, 0.995 * PHI_MAX);
const INERTIAL: (f64, f64) = (1e-3, 1e2);
/// Points that are drawn of the grains.
const POINTS: usize = 70;

/// A number of the grains and its standard error.
type Measured = Option<(f64, Option<f64>)>;
type Seen<'a> = (&'a str, Marker, &'a dyn Fn(usize) -> Measured);
type Law<'a> = (&'a str, Dash, &'a dyn Fn(usize) -> Option<f64>);

/// The figures of a coupled flow; none of any other.
#[must_use]
pub fn judge_figures(profile: &Profile, problem: &Problem) -> Vec<Figure> {
    let Some(flow) = problem.get::<Coupled>() else { return Vec::new() };
    let (e, mu_p) = (flow.bed.contact.e_n, flow.bed.contact.mu);
    let judge = Judge {
        profile,
        flow,
        z: profile.axis(),
        proposed: FrictionalCollisional::default().kinetic(e, mu_p),
        classical: GarzoDufty::default().kinetic(e, mu_p),
    };
    let rows: Vec<usize> = (0..judge.z.len()).filter(|&row| judge.asked(row)).collect();
    if rows.len() < 5 {
        return Vec::new();
    }
    [judge.laws(&problem.name, &rows), judge.rheology(&problem.name, &rows)].into_iter().flatten().collect()
}

struct Judge<'a> {
    profile: &'a Profile,
    flow: &'a Coupled,
    z: Vec<f64>,
    proposed: Kinetic,
    classical: Kinetic,
}

impl Judge<'_> {
    fn at(&self, quantity: &Quantity, row: usize) -> Option<f64> {
        self.profile.get(quantity)?.get(row).copied().flatten()
    }

    /// A column and its standard error.
    fn mean(&self, quantity: &Quantity, row: usize) -> Measured {
        let error = q::find(q::COLUMNS, &format!("{}_stderr", quantity.name));
        Some((self.at(quantity, row)?, error.and_then(|error| self.at(error, row))))
    }

    fn asked(&self, row: usize) -> bool {
        let within = |quantity, (low, high)| self.at(quantity, row).is_some_and(|x| (low..high).contains(&x));
        within(&q::PHI, PHI) && within(&q::INERTIAL_NUMBER, INERTIAL) && within(&q::GRANULAR_TEMPERATURE, (1e-12, 1e12))
    }

    /// Slope over one diameter.
    fn slope(&self, quantity: &Quantity, row: usize) -> Option<f64> {
        let dz = self.z.get(1)? - self.z[0];
        let half = ((0.5 * self.flow.bed.d / dz).round() as usize).max(1);
        let (below, above) = (row.checked_sub(half)?, row + half);
        Some((self.at(quantity, above)? - self.at(quantity, below)?) / (self.z.get(above)? - self.z[below]))
    }

    /// `x/(y scale)` with the relative errors of x and, to the power `n`, of T.
    fn over(x: Measured, below: Option<f64>, t: Measured, n: f64) -> Measured {
        let ((x, error), below, (t, spread)) = (x?, below?, t?);
        let share = (error.unwrap_or(0.0) / x).hypot(n * spread.unwrap_or(0.0) / t).abs();
        Some((x / below, Some(share * (x / below).abs())))
    }

    /// `g_0` from the pressure: eq. (3.1), of the means where the run did not keep it by blocks.
    fn radial(&self, row: usize) -> Measured {
        if let Some(known) = self.mean(&q::RADIAL, row) {
            return Some(known);
        }
        let (phi, t, e) = (self.at(&q::PHI, row)?, self.mean(&q::GRANULAR_TEMPERATURE, row), self.proposed.e);
        let below = self.flow.bed.rho_p * phi * t?.0;
        let (ratio, error) = Self::over(self.mean(&q::P_PARTICLE, row), Some(below), t, 1.0)?;
        let per = 2.0 * phi * (1.0 + e);
        Some(((ratio - 1.0) / per, error.map(|error| error / per)))
    }

    fn viscosity(&self, row: usize) -> Measured {
        let t = self.mean(&q::GRANULAR_TEMPERATURE, row);
        let below = self.flow.bed.rho_p * self.flow.bed.d * t?.0.sqrt() * self.at(&q::SHEAR_RATE, row)?;
        Self::over(self.mean(&q::TAU_PARTICLE, row), Some(below), t, 0.5)
    }

    fn conductivity(&self, row: usize) -> Measured {
        let t = self.mean(&q::GRANULAR_TEMPERATURE, row);
        let slope = self.slope(&q::GRANULAR_TEMPERATURE, row)?;
        let below = -self.flow.bed.rho_p * self.flow.bed.d * t?.0.sqrt() * slope;
        Self::over(self.mean(&q::FLUCTUATION_FLUX, row), Some(below), t, 0.5)
    }

    /// A loss over `ρ_p T^(3/2)/d`.
    fn loss(&self, quantity: &Quantity, row: usize) -> Measured {
        let t = self.mean(&q::GRANULAR_TEMPERATURE, row);
        let below = self.flow.bed.rho_p / self.flow.bed.d * t?.0.powf(1.5);
        Self::over(self.mean(quantity, row), Some(below), t, 1.5)
    }

    /// `K d/ρ_p` [m/s] and `C_∞/C_D` of the mean slip.
    fn drag(&self, row: usize) -> Option<(f64, f64)> {
        let slip = (self.at(&q::U_FLUID, row)? - self.at(&q::U_PARTICLE, row)?).abs();
        let viscous = self.flow.drag.viscous(self.flow.nu(), self.flow.bed.d);
        let (k, share) = self.flow.drag.per_volume(self.at(&q::PHI, row)?, slip, viscous);
        Some((k * self.flow.rho_f / self.flow.bed.rho_p, share))
    }

    fn law<T>(&self, row: usize, of: impl Fn(f64, f64, f64) -> T) -> Option<T> {
        let phi = self.at(&q::PHI, row)?;
        Some(of(phi, PHI_MAX - phi, self.at(&q::GRANULAR_TEMPERATURE, row)?.sqrt()))
    }

    fn transport(&self, theory: Kinetic, row: usize) -> Option<(f64, f64)> {
        let (k, _) = self.drag(row)?;
        self.law(row, |phi, gap, root| theory.transport(phi, gap, root, k))
    }

    fn drag_work(&self, theory: Kinetic, row: usize) -> Option<f64> {
        let (k, share) = self.drag(row)?;
        self.law(row, |phi, _, root| theory.drag_work.factor(share) * phi * (1.0 - phi) * k / root)
    }

    /// A panel over the solid fraction; none where the run did not keep what it takes.
    fn panel(&self, (rows, y): (&[usize], &Quantity), x: Axis, grains: &[Seen<'_>], laws: &[Law<'_>]) -> Option<Panel> {
        let every = rows.len().div_ceil(POINTS);
        let mut curves: Vec<Curve> = Vec::new();
        // Lines along the axis, not along the elevation: the solid fraction of a layered bed goes to and fro.
        let mut along: Vec<(usize, f64)> =
            rows.iter().step_by(every).filter_map(|&row| Some((row, self.at(y, row)?))).collect();
        along.sort_by(|a, b| a.1.total_cmp(&b.1));
        for (colour, (name, dash, of)) in laws.iter().enumerate() {
            let points = along.iter().map(|&(row, y)| Some((of(row)?, y))).collect();
            curves.push(Curve { name: (*name).into(), points, colour, line: Some(*dash), ..Curve::default() });
        }
        for (colour, (name, marker, of)) in grains.iter().enumerate() {
            let seen: Vec<(Measured, Option<f64>)> =
                rows.iter().step_by(every).map(|&row| (of(row), self.at(y, row))).collect();
            if seen.iter().all(|(x, _)| x.is_none()) {
                continue;
            }
            let points = seen.iter().map(|(x, y)| Some(((*x)?.0, (*y)?))).collect();
            let errors = seen.iter().map(|(x, _)| (*x)?.1).collect();
            let (name, marker) = ((*name).into(), Some(*marker));
            curves.push(Curve { name, points, colour: 2 + colour, marker, errors, ..Curve::default() });
        }
        (curves.len() > laws.len()).then_some(Panel { x, curves })
    }

    /// The coefficients over the solid fraction.
    fn laws(&self, case: &str, rows: &[usize]) -> Option<Figure> {
        let (new, old) = (self.proposed, self.classical);
        let of = (rows, &q::PHI);
        let (solid, dashed, circle) = (Dash::Solid, Dash::Dashed, Marker::Circle);
        let radial = |theory: Kinetic, row| self.law(row, |phi, gap, _| theory.radial.contact(phi, gap, theory.a));
        let loss = |theory: Kinetic, row| self.law(row, |phi, gap, _| phi * theory.dissipation_per_grain(phi, gap));
        let panels: Vec<Panel> = [
            self.panel(
                of,
                Axis::log("g₀", ""),
                &[("grains", circle, &|row| self.radial(row))],
                &[("with friction", solid, &|row| radial(new, row)), ("smooth", dashed, &|row| radial(old, row))],
            ),
            self.panel(
                of,
                Axis::log("viscosity F₂", ""),
                &[("", circle, &|row| self.viscosity(row))],
                &[
                    ("saltation", solid, &|row| self.transport(new, row).map(|(eta, _)| eta)),
                    ("classical", dashed, &|row| self.transport(old, row).map(|(eta, _)| eta)),
                ],
            ),
            self.panel(
                of,
                Axis::log("conductivity F₃", ""),
                &[("", circle, &|row| self.conductivity(row))],
                &[
                    ("saltation", solid, &|row| self.transport(new, row).map(|(_, kappa)| kappa)),
                    ("classical", dashed, &|row| self.transport(old, row).map(|(_, kappa)| kappa)),
                ],
            ),
            self.panel(
                of,
                Axis::log("contacts F₄", ""),
                &[
                    ("budget", circle, &|row| self.loss(&q::CONTACT_LOSS, row)),
                    ("power", Marker::Square, &|row| self.loss(&q::CONTACT_LOSS_DIRECT, row)),
                ],
                &[("e_eff", solid, &|row| loss(new, row)), ("e", dashed, &|row| loss(old, row))],
            ),
            self.panel(
                of,
                Axis::log("drag work", ""),
                &[("", circle, &|row| self.loss(&q::DRAG_LOSS, row))],
                &[
                    ("quadratic", solid, &|row| self.drag_work(new, row)),
                    ("linear", dashed, &|row| self.drag_work(old, row)),
                ],
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let y = Axis { ends: Some((0.0, PHI_MAX)), ..Axis::linear("solid fraction φ", "") };
        let what = "coefficients of kinetic theory from the grains, with standard errors, and its laws at their state";
        (!panels.is_empty()).then(|| figure("judge", format!("{case}: {what}, over the solid fraction φ."), y, panels))
    }

    /// Friction and solid fraction over the inertial number.
    fn rheology(&self, case: &str, rows: &[usize]) -> Option<Figure> {
        let dense = Inertial::default();
        let of = (rows, &q::INERTIAL_NUMBER);
        let i = |row| self.at(&q::INERTIAL_NUMBER, row);
        let friction = |row: usize| {
            let (p, spread) = self.mean(&q::P_PARTICLE, row)?;
            Self::over(self.mean(&q::TAU_PARTICLE, row), Some(p), Some((p, spread)), 1.0)
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
                &[("", Marker::Circle, &|row| self.mean(&q::PHI, row))],
                &[("φ(I)", Dash::DashDotted, &|row| i(row).map(|i| PHI_C / (1.0 + dense.b * i)))],
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let caption = format!(
            "{case}: friction and solid fraction of the grains, with standard errors, and the dense rheology, over the inertial number I."
        );
        (!panels.is_empty()).then(|| figure("judge_rheology", caption, Axis::log("inertial number I", ""), panels))
    }
}

fn figure(stem: &str, caption: String, y: Axis, panels: Vec<Panel>) -> Figure {
    Figure { stem: stem.into(), caption, y, panels, levels: Vec::new(), tint_below: None }
}
