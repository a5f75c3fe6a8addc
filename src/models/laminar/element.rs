//! The shear stress of one element as a function of its shear rate, and the inverse.
//!
//! `T(gamma) = e gamma + y R(gamma) + p (mu_2 - mu_s) I/(I_0 + I)`, `I = gamma/p` in scaled units (eta gamma/P_p).
//!
//! The first term is the fluid, the second the yield stress with its regularisation, the third what mu(I_v) adds to it. The
//! function is odd and increasing, so it has one inverse; with the exact yield it jumps from -y to y at rest.

use crate::closures::friction::MuIv;
use crate::closures::regularisation::{Regularisation, Smoothing};

/// An element of the mesh: one viscosity, one yield stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// relative viscosity
    pub e: f64,
    /// yield stress mu_s p
    pub y: f64,
    /// what mu(I_v) adds; `None` for a constant friction
    pub rise: Option<Rise>,
}

/// The rise of the friction with the viscous number, under the particle pressure of the element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    /// particle pressure
    pub p: f64,
    /// the law
    pub law: MuIv,
}

impl Rise {
    /// Stress and its derivative at the shear rate `gamma`.
    #[must_use]
    pub fn stress(&self, gamma: f64) -> (f64, f64) {
        self.law.rise(self.p, gamma)
    }
}

impl Element {
    /// Stress of the solid part and its derivative.
    #[must_use]
    pub fn solid(&self, gamma: f64, regularisation: &Regularisation) -> (f64, f64) {
        let (rise, slope) = self.rise.map_or((0.0, 0.0), |rise| rise.stress(gamma));
        (self.y * regularisation.ratio(gamma) + rise, self.y * regularisation.slope(gamma) + slope)
    }

    /// The shear rate under the stress `t`, and its derivative with respect to the stress.
    #[must_use]
    pub fn shear_rate(&self, t: f64, regularisation: &Regularisation) -> (f64, f64) {
        let size = t.abs();
        if regularisation.is_exact() && size <= self.y {
            return (0.0, 0.0);
        }
        // Between the shear rates without and with the whole yield stress and its rise.
        let (mut low, mut high) = (0.0_f64, size / self.e);
        let flow = self.beyond(size - self.y);
        if regularisation.is_exact() {
            let (_, slope) = self.solid(flow, regularisation);
            return (flow.copysign(t), 1.0 / (self.e + slope));
        }
        if regularisation.law == Smoothing::Simple && self.rise.is_none() {
            let gamma = self.simple(size, regularisation.lambda);
            let (_, slope) = self.solid(gamma, regularisation);
            return (gamma.copysign(t), 1.0 / (self.e + slope));
        }
        let mut gamma = flow.max(0.5 * self.creep(size, regularisation)).min(high);
        for _ in 0..200 {
            let (solid, slope) = self.solid(gamma, regularisation);
            let excess = self.e * gamma + solid - size;
            if excess > 0.0 {
                high = gamma
            } else {
                low = gamma
            }
            let step = excess / (self.e + slope);
            let mut next = gamma - step;
            if !(next > low && next < high) {
                next = 0.5 * (low + high);
            }
            let change = (next - gamma).abs();
            gamma = next;
            if change <= 2.0 * f64::EPSILON * gamma {
                break;
            }
        }
        let (_, slope) = self.solid(gamma, regularisation);
        (gamma.copysign(t), 1.0 / (self.e + slope))
    }

    /// The shear rate under a stress that exceeds the yield stress by `excess`: the root of
    /// `(e gamma - excess) (I_0 p + gamma) + (mu_2 - mu_s) p gamma = 0`.
    fn beyond(&self, excess: f64) -> f64 {
        if excess <= 0.0 {
            return 0.0;
        }
        let Some(Rise { p, law }) = self.rise else { return excess / self.e };
        let half = law.i_0 * p;
        let b = self.e * half + (law.mu_2 - law.mu_s) * p - excess;
        let root = (b * b + 4.0 * self.e * half * excess).sqrt();
        if b > 0.0 { 2.0 * half * excess / (b + root) } else { 0.5 * (root - b) / self.e }
    }

    /// The shear rate under the stress `size` by the simple law: the root of `e gamma^2 + (e lambda + y - size) gamma = lambda size`.
    fn simple(&self, size: f64, lambda: f64) -> f64 {
        let b = self.e * lambda + self.y - size;
        let root = (b * b + 4.0 * self.e * lambda * size).sqrt();
        if b > 0.0 { 2.0 * lambda * size / (b + root) } else { 0.5 * (root - b) / self.e }
    }

    /// Creep of the regularised solid under the stress `size`, from the paper's law: gamma = lambda size/(y - size).
    fn creep(&self, size: f64, regularisation: &Regularisation) -> f64 {
        if size < self.y { regularisation.lambda * size / (self.y - size) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_inverse_inverts_for_every_law_and_size() {
        let rise = Some(Rise { p: 0.2, law: MuIv { mu_s: 0.3, mu_2: 0.9, i_0: 7e-3 } });
        for law in [Smoothing::None, Smoothing::Simple, Smoothing::BercovierEngelman, Smoothing::Papanastasiou] {
            for lambda in [1e-1, 1e-4, 1e-8, 1e-12] {
                for (y, rise) in [(0.1, None), (0.1, rise), (0.0, rise), (0.0, None)] {
                    let r = Regularisation { law, lambda };
                    let element = Element { e: 2.5, y, rise };
                    for t in [-0.3, 1e-9, 0.05, 0.099_999, 0.1, 0.100_001, 0.5] {
                        let (gamma, slope) = element.shear_rate(t, &r);
                        if r.is_exact() && t.abs() <= y {
                            assert_eq!((gamma, slope), (0.0, 0.0));
                            continue;
                        }
                        let back = element.e * gamma + element.solid(gamma, &r).0;
                        assert_relative_eq!(back, t, max_relative = 1e-12);
                        let h = 1e-7 * t.abs();
                        if (t.abs() - y).abs() > 1e-3 {
                            let difference =
                                (element.shear_rate(t + h, &r).0 - element.shear_rate(t - h, &r).0) / (2.0 * h);
                            assert_relative_eq!(slope, difference, max_relative = 1e-4);
                        }
                    }
                }
            }
        }
    }
}
