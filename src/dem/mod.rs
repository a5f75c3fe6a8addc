//! Grains one by one: translation and rotation of spheres with contacts that remember.
//!
//! ```text
//!  grains ─► cells ─► neighbours (tiles) ─► forces (lanes, law) ─► integrate ─► ledger
//!                                             walls                            contacts ─► stresses, limits
//! ```
//!
//! One binary gives the same bits for any number of threads and any width of vectors; see docs/grains.md.

pub mod average;
pub mod body;
pub mod budget;
pub mod cells;
pub mod certainty;
pub mod checkpoint;
pub mod contacts;
pub mod deposit;
pub mod domain;
pub mod drive;
pub mod engine;
pub mod error;
pub mod film;
pub mod forces;
pub mod grains;
pub mod guards;
pub mod integrate;
pub mod keep;
pub mod lanes;
pub mod law;
pub mod ledger;
pub mod neighbours;
pub mod outcome;
pub mod pack;
pub mod picture;
pub mod readings;
pub mod setup;
pub mod stability;
pub mod tile;
pub mod walls;

pub use domain::{Domain, Wall};
pub use engine::{Engine, Settings};
pub use error::{GrainError, RunError};
pub use grains::{Grain, Grains, Point};
pub use law::{ContactLaw, LinearSpring};
pub use setup::{Bottom, Discrete, GrainBed};

#[cfg(test)]
mod tests;
