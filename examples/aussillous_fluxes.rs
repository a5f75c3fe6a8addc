//! Measured fluxes of laminar bedload against the laminar bed, with error bars.
//!
//! `cargo run --release --example aussillous_fluxes` reads `reference/aussillous2013_runs.csv`, solves each run for the fluid depth and
//! the Shields number that were measured, prints the table of `docs/theory.md` and draws `docs/figures/laminar_aussillous_fluxes.png`.
//! The bars of the models are what the error of the Shields number makes of them. Nothing is fitted: friction and packing are those of `laminar_1d_muiv`.

use std::error::Error;
use std::path::Path;

use bedload::models;
use bedload::plot::png;
use bedload::result::Context;
use bedload::result::{Axis, Curve, Dash, Figure, Marker, Panel};

/// Thickness of the bed in diameters: more than moves in any run.
const BED: f64 = 20.0;

/// The laws that are compared, as changes of `laminar_1d_muiv`.
const MODELS: [(&str, &[&str]); 3] = [
    ("Coulomb friction", &["closures.friction={ law = \"coulomb\", mu_s = 0.32 }"]),
    ("friction μ(I)", &[]),
    ("friction μ(I), packing φ(I)", &["closures.dilatancy={ law = \"phi-iv\" }"]),
];

/// One measured run.
struct Run {
    name: String,
    depth: f64,
    shields: f64,
    shields_error: f64,
    measured: [f64; 3],
    simulated: f64,
}

fn runs() -> Result<Vec<Run>, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/aussillous2013_runs.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path)?;
    let header = reader.headers()?.clone();
    let mut runs = Vec::new();
    for record in reader.records() {
        let record = record?;
        let text = |name: &str| {
            let column = header.iter().position(|h| h == name).ok_or_else(|| format!("no column {name}"))?;
            record.get(column).ok_or_else(|| format!("no value of {name}"))
        };
        let value = |name: &str| -> Result<f64, Box<dyn Error>> { Ok(text(name)?.parse()?) };
        let measured = ["minus", "", "plus"].map(|end| format!("qv_over_qf_exp_{end}"));
        runs.push(Run {
            name: text("case")?.to_owned(),
            depth: value("hf_over_d_exp")?,
            shields: value("Shields_exp")?,
            shields_error: value("Shields_exp_pm")?,
            measured: [value(&measured[0])?, value("qv_over_qf_exp")?, value(&measured[2])?],
            simulated: value("qv_over_qf_sim")?,
        });
    }
    // A10M is the same measurement, simulated with other grains.
    runs.retain(|run: &Run| run.name != "A10M");
    Ok(runs)
}

/// Flux of the grains over that of the fluid.
fn ratio(run_of: &Run, shields: f64, changes: &[&str]) -> Result<f64, Box<dyn Error>> {
    let d = 1.1e-3;
    let mut settings: Vec<String> = vec![
        format!("grains.diameter={d}"),
        "grains.density=2247".into(),
        format!("bed.thickness={}", BED * d),
        format!("flow.depth={}", run_of.depth * d),
        "flow.pressure_gradient=".into(),
        format!("flow.shields={shields}"),
    ];
    settings.extend(changes.iter().map(|&s| s.to_owned()));
    let (_, problem) = models::builtin().load("laminar_1d_muiv", &settings).map_err(|e| format!("{e:?}"))?;
    let results = Context::quiet(|context| problem.run(context)).map_err(|failure| failure.error.to_string())?.results;
    let get = |name: &str| results.get(name).ok_or_else(|| format!("no {name}"));
    Ok(get("transport_rate_m2_s")? / get("fluid_discharge_m2_s")?)
}

fn points(name: &str, colour: usize, marker: Marker, points: Vec<(f64, f64)>) -> Curve {
    Curve {
        name: name.into(),
        points: points.into_iter().map(Some).collect(),
        colour,
        line: None,
        marker: Some(marker),
        ..Curve::default()
    }
}

/// A vertical bar.
fn bar(colour: usize, x: f64, low: f64, high: f64) -> Curve {
    Curve {
        name: String::new(),
        points: vec![Some((x, low)), Some((x, high))],
        colour,
        line: Some(Dash::Solid),
        ..Curve::default()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let runs = runs()?;
    let at = |value: fn(&Run) -> f64| runs.iter().map(|run| (run.depth, value(run))).collect();
    let mut curves: Vec<Curve> = runs.iter().map(|run| bar(0, run.depth, run.measured[0], run.measured[2])).collect();
    curves.push(points("measured", 0, Marker::Circle, at(|run| run.measured[1])));
    curves.push(points("grain-resolved simulation", 1, Marker::Square, at(|run| run.simulated)));
    println!("| run | h_f/d | θ | measured | {} |", MODELS.map(|(name, _)| name).join(" | "));
    println!("|---|---|---|---|{}", "---|".repeat(MODELS.len()));
    let mut rows: Vec<String> = runs
        .iter()
        .map(|r| {
            let [low, middle, high] = r.measured.map(|x| 1e3 * x);
            let (theta, pm) = (r.shields, r.shields_error);
            format!("| {} | {} | {theta} ± {pm} | {middle:.1} ({low:.1} to {high:.1})", r.name, r.depth)
        })
        .collect();
    for (i, (name, changes)) in MODELS.into_iter().enumerate() {
        let mut middles = Vec::new();
        for (row, run) in rows.iter_mut().zip(&runs) {
            let [low, middle, high] =
                [-1.0, 0.0, 1.0].map(|sign| ratio(run, run.shields + sign * run.shields_error, changes));
            let (low, middle, high) = (low?, middle?, high?);
            // Beside the measurement, not on it.
            let x = run.depth + 0.08 * (i as f64 + 1.0);
            middles.push((x, middle));
            curves.push(bar(2 + i, x, low, high));
            row.push_str(&format!(" | {:.1} ({:.1} to {:.1})", 1e3 * middle, 1e3 * low, 1e3 * high));
        }
        curves.push(points(name, 2 + i, Marker::Triangle, middles));
    }
    rows.iter().for_each(|row| println!("{row} |"));
    let figure = Figure {
        stem: "laminar_aussillous_fluxes".into(),
        caption: "Laminar bedload: flux of the grains over that of the fluid. Bars: error of the measurement; of the models, the \
                  measured error of the Shields number"
            .into(),
        y: Axis::log("flux of the grains over that of the fluid", "1"),
        panels: vec![Panel { x: Axis::linear("fluid depth over grain diameter", "1"), curves }],
        levels: Vec::new(),
        tint_below: None,
    };
    png(&figure, Path::new("docs/figures/laminar_aussillous_fluxes.png"))?;
    Ok(())
}
