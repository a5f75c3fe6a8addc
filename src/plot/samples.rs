//! Plausible runs to draw, from closed forms.

use serde_json::json;

use crate::result::quantity as q;
use crate::result::{Axis, Curve, Dash, Figure, Marker, Panel};
use crate::result::{Balance, Cost, ErrorReport, Profile, Provenance, Results, Statement, Status, Summary, Validity};

const LEVELS: usize = 200;

fn summary(case: &str, model: &str, results: Results) -> Summary {
    let mut regularisation = serde_json::Map::new();
    regularisation.insert("lambda_1_s".into(), json!(1e-6));
    Summary {
        format: Summary::FORMAT,
        status: Status::Done,
        case: case.into(),
        model: model.into(),
        scene: None,
        results,
        balances: vec![Balance {
            name: "momentum".into(),
            relative: 3.1e-16,
            how: "stress at the bottom against drive times depth".into(),
        }],
        regime: Vec::new(),
        validity: vec![Validity {
            closure: "mixture_viscosity/einstein".into(),
            variable: "phi".into(),
            value: 0.6,
            range: "below 0.1".into(),
            z_m: Some(0.016),
        }],
        regularisation,
        error: None,
        cost: Cost {
            solve_s: 2.1e-4,
            total_s: 3.3e-3,
            peak_memory_mb: Some(9.2),
            work_units: LEVELS as f64,
            ..Cost::default()
        },
        provenance: Provenance { source: "bed_ouriemi-laminar-exact".into(), ..Provenance::of_this_program() },
    }
}

/// Cell centres of a column of height `height`.
fn centres(height: f64) -> Vec<f64> {
    (0..LEVELS).map(|i| (i as f64 + 0.5) / LEVELS as f64 * height).collect()
}

struct Bed {
    z: Vec<f64>,
    bed: f64,
    yielding: f64,
    velocity: f64,
    stress: f64,
}

const HEIGHT: f64 = 0.065;
const PHI: f64 = 0.6;
const MU: f64 = 0.32;
const DRIVE: f64 = 0.084_947;
const EINSTEIN: f64 = 2.5;

impl Bed {
    fn new() -> Self {
        let (weight, eta) = (120.0 * 9.81, 0.27);
        Self {
            z: centres(HEIGHT),
            bed: 0.496 * HEIGHT,
            yielding: (0.496 - 0.186_205_5) * HEIGHT,
            velocity: weight * HEIGHT * HEIGHT / eta,
            stress: weight * HEIGHT,
        }
    }

    /// velocity, viscous stress, stress of the grains \[SI] at elevation `z`
    fn at(&self, z: f64) -> (f64, f64, f64) {
        let b = (MU * PHI - DRIVE) / EINSTEIN;
        let (z, top, low) = (z / HEIGHT, self.bed / HEIGHT, self.yielding / HEIGHT);
        let depth = top - low;
        let (u, viscous, grains) = if z < low {
            (0.0, 0.0, MU * PHI * depth + DRIVE * (low - z))
        } else if z < top {
            (b * (z - low).powi(2) / 2.0, EINSTEIN * b * (z - low), MU * PHI * (top - z))
        } else {
            let above = z - top;
            let slope = EINSTEIN * b * depth;
            (b * depth * depth / 2.0 + slope * above - DRIVE * above * above / 2.0, slope - DRIVE * above, 0.0)
        };
        (u * self.velocity, viscous * self.stress, grains * self.stress)
    }

    fn column(&self, value: impl Fn(f64) -> Option<f64>) -> Vec<Option<f64>> {
        self.z.iter().map(|&z| value(z)).collect()
    }

    fn inside<T>(&self, z: f64, value: T) -> Option<T> {
        (z < self.bed).then_some(value)
    }

    fn results(&self) -> Results {
        let mut results = Results::default();
        results.set(&q::SHIELDS, 0.37);
        results.set(&q::TRANSPORT_RATE, 3.310_3e-5);
        results.set(&q::TRANSPORT_RATE_DIMENSIONLESS, 0.2575);
        results.set(&q::U_MAX, 0.3123);
        results.set(&q::BED_LEVEL, self.bed);
        results.set(&q::YIELD_LEVEL, self.yielding);
        results.set(&q::MOBILE_DEPTH, self.bed - self.yielding);
        results.set(&q::FLOW_HEIGHT, HEIGHT);
        results.set(&q::PHI_INTERFACE, PHI);
        results.set(&q::DRIVE, 100.0);
        results.undefined(&q::SLIP_VELOCITY, "the phases move together");
        results
    }
}

