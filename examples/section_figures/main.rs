//! The figures 3, 5, 6 and 8 to 15 of Chauchat & Medale (2010) from the cross-section alone.
//!
//! `cargo run --release --example section_figures` writes them to `docs/figures`; it takes about a minute. Each function says
//! which figure it draws.

mod planes;

use std::error::Error;
use std::path::Path;

use bedload::models;
use bedload::plot::{Map, MapPanel, map_png, png, section_map};
use bedload::result::Context;
use bedload::result::{Axis, Curve, Dash, Field, Figure, Level, Marker, Panel};
use bedload::result::{Outcome, Profile, Quantity, quantity as q};

type Fallible<T> = Result<T, Box<dyn Error>>;

/// Runs a shipped case with changes.
fn run(case: &str, settings: &[&str]) -> Fallible<Outcome> {
    let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
    let (_, problem) = models::builtin().load(case, &settings).map_err(|e| e.render(false))?;
    Ok(Context::quiet(|context| problem.run(context)).map_err(|failure| failure.error.to_string())?)
}

/// Its field over the section.
fn field(case: &str, settings: &[&str]) -> Fallible<Field> {
    Ok(run(case, settings)?.field.ok_or("no field")?)
}

fn column(profile: &Profile, quantity: &'static Quantity) -> Vec<Option<f64>> {
    profile.get(quantity).map_or_else(Vec::new, <[Option<f64>]>::to_vec)
}

/// A curve through pairs; without a dash it has markers only.
fn curve(name: &str, colour: usize, style: (Option<Dash>, Option<Marker>), points: Vec<(f64, f64)>) -> Curve {
    let points = points.into_iter().map(Some).collect();
    Curve { name: name.into(), points, colour, line: style.0, marker: style.1, ..Curve::default() }
}

const SOLID: (Option<Dash>, Option<Marker>) = (Some(Dash::Solid), None);
const DASHED: (Option<Dash>, Option<Marker>) = (Some(Dash::Dashed), None);

fn draw(stem: &str, caption: &str, y: Axis, panels: Vec<Panel>, levels: Vec<Level>, bed: Option<f64>) -> Fallible<()> {
    let figure = Figure { stem: stem.into(), caption: caption.into(), y, panels, levels, tint_below: bed };
    Ok(png(&figure, &Path::new("docs/figures").join(format!("{stem}.png")))?)
}

