//! Continuum models of the flow and of the bed.

mod bed_results;
pub mod exact;
pub mod laminar;
pub mod shear_cell;
pub mod sheet_flow;
#[cfg(test)]
mod tests;
pub mod two_fluid;
