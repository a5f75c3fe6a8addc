//! The contact law: what two grains that touch do to each other. The pair loop knows only the trait.

use super::simd::scalar::One;
use super::simd::{Simd, Vector, dot, minus, plus, scale};
use crate::closures::contact::Tension;
use crate::closures::contact::restitution::{self, RestitutionError};
use crate::numerics::root;

/// A contact as the law sees it; the velocities are those of the second grain relative to the first at the contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact<L> {
    /// overlap \[m], positive
    pub overlap: L,
    /// unit vector from the first to the second grain
    pub normal: Vector<L>,
    /// normal velocity [m/s], positive where they part
    pub parting: L,
    /// tangential velocity [m/s]
    pub sliding: Vector<L>,
    /// elongation of the tangential spring before this step \[m]
    pub spring: Vector<L>,
    /// 1/m_1 + 1/m_2 [1/kg]; a fixed grain and a wall have 0
    pub inverse_mass: L,
}

/// What the contact does to the second grain; the first takes the opposite.
#[derive(Clone, Copy, Debug)]
pub struct Response<L> {
    /// repulsion along the normal \[N]
    pub normal: L,
    /// tangential force \[N]
    pub tangential: Vector<L>,
    /// elongation of the tangential spring after this step \[m]
    pub spring: Vector<L>,
}

/// A law of contact, written once for any number of contacts at a time.
pub trait ContactLaw: Copy + Send + Sync {
    /// Force and new spring after a step of `dt` \[s]; with `dt` = 0 the force as it stands.
    fn respond<L: Simd>(&self, proof: L::Proof, contact: Contact<L>, dt: f64) -> Response<L>;
    /// Normal and tangential stiffness [N/m].
    fn stiffness(&self) -> (f64, f64);
    /// Damping ratio c/(2 sqrt(m k_n)) of the normal contact.
    fn damping_ratio(&self) -> f64;
    /// The law for a time step of `dt` \[s], of mobile grains with inverse masses from and to `masses` [1/kg].
    #[must_use]
    fn for_step(self, dt: f64, masses: Option<[f64; 2]>) -> Self;
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
    /// what follows from the time step
    pub discrete: Discrete,
}

/// The dashpot of a time step. Leapfrog knows the velocity half a step late, which stiffens a damped contact by a share
/// of the order of the step. The damping is therefore chosen so that an impact that is followed with this very step, the
/// moment of touch anywhere within it, returns e_n in the mean; as the step shrinks it becomes that of the closed form.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Discrete {
    /// time step \[s]; 0 is the continuous law
    pub dt: f64,
    /// of equal grains: inverse mass between those of a pair with one and with two mobile grains [1/kg], and the
    /// damping coefficients of both [kg/s]
    pub equal: Option<[f64; 3]>,
    /// damping over that of the closed form is 1 + a x + b x² with x = h sqrt(k_n/m): a and b
    pub curve: [f64; 2],
}

/// What LAMMPS takes for granted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lammps {
    /// 1/m_1 + 1/m_2 of two mobile grains [1/kg], used for fixed ones, too
    pub inverse_mass: f64,
}

fn equal_pair(masses: Option<[f64; 2]>) -> Option<f64> {
    masses.and_then(|[least, largest]| (least == largest).then_some(least))
}

/// Moments of touch within a step over which the restitution of a step is the mean: in a contact of few steps one step more or
/// less is a jump, and it takes many moments to smooth it.
fn phases(x: f64) -> usize {
    (256.0 * x).clamp(16.0, 512.0) as usize
}
/// Steps over the period of a contact so short that the closed form serves.
const SHORT: f64 = 1e-3;

impl LinearSpring {
    /// The law whose restitution coefficient is `e_n` in the convention `tension`.
    ///
    /// # Errors
    /// [`RestitutionError`] if no damping gives it.
    pub fn new(k_n: f64, k_s: f64, mu: f64, e_n: f64, tension: Tension) -> Result<Self, RestitutionError> {
        Ok(Self {
            k_n,
            k_s,
            mu,
            zeta: restitution::damping_ratio(e_n, tension)?,
            tension,
            lammps: None,
            discrete: Discrete::default(),
        })
    }
}

impl LinearSpring {
    /// Damping coefficient of a contact [kg/s].
    #[inline(always)]
    fn damping<L: Simd>(&self, proof: L::Proof, inverse_mass: L) -> L {
        let all = |x| L::splat(proof, x);
        let Discrete { dt, curve: [a, b], .. } = self.discrete;
        let x = all(dt) * (all(self.k_n) * inverse_mass).sqrt();
        let closed = (all(4.0 * self.zeta * self.zeta * self.k_n) / inverse_mass).sqrt();
        closed * (all(1.0) + x * (all(a) + x * all(b)))
    }

