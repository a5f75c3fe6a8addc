//! Faces and centres of one-dimensional cells.

/// `n + 1` faces from `a` to `b`, the cells shrinking towards `b` until the last one is about `finest` thick (by a hyperbolic
/// sine, which is smooth); equal cells where those are fine enough already.
#[must_use]
pub fn graded(a: f64, b: f64, n: usize, finest: f64) -> Vec<f64> {
    let ratio = (b - a) / (n as f64 * finest);
    if ratio <= 1.0 || !ratio.is_finite() {
        return (0..=n).map(|i| a + (b - a) * i as f64 / n as f64).collect();
    }
    // sinh(beta)/beta = ratio, by fixed-point iteration
    let beta = (0..60).fold(3.0_f64, |beta, _| (ratio * beta).asinh());
    (0..=n).map(|i| b - (b - a) * (beta * (1.0 - i as f64 / n as f64)).sinh() / beta.sinh()).collect()
}

/// Centres of the cells between `faces`.
#[must_use]
pub fn centres(faces: &[f64]) -> Vec<f64> {
    faces.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect()
}

/// The first face, the centres of the cells, the last face.
#[must_use]
pub fn between_walls(faces: &[f64]) -> Vec<f64> {
    let (first, last) = (faces.first().copied(), faces.last().copied());
    first.into_iter().chain(centres(faces)).chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn ends_and_finest_cell() {
        let faces = graded(0.0, 1.0, 50, 1e-3);
        assert_eq!(faces.len(), 51);
        assert_relative_eq!(faces[0], 0.0, epsilon = 1e-15);
        assert_eq!(faces[50], 1.0);
        assert_relative_eq!(faces[50] - faces[49], 1e-3, max_relative = 0.05);
        assert!(faces.windows(3).all(|f| f[1] > f[0] && f[2] - f[1] <= f[1] - f[0]));
        assert_relative_eq!(graded(0.0, 2.0, 4, 1.0)[1], 0.5);
        assert_eq!(centres(&[0.0, 1.0, 3.0]), [0.5, 2.0]);
        assert_eq!(between_walls(&[0.0, 1.0, 3.0]), [0.0, 0.5, 2.0, 3.0]);
    }
}
