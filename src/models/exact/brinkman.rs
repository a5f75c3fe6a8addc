//! Seepage through a static bed: Darcy drag and viscous stress, `l^2 U'' - U + K f = 0` with `U(0) = 0`, `U(h) = U_h`.
//!
//! `U(z) = K f + [(U_h - K f) sinh(z/l) - K f sinh((h - z)/l)] / sinh(h/l)`, `l = sqrt(K e)`.
//! The ratios of hyperbolic functions are evaluated by decaying exponentials, so that a bed of thousands of `l` does not
//! overflow. Source: Chauchat & Medale (2010), eq. (12) with u_p = 0.

/// The static layer, in the units of the model: lengths in H, velocities in (rho_p - rho_f) g H^2/eta.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brinkman {
    /// K f: velocity of the seepage far from the walls
    pub seepage: f64,
    /// l
    pub length: f64,
    /// thickness h
    pub h: f64,
    /// velocity at the top, U_h
    pub top: f64,
}

impl Brinkman {
    /// `sinh(x/l)/sinh(h/l)` for 0 <= x <= h.
    fn sinh(&self, x: f64) -> f64 {
        let l = self.length;
        ((x - self.h) / l).exp() * (-2.0 * x / l).exp_m1() / (-2.0 * self.h / l).exp_m1()
    }

    /// `cosh(x/l)/sinh(h/l)` for 0 <= x <= h.
    fn cosh(&self, x: f64) -> f64 {
        let l = self.length;
        -((x - self.h) / l).exp() * (1.0 + (-2.0 * x / l).exp()) / (-2.0 * self.h / l).exp_m1()
    }

    /// U(z).
    pub fn velocity(&self, z: f64) -> f64 {
        self.seepage + (self.top - self.seepage) * self.sinh(z) - self.seepage * self.sinh(self.h - z)
    }

    /// U'(z).
    pub fn slope(&self, z: f64) -> f64 {
        ((self.top - self.seepage) * self.cosh(z) + self.seepage * self.cosh(self.h - z)) / self.length
    }

    /// Integral of U from z to h.
    pub fn integral_above(&self, z: f64) -> f64 {
        let bottom = 1.0 / (self.h / self.length).sinh();
        self.seepage * (self.h - z) + (self.top - self.seepage) * self.length * (self.cosh(self.h) - self.cosh(z))
            - self.seepage * self.length * (self.cosh(self.h - z) - bottom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::quadrature::simpson;
    use approx::assert_relative_eq;

    const THICK: Brinkman = Brinkman { seepage: 0.3, length: 0.2, h: 1.0, top: 0.9 };

    #[test]
    fn boundary_values_slope_and_integral() {
        assert_relative_eq!(THICK.velocity(0.0), 0.0, epsilon = 1e-15);
        assert_relative_eq!(THICK.velocity(1.0), 0.9, epsilon = 1e-15);
        let h = 1e-5;
        for z in [0.1, 0.5, 0.9] {
            let difference = (THICK.velocity(z + h) - THICK.velocity(z - h)) / (2.0 * h);
            assert_relative_eq!(THICK.slope(z), difference, max_relative = 1e-8);
            let integral = simpson(|x| THICK.velocity(x), z, 1.0, 2000);
            assert_relative_eq!(THICK.integral_above(z), integral, max_relative = 1e-12);
        }
    }

    #[test]
    fn the_equation_holds_by_runge_kutta() {
        // From U(0) = 0 and the slope at the wall upwards: U'' = (U - K f)/l^2.
        let n = 20_000;
        let dz = THICK.h / f64::from(n);
        let rhs = |u: f64, v: f64| (v, (u - THICK.seepage) / THICK.length.powi(2));
        let (mut u, mut v) = (0.0, THICK.slope(0.0));
        for _ in 0..n {
            let k1 = rhs(u, v);
            let k2 = rhs(u + 0.5 * dz * k1.0, v + 0.5 * dz * k1.1);
            let k3 = rhs(u + 0.5 * dz * k2.0, v + 0.5 * dz * k2.1);
            let k4 = rhs(u + dz * k3.0, v + dz * k3.1);
            u += dz / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
            v += dz / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
        }
        assert_relative_eq!(u, THICK.top, max_relative = 1e-11);
        assert_relative_eq!(v, THICK.slope(1.0), max_relative = 1e-11);
    }

    #[test]
    fn a_thin_layer_in_a_deep_bed_does_not_overflow() {
        let thin = Brinkman { length: 1e-6, ..THICK };
        assert_relative_eq!(thin.velocity(0.5), 0.3, max_relative = 1e-15);
        assert_relative_eq!(thin.slope(1.0), 0.6 / 1e-6, max_relative = 1e-12);
        assert!(thin.integral_above(0.0).is_finite());
    }
}
