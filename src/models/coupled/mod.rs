//! Grains in a fluid: Maurin et al. (2015). The grains are those of [`crate::dem`], the fluid that of [`crate::column`].
//!
//! ```text
//!  grains ─► exchange.average ( φ, drag, what was given) ─► exchange.advance (column) ─► fluid_at_grains ─► grains
//!                                                     record (samples, blocks) ─► outcome
//! ```

mod advice;
pub mod case;
mod direction;
mod equations;
mod error;
mod exchange;
mod figures;
mod fluid_at_grains;
mod freeze;
mod limits;
mod outcome;
mod problem;
mod record;
mod run;
mod start;
mod study;
#[cfg(test)]
mod tests;
mod theory;

pub use case::FluidScheme;
use equations::equations;
pub use error::CoupledError;
pub use problem::{Coupled, Freeze, Relief, Surface};
use run::run;
