//! The figures of a run, from its profile and its numbers.

use crate::result::quantity::{self, Quantity};
use crate::result::{Profile, Summary};
use crate::units::readable_unit;

use super::interface::Interface;
use crate::result::figure::sentence;
use crate::result::{Axis, Curve, Dash, Figure, Level, Panel, Scale};

/// Profiles over the elevation: velocities, shear stresses, solid fraction and flux, or what stands for them in a clear
/// flow; and, where turbulence over a wall spans decades of z, the velocity over log z. A quantity that the profile
/// does not have gets no panel, curves that coincide are drawn once.
pub(super) fn figures(profile: &Profile, summary: &Summary) -> Vec<Figure> {
    let drawing = Drawing::new(profile, summary);
    let mut figures = Vec::new();
    let mut panels: Vec<Panel> = [
        drawing.velocities(),
        drawing.stresses(),
        drawing.single("solid fraction φ", &quantity::PHI, GRAINS),
        drawing.single("flux φuₚ", &quantity::FLUX, GRAINS),
        drawing.single("T", &quantity::GRANULAR_TEMPERATURE, GRAINS),
    ]
    .into_iter()
    .flatten()
    .collect();
    let mut turbulence: Vec<Panel> = [
        drawing.single("mixing length", &quantity::MIXING_LENGTH, TURBULENCE),
        drawing.single("eddy viscosity", &quantity::EDDY_VISCOSITY, TURBULENCE),
    ]
    .into_iter()
    .flatten()
    .collect();
    // More than five panels side by side leave no room for their titles.
    if !drawing.has_grains {
        panels.append(&mut turbulence);
    }
    if !panels.is_empty() {
        figures.push(drawing.figure("profiles", panels, drawing.elevation()));
    }
    if !turbulence.is_empty() {
        figures.push(drawing.figure("turbulence", turbulence, drawing.elevation()));
    }
    if drawing.is_logarithmic()
        && let Some(velocities) = drawing.velocities()
    {
        let axis = Axis { ends: None, scale: Scale::Log, ..drawing.elevation() };
        figures.push(drawing.figure("velocity_log", vec![velocities], axis));
    }
    figures
}

/// How one kind of curve looks, the same in every panel.
#[derive(Clone, Copy)]
struct Pen(usize, Dash);

const WHOLE: Pen = Pen(0, Dash::Dotted);
const FLUID: Pen = Pen(1, Dash::Solid);
const GRAINS: Pen = Pen(2, Dash::Dashed);
const TURBULENCE: Pen = Pen(3, Dash::DashDotted);

struct Drawing<'a> {
    profile: &'a Profile,
    summary: &'a Summary,
    /// elevations \[m]
    z: Vec<f64>,
    /// readable unit of the elevation: factor from SI and symbol
    z_unit: (f64, &'static str),
    has_grains: bool,
}

impl<'a> Drawing<'a> {
    fn new(profile: &'a Profile, summary: &'a Summary) -> Self {
        let z = profile.axis();
        let highest = z.iter().fold(0.0_f64, |m, z| m.max(z.abs()));
        let has_grains = profile.range(&quantity::PHI).is_some_and(|(_, high)| high > 0.0);
        Self { profile, summary, z, z_unit: readable_unit(highest, "m"), has_grains }
    }

