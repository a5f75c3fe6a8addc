//! What a step says of itself: how it converged, and where the momentum went.

/// What a step did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// linear systems solved
    pub iterations: usize,
    /// largest residual of a cell over the largest force in the column
    pub residual: f64,
    /// momentum of the fluid
    pub balance: Balance,
}

/// Momentum of the fluid over the whole column, per area of the bed \[Pa]. Each entry is summed from the terms of the cells, at
/// the velocity after the step:
/// `inertia = top - bottom - grains_share + drive + drag + force - side_walls + error`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// viscous and turbulent stress at the top
    pub top: f64,
    /// viscous and turbulent stress at the bottom
    pub bottom: f64,
    /// part of the viscous force that the grains take, `phi d(tau)/dz`; only in the mixture form
    pub grains_share: f64,
    /// driving force on the fluid
    pub drive: f64,
    /// drag of the grains on the fluid
    pub drag: f64,
    /// other forces on the fluid, from the medium
    pub force: f64,
    /// friction of the side walls
    pub side_walls: f64,
    /// gain of momentum over the time step; 0 in a steady solve
    pub inertia: f64,
}

impl Balance {
    /// What does not add up \[Pa].
    #[must_use]
    pub fn error(&self) -> f64 {
        let gained = self.top - self.bottom - self.grains_share + self.drive + self.drag + self.force;
        self.inertia - (gained - self.side_walls)
    }

    /// What does not add up, relative to the largest entry; 0 if all are.
    #[must_use]
    pub fn relative(&self) -> f64 {
        let entries = [
            self.top,
            self.bottom,
            self.grains_share,
            self.drive,
            self.drag,
            self.force,
            self.side_walls,
            self.inertia,
        ];
        let largest = entries.into_iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        if largest > 0.0 { self.error() / largest } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn signs() {
        let closed = Balance {
            top: 1.0,
            bottom: 2.0,
            grains_share: 4.0,
            drive: 8.0,
            drag: 16.0,
            force: 32.0,
            side_walls: 64.0,
            inertia: -13.0,
        };
        assert_eq!(closed.error(), 0.0);
        assert_relative_eq!(Balance { drive: 8.64, ..closed }.relative(), -0.01, max_relative = 1e-14);
        assert_eq!(Balance::default().relative(), 0.0);
    }
}
