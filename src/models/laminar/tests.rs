//! The bed against closed forms and independent integrations, and the regularised one against the exact yield.

use approx::assert_relative_eq;

use super::bed::*;
use super::element::Element;
use super::mesh::{Layer, Mesh};
use super::single;
use crate::closures::dilatancy::PhiIv;
use crate::closures::drag::CarmanKozeny;
use crate::closures::friction::MuIv;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::regularisation::{Regularisation, Smoothing};
use crate::models::exact::ouriemi::{Scaled, Solution as Closed};
use crate::numerics::root::brent;

/// Permeability of the bed of Chauchat & Medale (2010), H/d = 30.
const K: f64 = 1.8595e-6;

fn coulomb(k: Option<f64>) -> Bed {
    Bed { f: 0.1, h_p: 0.5, phi: 0.55, mu_s: 0.43, rise: None, e: 2.375, k, dilation: None }
}

fn closed(bed: &Bed) -> Closed {
    Scaled { f: bed.f, resistance: bed.mu_s * bed.phi, e: bed.e, h_p: bed.h_p, k: bed.k }.solve(|_| {}).unwrap()
}

fn nodes(elements: usize, on_yield: bool) -> Nodes {
    Nodes { elements, on_yield }
}

/// Relative L2 over the nodes.
fn error(solution: &Solution, exact: impl Fn(f64) -> f64) -> f64 {
    let norm = |f: &dyn Fn(usize) -> f64| (0..solution.u.len()).map(|j| f(j).powi(2)).sum::<f64>().sqrt();
    let z = solution.mesh.nodes();
    norm(&|j| solution.u[j] - exact(z[j])) / norm(&|j| exact(z[j]))
}

#[test]
fn exact_yield_is_the_closed_form_at_the_nodes() {
    for k in [None, Some(K)] {
        let bed = coulomb(k);
        let solution = bed.solve(nodes(200, true), &Regularisation::EXACT).unwrap();
        let exact = closed(&bed);
        assert_relative_eq!(solution.h_c, exact.h_c, max_relative = 1e-14);
        assert!(error(&solution, |z| exact.mixture(z)) < 1e-14);
        assert_relative_eq!(solution.flux(), bed.phi * exact.flux(), max_relative = 1e-13);
    }
}

#[test]
fn newton_needs_as_many_iterations_as_it_needed() {
    // For lambda = 1e-1, 1e-2, ... 1e-12 in units of (rho_p - rho_f) g H/eta; a change must be meant.
    let expected = [
        (None, Smoothing::Simple, [4, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5]),
        (None, Smoothing::BercovierEngelman, [4, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 4]),
        (None, Smoothing::Papanastasiou, [4, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 4]),
        (Some(K), Smoothing::Simple, [5, 7, 9, 10, 11, 10, 8, 7, 5, 4, 4, 3]),
        (Some(K), Smoothing::BercovierEngelman, [4, 5, 6, 8, 9, 10, 11, 11, 11, 11, 11, 11]),
        (Some(K), Smoothing::Papanastasiou, [5, 6, 5, 7, 9, 11, 11, 11, 11, 11, 11, 11]),
    ];
    for (k, law, expected) in expected {
        let counts: Vec<usize> = regularised(k, law).iter().map(|s| s.history.len()).collect();
        assert_eq!(counts, expected, "{k:?} {law:?}");
    }
}

#[test]
fn the_regularised_bed_tends_to_the_exact_yield_monotonically() {
    for k in [None, Some(K)] {
        let exact = closed(&coulomb(k));
        for law in [Smoothing::Simple, Smoothing::BercovierEngelman, Smoothing::Papanastasiou] {
            let errors: Vec<f64> = regularised(k, law).iter().map(|s| error(s, |z| exact.mixture(z))).collect();
            for (i, pair) in errors.windows(2).enumerate() {
                let slope = (pair[0] / pair[1]).log10();
                assert!(slope > 0.0, "{law:?} {errors:?}");
                assert!(i < 3 || (0.84..1.01).contains(&slope), "{law:?} slope {slope} from lambda 1e-{}", i + 1);
            }
            assert!(errors[11] < 1e-8);
        }
    }
}

/// The bed of Chauchat & Medale (2010) for lambda = 1e-1, ... 1e-12.
fn regularised(k: Option<f64>, law: Smoothing) -> Vec<Solution> {
    let at = |p: i32| Regularisation { law, lambda: 10_f64.powi(-p) };
    (1..=12).map(|p| coulomb(k).solve(nodes(400, true), &at(p)).unwrap()).collect()
}

