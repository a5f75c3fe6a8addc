//! The shared fluid of one dimension: cells, what grains do to the fluid, and its streamwise momentum.
//!
//! [`Grid`] says where the cells are, [`Medium`] what the grains do in them, [`FluidColumn`] solves for the velocity of the
//! fluid. Who fills the medium is not known here: a continuum, a discrete model, or nobody.
//!
//! ```
//! use bedload::column::{Bottom, FluidColumn, Forcing, Grid, Medium, Setup, Top};
//!
//! // A film of water, 1 mm deep, down a slope of 1e-3: u = (g sin(slope)/nu) (H z - z^2/2).
//! let mut column = FluidColumn::new(Grid::uniform(0.0, 1e-3, 200)?, Setup::laminar(1000.0, 1e-3))?;
//! let forcing = Forcing { drive: 9.81, bottom: Bottom::NoSlip, top: Top::FreeSurface };
//! let step = column.step(&Medium::clear(200), &forcing, f64::INFINITY)?;
//! assert!((column.velocity()[199] / 4.905e-3 - 1.0).abs() < 1e-4);
//! assert!((step.balance.bottom - 9.81e-3).abs() < 1e-14);
//! # Ok::<(), bedload::column::ColumnError>(())
//! ```

mod balance;
mod conductance;
mod error;
pub mod fluid;
pub mod grid;
pub mod medium;
mod setup;
#[cfg(test)]
mod tests;

pub use balance::{Balance, Step};
pub use error::ColumnError;
pub use fluid::FluidColumn;
pub use grid::Grid;
pub use medium::Medium;
pub use setup::{Bottom, Forcing, Newton, Setup, Top, ViscousForm};
