//! Where the nodes go: in the bed by solid volume below the interface, above it by height.

/// Shares of the cells of the moving grains that go by the logarithm of the depth, by the depth, and by the root of the
/// distance to the yield level.
const MOVING: [f64; 3] = [0.5, 0.3, 0.2];
/// The same above the interface, up to the level without stress.
const ABOVE: [f64; 3] = [0.8, 0.0, 0.2];
/// Share of the cells of a bed that creeps that lie below the yield level.
const BELOW: f64 = 0.25;

/// Shares of a length: `nodes` from 0 to 1, and the middles of the cells between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// ascending from 0 to 1
    pub nodes: Vec<f64>,
    /// one per cell
    pub middles: Vec<f64>,
}

impl Mesh {
    /// Cells from 0 to 1: the given shares of them by the logarithm of the distance to 0 beyond `top`, evenly, and by the root
    /// of the distance to 1, which makes powers of that root smooth.
    fn graded(cells: usize, top: f64, [log, even, root]: [f64; 3]) -> Vec<f64> {
        let whole = (1.0 / top).ln_1p();
        // The number of cells beyond x = 1 - y^2, as a share, and its slope by y.
        let beyond = |y: f64| {
            let x = 1.0 - y * y;
            let count = log * (1.0 - (x / top).ln_1p() / whole) + even * y * y + root * y;
            (count, 2.0 * y * (log / (whole * (top + x)) + even) + root)
        };
        let mut y = 1.0;
        let mut at = |share: f64| {
            let (mut low, mut high) = (0.0, y);
            // Newton's method between bounds, from the place before.
            for _ in 0..60 {
                let (count, slope) = beyond(y);
                let miss = count - (1.0 - share);
                if miss > 0.0 {
                    high = y
                } else {
                    low = y
                }
                let next = y - miss / slope;
                let next = if next > low && next < high { next } else { 0.5 * (low + high) };
                let converged = (next - y).abs() <= 4.0 * f64::EPSILON;
                y = next;
                if converged {
                    break;
                }
            }
            1.0 - y * y
        };
        let inner = (1..cells).map(|c| at(c as f64 / cells as f64));
        std::iter::once(0.0).chain(inner).chain([1.0]).collect()
    }

    /// The pressure of a cell of the bed is that at half of its volume, the stress above it that at half of its height.
    fn halved(nodes: Vec<f64>) -> Self {
        let middles = nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
        Self { nodes, middles }
    }

    /// The moving grains, from the interface down to the yield level at 1: fine at the interface, where the pressure vanishes
    /// (`top` is the scale there, as a share), and at the yield level, where the solid fraction goes like the root of the
    /// distance.
    #[must_use]
    pub fn moving(cells: usize, top: f64) -> Self {
        Self::halved(Self::graded(cells, top, MOVING))
    }

    /// The whole bed, whose yield level is at the share `mobile`: above it as [`Mesh::moving`].
    #[must_use]
    pub fn bed(cells: usize, top: f64, mobile: f64) -> Self {
        let below = ((BELOW * cells as f64) as usize).max(2);
        let moving = Self::graded(cells - below, top / mobile, MOVING);
        let deeper = (1..=below).map(|j| {
            let share = j as f64 / below as f64;
            mobile + (1.0 - mobile) * share * share
        });
        let mut nodes: Vec<f64> = moving.iter().map(|x| x * mobile).chain(deeper).collect();
        nodes[cells] = 1.0;
        Self::halved(nodes)
    }

    /// The suspension, from the interface up to where the stress vanishes: by the logarithm of the distance beyond `bottom`,
    /// and by the root of the distance to the top, in which the decay of the suspension is smooth.
    #[must_use]
    pub fn suspension(cells: usize, bottom: f64) -> Self {
        Self::halved(Self::graded(cells, bottom, ABOVE))
    }

    /// Under a lid: by the root of the distance to the level without stress.
    #[must_use]
    pub fn under_lid(cells: usize) -> Self {
        Self::halved((0..=cells).map(|j| (j as f64 / cells as f64).powi(2)).collect())
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
        let corner = bed.nodes.iter().position(|&x| x == 0.25).unwrap();
        assert!(bed.size(0) < 0.05 * bed.size(199) && bed.size(corner) < 0.05 * bed.size(199));
        // Finer at the yield level as the square of the cell count.
        let at_yield = |cells: usize| 1.0 - Mesh::moving(cells, 4e-3).nodes[cells - 1];
        assert!((at_yield(300) / at_yield(150) - 0.25).abs() < 0.02);
        let moving = Mesh::moving(150, 4e-3);
        assert!(moving.nodes.iter().zip(&bed.nodes).all(|(a, b)| (0.25 * a - b).abs() < 1e-13));
        let top = Mesh::suspension(100, 0.02);
        assert!(top.size(0) < 2e-3 && top.size(99) < 3e-3, "{} {}", top.size(0), top.size(99));
        assert!(top.middles.iter().zip(top.nodes.windows(2)).all(|(m, pair)| pair[0] < *m && *m < pair[1]));
        assert!(Mesh::under_lid(10).size(0) < Mesh::under_lid(10).size(9));
    }
}
