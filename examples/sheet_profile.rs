//! Scratch: times and errors.
use bedload::case::Case;
use bedload::continuum::sheet_flow::{column::Setting, flow::Flow, layers::Layers, solve::solve};
use bedload::problem::{Model, Problem};
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let cells: Vec<usize> = if args.is_empty() { vec![300] } else { args.iter().filter_map(|x| x.parse().ok()).collect() };
    for case in ["sheet_1d_sumer82", "sheet_1d_sumer91", "sheet_1d_sumer99", "sheet_1d_cowen", "sheet_1d_type_a", "sheet_1d_type_b"] {
        let p = Problem::new(&Case::load(case, &[]).unwrap()).unwrap();
        let Model::SheetFlow(s) = p.model else { panic!() };
        let (f, g) = (Flow::scaled(&s), Setting::scaled(&s));
        for &n in &cells {
            let mut best = f64::INFINITY;
            for _ in 0..15 {
                let t = Instant::now();
                std::hint::black_box(solve(f, g, n).is_ok());
                best = best.min(t.elapsed().as_secs_f64());
            }
            match solve(f, g, n) {
                Ok(x) => {
                    let l = Layers::new(&x.column, &x.state);
                    println!("{case} {n} {:.2} ms {} it psi {:.8} phi0 {:.7} flux {:.8} cut {:.3}", 1e3 * best, x.history.len(), l.psi(), l.inflow.phi, l.flux, x.column.flow.cut);
                    if std::env::var("HIST").is_ok() { println!("{:?}", x.history.iter().map(|r| format!("{r:.0e}")).collect::<Vec<_>>().join(" ")); }
                }
                Err(e) => println!("{case} {n} {e:?}"),
            }
        }
    }
}
