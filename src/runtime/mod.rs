//! What a run costs, the threads that share its work, random numbers.

pub mod cost;
pub mod pool;
pub mod rng;
