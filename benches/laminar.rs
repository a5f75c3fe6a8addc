//! What the second velocity costs: the laminar bed in both forms, solved in turn in one run. `cargo bench --bench laminar`.
//!
//! Chauchat & Medale (2010), Table 2, find the two-fluid form several times as expensive as the mixed one in three dimensions.
//! Here: median time of a solve and their ratio, at equal mesh and equal regularisation, with the error of each against its
//! exact yield, and the rate that the mixed form misses.

use std::hint::black_box;
use std::time::Instant;

use bedload::closures::regularisation::{Regularisation, Smoothing};
use bedload::models::laminar::bench::{Bed, Nodes};

const REPEATS: usize = 201;

fn bed(k: Option<f64>) -> Bed {
    Bed { f: 0.1, h_p: 0.5, phi: 0.55, mu_s: 0.43, rise: None, e: 2.375, k, dilation: None }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let forms = [bed(None), bed(Some(1.859_504_132_231_405e-6))];
    println!(
        "{:>8} {:>8} {:>12} {:>12} {:>7} {:>12} {:>12}",
        "cells", "lambda", "mixed", "two-fluid", "ratio", "error", "error"
    );
    for elements in [100, 200, 400] {
        for lambda in [0.0, 1e-4, 1e-6, 1e-8] {
            let law = if lambda > 0.0 { Smoothing::Simple } else { Smoothing::None };
            let (nodes, regularisation) = (Nodes { elements, on_yield: true }, Regularisation { law, lambda });
            let mut times = [Vec::new(), Vec::new()];
            // In turn, so that both meet the same disturbances.
            for _ in 0..REPEATS {
                for (bed, times) in forms.iter().zip(&mut times) {
                    let start = Instant::now();
                    black_box(bed.solve(nodes, &regularisation)?);
                    times.push(start.elapsed().as_secs_f64());
                }
            }
            let [mixed, two] = times.map(|mut times| {
                times.sort_by(f64::total_cmp);
                1e6 * times[REPEATS / 2]
            });
            let mut errors = [0.0; 2];
            for (bed, error) in forms.iter().zip(&mut errors) {
                let exact = bed.solve(nodes, &Regularisation::EXACT)?.flux();
                *error = bed.solve(nodes, &regularisation)?.flux() / exact - 1.0;
            }
            let [a, b] = errors;
            println!(
                "{elements:>8} {lambda:>8.0e} {mixed:>9.1} µs {two:>9.1} µs {:>7.2} {a:>12.2e} {b:>12.2e}",
                two / mixed
            );
        }
    }
    let nodes = Nodes { elements: 200, on_yield: true };
    let [mixed, two] = [&forms[0], &forms[1]].map(|bed| bed.solve(nodes, &Regularisation::EXACT).map(|s| s.flux()));
    println!("the mixed form misses the rate of the two-fluid form by {:+.2e}", mixed? / two? - 1.0);
    Ok(())
}
