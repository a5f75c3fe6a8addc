//! Newton's method against the iteration of Revil-Baudard & Chauchat (2013), Appendix B, on the same discrete equations, in one
//! run. `cargo bench --bench sheet`.
//!
//! First the time of a cold start of Newton's method on 300 cells, case by case. Then both methods with the paper's
//! regularisation to the same error of the transport rate against the solution of the discrete equations, the iteration from
//! the same first guess at several steps of pseudo-time: the fastest that gets there counts.

use std::hint::black_box;
use std::time::Instant;

use bedload::model::{OnMesh, read};
use bedload::models::sheet_flow::SheetFlow;
use bedload::models::sheet_flow::bench::{Column, Flow, Layers, REST, Setting, StepControl, solve};

const CASES: [&str; 6] = [
    "sheet_1d_sumer82",
    "sheet_1d_sumer91",
    "sheet_1d_sumer99",
    "sheet_1d_cowen",
    "sheet_1d_type_a",
    "sheet_1d_type_b",
];
const REPEATS: usize = 51;
const CELLS: usize = 300;
/// Relative error of the transport rate at which both stop.
const ERROR: f64 = 1e-4;
/// Steps of pseudo-time, scaled; iterations at most.
const STEPS: [f64; 8] = [0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0];
const MAX_ITERATIONS: usize = 40_000;
/// Iterations between two looks at the transport rate.
const LOOK: usize = 20;
/// Looks in a row at which the error must be small.
const STAYS: usize = 20;

fn scaled(case: &str, settings: &[&str]) -> Result<(Flow, Setting), Box<dyn std::error::Error>> {
    let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
    let sheet = read::<OnMesh<SheetFlow>>(case, &settings)?.problem;
    Ok((Flow::scaled(&sheet), Setting::scaled(&sheet)))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Milliseconds of a solution from cold.
fn cold(flow: Flow, setting: Setting) -> f64 {
    let times = (0..REPEATS).map(|_| {
        let start = Instant::now();
        let _ = black_box(solve(flow, setting, CELLS));
        1e3 * start.elapsed().as_secs_f64()
    });
    median(times.collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("Newton from cold, {CELLS} cells, median of {REPEATS}");
    for case in CASES {
        let (flow, setting) = scaled(case, &[])?;
        let solved = solve(flow, setting, CELLS).map_err(|failed| format!("{case}: {failed:?}"))?;
        println!("{case:>18} {:>8.2} ms {:>4} iterations", cold(flow, setting), solved.history.len());
    }
    println!("\nboth to {ERROR:e} of the transport rate, regularisation 1e-6 1/s, {CELLS} cells");
    for case in &CASES[..4] {
        let (flow, setting) = scaled(case, &["regularisation.law=simple", "regularisation.lambda=1e-6"])?;
        let solved = solve(flow, setting, CELLS).map_err(|failed| format!("{case}: {failed:?}"))?;
        let psi = Layers::new(&solved.column, &solved.state).psi();
        let newton = cold(flow, setting);
        let mut best: Option<(f64, f64, usize)> = None;
        for dt in STEPS {
            let (_, guess) = Column::start(flow, setting, CELLS, REST);
            // Iterated in blocks, so that only the iteration is timed.
            let (mut state, mut iterations, mut spent) = (guess, 0, 0.0);
            let control = StepControl { dt, tolerance: 0.0, max_iterations: LOOK };
            let column = &solved.column;
            // Within the error for good: at several looks in a row, of which the first counts.
            let (mut within, mut first) = (0, (0.0, 0));
            let found = loop {
                let start = Instant::now();
                let Some(next) = column.iterate_for(state, &control) else { break false };
                spent += start.elapsed().as_secs_f64();
                (state, iterations) = (next, iterations + LOOK);
                let error = (Layers::new(column, &state).psi() / psi - 1.0).abs();
                if error > ERROR {
                    within = 0;
                } else {
                    within += 1;
                    if within == 1 {
                        first = (spent, iterations);
                    }
                }
                if within == STAYS {
                    break true;
                }
                if iterations >= MAX_ITERATIONS || !error.is_finite() {
                    break false;
                }
            };
            (spent, iterations) = first;
            if found && best.is_none_or(|(least, ..)| spent < least) {
                best = Some((spent, dt, iterations));
            }
        }
        match best {
            Some((spent, dt, iterations)) => println!(
                "{case:>18} Newton {newton:>7.2} ms, iteration {:>9.2} ms at its best step {dt} ({iterations} iterations): ratio {:.0}",
                1e3 * spent,
                1e3 * spent / newton
            ),
            None => println!("{case:>18} Newton {newton:>7.2} ms, the iteration does not get there"),
        }
    }
    Ok(())
}
