//! Restitution of a linear spring and dashpot, in closed form and inverted, in both conventions.
//!
//! Units w_0 = sqrt(k_n/m) of the pair's reduced mass m; ζ = c/(2 sqrt(m k_n)).
//! Tension kept, contact until the overlap is zero: e = exp(-π ζ/sqrt(1 - ζ²)), t_c = π/sqrt(1 - ζ²).
//! Tension cut, contact until the force is zero (Schwager & Pöschel 2007, doi:10.1007/s10035-007-0065-z):
//! e = exp(-(ζ/w) φ), t_c = φ/w, w = sqrt(1 - ζ²), φ = atan2(2 ζ w, 2 ζ² - 1) = 2 acos(ζ); ζ > 1 by continuation.

use std::f64::consts::PI;

use super::Tension;
use crate::numerics::root;

/// Why no damping gives a restitution coefficient.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RestitutionError {
    /// outside what the law can do
    #[error("no damping gives the restitution coefficient {e_n}: it must be in (0, 1]")]
    OutOfRange {
        /// the coefficient
        e_n: f64,
    },
    /// the root was not found
    #[error("the damping ratio of the restitution coefficient {e_n} was not found")]
    NotFound {
        /// the coefficient
        e_n: f64,
    },
}

/// Restitution coefficient of a damping ratio `zeta` >= 0.
#[must_use]
pub fn coefficient(zeta: f64, tension: Tension) -> f64 {
    logarithm(zeta, tension).exp()
}

/// ln e.
fn logarithm(zeta: f64, tension: Tension) -> f64 {
    match tension {
        Tension::Kept if zeta < 1.0 => -PI * zeta / (1.0 - zeta * zeta).sqrt(),
        Tension::Kept => f64::NEG_INFINITY,
        Tension::Cut => -zeta * duration(zeta, tension),
    }
}

/// Duration of a contact in units of 1/w_0.
#[must_use]
pub fn duration(zeta: f64, tension: Tension) -> f64 {
    match tension {
        Tension::Kept if zeta < 1.0 => PI / (1.0 - zeta * zeta).sqrt(),
        Tension::Kept => f64::INFINITY,
        Tension::Cut => {
            // 2 acos(ζ)/sin(acos(ζ)), and the same with hyperbolic functions: near ζ = 1 both are 2 + (2/3)(1 - ζ) + ...
            let off = 1.0 - zeta;
            if off.abs() < 1e-5 {
                2.0 * (1.0 + off / 3.0 + off * off * 2.0 / 15.0)
            } else if zeta < 1.0 {
                let w = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
                2.0 * w.atan2(zeta) / w
            } else {
                let w = ((zeta - 1.0) * (zeta + 1.0)).sqrt();
                2.0 * (w + zeta).ln() / w
            }
        }
    }
}

/// Damping ratio that gives the restitution coefficient `e_n`: closed form with the tension kept, a root with it cut.
///
/// # Errors
/// [`RestitutionError`] if `e_n` is not in (0, 1], or so small that no number holds the ratio.
pub fn damping_ratio(e_n: f64, tension: Tension) -> Result<f64, RestitutionError> {
    // Also false for NaN.
    let possible = e_n > 0.0 && e_n <= 1.0;
    if !possible {
        return Err(RestitutionError::OutOfRange { e_n });
    }
    let wanted = e_n.ln();
    if tension == Tension::Kept || wanted == 0.0 {
        return Ok(-wanted / PI.hypot(wanted));
    }
    let mut high = 1.0;
    while logarithm(high, tension) > wanted {
        high *= 2.0;
        if high > 1e100 {
            return Err(RestitutionError::NotFound { e_n });
        }
    }
    let excess = |zeta: f64| logarithm(zeta, tension) / wanted - 1.0;
    root::brent(excess, 0.0, high, |_| ()).map_err(|_| RestitutionError::NotFound { e_n })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e, ζ kept, t_c kept, e of that ζ if cut, ζ cut, t_c cut.
    const TABLE: [[f64; 6]; 5] = [
        [0.9, 0.033518, 3.14336, 0.90203, 0.034265, 3.07485],
        [0.8, 0.070850, 3.14951, 0.80810, 0.074355, 3.00105],
        [0.7, 0.112808, 3.16178, 0.71820, 0.122215, 2.91843],
        [0.5, 0.215454, 3.21715, 0.55028, 0.255276, 2.71529],
        [0.3, 0.357857, 3.36440, 0.39714, 0.497239, 2.42131],
    ];

    #[test]
    fn the_table_of_both_conventions() {
        for [e, kept, t_kept, e_if_cut, cut, t_cut] in TABLE {
            approx::assert_relative_eq!(damping_ratio(e, Tension::Kept).unwrap(), kept, max_relative = 2e-5);
            approx::assert_relative_eq!(duration(kept, Tension::Kept), t_kept, max_relative = 2e-5);
            approx::assert_relative_eq!(coefficient(kept, Tension::Cut), e_if_cut, max_relative = 2e-5);
            approx::assert_relative_eq!(damping_ratio(e, Tension::Cut).unwrap(), cut, max_relative = 2e-5);
            approx::assert_relative_eq!(duration(cut, Tension::Cut), t_cut, max_relative = 2e-5);
        }
    }

    #[test]
    fn the_inverse_is_exact_to_1e_12() {
        for tension in [Tension::Cut, Tension::Kept] {
            for step in 1..=1000 {
                let e = f64::from(step) / 1000.0;
                let back = coefficient(damping_ratio(e, tension).unwrap(), tension);
                assert!((back - e).abs() <= 1e-12 * e, "{tension:?} {e}: {back}");
            }
            for e in [1e-6, 1e-3, 0.1249, 0.125, 0.1353352832366127, 0.1354] {
                let back = coefficient(damping_ratio(e, tension).unwrap(), tension);
                assert!((back - e).abs() <= 1e-12 * e, "{tension:?} {e}: {back}");
            }
            for wrong in [0.0, -0.1, 1.0001, f64::NAN] {
                assert!(matches!(damping_ratio(wrong, tension), Err(RestitutionError::OutOfRange { .. })));
            }
        }
        approx::assert_relative_eq!(damping_ratio(0.01, Tension::Cut).unwrap(), 4.81, max_relative = 1e-3);
    }
}