/// Ouriemi's bed in the mixed form: one velocity.
pub(super) fn laminar_bed() -> (Profile, Summary) {
    let bed = Bed::new();
    let mut profile = Profile::new(bed.z.clone()).unwrap();
    let velocity = |z: f64| bed.at(z).0;
    profile.push(&q::PHI, bed.column(|z| Some(if z < bed.bed { PHI } else { 0.0 }))).unwrap();
    profile.push(&q::U_FLUID, bed.column(|z| Some(velocity(z)))).unwrap();
    profile.push(&q::U_PARTICLE, bed.column(|z| bed.inside(z, velocity(z)))).unwrap();
    profile.push(&q::U_MIXTURE, bed.column(|z| Some(velocity(z)))).unwrap();
    let flux = |z: f64| Some(bed.inside(z, PHI * velocity(z)).unwrap_or(0.0));
    profile.push(&q::FLUX, bed.column(flux)).unwrap();
    profile.push(&q::TAU_VISCOUS, bed.column(|z| Some(bed.at(z).1))).unwrap();
    profile.push(&q::TAU_REYNOLDS, bed.column(|_| Some(0.0))).unwrap();
    profile.push(&q::TAU_PARTICLE, bed.column(|z| Some(bed.at(z).2))).unwrap();
    (profile, summary("bed_ouriemi-laminar-exact", "exact/ouriemi (mixed)", bed.results()))
}

/// The same with a slip between the phases.
pub(super) fn two_fluid_bed() -> (Profile, Summary) {
    let bed = Bed::new();
    let mut profile = Profile::new(bed.z.clone()).unwrap();
    let slip = |z: f64| 0.02 * ((z - bed.bed) / 0.004).exp().min(1.0);
    let grains = |z: f64| bed.inside(z, bed.at(z).0);
    let fluid = |z: f64| bed.at(z).0 + slip(z);
    let mixture = |z: f64| match grains(z) {
        Some(u) => (1.0 - PHI) * fluid(z) + PHI * u,
        None => fluid(z),
    };
    profile.push(&q::PHI, bed.column(|z| Some(if z < bed.bed { PHI } else { 0.0 }))).unwrap();
    profile.push(&q::U_FLUID, bed.column(|z| Some(fluid(z)))).unwrap();
    profile.push(&q::U_PARTICLE, bed.column(grains)).unwrap();
    profile.push(&q::U_MIXTURE, bed.column(|z| Some(mixture(z)))).unwrap();
    profile.push(&q::TAU_VISCOUS, bed.column(|z| Some(bed.at(z).1))).unwrap();
    profile.push(&q::TAU_PARTICLE, bed.column(|z| bed.inside(z, bed.at(z).2))).unwrap();
    (profile, summary("laminar_1d_two_fluid", "laminar (two-fluid)", bed.results()))
}

/// A rough wall: levels from z_0 = 0.1 mm to 10 cm, geometrically.
pub(super) fn log_law() -> (Profile, Summary) {
    let (rough, top, u_star) = (1e-4_f64, 0.1_f64, 0.05);
    let z: Vec<f64> = (0..LEVELS).map(|i| rough * (top / rough).powf(i as f64 / (LEVELS - 1) as f64)).collect();
    let mut profile = Profile::new(z.clone()).unwrap();
    let column = |value: &dyn Fn(f64) -> f64| z.iter().map(|&z| Some(value(z))).collect::<Vec<_>>();
    profile.push(&q::U_FLUID, column(&|z| u_star / 0.41 * (z / rough).ln())).unwrap();
    profile.push(&q::U_MIXTURE, column(&|z| u_star / 0.41 * (z / rough).ln())).unwrap();
    profile.push(&q::TAU_REYNOLDS, column(&|_| 1000.0 * u_star * u_star)).unwrap();
    profile.push(&q::MIXING_LENGTH, column(&|z| 0.41 * z)).unwrap();
    profile.push(&q::EDDY_VISCOSITY, column(&|z| 0.41 * u_star * z)).unwrap();
    let mut results = Results::default();
    results.set(&q::U_STAR, u_star);
    results.set(&q::ROUGHNESS_LENGTH, rough);
    results.set(&q::FLOW_HEIGHT, top);
    (profile, summary("exact_1d_log_law", "exact/log-law", results))
}

/// Bingham's fluid between two plates, with a plug of a third of the gap.
pub(super) fn bingham_plane() -> (Profile, Summary) {
    let (height, plug, gradient, eta) = (0.01, 0.01 / 6.0, 50.0, 0.1);
    let z = centres(height);
    let mut profile = Profile::new(z.clone()).unwrap();
    let column = |value: &dyn Fn(f64) -> f64| z.iter().map(|&z| Some(value(z - height / 2.0))).collect::<Vec<_>>();
    let sheared = |y: f64| (y.abs() - plug).max(0.0);
    let speed = |y: f64| gradient / (2.0 * eta) * ((height / 2.0 - plug).powi(2) - sheared(y).powi(2));
    profile.push(&q::U_MIXTURE, column(&speed)).unwrap();
    profile.push(&q::TAU_VISCOUS, column(&|y| -gradient * sheared(y) * y.signum())).unwrap();
    profile.push(&q::TAU_PARTICLE, column(&|y| -gradient * y.abs().min(plug) * y.signum())).unwrap();
    let mut results = Results::default();
    results.set(&q::FLOW_HEIGHT, height);
    results.set(&q::HALF_PLUG, plug);
    results.set(&q::BINGHAM, 4.4);
    (profile, summary("bingham_1d_plane", "exact/bingham", results))
}

