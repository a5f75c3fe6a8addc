//! `bedload chart` and `bedload stability`: what is on the front, where a method ends.

use serde_json::Value;

use crate::support::Scratch;

fn points(study: &Value) -> &[Value] {
    study["points"].as_array().unwrap()
}

fn measure(point: &Value, name: &str) -> Option<f64> {
    point["measures"][name].as_f64()
}

#[test]
fn the_exact_yield_and_the_closed_form_are_on_the_front_of_the_laminar_bed() {
    let scratch = Scratch::new();
    let found = scratch
        .bedload(["chart", "bed_ouriemi-laminar", "bed_ouriemi-laminar-exact", "--out", "c", "--png", "--json"])
        .exits(0)
        .json();
    assert_eq!(points(&found).len(), 43);
    let front = |point: &&Value| measure(point, "on_front") == Some(1.0);
    assert!(points(&found).iter().any(|p| front(&p)));
    for point in points(&found) {
        let error = measure(point, "error").unwrap();
        let exact = !["simple", "bercovier-engelman", "papanastasiou"].contains(&point["series"].as_str().unwrap());
        // A size of 1e-8 leaves 1e-5, the exact yield round-off.
        assert_eq!(exact, error < 1e-11, "{point}");
        assert!(exact || !front(&point), "{point}");
        assert!(point["cost"]["solve_s"].as_f64().unwrap() > 0.0 && measure(point, "work").unwrap() > 0.0);
    }
    let page = scratch.read("c/report.html");
    assert!(page.matches("class=\"hit\"").count() >= 80, "every point says what it is");
    assert!(page.contains("exact yield, 24 cells"));
    assert_eq!(scratch.names("c/figures"), ["chart.png"]);
    let table = scratch.read("c/points.csv");
    assert!(!table.contains("NaN") && !table.contains("inf,"));
    let again = scratch
        .bedload(["chart", "bed_ouriemi-laminar", "bed_ouriemi-laminar-exact", "--out", "c", "--resume"])
        .exits(0);
    assert!(again.out.contains("(43 before)"), "{}", again.out);
}

#[test]
fn a_finished_run_is_a_reference_and_what_is_none_is_refused() {
    let scratch = Scratch::new();
    scratch
        .bedload(["run", "bed_ouriemi-laminar", "--set", "regularisation.lambda_scaled=1e-4", "--out", "r"])
        .exits(0);
    let case = ["chart", "bed_ouriemi-laminar", "--json", "--out", "c", "--reference"];
    let found = scratch.bedload(case.iter().chain(&["r"])).exits(0).json();
    let same = points(&found).iter().find(|p| p["values"]["setting"] == "λ = 1e-4, 384 cells").unwrap();
    assert!(measure(same, "error").unwrap() < 0.01, "{same}");
    let exact = points(&found).iter().find(|p| p["series"] == "exact yield").unwrap();
    assert!(measure(exact, "error").unwrap() > 0.1, "{exact}");
    let said = scratch.bedload(case.iter().chain(&["nowhere", "--force"])).exits(2).json();
    assert_eq!(said["error"]["code"], "bad-reference");
}

/// The limits that a map finds, each as (holds, fails, class).
fn limits(scratch: &Scratch, case: &str, over: &str, more: &[&str]) -> Vec<(f64, f64, String)> {
    let words = ["stability", case, "--over", over, "--json", "--force"];
    let found = scratch.bedload(words.iter().chain(more)).exits(0).json();
    let limit = |l: &Value| {
        let number = |name: &str| l[name].as_f64().unwrap();
        (number("holds"), number("fails"), l["class"].as_str().unwrap().to_owned())
    };
    found["facts"]["limits"].as_array().unwrap().iter().map(limit).collect()
}

#[test]
fn the_laminar_bed_moves_to_its_bottom_where_the_closed_form_says() {
    let scratch = Scratch::new();
    let over = "flow.pressure_gradient=1000:4000:4 Pa/m";
    let sets = ["form=mixed", "closures.drag=", "regularisation.law=none", "regularisation.lambda_scaled="];
    let mixed: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let found = limits(&scratch, "bed_ouriemi-laminar", over, &mixed);
    // f = mu_s phi (1 + 2 e)/(1 + 3 e), e = 1 + 2.5 phi, in units of (rho_p - rho_f) g = 14715 Pa/m
    let (yields, e) = (0.43 * 0.55, 1.0 + 2.5 * 0.55);
    let predicted = 14715.0 * yields * (1.0 + 2.0 * e) / (1.0 + 3.0 * e);
    let [(holds, fails, class)] = &found[..] else { panic!("{found:?}") };
    assert!(*holds <= predicted * 1.0001 && *fails >= predicted * 0.9999, "{holds} {fails} {predicted}");
    assert!((fails / holds - 1.0).abs() < 2e-3);
    assert_eq!(class, "unphysical");
    // Just inside it works, just outside it is the typed failure.
    let at = |share: f64| format!("flow.pressure_gradient={} Pa/m", share * predicted);
    let run = |share: f64, out: &str| {
        let step = at(share);
        let words = ["run", "bed_ouriemi-laminar", "--json", "--out", out, "--set", &step];
        scratch.bedload(words.iter().chain(&mixed))
    };
    run(0.999, "in").exits(0);
    assert_eq!(run(1.001, "out").exits(3).json()["error"]["code"], "whole-bed-moves");
}

#[test]
fn the_step_of_a_bed_is_refused_beyond_its_limit_and_forced_it_diverges() {
    let scratch = Scratch::new();
    let run = |out: &str, more: &[String]| {
        let set = ["cell.length=24 mm", "cell.width=24 mm", "layers=3"].map(str::to_owned);
        let sets = set.iter().chain(more).flat_map(|set| ["--set".to_owned(), set.clone()]);
        let words = ["run", "grains_3d_bed_quick", "--json", "--out", out].map(str::to_owned);
        scratch.bedload(words.into_iter().chain(sets).collect::<Vec<_>>())
    };
    let found = run("rest", &[]).exits(0).json();
    let number = |name: &str| found["results"][name]["value"].as_f64().unwrap();
    let limit = number("time_step_s") / number("time_step_over_limit");
    let step = |share: f64| format!("discrete.time_step={:e} s", share * limit);
    run("in", &[step(0.95)]).exits(0);
    let refused = run("out", &[step(1.05)]).exits(3).json();
    assert_eq!(refused["error"]["code"], "step-too-long", "{refused}");
    let forced = run("far", &[step(3.0), "discrete.force_time_step=true".into()]).exits(3).json();
    assert!(["overlap", "not-finite", "grain-lost"].contains(&forced["error"]["code"].as_str().unwrap()), "{forced}");
}
