//! What can be read in the figures of the shipped cases.

use std::fs::File;
use std::io::BufReader;

use bedload::output::{read_run, read_series};
use bedload::plot::{faults, profile_figures, series_figures};
use bedload::result::Figure;
use serde_json::Value;

use crate::support::Scratch;

/// A case of each model that is solved in a second, with its model where the case has several.
const CASES: &[(&str, &str)] = &[
    ("bed_ouriemi", "laminar"),
    ("bed_ouriemi", "duct-bed"),
    ("bed_ouriemi", "laminar-exact"),
    ("section_2d_square", ""),
    ("section_2d_square_bed", ""),
    ("section_2d_cavity_bn5", ""),
    ("sheet_1d_sumer91", ""),
    ("sheet_1d_type_b", ""),
    ("flow_theta06", "two-fluid"),
    ("flow_theta06", "sheet-flow"),
    ("kinetic_1d_shear", ""),
    ("grains_2d_column", ""),
    ("grains_3d_bed_quick", ""),
    ("bingham_1d_plane", ""),
    ("exact_1d_aussillous", ""),
    ("exact_1d_bagnold", ""),
    ("exact_1d_bingham", ""),
    ("exact_1d_limit_posed", ""),
    ("exact_1d_loglaw", ""),
];

/// Flows in time, of which the beginning is solved.
const IN_TIME: &[(&str, &str)] = &[
    ("kinetic_1d_waves", "solver.duration=12 s"),
    ("kinetic_1d_settling", "solver.duration=2 s"),
    ("two_fluid_1d_avalanche", "solver.duration=4 s"),
];

/// The figures of a run, as its page shows them.
fn figures(scratch: &Scratch, folder: &str) -> Vec<Figure> {
    let folder = scratch.path(folder);
    let (summary, profile) = read_run(&folder).unwrap();
    let mut figures = profile.map(|profile| profile_figures(&profile, &summary)).unwrap_or_default();
    let words: Value = serde_json::from_reader(BufReader::new(File::open(folder.join("page.json")).unwrap())).unwrap();
    figures.extend(serde_json::from_value::<Vec<Figure>>(words["figures"].clone()).unwrap());
    figures.extend(read_series(&folder).map(|series| series_figures(&series, &summary.case)).unwrap_or_default());
    figures
}

/// Runs a case and looks at its figures; how many there are.
fn look(scratch: &Scratch, case: &str, more: [&str; 2]) -> usize {
    let out = format!("{case}{}", more.concat().replace(|c: char| !c.is_alphanumeric(), "-"));
    let mut arguments = vec!["run", case, "--out", &out, "--quiet"];
    arguments.extend(more.into_iter().filter(|_| !more[1].is_empty()));
    scratch.bedload(arguments).exits(0);
    let figures = figures(scratch, &out);
    for figure in &figures {
        assert_eq!(faults(figure).unwrap(), Vec::<String>::new(), "{} of {case} {more:?}", figure.stem);
    }
    figures.len()
}

#[test]
fn in_the_figures_of_every_model_texts_stand_apart_curves_stay_in_their_panels_and_legends_name_what_is_drawn() {
    let scratch = Scratch::new();
    let drawn: usize = CASES.iter().map(|(case, model)| look(&scratch, case, ["--model", model])).sum();
    assert!(drawn > 2 * CASES.len(), "{drawn} figures");
}

#[test]
fn in_the_figures_of_flows_in_time_too() {
    let scratch = Scratch::new();
    for (case, set) in IN_TIME {
        assert!(look(&scratch, case, ["--set", set]) > 3, "{case}");
    }
}

#[test]
fn the_regimes_of_a_sheet_have_named_axes_and_named_regions() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "sheet_1d_type_b", "--out", "out"]).exits(0);
    let figures = figures(&scratch, "out");
    let figure = figures.iter().find(|figure| figure.stem == "regimes").unwrap();
    assert_eq!(
        (figure.panels[0].x.title.as_str(), figure.y.title.as_str()),
        ("rearrangement ratio r", "Stokes number St")
    );
    // Each name lies in its region: free fall at St, r > 1, viscous at St < 1, r > St, turbulent at r < 1, St > r.
    let at = |name: &str| figure.panels[0].curves.iter().find(|curve| curve.text == name).unwrap().points[0].unwrap();
    let [(r, stokes), viscous, turbulent] = ["free fall", "viscous", "turbulent"].map(at);
    assert!(r > 1.0 && stokes > 1.0);
    assert!(viscous.1 < 1.0 && viscous.0 > viscous.1);
    assert!(turbulent.0 < 1.0 && turbulent.1 > turbulent.0);
}