/// A run that failed, with a name that attacks the page.
pub(super) fn hostile_failure() -> Summary {
    let mut summary = laminar_bed().1;
    summary.case = "</title><script>alert('x')</script><img src=x onerror=\"y\">".into();
    summary.status = Status::Failed;
    summary.error = Some(ErrorReport {
        code: "no-static-bed".into(),
        message: "no part of the bed can stay at rest: the drive is 0.300000 of the submerged weight, friction holds less than 0.192000".into(),
        path: Some("flow.pressure_gradient".into()),
        line: Some(12),
        allowed: None,
        hint: Some("lower the drive, or raise mu_s or phi".into()),
    });
    summary
}

/// Errors against cell counts, with symbols and a line of reference, as a study of convergence shows them.
pub(super) fn convergence() -> Figure {
    let cells = [25.0, 50.0, 100.0, 200.0, 400.0, 800.0_f64];
    let errors =
        |at: f64, order: i32| -> Vec<_> { cells.iter().map(|n| Some((*n, at * (25.0 / n).powi(order)))).collect() };
    let curve = |name: &str, points, colour, line, marker| Curve {
        name: name.into(),
        points,
        colour,
        line,
        marker,
        ..Curve::default()
    };
    Figure {
        stem: "convergence".into(),
        caption: "Error against the number of cells".into(),
        y: Axis::log("relative error", "1"),
        panels: vec![Panel {
            x: Axis::log("cells", ""),
            curves: vec![
                curve("second order", errors(0.02, 2), 0, Some(Dash::Dotted), None),
                curve("exact yield", errors(0.011, 2), 1, None, Some(Marker::Circle)),
                curve("λ = 10⁻⁶", errors(0.05, 1), 2, Some(Dash::Dashed), Some(Marker::Square)),
                curve("paper", errors(0.09, 1), 3, None, Some(Marker::Triangle)),
            ],
        }],
        levels: vec![],
        tint_below: None,
    }
}

/// Writes all samples as SVG and PNG where `BEDLOAD_SAMPLES` points, to be looked at.
#[test]
#[ignore = "draws files to be looked at"]
fn draw_the_samples() {
    let Ok(folder) = std::env::var("BEDLOAD_SAMPLES") else { return };
    let folder = std::path::Path::new(&folder);
    let equations = "fluid       0 = f + d/dz[(1 + 5/2 φ) η dU/dz] + dτ_p/dz\ngrains      |τ_p| ≤ μ_s P_p,  dP_p/dz = −φ (ρ_p − ρ_f) g\ntransport   q_p = ∫ φ u_p dz";
    let statement = Statement { equations: equations.into(), laws: Vec::new() };
    let mut hostile = (laminar_bed().0, hostile_failure());
    hostile.1.results = Results::default();
    for (profile, summary) in [laminar_bed(), two_fluid_bed(), log_law(), bingham_plane(), hostile] {
        let figures = crate::plot::profile_figures(&profile, &summary);
        let name = if summary.error.is_some() { "hostile" } else { &summary.case };
        let notes = ["Grains and fluid move together in the mixed form, so it has no threshold of motion.".to_owned()];
        let case_toml = "format = 1\n\n[case]\nname = \"ouriemi\"";
        let page = crate::plot::Page {
            summary: &summary,
            figures: &figures,
            drawing: None,
            animation: None,
            statement: &statement,
            case_toml,
            notes: &notes,
        };
        let begin = std::time::Instant::now();
        let html = crate::plot::report_html(&page);
        println!("{name}: page {:?}, {} bytes", begin.elapsed(), html.len());
        std::fs::write(folder.join(format!("{name}.html")), html).unwrap();
        for figure in figures.into_iter().chain([convergence()]) {
            let stem = format!("{name}_{}", figure.stem);
            let begin = std::time::Instant::now();
            let drawing = crate::plot::svg(&figure).unwrap();
            let svg_time = begin.elapsed();
            std::fs::write(folder.join(format!("{stem}.svg")), drawing).unwrap();
            crate::plot::png(&figure, &folder.join(format!("{stem}.png"))).unwrap();
            println!("{stem}: svg {svg_time:?}, svg and png {:?}", begin.elapsed());
        }
    }
}
