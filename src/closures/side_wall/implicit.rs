//! Friction factors that are given by an equation for themselves: `1/sqrt(f) = a ln(Re sqrt(f)/s) + c`.
//!
//! With `y = 1/sqrt(f)` it reads `y + a ln y = a ln(Re/s) + c`: the left side grows and bends down, so that Newton's method
//! climbs to the only root from any start below it.
//!
//! The formula cannot hold at rest: there it tends to `f Re^2` = constant, a friction as between solids. So it is left where
//! `f Re^2` has become proportional to Re, at `y = a`, and continued in proportion (`f = Re_l/(a^2 Re)` below
//! `Re_l = a s exp(1 - c/a)`, about 5): value and slope of the wall stress are continuous there, and no constant is added.

use super::Friction;

/// The constants of such an equation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Implicit {
    /// factor of the natural logarithm
    pub a: f64,
    /// what Re is divided by
    pub scale: f64,
    /// c
    pub c: f64,
}

/// Newton's method needs 3 or 4 steps; an end, should round-off keep it moving.
const MAX_ITERATIONS: usize = 20;

/// The step after one this small, relative to y, would be below round-off: each squares the error of the last.
const LAST: f64 = 1e-8;

impl Implicit {
    /// The friction at the Reynolds number `re`.
    pub fn friction(&self, re: f64) -> Friction {
        let Self { a, scale, c } = *self;
        let limit = a * scale * (1.0 - c / a).exp();
        if re <= limit {
            return Friction { times_reynolds: limit / (a * a), slope: -1.0 };
        }
        let target = a * (re / scale).ln() + c;
        // Below the root: y = a is its least value, and y = target - a ln(y) > target - a ln(target) where y < target.
        let mut y = if target > 1.0 { f64::max(a, target - a * target.ln()) } else { a };
        for _ in 0..MAX_ITERATIONS {
            let step = (target - y - a * y.ln()) * y / (y + a);
            y += step;
            if step.abs() <= LAST * y {
                break;
            }
        }
        Friction { times_reynolds: re / (y * y), slope: -2.0 * a / (y + a) }
    }
}
