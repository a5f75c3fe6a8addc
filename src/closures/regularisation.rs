//! How a yield stress is smoothed, and by how much.
//!
//! A regularised material carries `tau_0 R(gamma)` instead of `tau_0 gamma/|gamma|`, with `R -> +-1` for `|gamma| >> lambda`
//! and the viscosity `tau_0/lambda` at rest: below yield it creeps instead of standing still. `lambda` [1/s], or any unit of
//! shear rate as long as it is the unit of `gamma`.
//!
//! | law | R | source |
//! |---|---|---|
//! | `simple` | gamma/(abs(gamma) + lambda) | Frigaard & Nouar (2005); Chauchat & Medale (2010), sec. 2.3 |
//! | `bercovier-engelman` | gamma/sqrt(gamma^2 + lambda^2) | Bercovier & Engelman (1980), J. Comput. Phys. 36, 313-326 |
//! | `papanastasiou` | sign(gamma) (1 - exp(-abs(gamma)/lambda)) | Papanastasiou (1987), J. Rheol. 31, 385-404 |
//! | `none` | the exact yield: rigid below tau_0 | |

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the yield stress is smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Smoothing {
    /// The exact yield: rigid below the yield stress.
    #[default]
    None,
    /// gamma/(|gamma| + lambda): the law of Chauchat and Medale (2010).
    Simple,
    /// gamma/sqrt(gamma^2 + lambda^2).
    BercovierEngelman,
    /// sign(gamma) (1 - exp(-|gamma|/lambda)).
    Papanastasiou,
}

impl Smoothing {
    /// R over the shear rate γ and the size λ, as text; `None` for the exact yield.
    #[must_use]
    pub fn equation(self) -> Option<&'static str> {
        match self {
            Self::None => None,
            Self::Simple => Some("γ/(|γ| + λ)"),
            Self::BercovierEngelman => Some("γ/sqrt(γ² + λ²)"),
            Self::Papanastasiou => Some("sign(γ) (1 - exp(-|γ|/λ))"),
        }
    }
}

/// A law and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularisation {
    /// the law
    pub law: Smoothing,
    /// shear rate below which the material creeps instead of standing still; 0 for the exact yield
    pub lambda: f64,
}

impl Regularisation {
    /// The exact yield.
    pub const EXACT: Self = Self { law: Smoothing::None, lambda: 0.0 };

    /// Whether the material is rigid below yield.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.law == Smoothing::None || self.lambda == 0.0
    }

    /// `m = gamma/R(gamma)` and `dm/dgamma`: the yield stress is carried as `tau_0 gamma/m`. Never 0 for lambda > 0.
    #[must_use]
    pub fn effective(&self, gamma: f64) -> (f64, f64) {
        let (size, lambda) = (gamma.abs(), self.lambda);
        match self.law {
            Smoothing::None => (size, gamma.signum()),
            Smoothing::Simple => (size + lambda, gamma.signum()),
            Smoothing::BercovierEngelman => {
                let m = size.hypot(lambda);
                (m, gamma / m)
            }
            Smoothing::Papanastasiou => {
                let x = size / lambda;
                if x < 1e-4 {
                    // x/(1 - exp(-x)) = 1 + x/2 + x^2/12
                    return (lambda * (1.0 + x / 2.0 + x * x / 12.0), gamma.signum() * (0.5 + x / 6.0));
                }
                let carried = -(-x).exp_m1();
                (size / carried, gamma.signum() * (carried - x * (-x).exp()) / (carried * carried))
            }
        }
    }

    /// `R(gamma)` between -1 and 1; 0 at rest under the exact yield.
    #[must_use]
    pub fn ratio(&self, gamma: f64) -> f64 {
        let (m, _) = self.effective(gamma);
        if m > 0.0 { gamma / m } else { 0.0 }
    }

    /// `dR/dgamma`; 0 under the exact yield.
    #[must_use]
    pub fn slope(&self, gamma: f64) -> f64 {
        if self.is_exact() {
            return 0.0;
        }
        let (m, dm) = self.effective(gamma);
        (m - gamma * dm) / (m * m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAWS: [Smoothing; 3] = [Smoothing::Simple, Smoothing::BercovierEngelman, Smoothing::Papanastasiou];

    #[test]
    fn limits_at_rest_and_far_above_lambda() {
        for law in LAWS {
            let r = Regularisation { law, lambda: 1e-3 };
            assert_eq!(r.ratio(0.0), 0.0);
            assert_relative_eq!(r.slope(0.0), 1e3, max_relative = 1e-12);
            assert_relative_eq!(r.ratio(1e3), 1.0, max_relative = 1e-5);
            assert_relative_eq!(r.ratio(-0.7), -r.ratio(0.7), max_relative = 1e-15);
        }
        assert_eq!(Regularisation::EXACT.ratio(1e-300), 1.0);
        assert_eq!(Regularisation::EXACT.ratio(0.0), 0.0);
    }

    #[test]
    fn values_at_lambda() {
        let at = |law| Regularisation { law, lambda: 2.0 }.ratio(2.0);
        assert_relative_eq!(at(Smoothing::Simple), 0.5);
        assert_relative_eq!(at(Smoothing::BercovierEngelman), 0.5_f64.sqrt());
        assert_relative_eq!(at(Smoothing::Papanastasiou), 1.0 - (-1.0_f64).exp());
    }

    #[test]
    fn papanastasiou_is_smooth_where_its_series_ends() {
        // x/(1 - exp(-x)) and its derivative, without the cancellation of 1 - exp(-x).
        let r = Regularisation { law: Smoothing::Papanastasiou, lambda: 0.3 };
        for x in [1e-6_f64, 5e-5, 0.999e-4, 1.001e-4, 1e-3] {
            for sign in [-1.0, 1.0] {
                let (m, dm) = r.effective(0.3 * sign * x);
                assert_relative_eq!(m, 0.3 * x / -(-x).exp_m1(), max_relative = 1e-14);
                let exact = 0.5 + x / 6.0 - x.powi(3) / 180.0;
                assert_relative_eq!(dm, sign * exact, max_relative = 1e-7);
            }
        }
    }

    #[test]
    fn derivatives_by_differences() {
        for law in LAWS {
            let r = Regularisation { law, lambda: 0.3 };
            for gamma in [-2.0_f64, -1e-3, 1e-3, 0.3, 5.0] {
                let h = 1e-4 * gamma.abs();
                let ratio = (r.ratio(gamma + h) - r.ratio(gamma - h)) / (2.0 * h);
                assert_relative_eq!(r.slope(gamma), ratio, max_relative = 1e-5);
                let m = (r.effective(gamma + h).0 - r.effective(gamma - h).0) / (2.0 * h);
                assert_relative_eq!(r.effective(gamma).1, m, max_relative = 1e-4);
            }
        }
    }
}