    /// A column that has at least one value.
    fn column(&self, quantity: &Quantity) -> Option<&'a [Option<f64>]> {
        self.profile.get(quantity).filter(|values| values.iter().any(Option::is_some))
    }

    fn result(&self, quantity: &Quantity) -> Option<f64> {
        self.summary.results.get(quantity.name)
    }

    /// The vertical axis, from the bottom to the upper wall or the free surface where these are known.
    fn elevation(&self) -> Axis {
        let factor = self.z_unit.0;
        let lowest = self.z.iter().fold(f64::INFINITY, |m, &z| m.min(z));
        let highest = self.z.iter().fold(f64::NEG_INFINITY, |m, &z| m.max(z));
        let top = self.result(&quantity::FLOW_HEIGHT).unwrap_or(highest).max(highest);
        // cell centres start half a cell above the bottom
        let bottom = if lowest >= 0.0 && lowest < 0.2 * top { 0.0 } else { lowest };
        Axis { ends: Some((bottom * factor, top * factor)), ..Axis::elevation(self.z_unit.1) }
    }

    fn figure(&self, stem: &str, panels: Vec<Panel>, y: Axis) -> Figure {
        let levels = self.levels();
        let (factor, unit) = self.z_unit;
        let mut caption = format!("{}: {} over the elevation z", self.summary.case, sentence(&panels));
        if y.scale == Scale::Log {
            caption += ", logarithmic";
        }
        for level in &levels {
            caption += &format!("; {} at {} {unit}", level.label, crate::units::significant(level.y, 4));
        }
        let tint_below = self.result(&quantity::BED_LEVEL).filter(|_| self.has_grains).map(|z| z * factor);
        Figure { stem: stem.into(), caption: caption + ".", y, panels, levels, tint_below }
    }

    /// Levels that the results name, each once.
    fn levels(&self) -> Vec<Level> {
        let mut found = Vec::new();
        if self.has_grains {
            found.push((self.result(&quantity::BED_LEVEL), "bed level"));
            found.push((self.result(&quantity::YIELD_LEVEL), "yield level"));
        }
        if let (Some(half), Some(height)) = (self.result(&quantity::HALF_PLUG), self.result(&quantity::FLOW_HEIGHT)) {
            found.push((Some(height / 2.0 + half), "edge of plug"));
            found.push((Some(height / 2.0 - half), "edge of plug"));
        }
        let mut levels: Vec<Level> = Vec::new();
        for (z, label) in found {
            let Some(y) = z.map(|z| z * self.z_unit.0) else { continue };
            if levels.iter().all(|level| level.y != y) {
                levels.push(Level { y, label: label.into() });
            }
        }
        levels
    }

    /// A flow over a wall, with turbulence, whose levels span more than two decades.
    fn is_logarithmic(&self) -> bool {
        let turbulent = self.column(&quantity::MIXING_LENGTH).or(self.column(&quantity::EDDY_VISCOSITY)).is_some();
        let (low, high) = self.z.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &z| (a.min(z), b.max(z)));
        turbulent && !self.has_grains && low > 0.0 && high > 100.0 * low
    }

    fn velocities(&self) -> Option<Panel> {
        let planes = self.column(&quantity::U_PLANES).map(<[_]>::to_vec);
        let whole = match (self.has_grains, planes.is_some()) {
            (true, _) => "mixture",
            (false, true) => "here",
            (false, false) => "",
        };
        let candidates = [
            (whole, &quantity::U_MIXTURE, WHOLE),
            ("fluid", &quantity::U_FLUID, FLUID),
            ("grains", &quantity::U_PARTICLE, GRAINS),
        ];
        let present: Vec<Line> = candidates
            .into_iter()
            .filter_map(|(name, q, pen)| Some(Line { name, pen, quantity: Some(q), values: self.column(q)?.to_vec() }))
            .collect();
        let mut lines = distinct(present);
        // The mixture lies between the two phases: where both are drawn it says nothing new.
        if lines.len() == candidates.len() {
            lines.remove(0);
        }
        lines.extend(planes.map(|values| Line {
            name: "between planes",
            pen: TURBULENCE,
            quantity: Some(&quantity::U_PLANES),
            values,
        }));
        self.panel("velocity", "m/s", lines)
    }

    fn stresses(&self) -> Option<Panel> {
        let carried = if self.has_grains { "grains" } else { "yield stress" };
        let candidates = [
            ("viscous", &quantity::TAU_VISCOUS, FLUID),
            ("Reynolds", &quantity::TAU_REYNOLDS, TURBULENCE),
            (carried, &quantity::TAU_PARTICLE, GRAINS),
        ];
        let present = candidates
            .into_iter()
            .filter_map(|(name, q, pen)| Some(Line { name, pen, quantity: Some(q), values: self.column(q)?.to_vec() }))
            .collect::<Vec<_>>();
        let mut lines: Vec<Line> = present.iter().filter(|l| l.largest() > 0.0).cloned().collect();
        if lines.is_empty() {
            lines = present.into_iter().take(1).collect();
        } else if lines.len() > 1 {
            let total = (0..self.z.len()).map(|row| self.total(row)).collect();
            lines.insert(0, Line { name: "total", pen: WHOLE, quantity: None, values: total });
        }
        self.panel("shear stress", "Pa", lines)
    }

    /// The sum of all stresses in a row. An undefined stress of the grains counts as zero only where there are no grains.
    fn total(&self, row: usize) -> Option<f64> {
        let at = |q: &Quantity| self.column(q).map(|values| values.get(row).copied().flatten());
        let no_grains = at(&quantity::PHI).is_none_or(|phi| phi == Some(0.0));
        let fluid = [&quantity::TAU_VISCOUS, &quantity::TAU_REYNOLDS];
        let mut sum = fluid.into_iter().filter_map(at).try_fold(0.0, |sum, tau| tau.map(|tau| sum + tau))?;
        match at(&quantity::TAU_PARTICLE) {
            Some(Some(tau)) => sum += tau,
            Some(None) if !no_grains => return None,
            _ => {}
        }
        Some(sum)
    }

    /// A panel of one quantity, unless it is zero everywhere.
    fn single(&self, title: &str, quantity: &'static Quantity, pen: Pen) -> Option<Panel> {
        let line = Line { name: "", pen, quantity: Some(quantity), values: self.column(quantity)?.to_vec() };
        if line.largest() == 0.0 { None } else { self.panel(title, quantity.unit, vec![line]) }
    }

    /// The two limits at the bed level of a quantity that jumps there.
    fn jump(&self, line: &Line) -> Option<(usize, f64, f64)> {
        let interface =
            Interface { bed: self.result(&quantity::BED_LEVEL)?, phi: self.result(&quantity::PHI_INTERFACE) };
        interface.jump(self.profile, line.quantity?)
    }

    /// A panel in a unit that suits its largest value; `None` without curves.
    fn panel(&self, title: &str, unit: &'static str, lines: Vec<Line>) -> Option<Panel> {
        let largest = lines.iter().map(Line::largest).fold(0.0, f64::max);
        let (factor, symbol) = readable_unit(largest, unit);
        let alone = lines.len() == 1;
        let curves: Vec<Curve> = lines
            .into_iter()
            .map(|line| {
                let at = |(z, x): (f64, Option<f64>)| x.map(|x| (x * factor, z * self.z_unit.0));
                let dash = if alone { Dash::Solid } else { line.pen.1 };
                let mut points: Vec<_> = self.z.iter().copied().zip(line.values.iter().copied()).map(at).collect();
                if let (Some((row, below, above)), Some(bed)) = (self.jump(&line), self.result(&quantity::BED_LEVEL)) {
                    points.splice(row..row, [at((bed, Some(below))), at((bed, Some(above)))]);
                }
                let known = line.quantity.and_then(|q| self.profile.errors(q)).filter(|e| e.len() == points.len());
                let errors = known.map_or_else(Vec::new, |e| e.iter().map(|e| e.map(|e| e * factor)).collect());
                let (name, colour) = (line.name.into(), line.pen.0);
                Curve { name, points, colour, line: Some(dash), errors, ..Curve::default() }
            })
            .collect();
        (!curves.is_empty()).then(|| Panel { x: Axis::linear(title, symbol), curves })
    }
}

