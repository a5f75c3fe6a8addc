//! Threshold of motion of single grains on a flat bed: Soulsby's curve through measured Shields numbers.
//!
//! `theta_c = 0.30/(1 + 1.2 D*) + 0.055 (1 - exp(-0.020 D*))`, `D* = d ((rho_p/rho_f - 1) g/nu^2)^(1/3)`.
//!
//! Source: Soulsby (1997), Dynamics of Marine Sands, eq. (77).

/// Threshold Shields numbers that are measured, over the curve: a standard deviation of 0.23 decades to either side, which is that of
/// the reference thresholds on slopes below 0.02.
pub const RANGE: (f64, f64) = (0.589, 1.698);

/// Shields number at which grains of the dimensionless diameter `size`, D*, begin to move.
#[must_use]
pub fn soulsby(size: f64) -> f64 {
    0.30 / (1.0 + 1.2 * size) + 0.055 * (1.0 - (-0.020 * size).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_the_curve() {
        // By hand: 0.3/(1 + 1.2) + 0.055 (1 - exp(-0.02)); coarse grains tend to 0.055; the least is near 0.03.
        assert!((soulsby(1.0) - 0.137_453).abs() < 1e-6, "{}", soulsby(1.0));
        assert!((soulsby(1e4) - 0.055).abs() < 1e-4);
        let least = (1..100).map(|size| soulsby(f64::from(size))).fold(1.0, f64::min);
        assert!((0.028..0.032).contains(&least), "{least}");
        // 0.23 decades.
        assert!((RANGE.0.log10() + 0.23).abs() < 1e-3 && (RANGE.1.log10() - 0.23).abs() < 1e-3);
    }
}
