//! The nine-node quadrilateral: biquadratic in velocity and shape, with the nine points of Gauss.
//!
//! Source: Zienkiewicz & Taylor (1994), The Finite Element Method, vol. 1, 4th ed., chapters 7 and 8.

use super::mesh::Mesh;

/// One point of an element with what an integral over it needs.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// weight times Jacobian: area that the point stands for
    pub weight: f64,
    /// height
    pub z: f64,
    /// values of the nine shape functions
    pub shape: [f64; 9],
    /// their derivatives along y and z
    pub gradient: [[f64; 9]; 2],
}

/// Abscissae and weights of Gauss on -1..1.
pub(super) const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Values and derivatives of the three quadratic functions at `x` in -1..1.
#[must_use]
pub fn quadratic(x: f64) -> ([f64; 3], [f64; 3]) {
    ([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)], [x - 0.5, -2.0 * x, x + 0.5])
}

/// The nine points of an element, in rows from the lower left.
#[must_use]
pub fn points(mesh: &Mesh, element: usize) -> [Point; 9] {
    let nodes = mesh.element(element).map(|node| mesh.position(node));
    std::array::from_fn(|p| {
        let ((x, wx), (t, wt)) = (GAUSS[p % 3], GAUSS[p / 3]);
        point(&nodes, x, t, wx * wt)
    })
}

/// The point `(x, t)` of the square -1..1 mapped to the element.
fn point(nodes: &[(f64, f64); 9], x: f64, t: f64, weight: f64) -> Point {
    let ((nx, dx), (nt, dt)) = (quadratic(x), quadratic(t));
    let shape = std::array::from_fn(|k| nx[k % 3] * nt[k / 3]);
    let along_x: [f64; 9] = std::array::from_fn(|k| dx[k % 3] * nt[k / 3]);
    let along_t: [f64; 9] = std::array::from_fn(|k| nx[k % 3] * dt[k / 3]);
    let sum = |d: &[f64; 9]| -> (f64, f64) {
        d.iter().zip(nodes).fold((0.0, 0.0), |(y, z), (d, node)| (y + d * node.0, z + d * node.1))
    };
    let ((y_x, z_x), (y_t, z_t), (_, height)) = (sum(&along_x), sum(&along_t), sum(&shape));
    let jacobian = y_x * z_t - y_t * z_x;
    let gradient = [
        std::array::from_fn(|k| (z_t * along_x[k] - z_x * along_t[k]) / jacobian),
        std::array::from_fn(|k| (y_x * along_t[k] - y_t * along_x[k]) / jacobian),
    ];
    Point { weight: weight * jacobian, z: height, shape, gradient }
}
