//! The grains: where they are and how they move, in the order of the list.

use std::f64::consts::PI;

use super::simd::Row;

/// A point or vector in space: x along the flow, y across, z normal to the bed.
pub type Point = [f64; 3];

/// One sphere, as a scene describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// position of the centre \[m]
    pub position: Point,
    /// velocity [m/s]
    pub velocity: Point,
    /// angular velocity [1/s]
    pub spin: Point,
    /// radius \[m]
    pub radius: f64,
    /// density [kg/m3]
    pub density: f64,
    /// whether it keeps its velocity whatever acts on it
    pub fixed: bool,
}

impl Grain {
    /// A grain at rest.
    #[must_use]
    pub fn at_rest(position: Point, radius: f64, density: f64) -> Self {
        Self { position, velocity: [0.0; 3], spin: [0.0; 3], radius, density, fixed: false }
    }

    /// Mass \[kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius * self.radius * self.radius * self.density
    }
}

/// Rows behind the grains: the two of a pair that never touches, and the one that touches no wall.
pub const PADDING: usize = 3;

/// All grains, one row of each kind a grain, sorted by cell at each rebuild of the list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grains {
    /// x, y, z, radius \[m]
    pub positions: Vec<Row>,
    /// velocity [m/s] and mass \[kg]
    pub velocities: Vec<Row>,
    /// radius times angular velocity [m/s] and inverse mass [1/kg], 0 for a fixed grain
    pub spins: Vec<Row>,
    /// place of each grain in the order of the scene: its name for life
    pub ids: Vec<u32>,
}

impl Grains {
    /// The grains of a scene, in its order.
    #[must_use]
    pub fn new(grains: &[Grain]) -> Self {
        let mut all = Self::default();
        for (id, grain) in grains.iter().enumerate() {
            let ([x, y, z], [u, v, w], r) = (grain.position, grain.velocity, grain.radius);
            let mass = grain.mass();
            all.positions.push(Row([x, y, z, r]));
            all.velocities.push(Row([u, v, w, mass]));
            let inverse = if grain.fixed { 0.0 } else { 1.0 / mass };
            all.spins.push(Row([r * grain.spin[0], r * grain.spin[1], r * grain.spin[2], inverse]));
            all.ids.push(id as u32);
        }
        all.pad();
        all
    }

    /// Appends the rows behind the grains.
    pub(super) fn pad(&mut self) {
        let count = self.len();
        for rows in [&mut self.positions, &mut self.velocities, &mut self.spins] {
            rows.truncate(count);
            rows.resize(count + PADDING, Row::default());
        }
        self.positions[count + 1] = Row([0.0, 0.0, FAR, 0.0]);
        self.positions[count + 2] = Row([0.0, 0.0, 0.0, -FAR]);
        for k in 0..PADDING {
            self.spins[count + k].0[3] = 1.0;
        }
    }

    /// Number of grains.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Centre of grain `i` \[m].
    #[must_use]
    pub fn position(&self, i: usize) -> Point {
        let [x, y, z, _] = self.positions[i].0;
        [x, y, z]
    }

    /// Velocity of grain `i` [m/s].
    #[must_use]
    pub fn velocity(&self, i: usize) -> Point {
        let [u, v, w, _] = self.velocities[i].0;
        [u, v, w]
    }

    /// Angular velocity of grain `i` [1/s].
    #[must_use]
    pub fn spin(&self, i: usize) -> Point {
        let ([x, y, z, _], r) = (self.spins[i].0, self.radius(i));
        [x / r, y / r, z / r]
    }

    /// Radius of grain `i` \[m].
    #[must_use]
    pub fn radius(&self, i: usize) -> f64 {
        self.positions[i].0[3]
    }

    /// Mass of grain `i` \[kg].
    #[must_use]
    pub fn mass(&self, i: usize) -> f64 {
        self.velocities[i].0[3]
    }

    /// Whether grain `i` is fixed.
    #[must_use]
    pub fn is_fixed(&self, i: usize) -> bool {
        self.spins[i].0[3] == 0.0
    }

    /// Largest radius \[m].
    #[must_use]
    pub fn largest_radius(&self) -> f64 {
        (0..self.len()).fold(0.0, |r, i| self.radius(i).max(r))
    }

    /// Least and largest inverse mass of the mobile grains [1/kg], if there are any.
    #[must_use]
    pub fn inverse_masses(&self) -> Option<[f64; 2]> {
        let mobile = (0..self.len()).map(|i| self.spins[i].0[3]).filter(|&inverse| inverse > 0.0);
        mobile.fold(None, |ends, x| Some(ends.map_or([x, x], |[low, high]: [f64; 2]| [low.min(x), high.max(x)])))
    }

    /// Place of each grain of the scene in the present order.
    #[must_use]
    pub fn places(&self) -> Vec<usize> {
        let mut places = vec![0; self.len()];
        for (place, &id) in self.ids.iter().enumerate() {
            places[id as usize] = place;
        }
        places
    }

    /// The grains as a scene describes them, in its order.
    #[must_use]
    pub fn listed(&self) -> Vec<Grain> {
        let one = |i: usize| Grain {
            position: self.position(i),
            velocity: self.velocity(i),
            spin: self.spin(i),
            radius: self.radius(i),
            density: self.mass(i) / (4.0 / 3.0 * PI * self.radius(i).powi(3)),
            fixed: self.is_fixed(i),
        };
        self.places().into_iter().map(one).collect()
    }

    /// Kinetic energy of the mobile grains, translation and rotation \[J].
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        (0..self.len()).filter(|&i| !self.is_fixed(i)).map(|i| self.kinetic_energy_of(i)).sum()
    }

    /// Kinetic energy of grain `i` \[J].
    #[must_use]
    pub fn kinetic_energy_of(&self, i: usize) -> f64 {
        let squared = |r: &Row| r.0[0] * r.0[0] + r.0[1] * r.0[1] + r.0[2] * r.0[2];
        0.5 * self.mass(i) * (squared(&self.velocities[i]) + 0.4 * squared(&self.spins[i]))
    }

    /// Momentum of the mobile grains [kg m/s].
    #[must_use]
    pub fn momentum(&self) -> Point {
        let mut sum = [0.0; 3];
        for i in (0..self.len()).filter(|&i| !self.is_fixed(i)) {
            for (s, v) in sum.iter_mut().zip(self.velocity(i)) {
                *s += self.mass(i) * v;
            }
        }
        sum
    }
}

/// Farther than any grain, and still with a square.
const FAR: f64 = 1e100;