/// mu(I_v) of Aussillous et al. (2013) in their channel.
fn aussillous(k: Option<f64>) -> Bed {
    let rise = Some(MuIv { mu_s: 0.32, mu_2: 0.94, i_0: 0.0077 });
    Bed { f: 100.0 / (120.0 * 9.81), h_p: 0.5, phi: 0.6, mu_s: 0.32, rise, e: 2.5, k, dilation: None }
}

fn dilating(drag: Option<(CarmanKozeny, f64)>) -> Bed {
    let dilation = Some(Dilation { law: PhiIv { a: 1.0 }, viscosity: MixtureViscosity::Einstein, drag });
    Bed { dilation, ..aussillous(drag.map(|(law, d)| law.permeability(0.6, d))) }
}

/// Orders of `error` between `n` and 2 `n`.
fn orders(ns: &[usize], error: impl Fn(usize) -> f64) -> Vec<f64> {
    let orders = ns.iter().map(|&n| (error(n) / error(2 * n)).log2()).collect();
    println!("{ns:?} {orders:.3?} last error {:.2e}", error(2 * ns[ns.len() - 1]));
    orders
}

#[test]
fn friction_that_rises_and_grains_that_spread_against_independent_integrations() {
    // mu(I_v): quadrature with 30 digits. With phi(I_v): Runge-Kutta in P_p^(1/2), 2000 steps.
    let (h, velocity) = (0.065, 120.0 * 9.81 * 0.065 * 0.065 / 0.27);
    for (bed, rate, level, theta) in [
        (aussillous(None), 3.671_274_079_03e-6, 0.019_868_720_722_4, 0.676_106_069_3),
        (dilating(None), 9.584_746_5e-6, 0.013_384_28, 0.627_000_908),
    ] {
        let solve = |n: usize| bed.solve(nodes(n, true), &Regularisation::EXACT).unwrap();
        let flux = |n: usize| solve(n).flux() * velocity * h;
        // Richardson's value, for an error that falls by 4.
        let limit = (4.0 * flux(1600) - flux(800)) / 3.0;
        assert_relative_eq!(limit, rate, max_relative = 3e-7);
        for order in orders(&[100, 200, 400], |n| (flux(n) / rate - 1.0).abs()) {
            assert!((order - 2.0).abs() < 0.1, "{order}");
        }
        let fine = solve(1600);
        assert_relative_eq!(fine.h_c * h, level, max_relative = 2e-6);
        assert_relative_eq!(fine.tau_interface(bed.f) * h / 2e-3, theta, max_relative = 1e-6);
    }
}

#[test]
fn a_vanishing_rise_is_coulomb_and_a_vanishing_permeability_one_velocity() {
    let flat = coulomb(Some(K));
    let rise = Some(MuIv { mu_s: 0.43, mu_2: 0.43 * (1.0 + 1e-9), i_0: 1e-3 });
    let solution = Bed { rise, ..flat.clone() }.solve(nodes(200, true), &Regularisation::EXACT).unwrap();
    let exact = closed(&flat);
    assert!(error(&solution, |z| exact.mixture(z)) < 1e-5);
    // The flux changes in proportion to K, as the seepage does.
    let flux = |k| aussillous(k).solve(nodes(400, true), &Regularisation::EXACT).unwrap().flux();
    let change = |k: f64| flux(Some(k)) / flux(None) - 1.0;
    assert!(change(1e-7) < 0.0 && change(1e-7) > -3e-4, "{}", change(1e-7));
    assert!((change(1e-7) / change(1e-8) - 10.0).abs() < 2.0, "{}", change(1e-7) / change(1e-8));
}

#[test]
fn two_velocities_converge_with_order_two_where_friction_rises_and_grains_spread() {
    let law = CarmanKozeny { k_ck: 180.0, phi_min: 0.3 };
    let drag = Some((law, 2.0 / 65.0));
    for (bed, on_yield) in [
        (aussillous(dilating(drag).k), true),
        (aussillous(dilating(drag).k), false),
        (dilating(drag), true),
        (dilating(drag), false),
    ] {
        let flux = |n: usize| bed.solve(nodes(n, on_yield), &Regularisation::EXACT).unwrap().flux();
        let limit = (4.0 * flux(1600) - flux(800)) / 3.0;
        for order in orders(&[50, 100, 200], |n| (flux(n) / limit - 1.0).abs()) {
            assert!((order - 2.0).abs() < 0.2, "{order}");
        }
    }
}

