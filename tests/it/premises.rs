//! What a model assumes of its flow is checked against the flow that it finds.

use bedload::case::CaseError;
use bedload::model::Checked;
use bedload::result::Verdict;
use bedload::result::{Outcome, quantity as q};

use crate::support::{Scratch, load, parse, run, solve};

/// A laminar bed in water, as the closed form and as the solver take it.
const IN_WATER: &str = r#"
format = 2
scene = "bed"
case.title = "A laminar bed far beyond laminar flow"
fluid = { density = "1070 kg/m3", viscosity = "1e-3 Pa s" }
grains = { diameter = "2 mm", density = "1190 kg/m3" }
bed = { thickness = "32.24 mm", phi = 0.6 }
flow = { depth = "32.76 mm", top = "plane", pressure_gradient = "100 Pa/m" }
[MODEL]
form = "mixed"
closures.friction = { law = "coulomb", mu_s = 0.32 }
closures.mixture_viscosity = "clear"
"#;

fn solved(case: Result<Checked, CaseError>) -> Outcome {
    let (_, problem) = case.unwrap_or_else(|error| panic!("{}", error.render(false)));
    run(&problem).unwrap()
}

/// What a run says of the premise that begins so, and the number that decides.
fn verdict(outcome: &Outcome, premise: &str) -> Option<(Verdict, f64)> {
    outcome.regime.iter().find(|p| p.premise.starts_with(premise)).map(|p| (p.verdict, p.value))
}

/// The bulk Reynolds number at which the flow is not known to be laminar.
fn flagged(outcome: &Outcome) -> Option<f64> {
    verdict(outcome, "the flow is laminar").filter(|(verdict, _)| *verdict != Verdict::Holds).map(|(_, re)| re)
}

fn shipped(name: &str, sets: &[&str]) -> Outcome {
    solved(load(name, sets))
}

#[test]
fn a_laminar_bed_in_water_is_flagged_by_every_model_of_it() {
    for model in ["laminar-exact", "laminar", "duct-bed"] {
        let text = IN_WATER.replace("MODEL", model);
        let outcome = solved(parse("case", &text));
        let found = flagged(&outcome).unwrap_or_else(|| panic!("{model} is not flagged"));
        // The mean velocity over the gap times the gap over the viscosity, from the profile.
        let profile = outcome.profile.unwrap();
        let z = profile.axis();
        let u: Vec<f64> = profile.get(&q::U_MIXTURE).unwrap().iter().map(|u| u.unwrap()).collect();
        let over = |i: &usize| z[*i] >= 32.24e-3 - 1e-12;
        let discharge: f64 = (0..z.len() - 1).filter(over).map(|i| 0.5 * (u[i] + u[i + 1]) * (z[i + 1] - z[i])).sum();
        let reynolds = 1070.0 * discharge / 1e-3;
        assert!((found / reynolds - 1.0).abs() < 5e-3, "{model}: {found} against {reynolds}");
        assert!((3e5..5e5).contains(&found), "{model}: {found}");
    }
}

#[test]
fn other_laminar_flows_are_flagged_beyond_the_limit_alone() {
    // The mean velocity is given: Re is 1 m/s 1 m/(1 Pa s) times the density.
    for name in ["exact_1d_bingham", "bingham_1d_plane"] {
        assert_eq!(flagged(&shipped(name, &["fluid.density=999"])), None, "{name}");
        let beyond = flagged(&shipped(name, &["fluid.density=1001"])).unwrap();
        assert!((beyond - 1001.0).abs() < 1e-6, "{name}: {beyond}");
    }
    // A pressure gradient drives them: Re goes like 1/eta^2.
    for name in ["section_2d_square", "section_2d_circle", "section_2d_square_bed"] {
        assert_eq!(flagged(&shipped(name, &[])), None, "{name}");
        let at = |eta: f64| shipped(name, &["grid.cells=8", &format!("fluid.viscosity={eta:e}")]);
        let thin = at(1e-4);
        let (reynolds, reported) = (flagged(&thin).unwrap(), thin.results.get(q::REYNOLDS.name).unwrap());
        if name.ends_with("bed") {
            // On the gap, not on the height with the bed in it.
            assert!((0.9..1.1).contains(&(reported / reynolds)), "{name}: {reported} {reynolds}");
        } else {
            assert!((reported / reynolds - 1.0).abs() < 1e-3, "{name}: {reported} {reynolds}");
        }
        let eta = |wanted: f64| 1e-4 * (reynolds / wanted).sqrt();
        let limit = if name.contains("circle") { 2000.0 } else { 1000.0 };
        assert_eq!(flagged(&at(eta(limit - 1.0))), None, "{name}");
        assert!((flagged(&at(eta(limit + 1.0))).unwrap() - limit - 1.0).abs() < 0.1, "{name}");
    }
    // Between side walls half as far apart as bottom and lid, on their distance.
    let narrow = shipped("section_2d_square", &["grid.cells=8", "fluid.viscosity=1e-4", "flow.section.width=0.5"]);
    let (reynolds, reported) = (flagged(&narrow).unwrap(), narrow.results.get(q::REYNOLDS.name).unwrap());
    assert!((reported / reynolds - 2.0).abs() < 2e-3, "{reported} {reynolds}");
}