    /// Mean restitution coefficient of impacts that are followed with the step `x`, in units of sqrt(m/k_n), and damping
    /// `factor` times that of the closed form. Units: m = k_n = 1.
    fn followed(&self, x: f64, factor: f64) -> f64 {
        let damping = 2.0 * self.zeta * factor;
        let law = Self {
            k_n: 1.0,
            discrete: Discrete { dt: x, equal: Some([0.0, damping, damping]), ..Discrete::default() },
            ..*self
        };
        let zero = [One(0.0); 3];
        let (mut sum, phases) = (0.0, phases(x));
        for phase in 0..phases {
            let (mut overlap, mut parting) = ((phase as f64 + 0.5) / phases as f64 * x, -1.0);
            // An impact lasts at most a few periods; what lasts longer returns next to nothing.
            for _ in 0..(40.0 / x) as usize {
                let normal = [One(1.0), One(0.0), One(0.0)];
                let contact = Contact {
                    overlap: One(overlap),
                    normal,
                    parting: One(parting),
                    sliding: zero,
                    spring: zero,
                    inverse_mass: One(1.0),
                };
                parting += x * law.respond((), contact, 0.0).normal.0;
                overlap -= x * parting;
                if overlap <= 0.0 {
                    break;
                }
            }
            sum += parting;
        }
        sum / phases as f64
    }

    /// Damping over that of the closed form for the step `x`; 1 where it makes no difference or none meets e_n.
    fn correction(&self, x: f64) -> f64 {
        if self.zeta == 0.0 || x < SHORT {
            return 1.0;
        }
        let wanted = restitution::coefficient(self.zeta, self.tension);
        root::brent(|factor| self.followed(x, factor) - wanted, 0.3, 3.0, |_| ()).unwrap_or(1.0)
    }
}

impl ContactLaw for LinearSpring {
    #[inline(always)]
    fn respond<L: Simd>(&self, proof: L::Proof, contact: Contact<L>, dt: f64) -> Response<L> {
        let all = |x| L::splat(proof, x);
        let Contact { overlap, normal, parting, sliding, spring, inverse_mass } = contact;
        let zero = all(0.0);
        let damping = match self.lammps {
            Some(Lammps { inverse_mass }) => all(2.0 * self.zeta * (self.k_n / inverse_mass).sqrt()),
            None => match self.discrete.equal {
                Some([between, one, two]) => L::select(inverse_mass.above(all(between)), all(two), all(one)),
                None => self.damping(proof, inverse_mass),
            },
        };
        // A force that sets in (or, pulling, ends) within the step acts from (or to) the moment of the touch, not for
        // the whole step around the present: without this the restitution converges with the first order only.
        let way = all(self.discrete.dt) * parting;
        let came = match self.tension {
            Tension::Kept => L::select(way.above(zero), way, -way),
            Tension::Cut => -way,
        };
        let whole = all(1.0);
        let share = match self.lammps {
            Some(_) => whole,
            None => L::select(came.above(overlap), overlap / came + all(0.5), whole),
        };
        let push = all(self.k_n) * overlap - share * damping * parting;
        let pushing = L::select(push.above(zero), push, zero);
        let (f_n, pressing) = match self.tension {
            Tension::Cut => (pushing, pushing),
            Tension::Kept if self.lammps.is_some() => (push, L::select(push.above(zero), push, -push)),
            Tension::Kept => (push, pushing),
        };
        // The spring turns with the plane of contact: what leaves the plane is dropped.
        let longer = plus(spring, scale(all(dt), sliding));
        let flat = minus(longer, scale(dot(longer, normal), normal));
        let pull = all(self.k_s) * dot(flat, flat).sqrt();
        let cap = all(self.mu) * pressing;
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

    fn for_step(self, dt: f64, masses: Option<[f64; 2]>) -> Self {
        if self.lammps.is_some() {
            return self;
        }
        let x = |inverse: f64| dt * (self.k_n * inverse).sqrt();
        let closed = |inverse: f64| 2.0 * self.zeta * (self.k_n / inverse).sqrt();
        // Grains of one size are met exactly, others on a parabola through the lightest pair and one four times as heavy.
        let equal = equal_pair(masses).map(|inverse| {
            let of = |inverse: f64| closed(inverse) * self.correction(x(inverse));
            [1.5 * inverse, of(inverse), of(inverse + inverse)]
        });
        let curve = match (equal, masses) {
            (None, Some([_, largest])) if x(2.0 * largest) >= SHORT => {
                let whole = x(2.0 * largest);
                let (at_whole, at_half) = (self.correction(whole) - 1.0, self.correction(0.5 * whole) - 1.0);
                [(4.0 * at_half - at_whole) / whole, (2.0 * at_whole - 4.0 * at_half) / (whole * whole)]
            }
            _ => [0.0; 2],
        };
        Self { discrete: Discrete { dt, equal, curve }, ..self }
    }

    #[inline(always)]
    fn full_lever(&self) -> bool {
        self.lammps.is_some()
    }
}
