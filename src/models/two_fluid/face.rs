//! What passes through a face between two cells: stresses, fluctuation energy, grains and what they carry; and the vertical
//! momentum of the grains, which lives there.
//!
//! ```text
//! fluid      tau_f = k D + m |D| D,   D the difference of u;  1/k = sum of (h/2)/((1 - phi) nu),  1/m^(1/2) = sum of (h/2) <1/l>/(1 - phi)^(1/2)
//! grains     tau_p = r F2 T^(1/2) gamma + mu_s p_el gamma/(gamma^2 + lambda^2)^(1/2)
//! heat       q = - r F3 T^(1/2) dT/dz
//! vertical   (r + phi/(1 - phi)) dw/dt = - cos - (1/phi) dp/dz - K w/(1 - phi) - K (nu_t/Sc) d(ln phi)/dz
//! ```
//!
//! The pressure term is `(B(-a) P_+ - B(a) P_-)/dz`, with P = p/phi, `a = ln(phi_+/phi_-)` and `B(x) = x/(e^x - 1)`: the difference
//! of p over the logarithmic mean of phi, which is exact in a packed bed and in a dilute one, whose solid fraction falls
//! exponentially, and keeps phi positive on any grid.

use super::laws::Laws;
use super::state::{Cell, FLUID, GRAINS, HEAT, LENGTH, LOGIT, RISE, SIZE, VOLUME};
use crate::closures::kinetic::Moving;
use crate::closures::mixing_length::Length;
use crate::numerics::dual::Real;

/// Half the heights of the two cells.
#[derive(Clone, Copy, Debug)]
pub struct Halves {
    /// of the lower cell
    pub lower: f64,
    /// of the upper cell
    pub upper: f64,
}

/// Time derivative at the end of a step: `rate X + past`, where the past is known.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clock {
    /// of the solid volume above the face
    pub volume: f64,
    /// of its vertical velocity
    pub rise: f64,
}

/// How much of the friction of enduring contacts a shear rate mobilises, `gamma/(gamma^2 + lambda^2)^(1/2)`, as a variable of
/// its own: Newton's method on `r (gamma^2 + lambda^2)^(1/2) = gamma` in both keeps r between -1 and 1 and does not see the
/// kink that the law has at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mobilised(pub f64);

impl Mobilised {
    /// The value of the law, and the slope that the iteration takes.
    #[must_use]
    pub fn law(self, shear: f64, rate: f64) -> (f64, f64) {
        let size = shear.hypot(rate);
        let value = shear / size;
        (value, (1.0 - self.0 * value) / size)
    }

    /// After a `change` of the shear rate `from`.
    #[must_use]
    pub fn after(self, from: f64, change: f64, rate: f64) -> Self {
        let (value, slope) = self.law(from, rate);
        Self((value + slope * change).clamp(-1.0, 1.0))
    }
}

/// What a face does.
#[derive(Clone, Copy, Debug)]
pub struct Face<T> {
    /// viscous stress of the fluid
    pub viscous: T,
    /// turbulent stress of the fluid
    pub turbulent: T,
    /// stress of the grains by motion
    pub kinetic: T,
    /// stress of enduring contacts
    pub contact: T,
    /// eddy viscosity of the fluid
    pub eddy: T,
    /// shear rate of the grains
    pub shear: T,
    /// flux of fluctuation energy upward
    pub flux: T,
    /// rows of the lower cell
    pub lower: [T; SIZE],
    /// rows of the upper cell
    pub upper: [T; SIZE],
}

/// Laws, and the factor of the time derivative.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// laws
    pub laws: &'a Laws,
    /// factor of the new value in the time derivative; 0 where the flow is steady
    pub rate: f64,
    /// whether enduring contacts have the friction that is mobilised, or that of the law: the same in the end, but at rest
    /// only the first says how much
    pub mobilised: bool,
    /// whether what passes is the mean of both ways, as for disturbances of a flow without vertical motion
    pub both_ways: bool,
}

/// `x/(e^x - 1)`.
pub fn bernoulli<T: Real>(x: T) -> T {
    let z = x.value();
    if z.abs() < 1e-3 {
        let square = z * z;
        return x.chain(1.0 - 0.5 * z + square / 12.0 - square * square / 720.0, -0.5 + z / 6.0 - square * z / 180.0);
    }
    let less = z.exp_m1();
    if less.is_infinite() {
        return T::constant(0.0);
    }
    let value = z / less;
    x.chain(value, (1.0 - value * (less + 1.0)) / less)
}

