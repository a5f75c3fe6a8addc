//! Continuum models of the flow and of the bed.

mod bed_results;
pub mod exact;
pub mod laminar;
#[cfg(test)]
mod tests;
