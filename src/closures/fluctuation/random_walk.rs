//! Discrete random walk: `u_z' = lambda_1`, `u_x' = -lambda_1 + lambda_2`, lambda normal with `sigma = sqrt(R_xz/(rho_f eps))`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `u'` | fluctuation of the fluid velocity that one grain meets | m/s |
//! | `R_xz` | Reynolds stress at its centre, per total area | Pa |
//! | `eps` | porosity there | 1 |
//!
//! Then `<u_x' u_z'> = -sigma^2` is the Reynolds stress of the mean flow, and `<u_x'^2> = 2 sigma^2`, `<u_z'^2> = sigma^2`.
//! Drawn anew for all grains at once every `tau_t = w_d/U`, the turnover time of eddies of the water depth `w_d` \[m] at the mean
//! velocity `U` [m/s]. Options for comparison: a third number across the flow, and `sigma` without the porosity.
//! Source: Maurin et al. (2015), eq. (15)-(16), after Zannetti (1986).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Eddies;
use crate::closures::{Info, Standing};
use crate::runtime::rng::Stream;

/// Catalogue entry.
pub static INFO: Info = Info {
    family: "fluctuation",
    law: "random-walk",
    equation: "u_z' = λ₁,  u_x' = -λ₁ + λ₂,  λ normal, σ² = R_xz/(ρ_f ε),  drawn anew for each grain every w_d/U",
    source: "Maurin et al. (2015), eq. (15)-(16)",
    ranges: &[],
    standing: Standing::Validated,
};

/// A random velocity for each grain, drawn anew at every turn of the largest eddies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RandomWalk {
    /// Whether there is a fluctuation across the flow, too.
    #[serde(default)]
    pub spanwise: bool,
    /// Whether the variance is that of the fluid between the grains: R_xz over the porosity.
    #[serde(default = "yes")]
    pub per_porosity: bool,
}

fn yes() -> bool {
    true
}

impl Eddies for RandomWalk {
    fn are_drawn(&self) -> bool {
        true
    }

    fn deviation(&self, reynolds: f64, eps: f64, rho_f: f64) -> f64 {
        let share = if self.per_porosity { eps } else { 1.0 };
        (reynolds.max(0.0) / (rho_f * share)).sqrt()
    }

    fn draw(&self, stream: &mut Stream, sigma: f64) -> [f64; 3] {
        let [first, second] = stream.normal_pair();
        let across = if self.spanwise { stream.normal_pair()[0] } else { 0.0 };
        [sigma * (second - first), sigma * across, sigma * first]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_covariance_is_the_reynolds_stress() {
        let law = RandomWalk { spanwise: true, per_porosity: true };
        let sigma = law.deviation(2.0, 0.5, 1000.0);
        assert!((sigma * sigma - 4e-3).abs() < 1e-15);
        let plain = RandomWalk { per_porosity: false, ..law }.deviation(2.0, 0.5, 1000.0);
        assert!((plain * plain - 2e-3).abs() < 1e-15);
        assert_eq!(law.deviation(-1.0, 0.5, 1000.0), 0.0);
        let n = 200_000;
        let mut sums = [0.0; 6];
        for i in 0..n {
            let [x, y, z] = law.draw(&mut Stream::new([7, 1, i]), sigma);
            for (sum, term) in sums.iter_mut().zip([x, z, x * z, x * x, z * z, y * y]) {
                *sum += term / (n as f64 * sigma * sigma);
            }
        }
        let [x, z, xz, xx, zz, yy] = sums;
        // Four standard errors.
        assert!(x.abs() * sigma < 4.0 * (2.0 / n as f64).sqrt() && z.abs() * sigma < 4.0 / (n as f64).sqrt());
        assert!((xz + 1.0).abs() < 0.02 && (xx - 2.0).abs() < 0.03 && (zz - 1.0).abs() < 0.015, "{xz} {xx} {zz}");
        assert!((yy - 1.0).abs() < 0.015, "{yy}");
        let flat = RandomWalk { spanwise: false, ..law }.draw(&mut Stream::new([1, 2, 3]), 1.0);
        assert_eq!(flat[1], 0.0);
    }
}
