//! The discrete equations against the continuous ones, and the methods against each other.

use super::bed::{self, STRIDE, State};
use super::column::{Floor, Setting};
use super::flow::{Flow, Unknowns};
use super::iteration::StepControl;
use super::layers::Layers;
use super::linear::Linearised;
use super::mesh::Mesh;
use super::newton::Column;
use super::solve::solve;
use super::start::Guess;
use crate::closures::mixing_length::{LiSawamoto, MixingLength};
use crate::closures::mixture_viscosity::{Boyer, MixtureViscosity};
use crate::column::{Bottom, FluidColumn, Forcing, Grid, Medium, Setup, Top, ViscousForm};
use crate::model::{OnMesh, read};
use crate::models::sheet_flow::SheetFlow;

fn scaled(case: &str, settings: &[&str]) -> (Flow, Setting) {
    let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
    let sheet = read::<OnMesh<SheetFlow>>(case, &settings).unwrap().problem;
    (Flow::scaled(&sheet), Setting::scaled(&sheet))
}

const SINE: f64 = 0.01;
const BED: f64 = 5.0;

/// Manufactured fields over the solid volume m: friction, fluid stress, slip, dilation, velocity of the grains.
fn fields(m: f64) -> [f64; 5] {
    [
        0.6 + 0.05 * m.cos(),
        1.0 + 0.3 * m.sin(),
        0.3 + 0.1 * (2.0 * m).cos(),
        3.0 - 0.2 * m - 0.01 * m * m,
        2.0 - 0.3 * m,
    ]
}

/// The laws at m for the manufactured fields.
fn laws(flow: &Flow, m: f64) -> super::flow::Cell<f64> {
    let [r, s, w, d, _] = fields(m);
    let x = Unknowns { r, s, w, d, m: BED, sine: SINE, rest: 0.0 };
    flow.cell(m / BED, 1.0, &x)
}

#[test]
fn the_discrete_operators_are_those_of_the_equations_at_order_two() {
    let (flow, _) = scaled("sheet_1d_sumer91", &["regularisation.law=simple", "regularisation.lambda=1e-6"]);
    let flow = Flow { cut: 0.0, ..flow };
    let derivative = |f: &dyn Fn(f64) -> f64, m: f64| (f(m + 1e-5) - f(m - 1e-5)) / 2e-5;
    let worst = |cells: usize| {
        let nodes: Vec<f64> = (0..=cells).map(|j| j as f64 / cells as f64).collect();
        let middles = nodes.windows(2).map(|p| 0.5 * (p[0] + p[1])).collect();
        let mesh = Mesh { nodes, middles };
        let mut state = State { x: vec![0.0; STRIDE * cells], tau_b: 1.0, sine: SINE, m: BED, rest: 0.0 };
        for c in 0..cells {
            let (node, middle) = (fields(BED * mesh.nodes[c]), fields(BED * mesh.middles[c]));
            state.x[STRIDE * c..STRIDE * (c + 1)].copy_from_slice(&[node[4], node[2], node[3], middle[0], middle[1]]);
        }
        let mut rows = vec![0.0; STRIDE * cells];
        bed::residual(&flow, &mesh, &state, &mut rows);
        let mut worst = [0.0_f64; STRIDE];
        // Away from both ends, where the fields do not meet the boundary conditions.
        for c in cells / 4..cells - cells / 4 {
            let (size, m) = (BED / cells as f64, BED * mesh.nodes[c]);
            let here = laws(&flow, m);
            let slope = |f: &dyn Fn(f64) -> f64| derivative(f, m);
            let (tau_p, tau_f) = (slope(&|m| laws(&flow, m).tau_p), slope(&|m| laws(&flow, m).tau_f));
            let mixture = -slope(&|m| fields(m)[1]) - tau_p + flow.fluid_weight(SINE) / here.phi + SINE;
            let grains =
                -tau_p - here.phi * tau_f + flow.drag(here.phi, fields(m)[2]) / here.phi + flow.grain_weight(SINE);
            let m = BED * mesh.middles[c];
            let here = laws(&flow, m);
            let slope = |k: usize| derivative(&|m| fields(m)[k], m);
            let strain = -slope(4) - here.gamma / here.phi;
            let slip = -slope(2) - (here.rate - here.gamma) / here.phi;
            let swelling = -slope(3) - (1.0 / here.phi - 1.0 / flow.dilatancy.phi_max);
            for (k, exact) in [mixture, grains, strain, slip, swelling].into_iter().enumerate() {
                worst[k] = worst[k].max((rows[STRIDE * c + k] / size - exact).abs());
            }
        }
        worst
    };
    let (coarse, fine) = (worst(100), worst(200));
    for k in 0..STRIDE {
        let order = (coarse[k] / fine[k]).log2();
        assert!(order > 1.7 || coarse[k] < 1e-9, "row {k}: {coarse:?} {fine:?}");
    }
}

