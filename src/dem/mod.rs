//! Grains one by one: translation and rotation of spheres with contacts that remember.
//!
//! ```text
//!  grains ─► cells ─► neighbours (tiles) ─► forces (simd, law) ─► integrate ─► ledger
//!                                             walls                            contacts ─► stresses, limits
//! ```
//!
//! One binary gives the same bits for any number of threads and any width of vectors; see docs/grains.md.

pub(crate) mod animation;
pub(crate) mod average;
pub mod body;
pub(crate) mod budget;
pub(crate) mod cells;
pub(crate) mod certainty;
pub(crate) mod checkpoint;
pub(crate) mod contacts;
pub(crate) mod deposit;
pub(crate) mod domain;
pub(crate) mod drive;
pub(crate) mod engine;
pub(crate) mod error;
pub(crate) mod forces;
pub(crate) mod grains;
pub(crate) mod guards;
pub(crate) mod integrate;
pub(crate) mod keep;

pub mod law;
pub(crate) mod ledger;
pub(crate) mod neighbours;
pub(crate) mod outcome;
pub(crate) mod pack;
pub(crate) mod readings;
pub(crate) mod setup;
pub(crate) mod simd;
pub(crate) mod stability;
pub(crate) mod tile;
pub(crate) mod view;
pub(crate) mod walls;

pub use domain::{Domain, Wall};
pub use engine::{Engine, Settings};
pub use error::{GrainError, RunError};
pub use grains::{Grain, Grains, Point};
pub use law::{ContactLaw, LinearSpring};
pub use setup::{Bottom, Discrete, GrainBed};

#[cfg(test)]
mod tests;
