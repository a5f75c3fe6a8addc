//! The published equations, written down once more from the source, hold on the profiles that are written: in SI, with
//! differences between levels for derivatives and none of the code that solved them.

use super::{CLASSICAL, flow};
use crate::models::two_fluid::TwoFluid;
use crate::models::two_fluid::run;
use crate::result::{Profile, Quantity, Quiet, quantity as q};

const PI: f64 = std::f64::consts::PI;

struct Table {
    z: Vec<f64>,
    profile: Profile,
}

impl Table {
    fn new(flow: &TwoFluid, cells: usize) -> Self {
        let profile = run(flow, cells, &mut Quiet).unwrap().profile.unwrap();
        Self { z: profile.axis(), profile }
    }

    fn at(&self, quantity: &Quantity, i: usize) -> f64 {
        self.profile.get(quantity).unwrap()[i].unwrap()
    }

    fn slope(&self, quantity: &Quantity, i: usize) -> f64 {
        (self.at(quantity, i + 1) - self.at(quantity, i - 1)) / (self.z[i + 1] - self.z[i - 1])
    }

    /// Largest miss of `left = right` over the levels with a solid fraction between `low` and `high`, over the largest value.
    fn miss(&self, (low, high): (f64, f64), of: impl Fn(usize) -> (f64, f64)) -> f64 {
        let levels = 4..self.z.len() - 4;
        let inside = |i: &usize| (low..high).contains(&self.at(&q::PHI, *i));
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for i in levels.filter(inside) {
            let (left, right) = of(i);
            worst = worst.max((left - right).abs());
            largest = largest.max(left.abs()).max(right.abs());
        }
        assert!(largest > 0.0);
        worst / largest
    }
}

/// Table 1 of the source, by its numbers.
struct Theory {
    e: f64,
    e_eff: f64,
    a: f64,
    saltation: bool,
    quadratic: bool,
}

const PROPOSED: Theory = Theory { e: 0.7, e_eff: 0.457_812_557, a: 2.544_328_57, saltation: true, quadratic: true };
const OLD: Theory = Theory { e: 0.7, e_eff: 0.7, a: 0.58, saltation: false, quadratic: false };

impl Theory {
    fn g0(&self, phi: f64) -> f64 {
        (2.0 - phi) / (2.0 * (1.0 - phi).powi(3)) + self.a * phi.powi(2) / (0.635 - phi).powf(1.5)
    }

    /// Drag coefficient K [kg/(m3 s)] and C_inf/C_D.
    fn drag(phi: f64, slip: f64, d: f64) -> (f64, f64) {
        let c_d = 0.4 + 24.4 / (slip.abs() * d / 1e-6);
        (0.75 * c_d * 1000.0 / d * slip.abs() * (1.0 - phi).powf(-4.1), 0.4 / c_d)
    }

    /// F2 and F3 with saltation, for K d/rho_p [m/s] and T [m2/s2].
    fn coefficients(&self, phi: f64, t: f64, k: f64) -> (f64, f64) {
        let (e, g0) = (self.e, self.g0(phi));
        let x = phi * g0;
        let eta_k = 5.0 * PI.sqrt() / 96.0 * (1.0 - 0.4 * (1.0 + e) * (1.0 - 3.0 * e) * x)
            / (g0 * (1.0 - (1.0 - e).powi(2) / 4.0 - 5.0 / 24.0 * (1.0 - e * e)));
        let kap_k = 25.0 * PI.sqrt() / 64.0 * (1.0 + 0.6 * (1.0 + e).powi(2) * (2.0 * e - 1.0) * x)
            / ((1.0 + e) * g0 * (1.0 - 7.0 / 16.0 * (1.0 - e)));
        let salt = phi * t.sqrt() / (5.0 * k);
        let limited = |part: f64, salt: f64| if self.saltation { 1.0 / (1.0 / part + 1.0 / salt) } else { part };
        let f2 = limited(eta_k, salt) + 0.8 * (1.0 + e) * x * eta_k + 0.8 / PI.sqrt() * (1.0 + e) * phi * x;
        let f3 = limited(kap_k, 2.0 * salt) + 1.2 * (1.0 + e) * x * kap_k + 2.0 / PI.sqrt() * (1.0 + e) * phi * x;
        (f2, f3)
    }
}

fn elastic(phi: f64) -> f64 {
    if phi < 0.57 { 0.0 } else { 0.05 * (phi - 0.57).powi(3) / (0.635 - phi).powi(5) }
}

