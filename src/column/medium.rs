//! What the grains do to the fluid: the one contact surface of the two.
//!
//! A continuum fills it from its own solid phase, a discrete model from its averages; the fluid cannot tell which.

use super::{ColumnError, Grid};

/// The grains as the fluid meets them: one value per cell in each array.
///
/// The force of the grains on the fluid is `beta (u_p - u_f) + force` per volume of the whole, pores and grains together
/// [N/m3]; besides it, form [`super::ViscousForm::Mixture`] of the viscous stress hands a share to the grains.
///
/// The papers' coefficients in these terms: Maurin et al. (2015), eq. (18): `beta` as it is. Revil-Baudard & Chauchat (2013),
/// eq. (11), whose drag `C_D (U - u_p)` takes the mixture velocity: `beta = (1 - phi) C_D`. The kinetic model:
/// `beta = phi (1 - phi) K`. Chauchat & Medale (2010), eq. (6): `beta = eta (1 - phi)^2/K`.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// solid fraction, from 0 to below 1
    pub phi: Vec<f64>,
    /// velocity of the grains u_p [m/s]
    pub velocity: Vec<f64>,
    /// drag coefficient [kg/(m3 s)], not negative: a drag of the other sign belongs in `force`, where it cannot make the
    /// implicit step unstable
    pub beta: Vec<f64>,
    /// any other force on the fluid [N/m3], taken as it is: for example the momentum that the grains gave or took since the
    /// last step and that the drag does not count
    pub force: Vec<f64>,
}

impl Medium {
    /// No grains in any of the `cells`.
    #[must_use]
    pub fn clear(cells: usize) -> Self {
        let zero = vec![0.0; cells];
        Self { phi: zero.clone(), velocity: zero.clone(), beta: zero.clone(), force: zero }
    }

    /// Whether it fits the grid and holds numbers that can be.
    ///
    /// # Errors
    /// [`ColumnError`]: the first array of a wrong length, or the first value that is not finite or out of range.
    pub fn check(&self, grid: &Grid) -> Result<(), ColumnError> {
        let any = (f64::NEG_INFINITY, "a finite number");
        check_cells(grid, "phi", &self.phi, (0.0, "at least 0 and less than 1"))?;
        check_cells(grid, "u_p [m/s]", &self.velocity, any)?;
        check_cells(grid, "beta [kg/(m3 s)]", &self.beta, (0.0, "finite and at least 0"))?;
        check_cells(grid, "force [N/m3]", &self.force, any)?;
        match grid.centres().iter().zip(&self.phi).find(|(_, phi)| **phi >= 1.0) {
            Some((&z, &value)) => {
                Err(ColumnError::Cell { what: "phi", z, value, allowed: "at least 0 and less than 1" })
            }
            None => Ok(()),
        }
    }
}

/// Whether `values` has one finite value per cell, none below `min`.
pub(super) fn check_cells(
    grid: &Grid,
    what: &'static str,
    values: &[f64],
    (min, allowed): (f64, &'static str),
) -> Result<(), ColumnError> {
    if values.len() != grid.cells() {
        return Err(ColumnError::Length { what, found: values.len(), cells: grid.cells() });
    }
    match grid.centres().iter().zip(values).find(|(_, v)| !(v.is_finite() && **v >= min)) {
        Some((&z, &value)) => Err(ColumnError::Cell { what, z, value, allowed }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_is_said() {
        let grid = Grid::uniform(0.0, 3.0, 3).unwrap();
        assert_eq!(Medium::clear(3).check(&grid), Ok(()));
        assert_eq!(Medium::clear(2).check(&grid), Err(ColumnError::Length { what: "phi", found: 2, cells: 3 }));
        let faults: [fn(&mut Medium); 5] = [
            |m| m.phi[1] = 1.0,
            |m| m.phi[1] = -1e-3,
            |m| m.velocity[1] = f64::NAN,
            |m| m.beta[1] = -1.0,
            |m| m.force[1] = f64::INFINITY,
        ];
        for fault in faults {
            let mut medium = Medium::clear(3);
            fault(&mut medium);
            assert!(matches!(medium.check(&grid), Err(ColumnError::Cell { z: 1.5, .. })), "{medium:?}");
        }
    }
}
