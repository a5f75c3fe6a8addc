//! Integrals.

/// Composite Simpson rule on `n` intervals between `a` and `b`: exact for cubics, order 4.
#[must_use]
pub fn simpson(f: impl Fn(f64) -> f64, a: f64, b: f64, n: usize) -> f64 {
    let n = n.max(1);
    let h = (b - a) / n as f64;
    let piece = |i: usize| {
        let x = a + h * i as f64;
        f(x) + 4.0 * f(x + 0.5 * h) + f(x + h)
    };
    h / 6.0 * (0..n).map(piece).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn cubics_are_exact_and_the_order_is_four() {
        assert_relative_eq!(simpson(|x| x * x * x, 0.0, 2.0, 1), 4.0, max_relative = 1e-15);
        let error = |n| (simpson(f64::sin, 0.0, 1.0, n) - (1.0 - 1f64.cos())).abs();
        assert_relative_eq!((error(4) / error(8)).log2(), 4.0, epsilon = 0.05);
    }
}
