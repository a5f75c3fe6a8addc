//! Grains one by one without a fluid: a bed, one impact, verification cases.

pub mod bed;
pub mod case;
mod error;
pub mod impact;
mod problem;
pub mod trials;

pub use error::ImpactError;
pub use problem::{Impact, Trial};
