//! Grains one by one without a fluid: a bed, one impact, verification cases.

mod bed;
pub mod case;
mod error;
pub(crate) mod impact;
mod problem;
pub(crate) mod verification;

pub use error::ImpactError;
pub use problem::{Impact, Verification};