fn cavity(bn: f64) -> Fallible<Field> {
    let case = if bn > 0.0 { "section_2d_cavity_bn2" } else { "section_2d_cavity_bn0" };
    let finest = if bn > 0.0 { 0.3 } else { 1.0 };
    let mut settings = vec!["grid.cells=96".to_owned(), format!("grid.finest={finest}")];
    if bn > 0.0 {
        settings.push(format!("fluid.yield_stress={bn}"));
    }
    field(case, &settings.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Figures 5 and 6: the cavity at rising Bingham number, velocities and what does not yield.
fn figures_5_and_6() -> Fallible<()> {
    let panel = |bn: f64, arrows: bool| -> Fallible<MapPanel> {
        let mut panel = section_map(&cavity(bn)?, false, None, (&format!("Bn = {bn}"), 1.0)).ok_or("no map")?;
        if !arrows {
            panel.arrows.clear();
        }
        if bn == 0.0 {
            panel.trails.clear();
        }
        Ok(panel)
    };
    let colours = || Axis::linear("velocity over that of the lid", "1");
    for (stem, numbers, arrows) in
        [("section_cavity_vectors", [0.0, 2.0, 20.0], true), ("section_cavity_yield", [2.0, 5.0, 20.0], false)]
    {
        let panels = numbers.into_iter().map(|bn| panel(bn, arrows)).collect::<Fallible<Vec<_>>>()?;
        map_png(&Map { panels, colours: colours() }, &Path::new("docs/figures").join(format!("{stem}.png")))?;
    }
    Ok(())
}

const BEDS: [(&str, &str); 2] = [("section_2d_square_bed", "square"), ("section_2d_circle_bed", "circle")];
const TWO_FLUID: [&str; 2] = ["form=two-fluid", "closures.drag.law=carman-kozeny"];

/// Figures 10 and 13: velocity in the sections, with bed level and yield surface.
fn figures_10_and_13() -> Fallible<()> {
    let mut panels = Vec::new();
    for (case, name) in BEDS {
        let outcome = run(case, &[])?;
        let bed = outcome.results.get(q::BED_LEVEL.name);
        let field = outcome.field.ok_or("no field")?;
        panels.push(section_map(&field, true, bed, (name, 1e-3)).ok_or("no map")?);
    }
    map_png(
        &Map { panels, colours: Axis::linear("velocity of the mixture", "mm/s") },
        Path::new("docs/figures/section_beds.png"),
    )?;
    let mut panels = Vec::new();
    for (case, name) in [("section_2d_square", "square"), ("section_2d_circle", "circle")] {
        panels.push(section_map(&field(case, &[])?, true, None, (name, 1.0)).ok_or("no map")?);
    }
    let colours = Axis::linear("velocity, Bingham fluid, yield stress 0.1 of -dp/dx H", "m/s");
    Ok(map_png(&Map { panels, colours }, Path::new("docs/figures/section_bingham.png"))?)
}

/// Figures 11 and 14: symmetry plane on two meshes with the paper's law, and with the exact yield, over the plane solution.
fn figures_11_and_14() -> Fallible<()> {
    for (zoom, stem) in [(false, "section_profiles"), (true, "section_profiles_zoom")] {
        let mut panels = Vec::new();
        for (case, name) in BEDS {
            let law = ["regularisation.law=simple", "regularisation.lambda_scaled=1e-6", "grid.yield_row=false"];
            let mut curves = Vec::new();
            for (cells, colour, marker) in [(40, 1, Marker::Circle), (80, 2, Marker::Triangle)] {
                let mesh = format!("grid.cells={cells}");
                let profile = run(case, &[&law[..], &[mesh.as_str()]].concat())?.profile.ok_or("no profile")?;
                let every = if zoom { 1 } else { 4 };
                let points = pairs(&profile, &q::U_MIXTURE, zoom).into_iter().step_by(every).collect();
                curves.push(curve(&format!("{cells} rows, λ = 1e-6"), colour, (None, Some(marker)), points));
            }
            let profile = run(case, &["grid.cells=96"])?.profile.ok_or("no profile")?;
            curves.push(curve("exact yield", 0, SOLID, pairs(&profile, &q::U_MIXTURE, zoom)));
            if !zoom {
                curves.push(curve("between planes", 3, DASHED, pairs(&profile, &q::U_PLANES, zoom)));
            }
            panels.push(Panel { x: Axis::linear(&format!("velocity, {name}"), "mm/s"), curves });
        }
        draw(
            stem,
            "Velocity on the plane of symmetry: (a) square, (b) circle (figures 11 and 14 of the paper)",
            Axis::linear("height z", "mm"),
            panels,
            if zoom { Vec::new() } else { vec![Level { y: 15.0, label: "bed level".into() }] },
            Some(15.0),
        )?;
    }
    Ok(())
}

/// Velocity in mm/s and height in mm; `zoom`: around the yield surface only.
fn pairs(profile: &Profile, quantity: &'static Quantity, zoom: bool) -> Vec<(f64, f64)> {
    let z = profile.axis();
    let all = z.iter().zip(column(profile, quantity)).filter_map(|(z, u)| Some((1e3 * u?, 1e3 * z)));
    all.filter(|p| !zoom || (p.1 > 9.0 && p.1 < 12.6)).collect()
}

/// Figures 12 and 15: fluid and grains of the two-fluid form on the plane of symmetry.
fn figures_12_and_15() -> Fallible<()> {
    let mut panels = Vec::new();
    for (case, name) in BEDS {
        let profile = run(case, &[&TWO_FLUID[..], &["grid.cells=64"]].concat())?.profile.ok_or("no profile")?;
        let curves = vec![
            curve("fluid", 1, SOLID, pairs(&profile, &q::U_FLUID, false)),
            curve("grains", 2, DASHED, pairs(&profile, &q::U_PARTICLE, false)),
        ];
        panels.push(Panel { x: Axis::linear(&format!("velocity, {name}"), "mm/s"), curves });
    }
    draw(
        "section_two_fluid",
        "Velocity of fluid and grains on the plane of symmetry, two-fluid form (figures 12 and 15 of the paper)",
        Axis { ends: Some((0.0, 30.0)), ..Axis::linear("height z", "mm") },
        panels,
        vec![Level { y: 15.0, label: "bed level".into() }],
        Some(15.0),
    )
}

fn main() -> Fallible<()> {
    planes::figure_3()?;
    figures_5_and_6()?;
    planes::figure_8()?;
    planes::figure_9()?;
    figures_10_and_13()?;
    figures_11_and_14()?;
    figures_12_and_15()
}