/// A column on its way into a panel, in SI.
#[derive(Clone)]
struct Line {
    name: &'static str,
    pen: Pen,
    /// `None` for a sum
    quantity: Option<&'static Quantity>,
    values: Vec<Option<f64>>,
}

impl Line {
    fn largest(&self) -> f64 {
        self.values.iter().flatten().fold(0.0, |m, x| m.max(x.abs()))
    }

    /// Whether each of its values is one of `other`, to round-off.
    fn lies_on(&self, other: &Self) -> bool {
        let near = 1e-9 * self.largest().max(other.largest());
        self.values.iter().zip(&other.values).all(|(a, b)| match (a, b) {
            (None, _) => true,
            (Some(a), Some(b)) => (a - b).abs() <= near,
            (Some(_), None) => false,
        })
    }
}

/// The lines that do not lie on an earlier one.
fn distinct(lines: Vec<Line>) -> Vec<Line> {
    let mut kept: Vec<Line> = Vec::new();
    for line in lines {
        if !kept.iter().any(|k| line.lies_on(k)) {
            kept.push(line);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::super::{profile_figures, samples};
    use super::*;

    fn names(panel: &Panel) -> Vec<&str> {
        panel.curves.iter().map(|c| c.name.as_str()).collect()
    }

    #[test]
    fn coincident_velocities_are_drawn_once() {
        let (profile, summary) = samples::laminar_bed();
        let figures = profile_figures(&profile, &summary);
        assert_eq!(figures.len(), 1);
        assert_eq!(names(&figures[0].panels[0]), ["mixture"]);
        let (profile, summary) = samples::two_fluid_bed();
        assert_eq!(names(&profile_figures(&profile, &summary)[0].panels[0]), ["fluid", "grains"]);
    }

    #[test]
    fn a_laminar_bed_has_stresses_without_reynolds_and_their_total() {
        let (profile, summary) = samples::laminar_bed();
        let figure = &profile_figures(&profile, &summary)[0];
        let titles: Vec<&str> = figure.panels.iter().map(|p| p.x.title.as_str()).collect();
        assert_eq!(titles, ["velocity", "shear stress", "solid fraction φ", "flux φuₚ"]);
        assert_eq!(names(&figure.panels[1]), ["total", "viscous", "grains"]);
        let [total, viscous, grains] = [0, 1, 2].map(|i| figure.panels[1].curves[i].points[90].unwrap().0);
        assert!((total - viscous - grains).abs() < 1e-12 * total.abs());
        assert_eq!(figure.y.ends, Some((0.0, 65.0)));
        assert_eq!(figure.levels.iter().map(|l| l.label.as_str()).collect::<Vec<_>>(), ["bed level", "yield level"]);
        assert!(figure.tint_below.is_some_and(|z| (z - 32.24).abs() < 1e-9));
    }

    #[test]
    fn the_solid_fraction_steps_at_the_bed_level() {
        let (profile, summary) = samples::laminar_bed();
        let figure = &profile_figures(&profile, &summary)[0];
        let bed = figure.tint_below.unwrap();
        let at_bed = |panel: usize| -> Vec<f64> {
            let points = figure.panels[panel].curves[0].points.iter().flatten();
            points.filter(|p| (p.1 - bed).abs() < 1e-9).map(|p| p.0).collect()
        };
        assert_eq!(at_bed(2), [0.6, 0.0]);
        let flux = at_bed(3);
        assert_eq!(flux.len(), 2);
        assert!(flux[0] > 0.0 && flux[1] == 0.0);
        let heights: Vec<f64> = figure.panels[2].curves[0].points.iter().flatten().map(|p| p.1).collect();
        assert!(heights.windows(2).all(|w| w[0] <= w[1]));
    }

    #[test]
    fn what_is_undefined_breaks_the_line_and_the_total() {
        let (profile, summary) = samples::two_fluid_bed();
        let figure = &profile_figures(&profile, &summary)[0];
        let grains = &figure.panels[0].curves[1];
        assert!(grains.points.last().unwrap().is_none());
        assert!(grains.points.first().unwrap().is_some());
        let mut profile = Profile::new(vec![0.5, 1.5]).unwrap();
        profile.push(&quantity::PHI, vec![Some(0.6), Some(0.0)]).unwrap();
        profile.push(&quantity::TAU_VISCOUS, vec![Some(1.0), Some(2.0)]).unwrap();
        profile.push(&quantity::TAU_PARTICLE, vec![None, None]).unwrap();
        let drawing = Drawing::new(&profile, &summary);
        assert_eq!((drawing.total(0), drawing.total(1)), (Some(1.0), Some(2.0)));
        profile.push(&quantity::TAU_REYNOLDS, vec![Some(1.0), None]).unwrap();
        assert_eq!(Drawing::new(&profile, &summary).total(1), None);
    }

    #[test]
    fn a_wall_flow_over_decades_also_gets_a_logarithmic_elevation() {
        let (profile, summary) = samples::log_law();
        let figures = profile_figures(&profile, &summary);
        assert_eq!(figures.iter().map(|f| f.stem.as_str()).collect::<Vec<_>>(), ["profiles", "velocity_log"]);
        assert_eq!(figures[1].y.scale, Scale::Log);
        assert_eq!(figures[0].tint_below, None);
        let (profile, summary) = samples::bingham_plane();
        let figures = profile_figures(&profile, &summary);
        assert_eq!(figures.len(), 1);
        assert_eq!(figures[0].levels.iter().map(|l| l.label.as_str()).collect::<Vec<_>>(), ["edge of plug"; 2]);
    }

    #[test]
    fn nothing_moving_still_gives_a_figure() {
        let mut profile = Profile::new(vec![0.1, 0.2]).unwrap();
        profile.push(&quantity::U_FLUID, vec![Some(0.0), Some(0.0)]).unwrap();
        profile.push(&quantity::TAU_REYNOLDS, vec![Some(0.0), None]).unwrap();
        profile.push(&quantity::FLUX, vec![Some(0.0), Some(0.0)]).unwrap();
        let (_, summary) = samples::laminar_bed();
        let figures = profile_figures(&profile, &summary);
        assert_eq!(figures[0].panels.len(), 2);
        assert!(profile_figures(&Profile::new(vec![0.1]).unwrap(), &summary).is_empty());
    }
}
