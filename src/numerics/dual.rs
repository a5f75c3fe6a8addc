//! Forward-mode dual numbers: a value with its derivatives in `N` directions, exact to round-off.
//!
//! A law that is generic over [`Real`] gives its value for `f64` and its Jacobian for [`Dual`], from the same lines.
//! Source: Griewank & Walther (2008), Evaluating Derivatives, chapter 3.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What computes like a real number: `f64`, or one with derivatives.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A number that depends on nothing.
    fn constant(x: f64) -> Self;
    /// The value without its derivatives.
    fn value(self) -> f64;
    /// `f(x)` from the value and the slope of `f` at `x`.
    fn chain(self, value: f64, slope: f64) -> Self;

    /// Square root; at 0 its slope is taken as 0, where one-sided laws start from rest.
    #[must_use]
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }

    /// Real power of a positive number.
    #[must_use]
    fn powf(self, p: f64) -> Self {
        let x = self.value();
        let power = x.powf(p);
        self.chain(power, p * power / x)
    }

    /// Exponential.
    #[must_use]
    fn exp(self) -> Self {
        let e = self.value().exp();
        self.chain(e, e)
    }

    /// Natural logarithm of a positive number.
    #[must_use]
    fn ln(self) -> Self {
        let x = self.value();
        self.chain(x.ln(), 1.0 / x)
    }

    /// Magnitude; its slope at 0 is that of the positive side.
    #[must_use]
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }

    /// The smaller of two.
    #[must_use]
    fn min(self, other: Self) -> Self {
        if other.value() < self.value() { other } else { self }
    }
}

impl Real for f64 {
    fn constant(x: f64) -> Self {
        x
    }

    fn value(self) -> f64 {
        self
    }

    fn chain(self, value: f64, _slope: f64) -> Self {
        value
    }
}

/// A value and its derivatives in `N` directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// the value
    pub value: f64,
    /// its derivatives
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The variable of direction `i`.
    #[must_use]
    pub fn variable(value: f64, i: usize) -> Self {
        let mut slope = [0.0; N];
        if let Some(one) = slope.get_mut(i) {
            *one = 1.0;
        }
        Self { value, slope }
    }

    fn with(self, value: f64, slope: impl Fn(usize) -> f64) -> Self {
        Self { value, slope: std::array::from_fn(slope) }
    }
}

impl<const N: usize> Real for Dual<N> {
    fn constant(value: f64) -> Self {
        Self { value, slope: [0.0; N] }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn chain(self, value: f64, slope: f64) -> Self {
        self.with(value, |i| if self.slope[i] == 0.0 { 0.0 } else { slope * self.slope[i] })
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        self.with(self.value + o.value, |i| self.slope[i] + o.slope[i])
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self.with(self.value - o.value, |i| self.slope[i] - o.slope[i])
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule is a sum")]
impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.with(self.value * o.value, |i| self.slope[i] * o.value + self.value * o.slope[i])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let (inverse, quotient) = (1.0 / o.value, self.value / o.value);
        self.with(quotient, |i| (self.slope[i] - quotient * o.slope[i]) * inverse)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.with(-self.value, |i| -self.slope[i])
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    fn add(self, x: f64) -> Self {
        Self { value: self.value + x, ..self }
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    fn sub(self, x: f64) -> Self {
        Self { value: self.value - x, ..self }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    fn mul(self, x: f64) -> Self {
        self.with(self.value * x, |i| self.slope[i] * x)
    }
}

impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;
    fn div(self, x: f64) -> Self {
        self.with(self.value / x, |i| self.slope[i] / x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn law<T: Real>(x: T, y: T) -> T {
        let root = (x * x + y * 2.0 + 0.5).sqrt();
        (root / (y + x.powf(1.7))).ln().exp() - (-x).abs() * y.exp() / 3.0 + (x - 1.0).min(y)
    }

    #[test]
    fn derivatives_against_differences() {
        let (x, y) = (1.3, 0.7);
        let d = law(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
        assert_eq!(d.value, law(x, y));
        let h = 1e-5;
        assert_relative_eq!(d.slope[0], (law(x + h, y) - law(x - h, y)) / (2.0 * h), max_relative = 1e-8);
        assert_relative_eq!(d.slope[1], (law(x, y + h) - law(x, y - h)) / (2.0 * h), max_relative = 1e-8);
    }

    #[test]
    fn rest_has_no_slope() {
        assert_eq!(Dual::<1>::variable(0.0, 0).sqrt(), Dual::constant(0.0));
        assert_eq!(Dual::<1>::constant(2.0).chain(1.0, f64::INFINITY), Dual::constant(1.0));
    }
}
