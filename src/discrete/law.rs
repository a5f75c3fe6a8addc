//! The contact law: what two grains that touch do to each other. The pair loop knows only the trait.

use super::lanes::{Lanes, Vector, dot, minus, plus, scale};
pub use crate::closures::contact::Tension;
use crate::closures::contact::restitution::{self, RestitutionError};

/// A contact as the law sees it; the velocities are those of the second grain relative to the first at the contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact<L> {
    /// overlap [m], positive
    pub overlap: L,
    /// unit vector from the first to the second grain
    pub normal: Vector<L>,
    /// normal velocity [m/s], positive where they part
    pub parting: L,
    /// tangential velocity [m/s]
    pub sliding: Vector<L>,
    /// elongation of the tangential spring before this step [m]
    pub spring: Vector<L>,
    /// 1/m_1 + 1/m_2 [1/kg]; a fixed grain and a wall have 0
    pub inverse_mass: L,
}

/// What the contact does to the second grain; the first takes the opposite.
#[derive(Clone, Copy, Debug)]
pub struct Response<L> {
    /// repulsion along the normal [N]
    pub normal: L,
    /// tangential force [N]
    pub tangential: Vector<L>,
    /// elongation of the tangential spring after this step [m]
    pub spring: Vector<L>,
}

/// A law of contact, written once for any number of contacts at a time.
pub trait ContactLaw: Copy + Send + Sync {
    /// Force and new spring after a step of `dt` [s]; with `dt` = 0 the force as it stands.
    fn respond<L: Lanes>(&self, proof: L::Proof, contact: Contact<L>, dt: f64) -> Response<L>;
    /// Normal and tangential stiffness [N/m].
    fn stiffness(&self) -> (f64, f64);
    /// Damping ratio c/(2 sqrt(m k_n)) of the normal contact.
    fn damping_ratio(&self) -> f64;
    /// Whether torque and sliding take the lever arm R, as LAMMPS does, instead of the distance to the contact.
    fn full_lever(&self) -> bool;
}

/// Linear spring and dashpot along the normal, linear spring with a Coulomb slider across it (paper 000, section II.A).
///
/// f_n = k_n δ - c v_n, c = 2 ζ sqrt(m k_n) with 1/m = 1/m_1 + 1/m_2; |f_t| = min(k_s |s|, μ f_n), ds/dt = v_t in the plane of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSpring {
    /// normal stiffness [N/m]
    pub k_n: f64,
    /// tangential stiffness [N/m]
    pub k_s: f64,
    /// friction coefficient
    pub mu: f64,
    /// damping ratio
    pub zeta: f64,
    /// whether the normal force may pull
    pub tension: Tension,
    /// conventions of LAMMPS `gran/hooke/history`: lever arm R, cap on |f_n|, the reduced mass of two equal grains everywhere
    pub lammps: Option<Lammps>,
}

/// What LAMMPS takes for granted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lammps {
    /// 1/m_1 + 1/m_2 of two mobile grains [1/kg], used for fixed ones, too
    pub inverse_mass: f64,
}

impl LinearSpring {
    /// The law whose restitution coefficient is `e_n` in the convention `tension`.
    ///
    /// # Errors
    /// [`RestitutionError`] if no damping gives it.
    pub fn new(k_n: f64, k_s: f64, mu: f64, e_n: f64, tension: Tension) -> Result<Self, RestitutionError> {
        Ok(Self { k_n, k_s, mu, zeta: restitution::damping_ratio(e_n, tension)?, tension, lammps: None })
    }
}

impl ContactLaw for LinearSpring {
    #[inline(always)]
    fn respond<L: Lanes>(&self, proof: L::Proof, contact: Contact<L>, dt: f64) -> Response<L> {
        let all = |x| L::splat(proof, x);
        let Contact { overlap, normal, parting, sliding, spring, inverse_mass } = contact;
        let zero = all(0.0);
        let damping = match self.lammps {
            Some(Lammps { inverse_mass }) => all(2.0 * self.zeta * (self.k_n / inverse_mass).sqrt()),
            None => (all(4.0 * self.zeta * self.zeta * self.k_n) / inverse_mass).sqrt(),
        };
        let push = all(self.k_n) * overlap - damping * parting;
        let pushing = L::select(push.above(zero), push, zero);
        let (f_n, held) = match self.tension {
            Tension::Cut => (pushing, pushing),
            Tension::Kept if self.lammps.is_some() => (push, L::select(push.above(zero), push, -push)),
            Tension::Kept => (push, pushing),
        };
        // The spring turns with the plane of contact: what leaves the plane is dropped.
        let longer = plus(spring, scale(all(dt), sliding));
        let flat = minus(longer, scale(dot(longer, normal), normal));
        let pull = all(self.k_s) * dot(flat, flat).sqrt();
        let cap = all(self.mu) * held;
        let slips = pull.above(cap);
        // Where nothing slips the quotient is not used, and 0/0 stays away from the result.
        let kept = L::select(slips, cap / pull, all(1.0));
        let spring = scale(kept, flat);
        Response { normal: f_n, tangential: scale(-all(self.k_s), spring), spring }
    }

    fn stiffness(&self) -> (f64, f64) {
        (self.k_n, self.k_s)
    }

    fn damping_ratio(&self) -> f64 {
        self.zeta
    }

    #[inline(always)]
    fn full_lever(&self) -> bool {
        self.lammps.is_some()
    }
}