#[test]
fn the_jacobian_is_the_derivative_of_the_residual() {
    let creep = &["regularisation.law=simple", "regularisation.lambda=1e-3"][..];
    for (settings, floor) in [(&[][..], Floor::Yield), (&[][..], Floor::Bottom), (creep, Floor::Bottom)] {
        let (flow, setting) = scaled("sheet_1d_cowen", settings);
        let (column, mut state) = Column::start(flow, setting, 60, Guess { floor, friction: 0.7, mobile: None });
        // Without slip the turbulent time is infinite, and its root has no difference.
        (0..column.mesh.cells()).for_each(|c| state.x[STRIDE * c + 1] += 0.02);
        let n = column.mesh.cells();
        let mut system = Linearised::new(n);
        system.fill(&column.flow, &column.mesh, &state, &column.local_cells(&state));
        let mut rows = vec![0.0; STRIDE * n];
        bed::residual(&column.flow, &column.mesh, &state, &mut rows);
        assert!(rows.iter().zip(&system.residual).all(|(a, b)| (a - b).abs() < 1e-13));
        for k in 0..STRIDE * n {
            let mut unit = vec![0.0; STRIDE * n];
            unit[k] = 1.0;
            let exact = system.jacobian.times(&unit);
            let at = |step: f64| {
                let mut moved = state.clone();
                moved.x[k] += step;
                let mut rows = vec![0.0; STRIDE * n];
                bed::residual(&column.flow, &column.mesh, &moved, &mut rows);
                rows
            };
            let (up, down) = (at(1e-6), at(-1e-6));
            let size = exact.iter().fold(1e-6, |a: f64, b| a.max(b.abs()));
            for (i, exact) in exact.iter().enumerate() {
                let difference = (up[i] - down[i]) / 2e-6;
                // Beside the corners of the laws a difference takes both sides.
                assert!((difference - exact).abs() < 2e-3 * size, "({i}, {k}): {difference} {exact}");
            }
        }
    }
}

#[test]
fn the_iteration_ends_where_newton_does() {
    for case in ["sheet_1d_sumer82", "sheet_1d_cowen"] {
        let (flow, setting) = scaled(case, &["regularisation.law=simple", "regularisation.lambda=1e-6"]);
        let solved = solve(flow, setting, 80).unwrap();
        let (_, guess) = Column::start(flow, setting, 80, Guess { floor: Floor::Bottom, friction: 0.8, mobile: None });
        let control = StepControl { dt: 1.0, tolerance: 1e-10, max_iterations: 100_000 };
        let iterated = solved.column.iterate(guess, &control, &mut Vec::new(), |_, _| false).unwrap();
        let psi = |state: &State| Layers::new(&solved.column, state).psi();
        let difference = psi(&iterated) / psi(&solved.state) - 1.0;
        assert!(difference.abs() < 1e-7, "{case}: {difference:e}");
    }
}

#[test]
fn newton_takes_few_steps() {
    for case in ["sheet_1d_sumer82", "sheet_1d_sumer91", "sheet_1d_sumer99", "sheet_1d_cowen"] {
        let (flow, setting) = scaled(case, &[]);
        let solved = solve(flow, setting, 300).unwrap();
        assert!(solved.history.len() <= 16, "{case}: {}", solved.history.len());
        assert!(solved.history.last().unwrap() < &1e-12);
        // Grains at rest lie under moving ones, and nowhere else.
        assert!((0..solved.column.mesh.cells()).all(|c| solved.state.r(c) > flow.friction.mu_s), "{case}");
        assert!(solved.state.rest > 0.0);
    }
}

