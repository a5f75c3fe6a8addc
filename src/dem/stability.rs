//! The longest stable step: of a pair in closed form, of a packing grain by grain.
//!
//! Leapfrog whose damping takes the factor e^(-2 ζ w h) a step is stable for (w h)² < 2 (1 + e^(-2 ζ w h)). A pair has two modes: head-on, w² = k_n/m
//! with the reduced mass m and damping ratio ζ; rolling against each other, w² = 7/2 k_s/m, undamped.
//! A contact takes the share 1 - e^(-2 ζ w h) of the approach of its grains in a step. Where several contacts of a grain act along one
//! direction, on λ of them as one, they must not take more than twice the approach: λ (1 - e^(-2 ζ w h)) < 2. It binds
//! for restitution coefficients below about 0.1.
//! In a packing w² of a grain is bounded by the largest eigenvalue of the stiffness of its contacts, translation and
//! R ω together, over its mass, counted twice where the neighbour is mobile (block Gershgorin); for one pair the bound is exact.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::engine::Engine;
use super::law::ContactLaw;

/// The longest step, and who sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// longest stable step \[s]; infinite without contacts
    pub step: f64,
    /// place of the grain
    pub grain: usize,
    /// its contacts
    pub contacts: usize,
}

/// Longest stable step of one contact of reduced mass `mass` \[kg] \[s].
#[must_use]
pub fn of_pair<C: ContactLaw>(law: &C, mass: f64) -> f64 {
    let (k_n, k_s) = law.stiffness();
    damped((k_n / mass).sqrt(), law.damping_ratio()).min(2.0 / (3.5 * k_s / mass).sqrt())
}

/// Longest step of a mode of frequency `w` [1/s] and damping ratio `zeta` \[s].
fn damped(w: f64, zeta: f64) -> f64 {
    // The step falls where the map rises, and the slope of the map is below 1: halving the interval cannot fail.
    let (mut low, mut high) = (std::f64::consts::SQRT_2, 2.0);
    for _ in 0..60 {
        let x = 0.5 * (low + high);
        if x * x < 2.0 * (1.0 + (-2.0 * zeta * x).exp()) {
            low = x;
        } else {
            high = x;
        }
    }
    low / w
}

/// Longest step in which contacts with the rate 2 ζ w [1/s], `lambda` of them as one, take less than twice the approach of a grain \[s].
fn of_damping(rate: f64, lambda: f64) -> f64 {
    if lambda > 2.0 && rate > 0.0 { -(-2.0 / lambda).ln_1p() / rate } else { f64::INFINITY }
}

/// Contacts that act as one along the worst direction in a bed that comes to rest: twelve touching neighbours, all around.
const CLOSE_PACKED: f64 = 4.0;

/// Longest step in which the damping of contacts of reduced mass `mass` \[kg] is stable in any bed of like grains \[s].
#[must_use]
pub fn of_packing<C: ContactLaw>(law: &C, mass: f64) -> f64 {
    let (k_n, _) = law.stiffness();
    of_damping(2.0 * law.damping_ratio() * (k_n / mass).sqrt(), CLOSE_PACKED)
}

#[derive(Clone)]
struct Stiffness {
    normal: Matrix3<f64>,
    whole: Matrix6<f64>,
    contacts: usize,
    /// largest damping ratio over frequency of a contact \[s]
    damping: f64,
    /// smallest w² of a contact [1/s2]
    softest: f64,
}

/// Longest stable step of the present contacts.
#[must_use]
pub fn limit<C: ContactLaw>(engine: &Engine<C>) -> Limit {
    let grains = &engine.grains;
    let (k_n, k_s) = engine.law.stiffness();
    let none = Stiffness {
        normal: Matrix3::zeros(),
        whole: Matrix6::zeros(),
        contacts: 0,
        damping: 0.0,
        softest: f64::INFINITY,
    };
    let mut all = vec![none; grains.len()];
    for contact in engine.contacts() {
        let n = Vector3::from(contact.normal);
        let along = n * n.transpose();
        let across = Matrix3::identity() - along;
        // v × n = -[n] v: the tangential motion of the contact point is (I - nnᵀ) v ± n × (R ω).
        let turned = n.cross_matrix();
        let mut whole = Matrix6::zeros();
        whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&(along * k_n + across * k_s));
        // With the inertia 2/5 m R², R ω counts sqrt(5/2) times.
        let mixed = turned * (k_s * 2.5_f64.sqrt());
        whole.fixed_view_mut::<3, 3>(0, 3).copy_from(&mixed);
        whole.fixed_view_mut::<3, 3>(3, 0).copy_from(&mixed.transpose());
        whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&(across * (2.5 * k_s)));
        let inverse = |i: usize| grains.spins[i].0[3];
        let both = inverse(contact.first) + contact.second.map_or(0.0, inverse);
        let alone = k_n * both;
        let damping = engine.law.damping_ratio() / alone.sqrt();
        for (one, other, sign) in
            [(Some(contact.first), contact.second, 1.0), (contact.second, Some(contact.first), -1.0)]
        {
            let Some(i) = one.filter(|&i| inverse(i) > 0.0) else { continue };
            let count = if other.is_some_and(|j| inverse(j) > 0.0) { 2.0 } else { 1.0 };
            let mut whole = whole;
            let mut mixed = whole.fixed_view_mut::<3, 3>(0, 3);
            mixed *= sign;
            let mut mixed = whole.fixed_view_mut::<3, 3>(3, 0);
            mixed *= sign;
            all[i].normal += along * (count * k_n);
            all[i].whole += whole * count;
            all[i].contacts += 1;
            all[i].damping = all[i].damping.max(damping);
            all[i].softest = all[i].softest.min(alone);
        }
    }
    let mut least = Limit { step: f64::INFINITY, grain: 0, contacts: 0 };
    for (i, stiffness) in all.iter().enumerate().filter(|(_, s)| s.contacts > 0) {
        let inverse = grains.spins[i].0[3];
        let w_n = (stiffness.normal.symmetric_eigenvalues().max() * inverse).sqrt();
        let w = (stiffness.whole.symmetric_eigenvalues().max() * inverse).sqrt();
        let rate = 2.0 * stiffness.damping * stiffness.softest;
        let together = of_damping(rate, w_n * w_n / stiffness.softest);
        let step = damped(w_n, stiffness.damping * w_n).min(2.0 / w).min(together);
        if step < least.step {
            least = Limit { step, grain: i, contacts: stiffness.contacts };
        }
    }
    least
}
