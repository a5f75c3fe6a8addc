//! The flow in time: order, conservation, and where it ends.

use super::reference;
use crate::models::two_fluid::levels::Levels;
use crate::models::two_fluid::steady;
use crate::models::two_fluid::transient::March;
use crate::result::quantity as q;
use approx::assert_relative_eq;

#[test]
fn it_ends_where_the_steady_flow_is_and_keeps_its_grains() {
    let (flow, column) = reference(&["grid.fine="], 60);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let wanted = Levels::new(&column, &solved.state, &solved.mobilised).flux();
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
fn order_two_in_time() {
    // From the steady flow under a drive that grows smoothly: grains that begin to move are kinks, and lower the order there.
    let (flow, column) = reference(&["grid.fine="], 40);
    let solved = steady::solve(&column, flow.phi, flow.shields(), |_| false).unwrap();
    let drive = |time: f64| column.laws.drive.map(|drive| drive * (1.0 + 0.2 * (0.3 * time).sin().powi(2)));
    let after = |tolerance: f64| {
        let mut march = March::new(column.clone(), solved.state.clone());
        while march.time < 20.0 {
            march.step(tolerance, 20.0, drive).unwrap();
        }
        (march.state.iter().map(|x| x[super::super::state::FLUID]).sum::<f64>(), march.steps)
    };
    let (finest, _) = after(1e-8);
    let (rough, fine) = (after(1e-4), after(1e-6));
    let ratio = ((rough.0 - finest) / (fine.0 - finest)).abs();
    let order = ratio.ln() / (fine.1 as f64 / rough.1 as f64).ln();
    assert!(order > 1.7, "{order}: {rough:?} {fine:?} {finest}");
}

#[test]
fn a_suspension_settles_with_the_hindered_velocity() {
    // Kynch: the interface to the clear fluid falls with w(phi), the bed rises with phi w/(phi_bed - phi).
    let flow = super::flow("kinetic_1d_settling", &[]);
    let column = super::scaled(&flow, 240).unwrap();
    let drive = column.laws.drive;
    let mut march = March::new(column.clone(), column.at_rest(flow.phi));
    let level = |march: &March, phi: f64, above: bool| {
        let cells = Levels::new(&march.column, &march.state, &march.mobilised).cells;
        let crossed = |pair: &&[crate::models::two_fluid::levels::Level]| pair[0].phi >= phi && pair[1].phi < phi;
        let mut pairs = cells.windows(2);
        let pair = if above { pairs.rfind(crossed) } else { pairs.find(crossed) }.unwrap();
        pair[0].z + (pair[1].z - pair[0].z) * (pair[0].phi - phi) / (pair[0].phi - pair[1].phi)
    };
    let mut at = |time: f64| {
        while march.time < time {
            march.step(1e-3, time, |_| drive).unwrap();
        }
        (level(&march, 0.05, true), level(&march, 0.35, false))
    };
    let (early, late) = (at(20.0), at(45.0));
    let (laws, eps) = (&column.laws, 1.0 - flow.phi);
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..60 {
        let w: f64 = 0.5 * (low + high);
        let k = 0.75 * (0.4 * w / eps + 24.4 * laws.nu) * eps.powf(-4.1);
        if k * w / eps < 1.0 { low = w } else { high = w }
    }
    assert_relative_eq!((early.0 - late.0) / 25.0, low, max_relative = 0.02);
    let rise = (late.1 - early.1) / 25.0;
    assert!((0.8..1.2).contains(&(rise / (flow.phi * low / (0.58 - flow.phi)))), "{rise}");
}

#[test]
fn waves_go_to_and_fro() {
    let set = ["state=transient", "flow.shields=", "flow.depth=0.1", "flow.slope=0", "grid.fine="];
    // Water that goes with 1 m/s: a fifth of that leaves the bed at rest.
    let waves = [
        "flow.oscillation.amplitude=3000",
        "flow.oscillation.period=2",
        "solver.duration=8",
        "solver.samples=160",
        "solver.tolerance=1e-2",
    ];
    let all: Vec<&str> = set.into_iter().chain(waves).collect();
    let flow = super::flow("flow_theta06-two-fluid", &all);
    let outcome = crate::models::two_fluid::run(&flow, 60, &mut crate::result::Quiet).unwrap();
    let series = outcome.series.as_ref().unwrap();
    let rates: Vec<f64> =
        series.get(&crate::result::quantity::RATE_IN_TIME).unwrap()[80..].iter().flatten().copied().collect();
    let (low, high) = rates.iter().fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
    assert!(high > 1e-4 && low < -1e-4, "{low} {high}");
    assert!((low + high).abs() < 0.3 * high, "{low} {high}");
    // What is reported is of whole periods: the four of 8 s, of which the last two are averaged.
    let get = |quantity: &crate::result::Quantity| outcome.results.get(quantity.name).unwrap();
    let later = &rates;
    let mean = later.iter().sum::<f64>() / later.len() as f64;
    let amplitude = get(&q::RATE_AMPLITUDE);
    assert!((get(&q::TRANSPORT_RATE) - mean).abs() < 1e-3 * amplitude, "{mean}");
    let halves = [get(&q::RATE_FORWARD), get(&q::RATE_BACKWARD)];
    assert_relative_eq!(0.5 * (halves[0] + halves[1]), get(&q::TRANSPORT_RATE), epsilon = 1e-9 * amplitude);
    let of = |from: usize| {
        let halves = [0, 40].map(|period| later[period + from..period + from + 20].iter().sum::<f64>() / 20.0);
        0.5 * (halves[0] + halves[1])
    };
    assert!(halves[0] > 0.0 && halves[1] < 0.0, "{halves:?}");
    assert!((halves[0] - of(0)).abs() + (halves[1] - of(20)).abs() < 2e-3 * amplitude, "{halves:?}");
    assert!((amplitude / (0.5 * (high - low)) - 1.0).abs() < 0.05, "{amplitude} {low} {high}");
    assert_relative_eq!(get(&q::AVERAGED_TIME), 4.0, max_relative = 1e-9);
    // At 90 and 270 degrees the clear fluid is fastest: G T/(2 pi rho_f) without friction.
    let top = |quantity: &crate::result::Quantity| {
        outcome.profile.as_ref().unwrap().get(quantity).unwrap().last().unwrap().unwrap()
    };
    let fastest = 3000.0 * 2.0 / (std::f64::consts::TAU * 1000.0);
    for (phase, sign) in [(1, 1.0), (3, -1.0)] {
        assert!((0.8..1.05).contains(&(sign * top(q::PHASES[phase][1]) / fastest)), "{phase}");
    }
}
