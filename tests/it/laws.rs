//! The text of a law stands in its catalogue entry alone: models print it from there, and spell no formula of a law again.

use std::fs;

use bedload::case::shipped;
use bedload::closures::catalogue;

use crate::support::{REGISTRY, files, project};

/// Laws that no shipped case has: a case, and what it is given instead of its own.
const OTHERS: &[(&str, &str)] = &[
    ("sheet_1d_theta06", "closures.lid={ law = \"stress\", stress = 1.4 }"),
    ("sheet_1d_theta06", "closures.lid={ law = \"colebrook-white\", roughness = 1e-4 }"),
    ("sheet_1d_theta06", "closures.suspension={ law = \"none\" }"),
    ("sheet_1d_theta06", "closures.rearrangement={ law = \"free-fall\" }"),
    ("kinetic_1d_theta06", "closures.granular={ law = \"garzo-dufty\" }"),
    ("kinetic_1d_theta06", "closures.granular={ law = \"mu-i\" }"),
    ("kinetic_1d_theta06", "closures.elastic={ law = \"none\" }"),
    ("kinetic_1d_theta06", "closures.static_friction={ law = \"given\", mu_s = 0.3 }"),
    ("kinetic_1d_theta06", "closures.dispersion={ law = \"gradient\" }"),
    ("kinetic_1d_theta06", "closures.mixing_length={ law = \"prandtl\" }"),
    ("coupled_3d_theta04_quick", "closures.fluctuation={ law = \"none\" }"),
    ("coupled_3d_theta04_quick", "closures.mixture_viscosity={ law = \"einstein\" }"),
    ("coupled_2d_exp14_quick", "closures.side_wall={ law = \"blasius\" }"),
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
