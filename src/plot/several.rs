//! Several profiles on the same axes: lines for models, markers with error bars for measurements.

use crate::result::Profile;
use crate::result::quantity::{self, COLUMNS, Quantity};
use crate::units::readable_unit;

use super::interface::Interface;
use crate::result::figure::sentence;
use crate::result::{Axis, Curve, Dash, Figure, Level, Marker, Panel};

/// One profile among several.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// its name in the legend
    pub name: &'a str,
    /// columns over the elevation
    pub profile: &'a Profile,
    /// one sigma of some columns, on the same levels: error bars
    pub errors: Option<&'a Profile>,
    /// whether the values were measured: markers instead of a line, unless there are very many
    pub measured: bool,
    /// bed level, where it is known
    pub bed: Option<f64>,
    /// solid fraction just below it, where it is known
    pub phi_interface: Option<f64>,
}

/// Measurements at more levels than this are drawn as a line: their markers would run into a band.
const MARKERS: usize = 80;
/// Panels side by side in one figure.
const PANELS: usize = 4;

/// Columns of the first figure: of each group the one that most traces have, the first of equals.
const FIRST: [&[&Quantity]; PANELS] = [
    &[&quantity::U_MIXTURE, &quantity::U_FLUID, &quantity::U_PARTICLE],
    &[&quantity::TAU_REYNOLDS, &quantity::TAU_VISCOUS, &quantity::TAU_PARTICLE],
    &[&quantity::PHI],
    &[&quantity::FLUX],
];

/// Figures of `traces` over one elevation, the first being the reference, whose bed is tinted: velocity, shear stress,
/// solid fraction and flux, then every other column that two or more share, four panels to a figure. Each trace has one
/// colour with one dash or marker in all of them; the legend stands in the first panel. `top` is the upper wall or free
/// surface, where it is known; `scaled` gives the unit of a column that is not in SI.
#[must_use]
pub fn shared_figures(
    traces: &[Trace<'_>],
    top: Option<f64>,
    scaled: Option<fn(&Quantity) -> &'static str>,
) -> Vec<Figure> {
    let drawing = Drawing { traces, top, scaled };
    let first: Vec<&'static Quantity> = FIRST.iter().filter_map(|group| drawing.most_shared(group)).collect();
    let others = COLUMNS.iter().copied().skip(1).filter(|q| !first.contains(q) && drawing.holders(q) > 1);
    let others: Vec<&'static Quantity> = others.collect();
    let pages = std::iter::once(("profiles".to_owned(), first.as_slice()))
        .chain(others.chunks(PANELS).enumerate().map(|(i, q)| (format!("profiles_{}", i + 2), q)));
    pages.filter(|(_, columns)| !columns.is_empty()).map(|(stem, columns)| drawing.figure(stem, columns)).collect()
}

struct Drawing<'a> {
    traces: &'a [Trace<'a>],
    top: Option<f64>,
    scaled: Option<fn(&Quantity) -> &'static str>,
}

impl Trace<'_> {
    fn is_marked(&self) -> bool {
        self.measured && self.profile.rows() <= MARKERS
    }
}

