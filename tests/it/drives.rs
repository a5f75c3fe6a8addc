//! What drives a flow: what is solved for where another number is given, and waves.

use std::fs;

use crate::support::{REGISTRY, project, run};

#[test]
fn what_drives_a_flow_between_planes_is_solved_for() {
    let drive = |model: &str, set: &[&str]| {
        let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
        let problem = REGISTRY.load(&format!("bed_ouriemi-{model}"), &set).unwrap().1;
        run(&problem).unwrap().results
    };
    for model in ["laminar-exact", "laminar"] {
        let given = drive(model, &[]);
        for (key, result) in [
            ("discharge", "fluid_discharge_m2_s"),
            ("mean_velocity", "mean_velocity_m_s"),
            ("shields", "shields"),
            ("u_star", "u_star_m_s"),
        ] {
            let wanted = given.get(result).unwrap();
            let found = drive(model, &["flow.pressure_gradient=", &format!("flow.{key}={wanted}")]);
            let gradient = found.get("pressure_gradient_Pa_m").unwrap();
            assert!((gradient / 1471.5 - 1.0).abs() < 1e-7, "{model} {key}: {gradient}");
            assert!((found.get(result).unwrap() / wanted - 1.0).abs() < 1e-7, "{model} {key}");
        }
    }
    let refused = |set: &[&str]| {
        let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
        REGISTRY.load("bed_ouriemi-laminar", &set).unwrap_err().render(false)
    };
    let two = refused(&["flow.discharge=1e-4"]);
    assert!(two.contains("2 drives: pressure_gradient, discharge"), "{two}");
    let slope = refused(&["flow.pressure_gradient=", "flow.slope=2 deg"]);
    assert!(slope.contains("pressure_gradient, discharge, mean_velocity, shields, u_star"), "{slope}");
    let far = set_of("flow.mean_velocity=1e3");
    let failure = run(&REGISTRY.load("bed_ouriemi-laminar", &far).unwrap().1).unwrap_err();
    assert_eq!(failure.error.code(), "out-of-reach", "{failure}");
}

fn set_of(drive: &str) -> [String; 2] {
    ["flow.pressure_gradient=".to_owned(), drive.to_owned()]
}

#[test]
fn waves_that_were_measured_are_those_of_the_same_form() {
    let waves = fs::read_to_string(project("cases/kinetic_1d_waves.toml")).unwrap();
    let small = ["grid.cells=30", "solver.duration=1.2", "solver.samples=12"].map(str::to_owned);
    let solved = |text: &str| run(&REGISTRY.parse("waves", "waves.toml", text.to_owned(), &small).unwrap().1).unwrap();
    let form = "[flow.oscillation]\namplitude = \"1257 Pa/m\"\nperiod = \"5 s\"\n";
    assert!(waves.contains(form));
    let moment = |i: usize| {
        let time = i as f64 * 0.01;
        let fall = 1257.0 * (std::f64::consts::TAU * time / 5.0).cos();
        format!("[[flow.recorded]]\ntime = {time}\npressure_gradient = {fall}\n")
    };
    let recorded = |moments: usize| waves.replace(form, &(0..moments).map(moment).collect::<String>());
    let (form, record) = (solved(&waves), solved(&recorded(121)));
    for name in ["fluid_discharge_m2_s", "shields_bed"] {
        let (a, b) = (form.results.get(name), record.results.get(name));
        assert!(a.zip(b).is_some_and(|(a, b)| (b / a - 1.0).abs() < 2e-3), "{name}: {a:?} {b:?}");
    }
    // A record of one whole period has the mean and the amplitude of the form.
    let period = ["grid.cells=30", "solver.duration=5", "solver.samples=20"].map(str::to_owned);
    let solved = |text: &str| run(&REGISTRY.parse("waves", "waves.toml", text.to_owned(), &period).unwrap().1).unwrap();
    let [form, record] = [solved(&waves), solved(&recorded(501))].map(|outcome| outcome.results);
    let amplitude = form.get("transport_rate_amplitude_m2_s").unwrap();
    for name in ["transport_rate_m2_s", "transport_rate_amplitude_m2_s"] {
        let (a, b) = (form.get(name).unwrap(), record.get(name).unwrap());
        assert!((b - a).abs() < 2e-3 * amplitude && a.abs() > 4e-3 * amplitude, "{name}: {a} {b}");
    }
    assert!((record.get("averaged_time_s").unwrap() - 5.0).abs() < 1e-12);
    assert!(record.reason("transport_rate_forward_m2_s").is_some_and(|why| why.contains("no half-cycles")));
    let code = |text: String| {
        let refused = REGISTRY.parse("waves", "waves.toml", text, &small).unwrap_err();
        refused.violations[0].fault.code().to_owned()
    };
    assert_eq!(code(recorded(60)), "record-ends");
    assert_eq!(code(recorded(121).replace("time = 0.5\n", "time = 0.9\n")), "out-of-range");
    assert_eq!(code(recorded(121).replacen("time = 0\n", "time = 0.001\n", 1)), "out-of-range");
    assert_eq!(code(format!("{}[flow.oscillation]\namplitude = 1\nperiod = 1\n", recorded(121))), "drives");
}
