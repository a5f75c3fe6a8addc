//! Laminar flow of a material with a yield stress between two planes: a Coulomb bed under a viscous fluid, mixed and
//! two-fluid, or a Bingham fluid; regularised, or with the exact yield (rigid below it).
//!
//! Units of the solvers: H, S = (rho_p - rho_f) g H (or any stress), S H/eta; the mesh runs from 0 to 1.

mod bed;
pub(super) mod element;
pub(super) mod mesh;
pub(super) mod outcome;
mod packing;
mod problem;
pub(super) mod single;
mod slipping;
mod spreading;
mod study;
#[cfg(test)]
mod tests;
mod two_fluid;

use outcome::equations;
pub(super) use outcome::run;
pub use problem::RegularisedBed;

/// The solver in its own units: for `benches/laminar.rs` alone.
#[doc(hidden)]
pub mod bench {
    pub use super::bed::{Bed, Nodes};
}