impl Drawing<'_> {
    /// The marker of trace `i`: another one for each that is marked.
    fn marker(&self, i: usize) -> Marker {
        let before = self.traces.iter().take(i).filter(|t| t.is_marked()).count();
        [Marker::Circle, Marker::Square, Marker::Triangle][before % 3]
    }

    /// How many traces have a value of the column that is not zero, or none if all of them are zero.
    fn holders(&self, quantity: &Quantity) -> usize {
        let present = self.traces.iter().filter(|t| t.profile.range(quantity).is_some());
        if self.largest(quantity) > 0.0 { present.count() } else { 0 }
    }

    fn largest(&self, quantity: &Quantity) -> f64 {
        let ranges = self.traces.iter().filter_map(|t| t.profile.range(quantity));
        ranges.fold(0.0, |m, (low, high)| m.max(low.abs()).max(high.abs()))
    }

    fn most_shared(&self, group: &[&'static Quantity]) -> Option<&'static Quantity> {
        // the last of equals is the largest: hence from the end
        let best = group.iter().rev().max_by_key(|q| self.holders(q))?;
        (self.holders(best) > 1).then_some(best)
    }

    /// Factor from the values to the axis, and the unit there.
    fn unit(&self, quantity: &'static Quantity) -> (f64, &'static str) {
        match self.scaled {
            Some(unit) => (1.0, unit(quantity)),
            None => readable_unit(self.largest(quantity), quantity.unit),
        }
    }

    fn figure(&self, stem: String, columns: &[&'static Quantity]) -> Figure {
        let (factor, unit) = self.unit(&quantity::Z);
        let panels: Vec<Panel> = columns.iter().enumerate().map(|(i, q)| self.panel(q, factor, i == 0)).collect();
        let names: Vec<&str> = self.traces.iter().map(|t| t.name).collect();
        let bed = self.traces.first().and_then(|t| t.bed).map(|z| z * factor);
        let levels: Vec<Level> = bed.map(|y| Level { y, label: self.bed_label().into() }).into_iter().collect();
        let mut caption = format!("{} over the elevation z: {}", sentence(&panels), names.join(", "));
        for level in &levels {
            caption += &format!("; {} at {} {unit}", level.label, crate::units::significant(level.y, 4));
        }
        let y = Axis { ends: self.ends().map(|(a, b)| (a * factor, b * factor)), ..Axis::elevation(unit) };
        Figure { stem, caption: caption + ".", y, panels, levels, tint_below: bed }
    }

    /// Whether the bed that is drawn is that of all who have one.
    fn bed_label(&self) -> &'static str {
        let beds: Vec<f64> = self.traces.iter().filter_map(|t| t.bed).collect();
        let (low, high) = beds.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &z| (a.min(z), b.max(z)));
        if high - low <= 1e-2 * high.abs().max(low.abs()) { "bed level" } else { "reference bed" }
    }

    /// From the bottom to the upper wall or free surface, where these lie near the data.
    fn ends(&self) -> Option<(f64, f64)> {
        let ranges: Vec<(f64, f64)> = self.traces.iter().filter_map(|t| t.profile.range(&quantity::Z)).collect();
        let lowest = ranges.iter().map(|r| r.0).reduce(f64::min)?;
        let highest = ranges.iter().map(|r| r.1).reduce(f64::max)?;
        let top = self.top.map_or(highest, |top| top.max(highest));
        Some((if lowest >= 0.0 && lowest < 0.2 * top { 0.0 } else { lowest }, top))
    }

    fn panel(&self, quantity: &'static Quantity, z_factor: f64, named: bool) -> Panel {
        let (factor, unit) = self.unit(quantity);
        let mut curves = Vec::new();
        for (i, trace) in self.traces.iter().enumerate() {
            let place = |(z, x): (f64, Option<f64>)| x.map(|x| (x * factor, z * z_factor));
            let points: Vec<_> = points(trace, quantity).into_iter().map(place).collect();
            let marked = trace.is_marked();
            let (line, marker) = if marked { (None, Some(self.marker(i))) } else { (Some(dash(i)), None) };
            let known = trace.errors.and_then(|errors| errors.get(quantity)).unwrap_or_default();
            let errors = known.iter().map(|sigma| sigma.map(|sigma| sigma * factor)).collect();
            let name = if named { trace.name.to_owned() } else { String::new() };
            curves.push(Curve { name, points, colour: i, line, marker, errors, ..Curve::default() });
        }
        Panel { x: Axis::linear(quantity.title, unit), curves }
    }
}