#[test]
fn a_person_reads_of_it() {
    let scratch = Scratch::new();
    let case = IN_WATER.replace("MODEL", "laminar-exact");
    scratch.write("water.toml", case);
    let said = scratch.bedload(["run", "water.toml"]).exits(0).out;
    assert!(said.starts_with("broken premise: the flow is laminar: Re"), "{said}");
    assert!(scratch.read("runs/water/report.html").contains("A premise of the model is broken"));
    assert_eq!(scratch.summary("runs/water")["regime"][0]["verdict"], "broken");
    let strict = ["run", "water.toml", "--strict", "--out", "strict", "--json"];
    let strict = scratch.bedload(strict).exits(3).json();
    assert_eq!((&strict["status"], &strict["error"]["code"]), (&"done".into(), &"broken-premise".into()));
    let both = ["compare", "water.toml", "exact_1d_aussillous", "--json"];
    let both = scratch.bedload(both).exits(0).json();
    assert!(both["warnings"][0].as_str().unwrap().starts_with("A premise of water is broken"), "{}", both["warnings"]);
    let swept = ["sweep", "water.toml", "--over", "fluid.viscosity=0.27,0.001Pa s", "--out", "swept"];
    let swept = scratch.bedload(swept).exits(0).out;
    assert!(swept.starts_with("broken premise: 1 of 2 points"), "{swept}");
    let over = ["--over", "fluid.viscosity=0.27,0.001Pa s"];
    for (verb, more, folder) in [
        ("sweep", &over[..], "sweep-water"),
        ("stability", &over, "stability-water"),
        ("chart", &[], "chart-water"),
        ("compare", &["exact_1d_aussillous"], "compare-water-exact_1d_aussillous"),
    ] {
        let line = [&[verb, "water.toml", "--strict", "--json"], more].concat();
        let answer = scratch.bedload(&line).exits(3).json();
        assert_eq!(answer["error"]["code"], "broken-premise", "{verb}: {answer}");
        // What was found is kept.
        assert!(!scratch.read(&format!("runs/{folder}/report.html")).is_empty(), "{verb}");
    }
    let slow = scratch.bedload(["run", "bed_ouriemi-laminar-exact", "--strict"]).exits(0).out;
    assert!(slow.contains("regime           all 2 premises hold") && !slow.contains("einstein"), "{slow}");
}

#[test]
fn coarser_sand_does_not_keep_the_settling_velocity_of_finer_sand() {
    let coarser = |more: &[&str]| {
        let set = [&["grains.diameter=0.5 mm"], more].concat();
        let outcome = solve("sheet_1d_type_b", &set).unwrap();
        let flagged = outcome.validity.iter().any(|v| v.closure == "grains/settling velocity");
        (outcome.results.get("transport_rate_dimensionless").unwrap(), flagged)
    };
    let (old, flagged) = coarser(&[]);
    assert!((old / 79.0 - 1.0).abs() < 0.01 && flagged, "{old}");
    let (derived, flagged) = coarser(&["grains.settling_velocity="]);
    assert!((derived / 22.6 - 1.0).abs() < 0.01 && !flagged, "{derived}");
    // The coarser the sand, the less is carried at one Shields number.
    let rate = |d: &str| {
        let set = [format!("grains.diameter={d}"), "grains.settling_velocity=".into(), "bed.thickness=24 mm".into()];
        solve("sheet_1d_type_b", &set).unwrap().results.get("transport_rate_dimensionless").unwrap()
    };
    let rates = ["0.2 mm", "0.25 mm", "0.35 mm", "0.5 mm"].map(rate);
    assert!(rates.windows(2).all(|pair| pair[1] < pair[0]), "{rates:?}");
    // A person reads of it before the rate.
    let scratch = Scratch::new();
    let said = scratch.bedload(["run", "sheet_1d_type_b", "--set", "grains.diameter=0.5 mm"]).exits(0).out;
    let second = said.lines().nth(1).unwrap();
    assert!(second.contains("settling velocity") && second.contains("w_s over that of a sphere = 0.437"), "{said}");
}
