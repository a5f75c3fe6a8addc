//! The whole three-dimensional duct against its cross-section.

use std::ops::ControlFlow;

use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::models::section::Outline;
use crate::models::section::duct::{Duct, Filling};
use crate::models::section::full::{Full, Whole};
use crate::models::section::newton;

use super::{load, run};

const PAPER: Regularisation = Regularisation { law: Smoothing::Simple, lambda: 1e-6 };

/// The whole duct, and the largest difference of its velocity from that of the section over the largest one.
fn both(duct: &Duct, rows: usize, weight: f64, law: &Regularisation) -> (Whole, f64) {
    let divided = duct.divide(rows / 2, rows, 1.0, None);
    let go_on = &mut |_| ControlFlow::Continue(());
    let section = newton::solve(&divided.program, law, go_on).unwrap();
    let whole = Full::new(&divided, 2, weight).solve(law, go_on).unwrap();
    let largest = section.x.iter().fold(0.0_f64, |m, x| m.max(*x));
    let apart = section.x.iter().zip(&whole.section.x).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    println!("{apart:.1e} of {largest:.1e}, across {:.1e}, pressure {:.1e}", whole.across, whole.pressure);
    (whole, apart / largest)
}

#[test]
fn the_whole_duct_over_a_bed_has_the_velocity_of_its_section_and_the_pressure_of_the_grains() {
    let filling = Filling::Bed { level: 0.5, e: 2.375, resistance: 0.43 * 0.55, k: None };
    for shape in [Outline::Rectangle { width: 1.0 }, Outline::Circle] {
        let (whole, apart) = both(&Duct { shape, filling, f: 0.1 }, 8, 0.55, &PAPER);
        assert!(apart < 1e-8, "{shape:?}: {apart}");
        assert!(whole.across < 1e-8 && whole.uneven < 1e-8, "{shape:?}: {} {}", whole.across, whole.uneven);
        assert!(whole.pressure < 1e-6, "{shape:?}: {}", whole.pressure);
    }
}

#[test]
fn the_whole_duct_has_the_plug_of_a_bingham_fluid() {
    let duct = Duct { shape: Outline::Rectangle { width: 1.0 }, filling: Filling::Bingham(0.1), f: 1.0 };
    let (_, apart) = both(&duct, 8, 0.0, &PAPER);
    assert!(apart < 1e-8, "{apart}");
}

#[test]
fn a_model_that_has_only_a_section_refuses_the_whole_duct() {
    for settings in [
        &["form=two-fluid", "closures.drag.law=carman-kozeny"][..],
        &["flow.section.shape=planes"],
        &["method=first-order", "regularisation={ law = \"none\" }"],
    ] {
        let refused = load("section_3d_square_bed", settings).unwrap_err();
        assert!(refused.render(false).contains("not-whole"), "{}", refused.render(false));
    }
}

#[test]
fn a_case_reports_how_far_the_whole_duct_is_from_its_section() {
    let results = run("section_3d_square_bed", &["grid.cells=8", "grid.along=2"]).results;
    for name in ["section_deviation", "cross_flow", "uneven_flow"] {
        assert!(results.get(name).unwrap() < 1e-8, "{name}: {:?}", results.get(name));
    }
    assert!(results.get("pressure_deviation").unwrap() < 1e-6);
    // 8 rows and 4 columns of elements, 4 planes: the walls hold the last node column and two node rows, symmetry one v.
    assert_eq!(results.get("unknowns_whole"), Some(f64::from((8 * 3 - 1) * 15 * 4)));
}