fn check(set: &[&str], theory: &Theory) {
    let flow = flow("flow_theta06-two-fluid", set);
    let (rho_f, rho_p, g, d, sine) = (1000.0, 2500.0, 9.81, 6e-3, 0.05);
    let cosine = (1.0_f64 - sine * sine).sqrt();
    let table = Table::new(&flow, 960);
    let at = |quantity: &Quantity, i: usize| table.at(quantity, i);
    let slope = |quantity: &Quantity, i: usize| table.slope(quantity, i);
    let all = (1e-3, 0.65);
    let near = |what: &str, range: (f64, f64), most: f64, of: &dyn Fn(usize) -> (f64, f64)| {
        let miss = table.miss(range, of);
        assert!(miss < most, "{set:?}: {what} misses by {miss:e}");
    };
    let slip = |i: usize| at(&q::U_FLUID, i) - at(&q::U_PARTICLE, i);
    let force = |i: usize| {
        let phi = at(&q::PHI, i);
        phi * (1.0 - phi) * Theory::drag(phi, slip(i), d).0 * slip(i)
    };
    near("momentum of the fluid", all, 0.01, &|i| {
        let phi = at(&q::PHI, i);
        let stress = slope(&q::TAU_VISCOUS, i) + slope(&q::TAU_REYNOLDS, i);
        (stress + (1.0 - phi) * rho_f * g * sine, force(i))
    });
    near("momentum of the grains", all, 0.01, &|i| {
        (-slope(&q::TAU_PARTICLE, i), at(&q::PHI, i) * rho_p * g * sine + force(i))
    });
    near("weight of the grains", all, 0.01, &|i| {
        (-slope(&q::P_PARTICLE, i), (rho_p - rho_f) * g * cosine * at(&q::PHI, i))
    });
    near("pressure", all, 1e-9, &|i| {
        let phi = at(&q::PHI, i);
        let kinetic = rho_p * phi * (1.0 + 2.0 * (1.0 + theory.e) * phi * theory.g0(phi));
        (at(&q::P_PARTICLE, i), kinetic * at(&q::GRANULAR_TEMPERATURE, i) + elastic(phi))
    });
    near("pressure of contacts", all, 1e-9, &|i| (at(&q::P_CONTACT, i), elastic(at(&q::PHI, i))));
    let k = |i: usize| Theory::drag(at(&q::PHI, i), slip(i), d);
    near("stress of moving grains", (1e-3, 0.565), 0.01, &|i| {
        let t = at(&q::GRANULAR_TEMPERATURE, i);
        let (f2, _) = theory.coefficients(at(&q::PHI, i), t, k(i).0 * d / rho_p);
        (at(&q::TAU_PARTICLE, i), rho_p * d * f2 * t.sqrt() * slope(&q::U_PARTICLE, i))
    });
    // mu_s = 0.146 + 0.228 tanh(0.4/0.232) = 0.359946.
    near("stress of contacts", (0.58, 0.606), 0.01, &|i| (at(&q::TAU_CONTACT, i), 0.359_946 * at(&q::P_CONTACT, i)));
    let flux = |i: usize| {
        let t = at(&q::GRANULAR_TEMPERATURE, i);
        let (_, f3) = theory.coefficients(at(&q::PHI, i), t, k(i).0 * d / rho_p);
        rho_p * d * f3 * t.sqrt() * slope(&q::GRANULAR_TEMPERATURE, i)
    };
    near("diffusion", (2e-3, 0.6), 0.03, &|i| {
        (at(&q::DIFFUSION, i), (flux(i + 1) - flux(i - 1)) / (table.z[i + 1] - table.z[i - 1]))
    });
    near("loss by contacts", all, 1e-6, &|i| {
        let (phi, t) = (at(&q::PHI, i), at(&q::GRANULAR_TEMPERATURE, i));
        let f4 = 12.0 / PI.sqrt() * (1.0 - theory.e_eff.powi(2)) * phi * phi * theory.g0(phi);
        (at(&q::CONTACT_LOSS, i), rho_p / d * f4 * t.powf(1.5))
    });
    near("loss by drag", all, 1e-4, &|i| {
        let (phi, (k, share)) = (at(&q::PHI, i), k(i));
        let factor = if theory.quadratic { 3.0 + 2.0 * share } else { 3.0 };
        (at(&q::DRAG_LOSS, i), phi * (1.0 - phi) * k * factor * at(&q::GRANULAR_TEMPERATURE, i))
    });
    near("fluctuation energy", all, 1e-3, &|i| {
        (at(&q::PRODUCTION, i) + at(&q::DIFFUSION, i), at(&q::CONTACT_LOSS, i) + at(&q::DRAG_LOSS, i))
    });
    near("production", all, 0.01, &|i| {
        let moving = at(&q::TAU_PARTICLE, i) - at(&q::TAU_CONTACT, i);
        (at(&q::PRODUCTION, i), moving * slope(&q::U_PARTICLE, i))
    });
    near("mixing length", (-1.0, 0.65), 0.01, &|i| {
        (slope(&q::MIXING_LENGTH, i), 0.41 * f64::max(1.0 - at(&q::PHI, i) / 0.61, 0.0))
    });
    near("Reynolds stress", (-1.0, 0.60), 0.01, &|i| {
        let shear = slope(&q::U_FLUID, i);
        let eps = 1.0 - at(&q::PHI, i);
        (at(&q::TAU_REYNOLDS, i), rho_f * eps * at(&q::MIXING_LENGTH, i).powi(2) * shear.abs() * shear)
    });
    near("viscous stress", (-1.0, 0.65), 0.01, &|i| {
        (at(&q::TAU_VISCOUS, i), 1e-3 * (1.0 - at(&q::PHI, i)) * slope(&q::U_FLUID, i))
    });
    near("inertial number", all, 0.01, &|i| {
        let rate = slope(&q::U_PARTICLE, i).abs();
        (at(&q::INERTIAL_NUMBER, i), d * rate * (rho_p / at(&q::P_PARTICLE, i)).sqrt())
    });
}

#[test]
fn of_the_proposed_theory() {
    check(&[], &PROPOSED);
}

#[test]
fn of_the_classical_theory() {
    check(&[CLASSICAL], &OLD);
}
