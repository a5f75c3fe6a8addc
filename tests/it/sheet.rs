//! Sheet flow, from outside: the published equations re-evaluated on the profiles that a run returns, balances, agreement of
//! the methods, what a user may change, and the errors.

use bedload::case::Case;
use bedload::problem::Problem;
use bedload::result::{Failure, Outcome, Profile, Quiet, SolveError, quantity as q};
use bedload::run;

fn attempt(case: &str, settings: &[&str]) -> Result<Outcome, Failure> {
    let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
    let case = Case::load(case, &settings).unwrap();
    run(&Problem::new(&case).unwrap(), &mut Quiet)
}

fn solve(case: &str, settings: &[&str]) -> Outcome {
    attempt(case, settings).unwrap()
}

fn get(outcome: &Outcome, name: &str) -> f64 {
    outcome.results.get(name).unwrap_or_else(|| panic!("{name}"))
}

const CASES: [&str; 6] = [
    "sheet_1d_sumer82",
    "sheet_1d_sumer91",
    "sheet_1d_sumer99",
    "sheet_1d_cowen",
    "sheet_1d_type_a",
    "sheet_1d_type_b",
];

struct Grains {
    d: f64,
    rho_p: f64,
    phi_max: f64,
    mu: (f64, f64),
    kappa: f64,
    w_s: f64,
}

const A: Grains = Grains { d: 2.6e-3, rho_p: 1140.0, phi_max: 0.62, mu: (0.51, 0.70), kappa: 0.35, w_s: 0.072 };
const B: Grains = Grains { d: 0.25e-3, rho_p: 2600.0, phi_max: 0.60, mu: (0.30, 0.64), kappa: 0.41, w_s: 0.0326 };
const RHO_F: f64 = 1000.0;
const ETA: f64 = 1e-3;
const G: f64 = 9.81;

