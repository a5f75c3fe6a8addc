//! A model and a law that are not of the crate go through its public interface alone.

use bedload::case::Case;
use bedload::result::{Class, Failure};
use bedload::study::{Settings, conduct, sweep};
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
    let order = &converged.assessment.facts["orders_from_coarsest_to_finest"]["mesh"]["order_velocity"];
    assert!((order.as_f64().unwrap() - 2.0).abs() < 0.1, "{:?}", converged.assessment.facts);
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
    assert!(error.to_string().contains("geometry.sine"), "{error}");
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

#[test]
fn a_fault_of_its_own_is_diagnosed_as_any_other() {
    let coarse = ["closures.viscosity.n=0.05".to_owned(), "grid.cells=20".to_owned()];
    let error = example::registry().parse("film", "film.toml", example::CASE.into(), &coarse).unwrap_err();
    let report = &error.reports()[0];
    assert_eq!((report.code.as_str(), report.path.as_deref()), ("too-coarse", Some("thin-film.grid.cells")));
    assert_eq!(report.allowed.as_deref(), Some("at least 40"));
    assert!(report.hint.as_ref().is_some_and(|hint| hint.starts_with("the smaller n is")), "{report:?}");
    let shown = error.render(false);
    assert!(
        ["too-coarse", "20 cells do not resolve", "at least 40", "the smaller n is"].iter().all(|w| shown.contains(w))
    );
    // Whoever knows the model has its numbers.
    let fault: Option<&example::TooCoarse> = error.violations[0].fault.downcast_ref();
    assert_eq!(fault.map(|fault| (fault.cells, fault.least)), Some((20, 40.0)));
    assert!(error.violations[0].fault.downcast_ref::<bedload::case::Fault>().is_none());
}

#[test]
fn a_failure_of_its_own_reaches_the_summary_and_has_its_class() {
    let (scratch, registry) = (Scratch::new(), example::registry());
    std::fs::write(scratch.path("film.toml"), example::CASE).unwrap();
    let mut settings = Settings::new(&registry, "own_model", &example::Nobody);
    (settings.out, settings.threads) = (Some(scratch.path("o")), 1);
    let case = scratch.path("film.toml").display().to_string();
    let (plan, assess) = sweep::plan(&case, &[], &["geometry.sine=0.05,0.5".into()]).unwrap();
    let swept = conduct(&plan, &settings, Box::new(|_, _| (Vec::new(), assess))).unwrap();
    let [good, fast] = &swept.rows[..] else { panic!("{:?}", swept.rows) };
    assert_eq!((good.class, fast.class), (None, Some(Class::Unphysical)));
    let folder = swept.record["points"][1]["folder"].as_str().unwrap().to_owned();
    let error = &scratch.summary(&format!("o/{folder}"))["error"];
    assert_eq!(error["code"], "compressible");
    assert!(error["message"].as_str().unwrap().starts_with("the film would flow at 80"), "{error}");
    assert_eq!(error["hint"], "a thinner film (geometry.height), or a smaller geometry.sine");
    let (_, problem) =
        registry.parse("film", "film.toml", example::CASE.into(), &["geometry.sine=0.5".into()]).unwrap();
    let Failure { error, .. } = bedload::prelude::Simulation::new(&problem).run().unwrap_err();
    assert!(error.downcast_ref::<example::Compressible>().is_some_and(|error| error.velocity_m_s > 500.0), "{error:?}");
    assert!(error.downcast_ref::<bedload::result::NumericalError>().is_none());
}
