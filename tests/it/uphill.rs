//! A bed denser than the phi_max of its mixing length: beds of slippery grains run, and no water flows uphill with exit 0.

use std::fs;

use serde_json::Value;

use crate::support::{Scratch, project};

/// A bed of 4 d by 4 d of the reference flow, 2 s.
const SMALL: [&str; 3] = ["cell.length=24 mm", "cell.width=24 mm", "discrete.duration=2 s"];
/// Grains without friction, which pack to 0.63, under shallow water: it flowed uphill at 0.4 m/s, with exit 0.
const SHALLOW: [&str; 2] = ["grains.friction=0", "flow.depth=20 mm"];
const PUBLISHED: &str = "closures.mixing_length.below_packed=published";

fn run(case: &str, sets: &[&str]) -> (i32, Value) {
    let scratch = Scratch::new();
    let sets = sets.iter().flat_map(|set| ["--set", *set]);
    let answer = scratch.bedload(["run", case, "--json", "--out", "o"].into_iter().chain(sets));
    (answer.code, answer.json())
}

fn small(sets: &[&str]) -> (i32, Value) {
    run("flow_theta06_quick-coupled", &[&SMALL, sets].concat())
}

fn number(found: &Value, name: &str) -> Option<f64> {
    found["results"][name]["value"].as_f64()
}

#[test]
fn shallow_water_over_grains_without_friction_flows_downhill() {
    let (exit, found) = small(&SHALLOW);
    assert_eq!(exit, 0, "{found}");
    let mean = number(&found, "mean_velocity_m_s").unwrap();
    assert!((0.4..1.2).contains(&mean), "{mean}");
}

#[test]
fn water_that_flows_uphill_is_a_failure_that_says_what_to_change() {
    let (exit, found) = small(&[&SHALLOW[..], &[PUBLISHED]].concat());
    let error = &found["error"];
    assert_eq!((exit, error["code"].as_str()), (3, Some("flows-uphill")), "{found}");
    let message = error["message"].as_str().unwrap();
    assert!(message.contains("mean velocity is -") && message.contains(" s to "), "{message}");
    assert!(error["hint"].as_str().unwrap().contains("below_packed = \"clipped\""), "{error}");
    // What there was until then is kept.
    assert!(number(&found, "mean_velocity_m_s").is_some() && number(&found, "averaged_time_s") > Some(0.0), "{found}");
}

#[test]
fn slippery_grains_flow_and_those_that_the_published_integral_throws_apart_say_why() {
    for (mu, rates) in [("grains.friction=0", 2.0..20.0), ("grains.friction=0.1", 1.0..10.0)] {
        let (exit, found) = small(&[mu, "discrete.duration=1 s"]);
        assert_eq!(exit, 0, "{mu}: {found}");
        assert!(number(&found, "mean_velocity_m_s") > Some(1.0), "{mu}: {found}");
        let rate = number(&found, "transport_rate_dimensionless").unwrap();
        assert!(rates.contains(&rate), "{mu}: {rate}");
    }
    let (exit, found) = small(&["grains.friction=0.1", PUBLISHED]);
    let (code, hint) = (found["error"]["code"].as_str(), found["error"]["hint"].as_str());
    assert_eq!((exit, code), (3, Some("overlap")), "{found}");
    assert!(hint.unwrap().contains("below_packed = \"clipped\""), "{found}");
}

#[test]
fn the_kinetic_theory_of_slippery_grains_runs_by_default() {
    for name in ["kinetic_1d_mu00", "kinetic_1d_mu01"] {
        let stated = fs::read_to_string(project(&format!("cases/{name}.toml"))).unwrap();
        let silent = stated.replace(", below_packed = \"clipped\"", "");
        assert!(silent.len() < stated.len(), "{name}");
        let scratch = Scratch::new();
        scratch.write("silent.toml", silent);
        let found = scratch.bedload(["run", "silent.toml", "--json", "--out", "o"]).exits(0).json();
        assert!(number(&found, "fluid_discharge_m2_s") > Some(0.0), "{found}");
        let (exit, shipped) = run(name, &[]);
        assert_eq!((exit, &shipped["results"]), (0, &found["results"]), "{name}");
    }
}