/// Elevations and values, with both limits where the column jumps at the bed.
fn points(trace: &Trace<'_>, quantity: &'static Quantity) -> Vec<(f64, Option<f64>)> {
    let values = trace.profile.get(quantity).unwrap_or_default();
    let mut points: Vec<_> = trace.profile.axis().into_iter().zip(values.iter().copied()).collect();
    if let Some(bed) = trace.bed.filter(|_| !trace.measured)
        && let Some((row, below, above)) = (Interface { bed, phi: trace.phi_interface }).jump(trace.profile, quantity)
    {
        points.splice(row..row, [(bed, Some(below)), (bed, Some(above))]);
    }
    points
}

fn dash(i: usize) -> Dash {
    [Dash::Solid, Dash::Dashed, Dash::DashDotted, Dash::Dotted][i % 4]
}

#[cfg(test)]
mod tests {
    use super::super::{png, samples, svg};
    use super::*;

    fn data() -> (Profile, Profile) {
        let z: Vec<f64> = (1..12).map(|i| f64::from(i) * 5e-3).collect();
        let (mut profile, mut errors) = (Profile::new(z.clone()).unwrap(), Profile::new(z.clone()).unwrap());
        profile.push(&quantity::U_MIXTURE, z.iter().map(|z| Some(z * z)).collect()).unwrap();
        let sigma = |i| if i == 3 { None } else { Some(1e-3) };
        errors.push(&quantity::U_MIXTURE, (0..z.len()).map(sigma).collect()).unwrap();
        (profile, errors)
    }

    #[test]
    fn each_trace_keeps_its_colour_and_the_first_panel_names_them_all() {
        let ((a, _), (b, _), (c, errors)) = (samples::laminar_bed(), samples::two_fluid_bed(), data());
        let trace = |name, profile, errors, measured| Trace {
            name,
            profile,
            errors,
            measured,
            bed: (!measured).then_some(0.03),
            phi_interface: Some(0.6),
        };
        let traces =
            [trace("mixed", &a, None, false), trace("two", &b, None, false), trace("data", &c, Some(&errors), true)];
        let figures = shared_figures(&traces, Some(0.065), None);
        let profiles = &figures[0];
        assert_eq!(profiles.panels[0].x.title, "mixture velocity");
        assert_eq!(profiles.levels.len(), 1);
        for (i, panel) in profiles.panels.iter().enumerate() {
            let named: Vec<&str> = panel.curves.iter().map(|c| c.name.as_str()).filter(|n| !n.is_empty()).collect();
            assert_eq!(named, if i == 0 { vec!["mixed", "two", "data"] } else { vec![] });
            assert!(panel.curves.iter().all(|c| c.colour != 2 || c.marker.is_some() || c.name.is_empty()));
        }
        let data = &profiles.panels[0].curves[2];
        assert_eq!((data.colour, data.errors.len(), data.errors[3]), (2, 11, None));
        assert!(data.errors[2].is_some_and(|e| e > 0.0));
        let looks: Vec<_> = profiles.panels[0].curves.iter().map(|c| (c.colour, c.line, c.marker.is_some())).collect();
        assert_eq!(looks[0], (0, Some(Dash::Solid), false));
        assert_eq!(looks[1], (1, Some(Dash::Dashed), false));
        assert_eq!(looks[2], (2, None, true));
        for figure in &figures {
            assert!(!svg(figure).unwrap().contains("NaN"));
        }
        let folder = tempfile::tempdir().unwrap();
        png(profiles, &folder.path().join("profiles.png")).unwrap();
    }

    #[test]
    fn what_only_one_has_gets_no_panel() {
        let ((a, _), (c, _)) = (samples::laminar_bed(), data());
        let trace =
            |name, profile| Trace { name, profile, errors: None, measured: false, bed: None, phi_interface: None };
        let figures = shared_figures(&[trace("a", &a), trace("c", &c)], None, Some(|_| "unit"));
        assert_eq!(figures.len(), 1);
        assert_eq!(figures[0].panels.len(), 1);
        assert_eq!((figures[0].y.unit.as_str(), figures[0].panels[0].x.unit.as_str()), ("unit", "unit"));
        assert!(figures[0].levels.is_empty() && figures[0].tint_below.is_none());
    }
}
