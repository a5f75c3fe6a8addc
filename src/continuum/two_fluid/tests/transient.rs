//! The flow in time: order, conservation, and where it ends.

use super::reference;
use crate::continuum::two_fluid::levels::Levels;
use crate::continuum::two_fluid::steady;
use crate::continuum::two_fluid::transient::March;
use approx::assert_relative_eq;

#[test]
fn it_ends_where_the_steady_flow_is_and_keeps_its_grains() {
    let (flow, column) = reference(&[], 60);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let wanted = Levels::new(&column, &solved.state).flux();
    let drive = column.laws.drive;
    let mut march = March::new(column.clone(), column.at_rest(flow.phi));
    let end = 60.0 * flow.velocity_scale() / flow.d;
    while march.time < end {
        march.step(1e-3, end, |_| drive).unwrap();
    }
    assert_relative_eq!(march.flux(), wanted, max_relative = 1e-3);
    assert!(march.drift < 1e-12, "{:e}", march.drift);
}

#[test]
fn second_order_in_time() {
    let (_, column) = reference(&[], 40);
    let drive = column.laws.drive;
    let after = |tolerance: f64| {
        let mut march = March::new(column.clone(), column.at_rest(0.6065));
        while march.time < 20.0 {
            march.step(tolerance, 20.0, |_| drive).unwrap();
        }
        (march.state.iter().map(|x| x[super::super::state::FLUID]).sum::<f64>(), march.steps)
    };
    let (finest, _) = after(1e-8);
    let (rough, fine) = (after(1e-4), after(1e-6));
    let ratio = ((rough.0 - finest) / (fine.0 - finest)).abs();
    let order = ratio.ln() / (fine.1 as f64 / rough.1 as f64).ln();
    assert!(order > 1.5, "{order}: {rough:?} {fine:?} {finest}");
}
