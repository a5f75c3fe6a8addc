//! Where the nodes go: in the bed by solid volume below the interface, above it by height.

/// Width of the region of small cells around the yield level, as a share of its depth.
const CORNER: f64 = 0.05;

/// Shares of a length: `nodes` from 0 to 1, and the middles of the cells between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// ascending from 0 to 1
    pub nodes: Vec<f64>,
    /// one per cell
    pub middles: Vec<f64>,
}

impl Mesh {
    /// `cells` cells whose number up to `x` follows the increasing function `count`; the middles are those of the count.
    fn by_count(cells: usize, count: impl Fn(f64) -> f64) -> Self {
        let (low, high) = (count(0.0), count(1.0));
        let at = |share: f64| {
            let wanted = low + (high - low) * share;
            let (mut a, mut b) = (0.0, 1.0);
            // Bisection in the logarithm near 0, where the cells are small.
            while b - a > f64::EPSILON * b {
                let middle = if a > 0.0 && b > 4.0 * a { (a * b).sqrt() } else { 0.5 * (a + b) };
                if middle <= a || middle >= b {
                    break;
                }
                if count(middle) < wanted { a = middle } else { b = middle }
            }
            0.5 * (a + b)
        };
        let n = cells as f64;
        let mut nodes: Vec<f64> = (0..=cells).map(|j| at(j as f64 / n)).collect();
        nodes[0] = 0.0;
        nodes[cells] = 1.0;
        Self { nodes, middles: (0..cells).map(|c| at((c as f64 + 0.5) / n)).collect() }
    }

    /// The bed, from the interface down to 1: fine at the interface, where the pressure vanishes (`top` is the scale there, as
    /// a share), and around the yield level, at the share `mobile`, where the solid fraction has a corner; sparse below.
    #[must_use]
    pub fn bed(cells: usize, top: f64, mobile: f64) -> Self {
        let log = |x: f64| (1.0 + x * mobile / top).ln() / (1.0 + mobile / top).ln();
        let even = |x: f64| x.atan() / 1f64.atan();
        let corner = |x: f64| ((x - 1.0) / CORNER).asinh() / (2.0 * (1.0 / CORNER).asinh());
        let mut mesh = Self::by_count(cells, |x| {
            let y = x / mobile;
            0.38 * log(y) + 0.32 * even(y) + 0.22 * corner(y) + 0.08 * x
        });
        // The pressure of a cell is that at half of its volume.
        mesh.middles = mesh.nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
        mesh
    }

    /// The suspension, from the interface up to where the stress vanishes: by the logarithm of the distance beyond `bottom`,
    /// and by the root of the distance to the top, in which the decay of the suspension is smooth.
    #[must_use]
    pub fn suspension(cells: usize, bottom: f64) -> Self {
        let log = move |x: f64| (1.0 + x / bottom).ln() / (1.0 + 1.0 / bottom).ln();
        Self::by_count(cells, |x| 0.6 * log(x) + 0.4 * (1.0 - (1.0 - x).sqrt()))
    }

    /// Under a lid: by the root of the distance to the level without stress.
    #[must_use]
    pub fn under_lid(cells: usize) -> Self {
        Self::by_count(cells, f64::sqrt)
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.middles.len()
    }

    /// Size of cell `c`.
    #[must_use]
    pub fn size(&self, c: usize) -> f64 {
        self.nodes[c + 1] - self.nodes[c]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_small_where_they_must_be() {
        let bed = Mesh::bed(200, 1e-3, 0.25);
        assert_eq!((bed.nodes.len(), bed.nodes[0], bed.nodes[200]), (201, 0.0, 1.0));
        assert!(bed.nodes.windows(2).all(|pair| pair[1] > pair[0]));
        let corner = bed.nodes.partition_point(|&x| x < 0.25);
        assert!(bed.size(0) < 0.05 * bed.size(199) && bed.size(corner) < 0.2 * bed.size(199));
        let top = Mesh::suspension(100, 0.02);
        assert!(top.size(0) < 2e-3 && top.size(99) < 1e-3, "{} {}", top.size(0), top.size(99));
        assert!(top.middles.iter().zip(top.nodes.windows(2)).all(|(m, pair)| pair[0] < *m && *m < pair[1]));
        assert!(Mesh::under_lid(10).size(0) < Mesh::under_lid(10).size(9));
    }
}
