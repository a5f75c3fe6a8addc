//! Scratch: hypercube statistics by trial.
use bedload::case::Case;
use bedload::continuum::sheet_flow::{column::Setting, flow::Flow, solve::solve};
use bedload::problem::{Model, Problem};
fn main() {
    let count: usize = std::env::args().nth(1).unwrap().parse().unwrap();
    let reading = std::env::args().nth(2).unwrap();
    let mut state = 88_172_645_463_325_252_u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut columns: Vec<Vec<usize>> = Vec::new();
    for _ in 0..8 {
        let mut column: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            column.swap(i, (uniform() * (i + 1) as f64) as usize);
        }
        columns.push(column);
    }
    let mut tally = std::collections::BTreeMap::new();
    let mut its = Vec::new();
    let t = std::time::Instant::now();
    for k in 0..count {
        let x: Vec<f64> = columns.iter().map(|c| (c[k] as f64 + uniform()) / count as f64).collect();
        let heavy = x[0] >= 0.5;
        let theta = 0.5 * 8f64.powf(x[1]);
        let (weight, d, level) = if heavy { (1.6, 0.25e-3, 0.012) } else { (0.14, 2.6e-3, 0.084) };
        let u_star = (weight * 9.81f64 * d * theta).sqrt();
        let w_s = u_star * (0.3 + 0.7 * x[6]) * if heavy { 1.0 } else { 2.0 };
        let mut settings = vec![
            format!("flow.shields={theta}"),
            format!("closures.friction.i_0={}", 0.1 * 10f64.powf(x[2])),
            format!("closures.dilatancy.b={}", 0.5 + 0.5 * x[3]),
            format!("closures.mixing_length.kappa={}", 0.35 + 0.06 * x[4]),
            format!("closures.suspension.settling_velocity={w_s}"),
            format!("bed.level={}", level * (0.5 + x[7])),
            format!("bed.reading={reading}"),
        ];
        if x[5] >= 0.3 {
            settings.push("regularisation.law=simple".into());
            settings.push(format!("regularisation.lambda={:e}", 10f64.powf(-12.0 + 10.0 * (x[5] - 0.3) / 0.7)));
        }
        let case = if heavy { "sheet_1d_type_b" } else { "sheet_1d_type_a" };
        let p = Problem::new(&Case::load(case, &settings).unwrap()).unwrap();
        let Model::SheetFlow(s) = p.model else { panic!() };
        let out = solve(Flow::scaled(&s), Setting::scaled(&s), 150);
        let key = match out {
            Ok(x) => { its.push(x.history.len()); format!("solved by {}", x.trial) }
            Err(e) => {
                if e.reason.is_none() {
                    println!("{case} theta {theta:.2} i0 {:.3} b {:.2} level {:.2} lambda {} ws {:.2} {:?}", s.friction.i_0, s.dilatancy.b, 0.5 + x[7], s.lambda, w_s/u_star, e);
                }
                format!("{:?}", e.reason.map(|r| format!("{r:?}")[..5].to_owned()))
            }
        };
        *tally.entry(key).or_insert(0) += 1;
    }
    its.sort();
    println!("{tally:#?} {:.1} s, iterations median {} 90 % {} max {}", t.elapsed().as_secs_f64(), its[its.len() / 2], its[its.len() * 9 / 10], its[its.len() - 1]);
}