/// Mean of 1/l over an interval in which l goes linearly from `a` to `b`; `None` where l reaches 0.
pub fn mean_inverse<T: Real>(a: T, b: T) -> Option<T> {
    if a.value() <= 0.0 || b.value() <= 0.0 {
        return None;
    }
    let sum = a + b;
    let r = (b - a) / sum;
    let q = r * r;
    // ln(b/a) = 2 atanh r: the series up to r^8 is exact to round-off here.
    let ratio = if q.value() < 1e-3 {
        (((q / 9.0 + 1.0 / 7.0) * q + 0.2) * q + 1.0 / 3.0) * q + 1.0
    } else {
        (b / a).ln() / (r * 2.0)
    };
    Some(ratio / sum * 2.0)
}

impl Setting<'_> {
    /// The face between `lower` and `upper`.
    pub fn face<T: Real>(
        &self,
        halves: Halves,
        lower: &Cell<T>,
        upper: &Cell<T>,
        (clock, r): (Clock, Mobilised),
    ) -> Face<T> {
        let laws = self.laws;
        let dz = halves.lower + halves.upper;
        let zero = T::constant(0.0);
        let (viscous, turbulent, eddy) = self.fluid(halves, lower, upper);

        let a = upper.ln_phi - lower.ln_phi;
        let phi = ((upper.ln_phi + lower.ln_phi) * 0.5).exp();
        let (gap, eps) = (-phi + laws.phi_max, -phi + 1.0);
        let w = lower.rise;
        let slip = (lower.u - lower.v + upper.u - upper.v) * 0.5;
        let up = w / eps;
        let (k, _) = laws.drag.per_volume(phi, (slip * slip + up * up).sqrt(), laws.drag.viscous(laws.nu, 1.0));

        let shear = (upper.v - lower.v) / dz;
        let (kinetic, flux) = self.moving((phi, gap), (k, shear, r), lower, upper, dz);
        let contact = self.contact((lower.elastic + upper.elastic) * 0.5, shear, r);

        // Grains are those of the cell that they leave; the fluid that makes room goes the other way.
        let passed = |from: &Cell<T>, to: &Cell<T>| {
            let passing = from.phi * w;
            [passing, -passing * to.u, passing * from.v * laws.ratio, passing * from.t * (1.5 * laws.ratio)]
        };
        let [passing, fluid, grains, heat] = if self.both_ways {
            let (up, down) = (passed(lower, upper), passed(upper, lower));
            std::array::from_fn(|k| (up[k] + down[k]) * 0.5)
        } else if w.value() > 0.0 {
            passed(lower, upper)
        } else {
            passed(upper, lower)
        };
        let fade = phi / (phi + laws.floors.phi);
        let pressure = (bernoulli(-a) * upper.per_grain - bernoulli(a) * lower.per_grain) / dz;
        let mut vertical =
            (w * self.rate + clock.rise) * (phi / eps + laws.ratio) + fade * laws.weight + pressure + k * up;
        if laws.dispersion > 0.0 {
            vertical = vertical + k * eddy * a * (laws.dispersion / dz);
        }

        let (u, v) = (viscous + turbulent, kinetic + contact);
        let heat = heat + flux;
        // Each cell takes the work done in its half.
        let heated = |half: f64, p: T, sign: f64| match laws.moving {
            Moving::Kinetic(_) => (heat + p * w) * sign - kinetic * shear * half,
            Moving::Inertial(_) => -shear * shear * half,
        };
        let mut below = [zero; SIZE];
        let mut above = [zero; SIZE];
        below[VOLUME] = lower.volume * self.rate + clock.volume - passing;
        below[RISE] = vertical;
        (below[LOGIT], above[LOGIT]) = (-lower.volume, lower.volume);
        (below[FLUID], above[FLUID]) = (fluid - u, u - fluid);
        (below[GRAINS], above[GRAINS]) = (grains - v, v - grains);
        below[HEAT] = heated(halves.lower, lower.kinetic, 1.0);
        above[HEAT] = heated(halves.upper, upper.kinetic, -1.0);
        (below[LENGTH], above[LENGTH]) = (lower.length, -lower.length);
        Face { viscous, turbulent, kinetic, contact, eddy, shear, flux, lower: below, upper: above }
    }

    /// Viscous and turbulent stress of the fluid, and its eddy viscosity, between two cells.
    fn fluid<T: Real>(&self, halves: Halves, lower: &Cell<T>, upper: &Cell<T>) -> (T, T, T) {
        let laws = self.laws;
        let share = |phi: T| if laws.share { -phi + 1.0 } else { T::constant(1.0) };
        let (below, above) = (share(lower.phi), share(upper.phi));
        let difference = upper.u - lower.u;
        let viscous = difference * laws.nu / (T::constant(halves.lower) / below + T::constant(halves.upper) / above);
        let middle = (lower.phi + upper.phi) * 0.5;
        let here = laws.mixing_length.length(lower.length, middle);
        let inside =
            |clearance: T, half: f64| laws.mixing_length.length(lower.length + clearance * (0.5 * half), middle);
        let mean = |near: T, half: f64| mean_inverse(here, near).map(|inverse| inverse * half);
        let parts = (
            mean(inside(-lower.clearance, 2.0 * halves.lower), halves.lower),
            mean(inside(upper.clearance, 2.0 * halves.upper), halves.upper),
        );
        let (Some(low), Some(high)) = parts else {
            return (viscous, T::constant(0.0), T::constant(0.0));
        };
        let resistance = low / below.sqrt() + high / above.sqrt();
        let turbulent = difference.abs() * difference / (resistance * resistance);
        let eddy = here * here * difference.abs() / (halves.lower + halves.upper);
        (viscous, turbulent, eddy)
    }

    /// Stress of moving grains, and flux of their fluctuation energy upward.
    fn moving<T: Real>(
        &self,
        (phi, gap): (T, T),
        (k, shear, r): (T, T, Mobilised),
        lower: &Cell<T>,
        upper: &Cell<T>,
        dz: f64,
    ) -> (T, T) {
        let ratio = self.laws.ratio;
        match self.laws.moving {
            Moving::Kinetic(law) => {
                let root = ((lower.t + upper.t) * 0.5).sqrt();
                let (eta, kappa) = law.transport(phi, gap, root, k / ratio);
                (eta * root * shear * ratio, kappa * root * (lower.t - upper.t) * (ratio / dz))
            }
            Moving::Inertial(law) => {
                let p = (lower.kinetic + lower.elastic + upper.kinetic + upper.elastic) * 0.5;
                let size = (shear * shear + self.laws.floors.rate * self.laws.floors.rate).sqrt();
                let inertial = size * (T::constant(ratio) / p).sqrt();
                (law.mu(inertial) * p * self.direction(shear, r), T::constant(0.0))
            }
        }
    }

    /// `gamma/(gamma^2 + lambda^2)^(1/2)` with the slope of the iteration.
    fn direction<T: Real>(&self, shear: T, r: Mobilised) -> T {
        let (value, slope) = r.law(shear.value(), self.laws.floors.rate);
        shear.chain(if self.mobilised { r.0 } else { value }, slope)
    }

    /// Stress of enduring contacts under the elastic pressure `p`.
    fn contact<T: Real>(&self, p: T, shear: T, r: Mobilised) -> T {
        match self.laws.moving {
            Moving::Kinetic(_) if p.value() > 0.0 => p * self.direction(shear, r) * self.laws.mu_s,
            _ => T::constant(0.0),
        }
    }

    /// The wall at rest under the lowest cell: stresses on it, and the rows of the cell. `half` is half its height.
    pub fn wall<T: Real>(&self, half: f64, cell: &Cell<T>, volume: f64, r: Mobilised) -> Face<T> {
        let laws = self.laws;
        let zero = T::constant(0.0);
        let share = if laws.share { -cell.phi + 1.0 } else { T::constant(1.0) };
        let viscous = cell.u * share * (laws.nu / half);
        let slip = cell.u - cell.v;
        let (k, _) = laws.drag.per_volume(cell.phi, slip.abs(), laws.drag.viscous(laws.nu, 1.0));
        let shear = cell.v / half;
        let (kinetic, _) = self.moving((cell.phi, cell.gap), (k, shear, r), cell, cell, half);
        let contact = self.contact(cell.elastic, shear, r);
        let mut above = [zero; SIZE];
        above[LOGIT] = T::constant(volume);
        above[FLUID] = viscous;
        above[GRAINS] = kinetic + contact;
        above[HEAT] = match laws.moving {
            Moving::Kinetic(_) => -kinetic * shear * half,
            Moving::Inertial(_) => -shear * shear * half,
        };
        Face {
            viscous,
            turbulent: zero,
            kinetic,
            contact,
            eddy: zero,
            shear,
            flux: zero,
            lower: [zero; SIZE],
            upper: above,
        }
    }
}
