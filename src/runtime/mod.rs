//! What a run costs and how it is stopped.

pub mod cost;
pub mod interrupt;
pub mod pool;
pub mod rng;
