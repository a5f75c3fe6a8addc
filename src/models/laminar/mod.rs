//! Laminar flow of a material with a yield stress between two planes: a Coulomb bed under a viscous fluid, mixed and
//! two-fluid, or a Bingham fluid; regularised, or with the exact yield (rigid below it).
//!
//! Units of the solvers: H, S = (rho_p - rho_f) g H (or any stress), S H/eta; the mesh runs from 0 to 1.

pub mod bed;
pub mod element;
pub mod mesh;
pub(super) mod outcome;
pub mod packing;
mod problem;
pub mod single;
mod slipping;
mod spreading;
mod study;
#[cfg(test)]
mod tests;
pub mod two_fluid;

pub use outcome::{equations, run};
pub use problem::RegularisedBed;