/// Largest relative error of each published equation over the rows where it can be differenced, written here a second time
/// from the paper, with three-point derivatives on the uneven levels. Nothing of the solver is used.
fn reevaluate(profile: &Profile, grains: &Grains, sine: f64, bed: f64) -> Vec<(&'static str, f64)> {
    let z = profile.axis();
    let column = |q| profile.get(q).unwrap();
    let (phi, u, w) = (column(&q::PHI), column(&q::U_MIXTURE), column(&q::U_PARTICLE));
    let (tf, r, tp) = (column(&q::TAU_VISCOUS), column(&q::TAU_REYNOLDS), column(&q::TAU_PARTICLE));
    let (p, l) = (column(&q::P_PARTICLE), column(&q::MIXING_LENGTH));
    let derivative = |f: &[Option<f64>], i: usize| {
        let (a, b) = (z[i] - z[i - 1], z[i + 1] - z[i]);
        let (f0, f1, f2) = (f[i - 1]?, f[i]?, f[i + 1]?);
        Some((f2 - f1) / b * a / (a + b) + (f1 - f0) / a * b / (a + b))
    };
    let mut worst: Vec<(&'static str, f64)> = Vec::new();
    let mut note = |name: &'static str, error: f64| match worst.iter_mut().find(|(n, _)| *n == name) {
        Some((_, w)) => *w = w.max(error.abs()),
        None => worst.push((name, error.abs())),
    };
    let interface = z.iter().position(|&x| (x - bed).abs() < 1e-12).unwrap();
    // Scales: stress of the interface over the grain diameter, shear rate of the mixture.
    let tau_b = tf[interface + 1].unwrap() + r[interface + 1].unwrap();
    for i in 2..z.len() - 1 {
        let dz = |f: &[Option<f64>]| derivative(f, i);
        let (Some(phi_i), Some(rate)) = (phi[i], dz(u)) else { continue };
        // The rows beside the interface and the corner of the solid fraction are one-sided.
        if (i as isize - interface as isize).abs() < 3 {
            continue;
        }
        let eps = 1.0 - phi_i;
        if i < interface {
            let (wi, pi) = (w[i].unwrap(), p[i].unwrap());
            let depth = bed - z[i];
            let slip = u[i].unwrap() - wi;
            let drag = RHO_F * phi_i / (grains.d * eps.powf(3.1)) * (0.3 * slip.abs() + 18.3 * ETA / (RHO_F * grains.d)) * slip;
            let (f, big_r, s) = (dz(tf).unwrap(), dz(r).unwrap(), dz(tp).unwrap());
            let unit = tau_b / grains.d;
            // Near the corner at the yield level no derivative is smooth; below it U = 0 and the stress is what balances.
            let moving = phi_i < 0.97 * grains.phi_max;
            let below = (phi_i - grains.phi_max).abs() < 1e-12 && (phi[i + 1].unwrap() - grains.phi_max).abs() < 1e-12;
            if moving || below {
                note("mixture momentum (29)", (big_r + f + s + (eps * RHO_F + phi_i * grains.rho_p) * G * sine) / unit);
                let normal = dz(p).unwrap() + phi_i * (grains.rho_p - RHO_F) * G * (1.0 - sine * sine).sqrt();
                note("pressure (12)", normal / ((grains.rho_p - RHO_F) * G));
            }
            if moving && depth > 4.0 * grains.d {
                note("grain momentum (14)", (s + phi_i * f + drag + phi_i * grains.rho_p * G * sine) / unit);
                note("fluid momentum (13)", (big_r + eps * f - drag + eps * RHO_F * G * sine) / unit);
            }
            if moving {
                let gamma = dz(w).unwrap();
                let free = grains.d * (grains.rho_p / pi).sqrt();
                let c = 4.0 / 3.0 * (0.3 + 18.3 * ETA / (RHO_F * slip.abs() * grains.d));
                let time = free.max(ETA / pi).max(grains.d * (RHO_F * c / pi).sqrt());
                let i_number = time * gamma;
                let mu = grains.mu.0 + (grains.mu.1 - grains.mu.0) / (0.3 / i_number + 1.0);
                note("friction (20)", tp[i].unwrap() / (mu * pi) - 1.0);
                note("dilatancy (24)", phi_i * (1.0 + 0.75 * i_number.sqrt()) / grains.phi_max - 1.0);
                let boyer = ETA * (1.0 + 2.5 * phi_i / (1.0 - phi_i / grains.phi_max));
                note("viscous stress (15)", tf[i].unwrap() / (boyer * rate) - 1.0);
            }
        } else if let (Some(f), Some(big_r)) = (dz(tf), dz(r)) {
            note("fluid momentum (25)", (f + big_r + RHO_F * G * sine) / (tau_b / grains.d));
            if phi_i > 1e-6 {
                let eddy = RHO_F * eps * l[i].unwrap().powi(2) * rate.abs();
                let fall = dz(phi).unwrap() * eddy / RHO_F;
                note("Rouse (26)", (fall + grains.w_s * phi_i) / (grains.w_s * 0.25));
            }
        }
        let turbulent = (phi_i < 0.97 * grains.phi_max) && l[i].unwrap() > 0.02 * grains.d;
        if turbulent && rate.abs() * grains.d > 0.02 * (tau_b / RHO_F).sqrt() {
            let reynolds = RHO_F * eps * l[i].unwrap().powi(2) * rate.abs() * rate;
            note("Reynolds stress (17)", (reynolds - r[i].unwrap()) / tau_b);
            note("mixing length (18)", dz(l).unwrap() / grains.kappa - (1.0 - phi_i / grains.phi_max));
        }
    }
    worst
}

#[test]
fn the_published_equations_hold_on_the_returned_profiles() {
    for (case, grains) in [("sheet_1d_sumer82", &A), ("sheet_1d_sumer91", &A), ("sheet_1d_cowen", &B)] {
        let errors: Vec<Vec<(&str, f64)>> = [600, 1200]
            .map(|cells| {
                let outcome = solve(case, &[&format!("grid.cells={cells}")]);
                let sine = get(&outcome, "slope_sine");
                reevaluate(outcome.profile.as_ref().unwrap(), grains, sine, get(&outcome, "bed_level_m"))
            })
            .into();
        assert!(errors[0].len() >= 11, "{errors:?}");
        for ((name, coarse), (_, fine)) in errors[0].iter().zip(&errors[1]) {
            println!("{case} {name}: {coarse:.2e} {fine:.2e}");
            assert!(*fine < 0.03, "{case} {name}: {fine}");
        }
    }
}
