//! A friction law from outside is solved by sheet flow through the public interface alone.

use bedload::closures::friction::FrictionLaw;
use bedload::result::quantity as q;

use crate::support::{REGISTRY, run};

#[path = "../../examples/own_law.rs"]
mod example;

use example::{Power, reference, registry};

#[test]
fn with_the_exponent_of_the_published_law_it_gives_the_published_flow() {
    let (_, published) = REGISTRY.load("flow_theta06-sheet-flow", &[]).unwrap();
    let (own, published) = (run(&reference(1.0).unwrap()).unwrap(), run(&published).unwrap());
    for quantity in [&q::TRANSPORT_RATE, &q::SHIELDS, &q::PHI_INTERFACE] {
        let [a, b] = [&own, &published].map(|outcome| outcome.results.get(quantity.name).unwrap());
        assert!((a / b - 1.0).abs() < 1e-6, "{}: {a} {b}", quantity.name);
    }
}

#[test]
fn moving_grains_carry_the_friction_of_the_law() {
    let law = Power { mu_s: 0.35, mu_2: 0.97, i_0: 0.69, n: 0.5 };
    let problem = reference(law.n).unwrap();
    let outcome = run(&problem).unwrap();
    let profile = outcome.profile.unwrap();
    let column = |quantity| profile.get(quantity).unwrap();
    let rows = column(&q::TAU_PARTICLE).iter().zip(column(&q::P_PARTICLE)).zip(column(&q::INERTIAL_NUMBER));
    let moving: Vec<[f64; 3]> =
        rows.filter_map(|((tau, p), i)| Some([(*tau)?, (*p)?, (*i)?])).filter(|row| row[2] > 1e-6).collect();
    assert!(moving.len() > 50, "{}", moving.len());
    for [tau, p, i] in moving {
        assert!((tau / p - law.mu(i)).abs() < 1e-8, "{tau} {p} {i}");
    }
    // By hand: half-way at I_0, and a quarter of I_0 halves the root.
    assert!((law.mu(0.69) - 0.66).abs() < 1e-15);
    assert!((law.mu(0.69 / 4.0) - (0.35 + 0.62 / 3.0)).abs() < 1e-14);
}

#[test]
fn it_has_the_texts_and_the_diagnostics_of_any_other() {
    let description = reference(0.5).unwrap().describe();
    let law = description.laws.iter().find(|info| info.law == "power").unwrap();
    assert!(description.equations.contains(&format!("{},  μ_s = 0.35000", law.equation)), "{}", description.equations);
    assert!(description.equations.contains("I_0 = 0.69000, n = 0.50000"), "{}", description.equations);
    // Its model takes it alone: mu(I) is a law of another model then.
    let refused = |set: &str| {
        let error = registry().load("flow_theta06-sheet-flow", &[format!("closures.friction={set}")]).unwrap_err();
        let codes = error.violations.iter().map(|v| format!("{} {}", v.fault.code(), v.path));
        codes.collect::<Vec<_>>().join(", ")
    };
    let friction = "mu_s = 0.35, mu_2 = 0.97, i_0 = 0.69";
    assert_eq!(refused(&format!("{{ law = \"mu-i\", {friction} }}")), "law-mismatch sheet-flow.closures.friction.law");
    assert_eq!(
        refused(&format!("{{ law = \"power\", {friction}, n = 20 }}")),
        "out-of-range sheet-flow.closures.friction.n"
    );
    assert_eq!(
        refused("{ law = \"power\", mu_s = 0.7, mu_2 = 0.6, i_0 = 0.69, n = 1 }"),
        "friction-falls sheet-flow.closures.friction.mu_2"
    );
    let (case, _) = registry()
        .load("flow_theta06-sheet-flow", &[format!("closures.friction={{ law = \"power\", {friction}, n = 1 }}")])
        .unwrap();
    let again = registry().parse("again", "again.toml", case.resolved(), &[]).unwrap().0;
    assert_eq!(again.resolved(), case.resolved());
}
