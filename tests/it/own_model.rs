//! A model and a law that are not of the crate go through its public interface alone.

use bedload::case::Case;
use serde_json::Value;

use crate::support::Scratch;

#[path = "../../examples/own_model.rs"]
mod example;

#[test]
fn a_model_from_outside_is_swept_and_converges() {
    let scratch = Scratch::new();
    let [swept, converged] = example::studies(&scratch.path(".")).unwrap();
    // n = 1/2: the discharge goes with the square of the slope.
    let discharge = |i: usize| swept.rows[i].result("discharge_m2_s").unwrap();
    for i in 1..3 {
        assert!((discharge(i) / discharge(i - 1) - 4.0).abs() < 1e-9);
    }
    let order = &converged.judgement.facts["orders_from_coarsest_to_finest"]["mesh"]["order_velocity"];
    assert!((order.as_f64().unwrap() - 2.0).abs() < 0.1, "{:?}", converged.judgement.facts);
    assert_eq!(converged.rows.len(), 5);
}

#[test]
fn its_cases_have_the_diagnostics_of_any_other() {
    let registry = example::registry();
    let bad = example::CASE.replace("sine = 0.05", "sine = 1.5").replace("n = 0.5", "m = 0.5");
    let error = registry.parse("film", "film.toml", bad, &[]).unwrap_err();
    let codes: Vec<&str> = error.violations.iter().map(|v| v.fault.code()).collect();
    assert_eq!(codes, ["out-of-range", "unknown-key"], "{error}");
    // The error says so itself, without a terminal.
    assert!(error.to_string().contains("flow.sine"), "{error}");
    let (case, problem) = registry.parse("film", "film.toml", example::CASE.into(), &[]).unwrap();
    assert_eq!((problem.kind, problem.cells()), ("thin-film", 200));
    let again = Case::parse(registry.kinds(), "film", "film.toml", case.resolved(), &[]).unwrap();
    assert_eq!(again.resolved(), case.resolved());
    let schema = bedload::case::schema::published(registry.kinds());
    assert!(
        schema["oneOf"]
            .as_array()
            .is_some_and(|all| all.iter().any(|kind: &Value| kind.to_string().contains("thin-film")))
    );
}
