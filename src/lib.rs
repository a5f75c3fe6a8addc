//! Sediment transport from several models of the same flow, with what each one costs and how far it can be trusted.

pub mod closures;
pub mod plot;
pub mod result;
pub mod units;
