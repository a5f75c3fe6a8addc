//! Where the grains are: periods and plane walls.

use super::grains::Point;

/// A plane wall; grains are on the side to which its normal points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// unit normal
    pub normal: Point,
    /// distance of the plane from the origin along the normal \[m]
    pub offset: f64,
    /// velocity of its surface [m/s]
    pub velocity: Point,
    /// whether it has the friction of the grains
    pub rough: bool,
}

/// Periods along x and y, and walls. Nothing bounds a direction that has neither.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Domain {
    /// length of the period along x and y \[m]
    pub periods: [Option<f64>; 2],
    /// walls
    pub walls: Vec<Wall>,
}

impl Domain {
    /// Length of each period; 0 where there is none.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        self.periods.map(|p| p.unwrap_or(0.0))
    }

    /// Separation from which on the other image is nearer; infinite where there is no period.
    #[must_use]
    pub fn halves(&self) -> [f64; 2] {
        self.periods.map(|p| p.map_or(f64::INFINITY, |l| 0.5 * l))
    }

    /// b - a, of the nearest images \[m].
    #[must_use]
    pub fn apart(&self, a: Point, b: Point) -> Point {
        let mut d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        for ((x, length), half) in d.iter_mut().zip(self.lengths()).zip(self.halves()) {
            if *x > half {
                *x -= length;
            } else if -half > *x {
                *x += length;
            }
        }
        d
    }
}

impl Wall {
    /// A horizontal or vertical wall at rest, through `point`, with normal `normal`.
    #[must_use]
    pub fn through(point: Point, normal: Point) -> Self {
        let offset = (0..3).map(|k| point[k] * normal[k]).sum();
        Self { normal, offset, velocity: [0.0; 3], rough: true }
    }

    /// Distance of a point from the plane \[m], positive on the side of the grains.
    #[must_use]
    pub fn distance(&self, x: Point) -> f64 {
        x[0] * self.normal[0] + x[1] * self.normal[1] + x[2] * self.normal[2] - self.offset
    }
}
