//! Grains and fluid as two fluids over the whole depth, from the bed at rest through colliding to saltating grains.
//!
//! Finite volumes on a column. `state` says what the unknowns are, `face` and `cell` what the equations are, `system`
//! assembles them with exact derivatives, `newton` solves them at the end of a step of any length: the steady flow is the
//! step without end. `docs/kinetic.md` derives it.
//! Source: Chassagne, Bonamy & Chauchat (2023), J. Fluid Mech. 964, A27.

pub mod case;
mod cell;
mod equations;
mod error;
mod face;
mod figures;
mod in_time;
mod laws;
mod levels;
mod newton;
mod outcome;
mod problem;
mod profile;
mod rest;
mod stability;
mod start;
mod state;
mod steady;
mod study;
mod system;
#[cfg(test)]
mod tests;
mod transient;
mod waves;

pub use case::{FluidStress, State};
use equations::equations;
pub use error::{TwoFluidError, TwoFluidFault};
use outcome::run;
pub use problem::TwoFluid;
