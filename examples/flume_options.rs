//! What each option of the coupled model contributes to the transport rate of the narrow flume, beside the measured rates.
//!
//! `cargo run --release --example flume_options -- FOLDER` reads the runs `FOLDER/RUN_OPTION` (RUN 6, 14 or 20, OPTION below), makes those that
//! are missing (a minute each), prints the table of `docs/coupled.md` and draws `docs/figures/coupled_flume_options.png`.
//! Measured: Frey (2014); published simulation: Maurin et al. (2015), Table III.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use bedload::plot::png;
use bedload::result::{Axis, Curve, Dash, Figure, Marker, Panel};

/// Name, legend, and changes of `coupled_2d_expRUN_quick`.
const OPTIONS: [(&str, &str, &[&str]); 7] = [
    ("base", "as shipped", &[]),
    ("wall", "textbook wall law", &["closures.side_wall.law=graf-altinakar"]),
    ("drag", "drag constant 0.44", &["closures.drag.constant=0.44"]),
    ("none", "no fluctuations", &["closures.fluctuation.law=none"]),
    ("span", "fluctuations in y, too", &["closures.fluctuation.spanwise=true"]),
    ("eps", "σ without 1/ε", &["closures.fluctuation.per_porosity=false"]),
    ("soft", "half the stiffness", &["closures.contact.k_n=2.5e3", "closures.contact.k_s=1.25e3"]),
];
/// Run, measured rate, published simulation [beads/s].
const RUNS: [(u32, f64, f64); 3] = [(6, 6.67, 10.15), (14, 13.68, 18.13), (20, 19.74, 26.38)];

fn rate(folder: &Path, run: u32, (name, _, changes): &(&str, &str, &[&str])) -> Result<[f64; 2], Box<dyn Error>> {
    let out = folder.join(format!("{run}_{name}"));
    if !out.join("summary.json").exists() {
        let mut command = Command::new("target/release/bedload");
        command.args(["run", &format!("coupled_2d_exp{run}_quick"), "--quiet", "--out"]).arg(&out);
        for change in *changes {
            command.args(["--set", change]);
        }
        command.status()?;
    }
    let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(out.join("summary.json"))?)?;
    let known = &summary["results"]["transport_rate_beads_1_s"];
    let number = |name: &str| known[name].as_f64().ok_or_else(|| format!("{}: no {name}", out.display()));
    Ok([number("value")?, number("stderr")?])
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("FOLDER is missing")?);
    let mut curves = Vec::new();
    println!("| | {} |", RUNS.map(|(run, ..)| format!("run {run}")).join(" | "));
    println!("|---|---|---|---|");
    println!("| measured | {} |", RUNS.map(|(_, measured, _)| measured.to_string()).join(" | "));
    println!("| published simulation | {} |", RUNS.map(|(.., published)| published.to_string()).join(" | "));
    let same = vec![Some((0.0, 0.0)), Some((24.0, 24.0))];
    curves.push(Curve { name: "as measured".into(), points: same, line: Some(Dash::Dotted), ..Curve::default() });
    curves.push(Curve {
        name: "published simulation".into(),
        points: RUNS.iter().map(|&(_, measured, published)| Some((published, measured))).collect(),
        marker: Some(Marker::Triangle),
        ..Curve::default()
    });
    for (i, option) in OPTIONS.iter().enumerate() {
        let rates: Vec<[f64; 2]> =
            RUNS.iter().map(|&(run, ..)| rate(&folder, run, option)).collect::<Result<_, _>>()?;
        let cells: Vec<String> = rates.iter().map(|[value, error]| format!("{value:.1} ± {error:.1}")).collect();
        println!("| {} | {} |", option.1, cells.join(" | "));
        curves.push(Curve {
            name: option.1.into(),
            points: rates.iter().zip(RUNS).map(|(&[value, _], (_, measured, _))| Some((value, measured))).collect(),
            colour: i % 6 + 1,
            line: Some([Dash::Solid, Dash::Dashed, Dash::DashDotted, Dash::Dotted][i % 4]),
            marker: Some([Marker::Circle, Marker::Square][i / 4]),
            errors: rates.iter().map(|&[_, error]| Some(error)).collect(),
            ..Curve::default()
        });
    }
    let figure = Figure {
        stem: "coupled_flume_options".into(),
        caption: "Measured over computed transport rate of the narrow flume, option by option.".into(),
        y: Axis { ends: Some((4.0, 24.0)), ..Axis::linear("measured rate", "beads/s") },
        panels: vec![Panel { x: Axis::linear("computed rate", "beads/s"), curves }],
        levels: Vec::new(),
        tint_below: None,
    };
    png(&figure, Path::new("docs/figures/coupled_flume_options.png"))?;
    Ok(())
}
