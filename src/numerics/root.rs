//! Roots of scalar equations.

/// A root that was not found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no root between {low} and {high} after {evaluations} evaluations: residual {residual}")]
pub struct NoRoot {
    /// lower end of the last bracket
    pub low: f64,
    /// upper end of the last bracket
    pub high: f64,
    /// residual of smallest magnitude
    pub residual: f64,
    /// evaluations made
    pub evaluations: usize,
}

/// Evaluations after which [`brent`] gives up; bisection alone would need about 110.
const MAX_EVALUATIONS: usize = 300;

/// The root of `f` between `a` and `b`, to the resolution of `f64`, by Brent's method: bisection made faster by secant
/// and inverse quadratic steps (Brent 1973, Algorithms for Minimization without Derivatives, chapter 4).
/// `see` receives each residual.
///
/// # Errors
/// [`NoRoot`] if `f` has the same sign at both ends, or is not finite.
pub fn brent(mut f: impl FnMut(f64) -> f64, a: f64, b: f64, mut see: impl FnMut(f64)) -> Result<f64, NoRoot> {
    let mut eval = |x: f64| {
        let y = f(x);
        see(y);
        y
    };
    // A root this close to 0 on the scale of the bracket is 0.
    let floor = f64::EPSILON * (a.abs() + b.abs());
    let (mut a, mut b) = (a, b);
    let (mut fa, mut fb) = (eval(a), eval(b));
    let fail =
        |a: f64, b: f64, residual: f64, evaluations| NoRoot { low: a.min(b), high: a.max(b), residual, evaluations };
    if fa == 0.0 {
        return Ok(a);
    }
    if !(fa * fb <= 0.0 && fa.is_finite() && fb.is_finite()) {
        return Err(fail(a, b, if fa.abs() < fb.abs() { fa } else { fb }, 2));
    }
    let (mut c, mut fc) = (a, fa);
    let mut step = b - a;
    let mut before = step;
    for evaluations in 2..MAX_EVALUATIONS {
        if fa.abs() < fb.abs() {
            (a, b, c) = (b, a, b);
            (fa, fb, fc) = (fb, fa, fb);
        }
        let tolerance = f64::EPSILON * b.abs().max(floor);
        let middle = 0.5 * (a - b);
        if fb == 0.0 || middle.abs() <= tolerance {
            return Ok(b);
        }
        if before.abs() < tolerance || fc.abs() <= fb.abs() {
            step = middle;
            before = middle;
        } else {
            let s = fb / fc;
            let (mut p, mut q) = if a == c {
                (2.0 * middle * s, 1.0 - s)
            } else {
                let (q, r) = (fc / fa, fb / fa);
                (s * (2.0 * middle * q * (q - r) - (b - c) * (r - 1.0)), (q - 1.0) * (r - 1.0) * (s - 1.0))
            };
            if p > 0.0 {
                q = -q
            } else {
                p = -p
            }
            if 2.0 * p < (3.0 * middle * q - (tolerance * q).abs()).min((before * q).abs()) {
                before = step;
                step = p / q;
            } else {
                step = middle;
                before = middle;
            }
        }
        (c, fc) = (b, fb);
        b += if step.abs() > tolerance { step } else { tolerance.copysign(middle) };
        fb = eval(b);
        if !fb.is_finite() {
            return Err(fail(a, b, fb, evaluations + 1));
        }
        if fa * fb > 0.0 {
            (a, fa) = (c, fc);
            step = b - a;
            before = step;
        }
    }
    Err(fail(a, b, fb, MAX_EVALUATIONS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn known_roots() {
        let find = |f: fn(f64) -> f64, a, b| brent(f, a, b, |_| {}).unwrap();
        assert_relative_eq!(find(|x| x.cos() - x, 0.0, 1.0), 0.739_085_133_215_160_6, max_relative = 1e-15);
        assert_relative_eq!(
            find(|x| 5.0 * x.powi(3) - 21.0 * x + 10.0, 0.0, 1.0),
            0.507_269_464_3,
            max_relative = 1e-9
        );
        assert_relative_eq!(find(|x| x.powi(3), -1.0, 1.5), 0.0, epsilon = 1e-15);
        assert_eq!(find(|x| x - 3.0, 3.0, 5.0), 3.0);
        assert_eq!(find(|x| x - 5.0, 3.0, 5.0), 5.0);
    }

    #[test]
    fn few_evaluations_and_a_history() {
        let mut history = Vec::new();
        brent(|x| x.exp() - 2.0, 0.0, 10.0, |r| history.push(r)).unwrap();
        assert!(history.len() < 20, "{}", history.len());
        assert!(history.last().unwrap().abs() < 1e-14);
    }

    #[test]
    fn no_sign_change_and_nan_are_errors() {
        assert!(brent(|x| x * x + 1.0, -1.0, 1.0, |_| {}).is_err());
        assert!(brent(|x| if x > 0.4 && x < 0.6 { f64::NAN } else { x - 0.5 }, 0.0, 1.0, |_| {}).is_err());
    }
}