/// The values of an attribute in a page, in order.
fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    let opening = format!(" {name}=\"");
    html.split(opening.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn the_limit_is_drawn_where_the_method_ends() {
    let scratch = Scratch::new();
    let over = "flow.pressure_gradient=60:600:4 Pa/m";
    scratch.bedload(["stability", "exact_1d_aussillous", "--over", over, "--out", "out"]).exits(0);
    let html = scratch.read("out/report.html");
    let named = html.split("<g class=\"curve\"").find(|part| part.contains("data-name=\"limit\"")).unwrap();
    let points = attributes(named, "data-points")[0];
    let drawn: Vec<f64> =
        points.split([' ', ';']).map(|point| point.split(',').next().unwrap().parse().unwrap()).collect();
    let study: Value = serde_json::from_str(&scratch.read("out/study.json")).unwrap();
    let text = study.to_string();
    let number = |name: &str| -> f64 {
        let rest = text.split_once(&format!("\"{name}\":")).unwrap().1;
        rest.split([',', '}']).next().unwrap().parse().unwrap()
    };
    let (holds, fails) = (number("holds"), number("fails"));
    assert!(holds < fails && fails < 1.002 * holds, "{holds} {fails}");
    assert!(drawn.len() == 2 && drawn.iter().all(|x| (holds..=fails).contains(x)), "{drawn:?} for {holds} to {fails}");
    // The classes are named at their axis, not numbered.
    assert!(html.contains(">holds, but inaccurate</text>") || html.contains("data-y-title=\"error"), "{points}");
}

#[test]
fn a_sweep_over_the_shields_number_has_it_on_one_axis() {
    let scratch = Scratch::new();
    let titles = |folder: &str| -> Vec<String> {
        let html = scratch.read(&format!("{folder}/report.html"));
        let first = html.split("<figure id=\"sweep\"").nth(1).unwrap().split("</figure>").next().unwrap();
        attributes(first, "data-x-title").into_iter().map(str::to_owned).collect()
    };
    scratch.bedload(["sweep", "sheet_1d_type_b", "--over", "flow.shields=0.4:1:3", "--out", "shields"]).exits(0);
    assert_eq!(titles("shields"), ["flow.shields"]);
    let over = "flow.pressure_gradient=60:180:3 Pa/m";
    scratch.bedload(["sweep", "exact_1d_aussillous", "--over", over, "--out", "gradient"]).exits(0);
    assert_eq!(titles("gradient"), ["flow.pressure_gradient", "Shields number"]);
}

#[test]
fn a_page_says_the_answer_then_shows_a_figure_then_the_tables() {
    let scratch = Scratch::new();
    scratch.bedload(["run", "sheet_1d_sumer91", "--out", "run"]).exits(0);
    let case = "exact_1d_aussillous";
    scratch.bedload(["sweep", case, "--over", "flow.pressure_gradient=60:180:3 Pa/m", "--out", "sweep"]).exits(0);
    scratch.bedload(["compare", "exact_1d_ouriemi_mixed", "bed_ouriemi-laminar-exact", "--out", "compare"]).exits(0);
    for (folder, answer) in [("run", "transport rate"), ("sweep", "largest"), ("compare", "exact_1d_ouriemi_mixed")] {
        let html = scratch.read(&format!("{folder}/report.html"));
        // A premise that does not hold comes before the answer.
        let alerts: usize = html.matches("<section class=\"alert").count();
        let answered = html.find("id=\"answer\"").unwrap();
        let places =
            ["<h1>", "id=\"answer\"", &format!("<dt>{answer}</dt>"), "<figure"].map(|part| html.find(part).unwrap());
        assert!(places.is_sorted(), "{folder}: {places:?}, {alerts} alerts");
        let after = &html[answered..];
        assert!(after.find("<figure") < after.find("<table"), "{folder}: a table before the first figure");
        assert!(after.contains("<table"), "{folder}");
    }
}