/// One medium for the fluid column and for the cells of the bed: the same shear rate, the same viscous and Reynolds stresses,
/// the same drag. All in the units of the model. The solid fraction is uniform and that at which the mixing length does not
/// grow, so that both have the same length between two cells.
#[test]
fn the_fluid_column_finds_the_same_stresses_in_the_same_medium() {
    for case in ["sheet_1d_sumer91", "sheet_1d_cowen"] {
        let (shipped, _) = scaled(case, &[]);
        for (phi, length) in [(0.3, 0.7), (0.5, 0.2), (0.59, 0.03)] {
            let viscosity = MixtureViscosity::Boyer(Boyer { phi_max: 0.6 });
            let mut flow = Flow { viscosity, phi_l: phi, ..shipped };
            flow.dilatancy.phi_max = phi;
            let law = LiSawamoto { phi_max: phi, ..LiSawamoto { kappa: flow.kappa, ..li_sawamoto(case) } };
            let setup = Setup {
                viscosity,
                form: ViscousForm::Mixture,
                mixing_length: MixingLength::LiSawamoto(law),
                ..Setup::laminar(1.0, flow.nu)
            };
            let cells = 12;
            let grid = Grid::uniform(0.0, 3.0, cells).unwrap();
            let velocity: Vec<f64> = grid.centres().iter().map(|z| 0.4 * z).collect();
            let beta = vec![(1.0 - phi) * flow.drag(phi, 1.0); cells];
            let medium = Medium { phi: vec![phi; cells], velocity: velocity.clone(), beta, force: vec![0.0; cells] };
            let forcing = Forcing {
                drive: 0.3,
                bottom: Bottom::Flow { velocity: 0.1, mixing_length: length },
                top: Top::Stress(1.2),
            };
            let mut column = FluidColumn::new(grid.clone(), setup).unwrap();
            column.step(&medium, &forcing, f64::INFINITY).unwrap();
            let mixture: Vec<f64> =
                column.velocity().iter().zip(&velocity).map(|(u, w)| (1.0 - phi) * u + phi * w).collect();
            for f in 1..cells {
                let (tau, reynolds) = (column.tau_viscous()[f], column.tau_reynolds()[f]);
                // Grains that do not yield keep phi; the dilation carries the length.
                let x = Unknowns {
                    r: 0.1,
                    s: tau + reynolds,
                    w: 0.0,
                    d: length / flow.kappa,
                    m: 5.0,
                    sine: 0.0,
                    rest: 1.0,
                };
                let cell = flow.cell(0.5, 0.01, &x);
                let rate = (mixture[f] - mixture[f - 1]) / grid.distances()[f];
                assert!((cell.phi - phi).abs() < 1e-15 && (cell.length - length).abs() < 1e-13);
                assert!((cell.rate / rate - 1.0).abs() < 1e-12, "{case} {phi}: {} {rate}", cell.rate);
                assert!((cell.tau_f / tau - 1.0).abs() < 1e-12, "{case} {phi}: {} {tau}", cell.tau_f);
                assert!(((x.s - cell.tau_f) - reynolds).abs() < 1e-12 * x.s.abs(), "{case} {phi}: {reynolds}");
            }
            let mut taken = vec![0.0; cells];
            // The drag alone: without viscous stress on the grains.
            let still = FluidColumn::new(grid, Setup { form: ViscousForm::Fluid, ..setup }).unwrap();
            let slip = 0.3;
            let mut still = still;
            still.set_velocity(&velocity.iter().map(|w| w + slip / (1.0 - phi)).collect::<Vec<_>>()).unwrap();
            let coefficient = flow.drag(phi, slip) / slip;
            let medium = Medium { beta: vec![(1.0 - phi) * coefficient; cells], ..medium };
            still.force_on_grains(&medium, &mut taken).unwrap();
            assert!(taken.iter().all(|force| (force / flow.drag(phi, slip) - 1.0).abs() < 1e-12), "{taken:?}");
        }
    }
}

fn li_sawamoto(case: &str) -> LiSawamoto {
    read::<OnMesh<SheetFlow>>(case, &[]).unwrap().problem.mixing_length
}