/// A bed whose solid fraction falls upwards, 0.4 + 0.3 x at the depth x, in closed form: with the stress tau + f x,
/// `du/dx = -(tau + a x - b x^2)/(2 + 0.75 x)`, `a = f - 0.4 mu_s`, `b = 0.15 mu_s`, a rational function.
struct Layered {
    f: f64,
    mu_s: f64,
    tau: f64,
    x_c: f64,
}

impl Layered {
    const H_P: f64 = 0.5;

    fn new(f: f64, mu_s: f64) -> Self {
        let at = |tau: f64| {
            let (half, c) = (0.5 * (0.4 * mu_s - f), 0.15 * mu_s);
            Self { f, mu_s, tau, x_c: ((half * half + c * tau).sqrt() - half) / c }
        };
        let d = 1.0 - Self::H_P;
        let lid = |tau: f64| at(tau).bed_velocity(0.0) + tau * d - 0.5 * f * d * d;
        at(brent(lid, 0.0, f, |_| {}).unwrap())
    }

    fn primitive(&self, x: f64) -> f64 {
        let (a, b) = (self.f - 0.4 * self.mu_s, 0.15 * self.mu_s);
        let q1 = -b / 0.75;
        let q0 = (a - 2.0 * q1) / 0.75;
        0.5 * q1 * x * x + q0 * x + (self.tau - 2.0 * q0) / 0.75 * (2.0 + 0.75 * x).ln()
    }

    fn bed_velocity(&self, x: f64) -> f64 {
        if x >= self.x_c { 0.0 } else { self.primitive(self.x_c) - self.primitive(x) }
    }

    fn velocity(&self, z: f64) -> f64 {
        let y = z - Self::H_P;
        if y <= 0.0 { self.bed_velocity(-y) } else { self.bed_velocity(0.0) + self.tau * y - 0.5 * self.f * y * y }
    }

    /// Relative L2 at the nodes, with `still` of `n` elements below a node on the yield level, or with no node there.
    fn error(&self, n: usize, on_yield: bool, regularisation: &Regularisation) -> f64 {
        let layer = |top: f64, elements: usize| Layer {
            top,
            elements,
            finest_below: f64::INFINITY,
            finest_above: f64::INFINITY,
        };
        let mut layers = vec![layer(Self::H_P, n / 2), layer(1.0, n / 2)];
        if on_yield {
            layers[0].elements = n / 4;
            layers.insert(0, layer(Self::H_P - self.x_c, n / 4));
        }
        let mesh = Mesh::layered(&layers);
        let element = |k: usize| {
            let x = Self::H_P - mesh.middle(k);
            if x < 0.0 {
                return Element { e: 1.0, y: 0.0, rise: None };
            }
            Element { e: 2.0 + 0.75 * x, y: self.mu_s * (0.4 + 0.15 * x) * x, rise: None }
        };
        let elements: Vec<Element> = (0..mesh.elements()).map(element).collect();
        let solved = single::solve(&mesh, &elements, self.f, regularisation).unwrap();
        let sum = |f: &dyn Fn(usize) -> f64| (0..solved.u.len()).map(|j| f(j).powi(2)).sum::<f64>().sqrt();
        let exact = |j: usize| self.velocity(mesh.nodes()[j]);
        sum(&|j| solved.u[j] - exact(j)) / sum(&exact)
    }
}

#[test]
fn order_two_with_a_varying_solid_fraction_wherever_the_yield_level_lies() {
    let layered = Layered::new(0.07, 0.43);
    let almost = Regularisation { law: Smoothing::Simple, lambda: 1e-12 };
    for regularisation in [Regularisation::EXACT, almost] {
        let last: Vec<f64> = [true, false].map(|on_yield| layered.error(800, on_yield, &regularisation)).to_vec();
        // Without a node on the yield level the error depends on where it lies in its element: erratic, of order 2 in the mean.
        for (on_yield, scatter) in [(true, 0.2), (false, 1.0)] {
            let mean = (layered.error(25, on_yield, &regularisation) / layered.error(400, on_yield, &regularisation))
                .log2()
                / 4.0;
            assert!((mean - 2.0).abs() < scatter, "{on_yield} {mean}");
        }
        for order in orders(&[50, 100, 200], |n| layered.error(n, true, &regularisation)) {
            assert!((order - 2.0).abs() < 0.15, "{order}");
        }
        assert!(last[0] < 1e-7 && last[1] < 1e-6, "{last:?}");
    }
}
