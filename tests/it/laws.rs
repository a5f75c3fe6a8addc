//! The text of a law stands in its catalogue entry alone: models print it from there, and spell no formula of a law again.

use std::fs;

use bedload::case::shipped;
use bedload::closures::catalogue;

use crate::support::{REGISTRY, files, project};

/// Laws that no shipped case has: a case, and what it is given instead of its own.
const OTHERS: &[(&str, &str)] = &[
    ("flow_theta06-sheet-flow", "flow.top={ law = \"stress\", stress = 1.4 }"),
    ("flow_theta06-sheet-flow", "flow.top={ law = \"colebrook-white\", roughness = 1e-4 }"),
    ("flow_theta06-sheet-flow", "closures.suspension={ law = \"none\" }"),
    ("flow_theta06-sheet-flow", "closures.rearrangement={ law = \"free-fall\" }"),
    ("flow_theta06-two-fluid", "closures.granular={ law = \"garzo-dufty\" }"),
    ("flow_theta06-two-fluid", "closures.granular={ law = \"mu-i\" }"),
    ("flow_theta06-two-fluid", "closures.elastic={ law = \"none\" }"),
    ("flow_theta06-two-fluid", "closures.static_friction={ law = \"given\", mu_s = 0.3 }"),
    ("flow_theta06-two-fluid", "closures.dispersion={ law = \"gradient\" }"),
    ("flow_theta06-two-fluid", "closures.mixing_length={ law = \"prandtl\" }"),
    ("flow_theta04_quick", "closures.fluctuation={ law = \"none\" }"),
    ("flow_theta04_quick", "closures.mixture_viscosity={ law = \"einstein\" }"),
    ("flume_exp14_quick", "closures.side_wall={ law = \"blasius\" }"),
];

#[test]
fn each_law_of_a_problem_stands_in_its_equations_as_in_the_catalogue() {
    let shipped = shipped::names().map(|name| (name, Vec::new()));
    let others = OTHERS.iter().map(|(name, set)| (*name, vec![(*set).to_owned()]));
    let (mut missing, mut seen) = (Vec::new(), 0);
    for (name, set) in shipped.chain(others) {
        let (_, problem) = REGISTRY.load(name, &set).unwrap_or_else(|error| panic!("{name} {set:?}: {error}"));
        let description = problem.describe();
        for info in description.laws {
            seen += 1;
            if !description.equations.contains(info.equation) {
                missing.push(format!("{name} {set:?}: {}/{}: {}", info.family, info.law, info.equation));
            }
        }
    }
    assert!(seen > 200, "{seen}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn no_model_spells_the_formula_of_a_law() {
    let formulas: Vec<&str> = catalogue()
        // What a neutral law says, `u_f = u_p`, a balance may say, too.
        .filter(|info| !info.source.contains("neutral"))
        .flat_map(|info| info.equation.split(",  "))
        .filter(|formula| formula.contains(['=', '→']))
        .collect();
    assert!(formulas.len() > 40, "{}", formulas.len());
    for folder in ["src/models", "src/dem"] {
        for path in files(&project(folder), "rs") {
            let text = fs::read_to_string(&path).unwrap();
            for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
                for formula in &formulas {
                    assert!(!line.contains(formula), "{}: {formula}: print it from INFO", path.display());
                }
            }
        }
    }
}
